// SPDX-License-Identifier: GPL-3.0-or-later
// Column operations on small dense matrices with a fixed or free number of rows, used by the superelement tangent.
#pragma once

#include <Eigen/Core>

namespace tisserand::mechanism {

namespace column_kernels {

/// Four doubles, processed at once by the loops of this header (one register of AVX, two of SSE). It is a `typedef`,
/// because clang ignores the alignment of 8 in an alias declaration and then uses aligned moves.
typedef double Four __attribute__((vector_size(32), aligned(8), may_alias));

inline const Four& load(const double* p) { return *reinterpret_cast<const Four*>(p); }
inline void store(double* p, const Four& v) { *reinterpret_cast<Four*>(p) = v; }

enum class Write { assign, add };

/// Computes out = in B or out += in B, with `in` and `out` (rows x 3, column by column). The number of rows is `Rows`,
/// or `free_rows` if `Rows` is Eigen::Dynamic. It is also the leading dimension of both.
template <int Rows, Write write>
inline void multiply3(const double* in, const Eigen::Matrix3d& B, int free_rows, double* out) {
  const int rows = Rows == Eigen::Dynamic ? free_rows : Rows;
  int r = 0;
  for (; r + 4 <= rows; r += 4) {
    const Four x0 = load(in + r), x1 = load(in + rows + r), x2 = load(in + 2 * rows + r);
    for (int c = 0; c < 3; ++c) {
      Four sum = x0 * B(0, c) + x1 * B(1, c) + x2 * B(2, c);
      if constexpr (write == Write::add) sum += load(out + c * rows + r);
      store(out + c * rows + r, sum);
    }
  }
  for (; r < rows; ++r) {
    const double x0 = in[r], x1 = in[rows + r], x2 = in[2 * rows + r];
    for (int c = 0; c < 3; ++c) {
      const double sum = x0 * B(0, c) + x1 * B(1, c) + x2 * B(2, c);
      out[c * rows + r] = write == Write::add ? out[c * rows + r] + sum : sum;
    }
  }
}

/// Computes out = inᵀ for matrices (rows x rows). Requires that they do not overlap. The number of rows is `Rows`, or
/// `free_rows` if `Rows` is Eigen::Dynamic.
template <int Rows>
inline void transpose(const double* in, int free_rows, double* out) {
  const int rows = Rows == Eigen::Dynamic ? free_rows : Rows;
  const int blocked = rows - rows % 4;
  for (int j = 0; j < blocked; j += 4)
    for (int i = 0; i < blocked; i += 4) {
      const double* p = in + j * rows + i;
      const Four a = load(p), b = load(p + rows), c = load(p + 2 * rows), d = load(p + 3 * rows);
      const Four ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6),
                 ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
      const Four cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6),
                 cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
      double* q = out + i * rows + j;
      store(q, __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5));
      store(q + rows, __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5));
      store(q + 2 * rows, __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7));
      store(q + 3 * rows, __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7));
    }
  for (int j = 0; j < rows; ++j)
    for (int i = j < blocked ? blocked : 0; i < rows; ++i) out[i * rows + j] = in[j * rows + i];
}

/// Adds A x to y with A (Rows x columns, column by column). Requires an even number `Rows`. Two independent sums hide
/// latency.
template <int Rows>
inline void multiply_add_fixed(const double* A, Eigen::Index columns, const double* x, double* y) {
  using Column = Eigen::Matrix<double, Rows, 1>;
  using Map = Eigen::Map<const Column>;
  Column even = Map(y), odd = Column::Zero();
  Eigen::Index k = 0;
  for (; k + 2 <= columns; k += 2, A += 2 * Rows) {
    even += x[k] * Map(A);
    odd += x[k + 1] * Map(A + Rows);
  }
  if (k < columns) even += x[k] * Map(A);
  Eigen::Map<Column>(y).noalias() = even + odd;
}

}  // namespace column_kernels

}  // namespace tisserand::mechanism
