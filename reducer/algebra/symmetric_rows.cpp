// SPDX-License-Identifier: GPL-3.0-or-later
// Products of sparse symmetric matrices with blocks of vectors.
#include "reducer/algebra/symmetric_rows.hpp"

#include <algorithm>
#include <vector>

#include "reducer/algebra/line.hpp"

namespace tisserand::reducer {
namespace {

/// y += A x for one line per row.
void add_product(const SymmetricRows& A, const double* x, double* y) {
  for (int i = 0; i < A.size; ++i) {
    const Line x_i = Line::load(x + Line::at(i));
    Line sum = Line::load(y + Line::at(i));
    int k = A.begin[i];
    if (k < A.begin[i + 1] && A.column[k] == i) sum.add(A.value[k++], x_i);
    for (; k < A.begin[i + 1]; ++k) {
      const std::ptrdiff_t j = Line::at(A.column[k]);
      sum.add(A.value[k], Line::load(x + j));
      Line y_j = Line::load(y + j);
      y_j.add(A.value[k], x_i);
      y_j.store(y + j);
    }
    sum.store(y + Line::at(i));
  }
}

}  // namespace

Eigen::MatrixXd multiply(const SymmetricRows& A, const Eigen::MatrixXd& X) {
  Eigen::MatrixXd Y(X.rows(), X.cols());
  const auto lines = static_cast<std::size_t>(Line::at(X.rows()));
  std::vector<double> x(lines), y(lines);
  const auto same = [](Eigen::Index i) { return i; };
  for (Eigen::Index first = 0; first < X.cols(); first += Line::width) {
    to_lines(X, first, same, x.data());
    std::fill(y.begin(), y.end(), 0.0);
    add_product(A, x.data(), y.data());
    from_lines(y.data(), first, same, Y);
  }
  return Y;
}

}  // namespace tisserand::reducer
