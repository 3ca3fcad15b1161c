// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness and mass with one common sparsity pattern, as assembly passes them to the solvers.
#pragma once

#include <vector>

#include "common/math/count.hpp"
#include "reducer/algebra/petsc.hpp"

namespace tisserand::reducer {

/// Sparse symmetric matrices S and M with one pattern: upper triangles, row by row. The columns of a row ascend from
/// the diagonal, which every row has.
struct SymmetricPair {
  std::vector<int> begin{0};  ///< rows + 1 numbers: index of the first entry of each row, then the number of entries
  std::vector<int> column;
  std::vector<double> S;
  std::vector<double> M;

  int size() const { return count_of(begin) - 1; }
};

/// View of S or M of `pair`. `values`: pair.S or pair.M.
SymmetricRows symmetric_rows(const SymmetricPair& pair, const std::vector<double>& values);

/// Stiffness S and mass M as symmetric PETSc matrices.
struct SystemMatrices {
  Matrix stiffness;
  Matrix mass;
};

/// Makes PETSc matrices of S and M, which take the arrays of `pair` over without a copy.
SystemMatrices to_petsc(SymmetricPair pair);

/// Throws Error if a matrix with `entries` stored entries exceeds the range of the indices of PETSc.
void check_entry_count(long entries);

}  // namespace tisserand::reducer
