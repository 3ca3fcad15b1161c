// SPDX-License-Identifier: GPL-3.0-or-later
// Slopes at the points of a grid, and the cubics between them.
#include "mechanism/tyres/height_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tisserand::mechanism {
namespace {

constexpr int stencil = 5;

/// Derivative at x[at] of the polynomial through `count` points from `first` on.
template <class Value>
double derivative_of_polynomial(const std::vector<double>& x, const Value& value, int first, int count, int at) {
  double sum = 0.0;
  for (int k = first; k < first + count; ++k) {
    if (k == at) continue;
    double weight = 1.0 / (x[k] - x[at]);  // derivative of the Lagrange polynomial of k at x[at]
    for (int m = first; m < first + count; ++m)
      if (m != k && m != at) weight *= (x[at] - x[m]) / (x[k] - x[m]);
    sum += weight * (value(k) - value(at));
  }
  return sum;
}

/// Stores derivatives along a line of a grid, for each run of finite values; not-a-number at the others.
template <class Value, class Store>
void differentiate(const std::vector<double>& x, const Value& value, const Store& store) {
  const int size = count_of(x);
  for (int begin = 0, end = 0; begin < size; begin = end + 1) {
    for (end = begin; end < size && std::isfinite(value(end));) ++end;
    const int count = std::min(stencil, end - begin);
    for (int i = begin; i < end; ++i)
      store(i, derivative_of_polynomial(x, value, std::clamp(i - stencil / 2, begin, end - count), count, i));
    if (end < size) store(end, std::numeric_limits<double>::quiet_NaN());
  }
}

/// Weights of the values and slopes at both ends of the interval of one coordinate, and their derivatives. Outside of
/// the axis those of the straight continuation.
struct HermiteWeights {
  int first = 0;
  double value[2], slope[2], d_value[2], d_slope[2];

  HermiteWeights(const std::vector<double>& axis, double at) {
    const int last = count_of(axis) - 2;
    first = std::clamp(static_cast<int>(std::ranges::upper_bound(axis, at) - axis.begin()) - 1, 0, last);
    const double begin = axis[first], end = axis[first + 1], h = end - begin, x = (at - begin) / h;
    if (!(x >= 0.0) || x > 1.0) {
      const int side = x > 1.0 ? 1 : 0;
      for (int a = 0; a < 2; ++a) {
        value[a] = d_slope[a] = a == side ? 1.0 : 0.0;
        slope[a] = a != side ? 0.0 : at - (a == 0 ? begin : end);
        d_value[a] = 0.0;
      }
      return;
    }
    const double y = 1.0 - x;
    value[0] = y * y * (1.0 + 2.0 * x);
    value[1] = x * x * (1.0 + 2.0 * y);
    slope[0] = h * x * y * y;
    slope[1] = -h * x * x * y;
    d_value[0] = -6.0 * x * y / h;
    d_value[1] = -d_value[0];
    d_slope[0] = y * (y - 2.0 * x);
    d_slope[1] = x * (x - 2.0 * y);
  }
};

}  // namespace

HeightGrid::HeightGrid(const formats::RoadHeights& heights)
    : along_(heights.along), across_(heights.across), nodes_(along_.size() * across_.size()) {
  const int rows = count_of(along_), columns = width();
  const auto at = [&](int i, int k) -> Node& { return nodes_[i * columns + k]; };
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < columns; ++k) at(i, k).z = heights.height(i, k);
  for (int i = 0; i < rows; ++i)
    differentiate(
        across_, [&](int k) { return at(i, k).z; }, [&](int k, double slope) { at(i, k).by_t = slope; });
  for (int k = 0; k < columns; ++k) {
    differentiate(
        along_, [&](int i) { return at(i, k).z; }, [&](int i, double slope) { at(i, k).by_s = slope; });
    differentiate(
        along_, [&](int i) { return at(i, k).by_t; }, [&](int i, double twist) { at(i, k).by_st = twist; });
  }
  if (!heights.height.allFinite()) fill_holes();
}

void HeightGrid::fill_holes() {
  const int rows = count_of(along_), columns = width();
  missing_.resize(nodes_.size());
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    if (!std::isfinite(nodes_[n].z)) {
      missing_[n] = 1;
      nodes_[n] = {nodes_[n].z, 0.0, 0.0, 0.0};
    }
  const auto take = [this](int n, int from) {
    if (!std::isfinite(nodes_[n].z)) nodes_[n].z = nodes_[from].z;
  };
  for (int i = 0; i < rows; ++i) {
    for (int k = 1; k < columns; ++k) take(i * columns + k, i * columns + k - 1);
    for (int k = columns - 1; k > 0; --k) take(i * columns + k - 1, i * columns + k);
  }
  for (int n = columns; n < rows * columns; ++n) take(n, n - columns);
  for (int n = rows * columns - 1; n >= columns; --n) take(n - columns, n);
}

GridHeight HeightGrid::at(double s, double t) const {
  const HermiteWeights along(along_, s), across(across_, t);
  GridHeight h;
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      const Node& n = nodes_[(along.first + a) * width() + across.first + b];
      const double z = across.value[b] * n.z + across.slope[b] * n.by_t;
      const double by_s = across.value[b] * n.by_s + across.slope[b] * n.by_st;
      h.value += along.value[a] * z + along.slope[a] * by_s;
      h.by_s += along.d_value[a] * z + along.d_slope[a] * by_s;
      h.by_t += along.value[a] * (across.d_value[b] * n.z + across.d_slope[b] * n.by_t) +
                along.slope[a] * (across.d_value[b] * n.by_s + across.d_slope[b] * n.by_st);
    }
  return h;
}

bool HeightGrid::is_hole(double s, double t) const {
  if (missing_.empty()) return false;
  const HermiteWeights along(along_, s), across(across_, t);
  for (const int i : {along.first, along.first + 1})
    for (const int k : {across.first, across.first + 1})
      if (missing_[i * width() + k] != 0) return true;
  return false;
}

}  // namespace tisserand::mechanism
