// Rank of a sparse matrix, columns that depend on the others, and vectors without their part in its null space.
#pragma once

#include <vector>

#include <Eigen/SparseCore>

namespace tisserand::mechanism {

/// Singular values and pivots below this part of the largest count as zero in constraint Jacobians (rows scaled with
/// the characteristic length).
inline constexpr double rank_tolerance = 1e-10;

struct ColumnRank {
  int rank = 0;
  std::vector<int> dependent;  ///< columns, ascending; without them the rank is full
};

/// By SuiteSparseQR, whose cost grows with the fill, for chains and trees linearly. A column counts as dependent if
/// what is left of it, after the parts along those before it, is shorter than `tolerance`.
ColumnRank column_rank(const Eigen::SparseMatrix<double>& A, double tolerance);

/// A⁺ A x: x without its part in the null space of A, with pivots below this part of the largest taken for zero. Up to
/// 400 columns by a complete orthogonal decomposition, above by conjugate gradients on the normal equations.
Eigen::VectorXd without_null_space(const Eigen::SparseMatrix<double>& A, const Eigen::VectorXd& x, double tolerance);

}  // namespace tisserand::mechanism
