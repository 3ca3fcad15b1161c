// SPDX-License-Identifier: GPL-3.0-or-later
// A view of a sparse symmetric matrix: its upper triangle, row by row.
#pragma once

#include <Eigen/Core>

namespace tisserand::reducer {

/// View of a sparse symmetric matrix: its upper triangle, row by row. Row i has the columns column[begin[i]] to
/// column[begin[i + 1] − 1], ascending from the diagonal on.
struct SymmetricRows {
  int size = 0;
  const int* begin = nullptr;
  const int* column = nullptr;
  const double* value = nullptr;
};

/// Product A X, eight columns at a time. Each column of the result is independent of the other columns, to the last
/// bit.
Eigen::MatrixXd multiply(const SymmetricRows& A, const Eigen::MatrixXd& X);

}  // namespace tisserand::reducer
