// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness and mass with one common sparsity pattern, as assembly passes them to the solvers.
#pragma once

#include <vector>

#include "common/math/count.hpp"
#include "reducer/algebra/petsc.hpp"

namespace tisserand::reducer {

/// Upper triangles, row by row. Columns ascend from the diagonal, which every row has.
struct SymmetricPair {
  std::vector<int> begin{0};  ///< rows + 1
  std::vector<int> column;
  std::vector<double> S;
  std::vector<double> M;

  int size() const { return count_of(begin) - 1; }
};

/// View of the matrix with the pattern of `pair` and `values`, which are its S or M.
SymmetricRows symmetric_rows(const SymmetricPair& pair, const std::vector<double>& values);

/// S and M as PETSc's symmetric matrices.
struct SystemMatrices {
  Matrix stiffness;
  Matrix mass;
};

/// PETSc matrices that take the arrays over without a copy.
SystemMatrices to_petsc(SymmetricPair pair);

/// Throws Error if a matrix with that many stored entries exceeds the range of PETSc's indices.
void check_entry_count(long entries);

}  // namespace tisserand::reducer
