// SPDX-License-Identifier: GPL-3.0-or-later
// Inverse iteration a few columns at a time, in place.
#include "reducer/modes/inverse_iteration.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/Cholesky>

#include "common/stable_sort.hpp"
#include "reducer/algebra/ranks.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Keeps the columns `order`, in this order.
void take_columns(const std::vector<Index>& order, VectorXd& value, Eigen::Ref<MatrixXd> X) {
  const auto count = static_cast<Index>(order.size());
  value = VectorXd(value(order));
  if (std::is_sorted(order.begin(), order.end())) {
    for (Index k = 0; k < count; ++k)
      if (const Index from = order[k]; from != k) X.col(k) = X.col(from);
    return;
  }
  X.leftCols(count) = MatrixXd(X(Eigen::all, order));
}

/// Sorts pairs by value. Returns the order: the former index of each pair.
std::vector<Index> sort_pairs(VectorXd& value, Eigen::Ref<MatrixXd> X) {
  std::vector<Index> order(static_cast<std::size_t>(value.size()));
  std::iota(order.begin(), order.end(), 0);
  sort_stably(order, [&](Index a, Index b) { return value[a] < value[b]; });
  if (!std::is_sorted(order.begin(), order.end())) take_columns(order, value, X);
  return order;
}

/// Removes pairs that round-off hides. Expects and keeps ascending order.
void discard_unresolved(double shift, VectorXd& value, Eigen::Ref<MatrixXd> X) {
  constexpr double resolved = 1e-13;
  const Eigen::ArrayXd mu = (value.array() - shift).inverse();
  std::vector<Index> good;
  for (Index k = 0; k < mu.size(); ++k)
    if (mu[k] > resolved * mu.maxCoeff()) good.push_back(k);
  if (static_cast<Index>(good.size()) < mu.size()) take_columns(good, value, X);
}

VectorXd column_norms(const ShiftedOperator& op, const MatrixXd& Y) {
  VectorXd squares = Y.colwise().squaredNorm();
  op.sum(squares.data(), squares.size());
  return squares.cwiseSqrt();
}

VectorXd column_products(const ShiftedOperator& op, const MatrixXd& X, const MatrixXd& Y) {
  VectorXd products(X.cols());
  for (Index c = 0; c < X.cols(); ++c) products[c] = X.col(c).dot(Y.col(c));
  op.sum(products.data(), products.size());
  return products;
}

}  // namespace

void ShiftedOperator::sum(double* values, Index count) const {
  if (shared && count > 0) sum_over_ranks(values, count);
}

void ShiftedOperator::agree(double* values, Index count) const {
  if (shared && count > 0) broadcast(values, count);
}

bool ShiftedOperator::agree(bool value) const {
  double number = value ? 1.0 : 0.0;
  agree(&number, 1);
  return number != 0.0;
}

void orthonormalise(const ShiftedOperator& op, const MatrixXd& G, Eigen::Ref<MatrixXd> X) {
  const Eigen::LLT<MatrixXd, Eigen::Upper> factor(G);
  if (op.agree(factor.info() == Eigen::Success)) factor.matrixU().solveInPlace<Eigen::OnTheRight>(X);
}

VectorXd iterate_once(const ShiftedOperator& op, VectorXd& value, Eigen::Ref<MatrixXd> X) {
  constexpr double far = 1e4;
  constexpr Index at_once = 64;
  sort_pairs(value, X);
  discard_unresolved(op.shift, value, X);
  const VectorXd lambda = value.array() - op.shift;
  VectorXd residual(lambda.size());
  MatrixXd G = MatrixXd::Zero(lambda.size(), lambda.size());
  for (Index first = 0; first < lambda.size(); first += at_once) {
    const Index count = std::min(at_once, lambda.size() - first), end = first + count;
    const MatrixXd MX = op.mass(X.middleCols(first, count));
    const MatrixXd Y = op.solve(MX * lambda.segment(first, count).asDiagonal());
    MatrixXd MY = op.mass(Y);
    residual.segment(first, count) = column_norms(op, MX - MY).cwiseQuotient(column_norms(op, MY));
    const VectorXd YMX = column_products(op, Y, MX), YMY = column_products(op, Y, MY);
    for (Index c = 0; c < count; ++c) {
      const Index k = first + c;
      if (lambda[k] < far * lambda[0]) {
        value[k] = op.shift + lambda[k] * YMX[c] / YMY[c];
        X.col(k) = Y.col(c);
      } else {
        residual[k] /= 1.0 + lambda[k] / lambda[0];
        MY.col(c) = MX.col(c);
      }
    }
    G.block(0, first, end, count).noalias() = X.leftCols(end).transpose() * MY;
  }
  op.sum(G.data(), G.size());
  orthonormalise(op, G, X.leftCols(lambda.size()));
  return residual(sort_pairs(value, X.leftCols(lambda.size())));
}

VectorXd iterate_once(const ShiftedOperator& op, EigenPairs& pairs) {
  VectorXd residual = iterate_once(op, pairs.value, pairs.vector);
  if (pairs.value.size() < pairs.vector.cols()) pairs.vector.conservativeResize(Eigen::NoChange, pairs.value.size());
  return residual;
}

VectorXd refine(const ShiftedOperator& op, const std::vector<Index>& columns, EigenPairs& pairs, VectorXd& residual) {
  const MatrixXd X = pairs.vector(Eigen::all, columns), MX = op.mass(X);
  const VectorXd lambda = pairs.value(columns).array() - op.shift;
  MatrixXd Y = op.solve(MX * lambda.asDiagonal());
  for (int pass = 0; pass < 2; ++pass) {
    MatrixXd shares = pairs.vector.transpose() * op.mass(Y);
    for (const Index k : columns) shares.row(k).setZero();
    Y -= pairs.vector * shares;
  }
  const Eigen::LLT<MatrixXd> factor(Y.transpose() * op.mass(Y));
  if (factor.info() != Eigen::Success) return VectorXd::Constant(lambda.size(), 1.0);
  factor.matrixU().solveInPlace<Eigen::OnTheRight>(Y);
  const MatrixXd MY = op.mass(Y), change = MX - MY;
  VectorXd bound(lambda.size());
  for (Index c = 0; c < lambda.size(); ++c) {
    const Index k = columns[c];
    pairs.value[k] = op.shift + lambda[c] * Y.col(c).dot(MX.col(c)) / factor.matrixLLT()(c, c);
    pairs.vector.col(k) = Y.col(c);
    residual[k] = change.col(c).norm() / MY.col(c).norm();
    bound[c] = std::sqrt(std::max(0.0, (X.col(c) - Y.col(c)).dot(change.col(c))));
  }
  return bound;
}

}  // namespace tisserand::reducer
