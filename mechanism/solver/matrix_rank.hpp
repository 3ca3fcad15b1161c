// SPDX-License-Identifier: GPL-3.0-or-later
// Rank and dependent columns of a sparse matrix, and vectors without their component in its null space.
#pragma once

#include <vector>

#include <Eigen/SparseCore>

namespace tisserand::mechanism {

/// Fraction of the largest singular value or pivot below which others count as zero in constraint Jacobians (rows
/// scaled with the characteristic length).
inline constexpr double rank_tolerance = 1e-10;

struct ColumnRank {
  int rank = 0;
  std::vector<int> dependent;  ///< dependent columns, ascending; the others have full rank
};

/// Rank by SuiteSparseQR. Its cost grows with the fill, so linearly for chains and trees. A column is dependent if its
/// remainder, after projection on those before it, is shorter than `tolerance`.
ColumnRank column_rank(const Eigen::SparseMatrix<double>& A, double tolerance);

/// A⁺ A x: x without its component in the null space of A. Pivots below `tolerance` times the largest count as zero. Up
/// to 400 columns by a complete orthogonal decomposition, above by conjugate gradients on the normal equations.
Eigen::VectorXd without_null_space(const Eigen::SparseMatrix<double>& A, const Eigen::VectorXd& x, double tolerance);

}  // namespace tisserand::mechanism
