// Products of constant matrices with vectors of any scalar.
#pragma once

#include <type_traits>

#include <Eigen/Core>

#include "common/math/column_kernels.hpp"

namespace tisserand::mechanism {

/// y += A x with constant A (column major) and vectors of any scalar; Rows is the number of rows, or Eigen::Dynamic.
template <int Rows, class S>
void multiply_add(const Eigen::MatrixXd& A, const Eigen::Matrix<S, Eigen::Dynamic, 1>& x,
                  Eigen::Matrix<S, Eigen::Dynamic, 1>& y) {
  if constexpr (!std::is_same_v<S, double>) {
    for (Eigen::Index k = 0; k < A.cols(); ++k)
      for (Eigen::Index i = 0; i < A.rows(); ++i) y[i] += A(i, k) * x[k];
  } else if constexpr (Rows == Eigen::Dynamic) {
    y.noalias() += A * x;
  } else {
    column_kernels::multiply_add_fixed<Rows>(A.data(), A.cols(), x.data(), y.data());
  }
}

/// out += Aᵀ x.
template <class S>
void multiply_transposed_add(const Eigen::MatrixXd& A, const Eigen::Matrix<S, Eigen::Dynamic, 1>& x,
                             Eigen::Matrix<S, Eigen::Dynamic, 1>& out) {
  if constexpr (std::is_same_v<S, double>) {
    out.noalias() += A.transpose() * x;
  } else {
    for (Eigen::Index k = 0; k < A.cols(); ++k)
      for (Eigen::Index i = 0; i < A.rows(); ++i) out[k] += A(i, k) * x[i];
  }
}

}  // namespace tisserand::mechanism
