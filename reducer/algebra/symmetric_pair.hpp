// Stiffness and mass with one common sparsity pattern: the form of the matrices between assembly and the solvers.
#pragma once

#include <vector>

#include "common/math/count.hpp"
#include "reducer/algebra/petsc.hpp"

namespace tisserand::reducer {

/// Upper triangles, row by row: columns ascend and begin with the diagonal, which every row has.
struct SymmetricPair {
  std::vector<int> begin{0};  ///< rows + 1
  std::vector<int> column;
  std::vector<double> S;
  std::vector<double> M;

  int size() const { return count_of(begin) - 1; }
};

/// The matrix with the pattern of `pair` and the values S or M of it.
SymmetricRows symmetric_rows(const SymmetricPair& pair, const std::vector<double>& values);

/// S and M as PETSc's symmetric matrices.
struct SystemMatrices {
  Matrix stiffness;
  Matrix mass;
};

/// Takes the arrays over without copying them.
SystemMatrices to_petsc(SymmetricPair pair);

/// Throws Error if a matrix with that many stored entries exceeds the range of PETSc's indices.
void check_entry_count(long entries);

}  // namespace tisserand::reducer
