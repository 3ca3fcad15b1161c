// A view of a sparse symmetric matrix: its upper triangle, row by row.
#pragma once

#include <Eigen/Core>

namespace tisserand::reducer {

/// Row i has the columns column[begin[i]] ... column[begin[i + 1] − 1], ascending from the diagonal on.
struct SymmetricRows {
  int size = 0;
  const int* begin = nullptr;
  const int* column = nullptr;
  const double* value = nullptr;
};

/// A X, eight columns at a time. A column of the result does not depend on the others, to the last bit.
Eigen::MatrixXd multiply(const SymmetricRows& A, const Eigen::MatrixXd& X);

}  // namespace tisserand::reducer
