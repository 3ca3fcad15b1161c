// SPDX-License-Identifier: GPL-3.0-or-later
// Both products work on a few rows at a time. Rows of the block are stored as lines, and each line meets four columns
// of A.
#include "reducer/algebra/tall.hpp"

#include <algorithm>
#include <type_traits>
#include <vector>

#include "reducer/algebra/line.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Tall = Eigen::Ref<const MatrixXd>;

constexpr Index tall_rows = 128;
constexpr int tall_columns = 4;  ///< columns of A processed together

Index groups_of(Index columns) { return (columns + Line::width - 1) / Line::width; }

/// Copies rows `first` ... `first + count − 1` of B. Group g of columns begins at line `g · stride`. Columns beyond the
/// last one are zero.
void load_rows(const Tall& B, Index first, Index count, Index stride, double* lines) {
  if (count == 0) return;  // `lines` may be empty
  for (Index g = 0; g < groups_of(B.cols()); ++g)
    for (Index c = 0; c < Line::width; ++c) {
      const Index column = Line::width * g + c;
      double* const to = lines + Line::at(g * stride) + c;
      for (Index i = 0; i < count; ++i) to[Line::at(i)] = column < B.cols() ? B(first + i, column) : 0.0;
    }
}

/// Copies lines back to rows of B; the inverse of load_rows().
void store_rows(const double* lines, Index first, Index count, Index stride, Eigen::Ref<MatrixXd> B) {
  if (count == 0) return;
  for (Index column = 0; column < B.cols(); ++column) {
    const double* const from = lines + Line::at(column / Line::width * stride) + column % Line::width;
    for (Index i = 0; i < count; ++i) B(first + i, column) = from[Line::at(i)];
  }
}

// The loops are unrolled explicitly, since without -O3 the lines of four columns would not stay in registers.

/// sum_j += Σ a_ij b_i for `columns` columns of A from `a` on, `stride` numbers apart.
template <int columns>
void add_inner(const double* a, Index stride, Index count, const double* lines, double* sums) {
  Line sum[columns];
#pragma GCC unroll 4
  for (int j = 0; j < columns; ++j) sum[j] = Line::load(sums + Line::at(j));
  for (Index i = 0; i < count; ++i) {
    const Line b = Line::load(lines + Line::at(i));
#pragma GCC unroll 4
    for (int j = 0; j < columns; ++j) sum[j].add(a[j * stride + i], b);
  }
#pragma GCC unroll 4
  for (int j = 0; j < columns; ++j) sum[j].store(sums + Line::at(j));
}

/// c_i −= Σ a_ij b_j for the same arguments.
template <int columns>
void subtract_product(const double* a, Index stride, Index count, const double* factors, double* lines) {
  Line b[columns];
#pragma GCC unroll 4
  for (int j = 0; j < columns; ++j) b[j] = Line::load(factors + Line::at(j));
  for (Index i = 0; i < count; ++i) {
    Line c = Line::load(lines + Line::at(i));
#pragma GCC unroll 4
    for (int j = 0; j < columns; ++j) c.add(-a[j * stride + i], b[j]);
    c.store(lines + Line::at(i));
  }
}

/// Calls four(j) for columns j ... j + 3 and one(j) for each remaining column.
template <class Four, class One>
void for_columns(Index columns, const Four& four, const One& one) {
  Index j = 0;
  for (; j + tall_columns <= columns; j += tall_columns) four(j);
  for (; j < columns; ++j) one(j);
}

}  // namespace

MatrixXd tall_inner_products(const Tall& A, const Tall& B) {
  const Index groups = groups_of(B.cols()), stride = A.outerStride();
  std::vector<double> lines(static_cast<std::size_t>(Line::at(groups * tall_rows)));
  std::vector<double> sums(static_cast<std::size_t>(Line::at(groups * A.cols())));
  for (Index first = 0; first < A.rows(); first += tall_rows) {
    const Index count = std::min(tall_rows, A.rows() - first);
    load_rows(B, first, count, tall_rows, lines.data());
    const auto add = [&](auto columns, Index j) {
      for (Index g = 0; g < groups; ++g)
        add_inner<columns.value>(A.data() + j * stride + first, stride, count, lines.data() + Line::at(g * tall_rows),
                                 sums.data() + Line::at(g * A.cols() + j));
    };
    for_columns(
        A.cols(), [&](Index j) { add(std::integral_constant<int, tall_columns>{}, j); },
        [&](Index j) { add(std::integral_constant<int, 1>{}, j); });
  }
  MatrixXd C(A.cols(), B.cols());
  store_rows(sums.data(), 0, A.cols(), A.cols(), C);
  return C;
}

void subtract_tall_product(const Tall& A, const MatrixXd& B, Eigen::Ref<MatrixXd> C) {
  const Index groups = groups_of(B.cols()), stride = A.outerStride();
  std::vector<double> lines(static_cast<std::size_t>(Line::at(groups * tall_rows)));
  std::vector<double> factors(static_cast<std::size_t>(Line::at(groups * A.cols())));
  load_rows(B, 0, A.cols(), A.cols(), factors.data());
  for (Index first = 0; first < A.rows(); first += tall_rows) {
    const Index count = std::min(tall_rows, A.rows() - first);
    load_rows(C, first, count, tall_rows, lines.data());
    const auto subtract = [&](auto columns, Index j) {
      for (Index g = 0; g < groups; ++g)
        subtract_product<columns.value>(A.data() + j * stride + first, stride, count,
                                        factors.data() + Line::at(g * A.cols() + j),
                                        lines.data() + Line::at(g * tall_rows));
    };
    for_columns(
        A.cols(), [&](Index j) { subtract(std::integral_constant<int, tall_columns>{}, j); },
        [&](Index j) { subtract(std::integral_constant<int, 1>{}, j); });
    store_rows(lines.data(), first, count, tall_rows, C);
  }
}

}  // namespace tisserand::reducer
