// SPDX-License-Identifier: GPL-3.0-or-later
// Products of constant matrices with vectors of any scalar.
#pragma once

#include <type_traits>

#include <Eigen/Core>

#include "common/math/column_kernels.hpp"

namespace tisserand::mechanism {

/// Adds A x to y, for a constant A (column major) and vectors of any scalar. 6, 9 and 12 rows have code of fixed size,
/// which is faster; at 18 rows it is slower (docs/PERFORMANCE.md). One or two boundary nodes give these numbers of
/// rows. A node without rotations has three.
template <class S>
void multiply_add(const Eigen::MatrixXd& A, const Eigen::Matrix<S, Eigen::Dynamic, 1>& x,
                  Eigen::Matrix<S, Eigen::Dynamic, 1>& y) {
  if constexpr (!std::is_same_v<S, double>) {
    for (Eigen::Index k = 0; k < A.cols(); ++k)
      for (Eigen::Index i = 0; i < A.rows(); ++i) y[i] += A(i, k) * x[k];
  } else {
    switch (A.rows()) {
      case 6:
        return column_kernels::multiply_add_fixed<6>(A.data(), A.cols(), x.data(), y.data());
      case 9:
        return column_kernels::multiply_add_fixed<9>(A.data(), A.cols(), x.data(), y.data());
      case 12:
        return column_kernels::multiply_add_fixed<12>(A.data(), A.cols(), x.data(), y.data());
      default:
        y.noalias() += A * x;
    }
  }
}

/// Adds Aᵀ x to `out`, for a constant A and vectors of any scalar.
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

/// Adds factor · A x to `out`. A and x have the same scalar S.
template <class S>
void multiply_add(const Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>& A,
                  const Eigen::Matrix<S, Eigen::Dynamic, 1>& x, S factor, Eigen::Matrix<S, Eigen::Dynamic, 1>& out) {
  if constexpr (std::is_same_v<S, double>) {
    out.noalias() += factor * A * x;
  } else {
    for (Eigen::Index k = 0; k < A.cols(); ++k)
      for (Eigen::Index i = 0; i < A.rows(); ++i) out[i] += factor * A(i, k) * x[k];
  }
}

/// Adds Aᵀ x to `out`, with the first `Rows` rows of A. A and x have the same scalar S. A may have more rows, as
/// padding.
template <int Rows, class S>
void add_transposed(const Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>& A, const Eigen::Matrix<S, Rows, 1>& x,
                    Eigen::Matrix<S, Eigen::Dynamic, 1>& out) {
  for (Eigen::Index k = 0; k < A.cols(); ++k) {
    const Eigen::Map<const Eigen::Matrix<S, Rows, 1>> column(A.data() + k * A.rows(), x.size());
    if constexpr (std::is_same_v<S, double>) {
      out[k] += column.dot(x);
    } else {
      for (Eigen::Index a = 0; a < x.size(); ++a) out[k] += column[a] * x[a];
    }
  }
}

/// Inner product x · y of vectors with the scalar S or double.
template <class S, class X, class Y>
S inner_product(const X& x, const Y& y) {
  if constexpr (std::is_same_v<S, double>) {
    return x.dot(y);
  } else {
    S sum(0.0);
    for (Eigen::Index i = 0; i < x.size(); ++i) sum += x[i] * y[i];
    return sum;
  }
}

}  // namespace tisserand::mechanism
