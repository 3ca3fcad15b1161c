// SPDX-License-Identifier: GPL-3.0-or-later
// Rank and dependent columns of a sparse matrix, and vectors without their component in its null space.
#pragma once

#include <vector>

#include <Eigen/SparseCore>

namespace tisserand::mechanism {

/// Fraction of the largest singular value or pivot below which others count as zero, for constraint Jacobians scaled
/// with the characteristic length.
inline constexpr double rank_tolerance = 1e-10;

/// Rank of a matrix, and its dependent columns.
struct ColumnRank {
  int rank = 0;
  std::vector<int> dependent;  ///< dependent columns, ascending; the other columns have full rank
};

/// Computes the rank of A and its dependent columns by SuiteSparseQR. The cost grows with the fill, so linearly for
/// chains and trees. A column is dependent if its remainder, after projection on the columns before it, is shorter than
/// `tolerance`.
ColumnRank column_rank(const Eigen::SparseMatrix<double>& A, double tolerance);

/// Vector x without its component in the null space of A: A⁺ A x. Pivots below `tolerance` times the largest count as
/// zero. Up to 400 columns it uses a complete orthogonal decomposition, above it conjugate gradients on the normal
/// equations.
Eigen::VectorXd without_null_space(const Eigen::SparseMatrix<double>& A, const Eigen::VectorXd& x, double tolerance);

}  // namespace tisserand::mechanism
