// SPDX-License-Identifier: GPL-3.0-or-later
// Finite differences of expressions.
#include "mechanism/forces/motion_function.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tisserand::mechanism {
namespace {

constexpr int points = 7;

/// Weights of the values at −3, … 3 for the value, the first and the second derivative at s (Fornberg, Mathematics of
/// Computation 51, 1988, 699).
std::array<std::array<double, points>, 3> weights_at(double s) {
  std::array<std::array<double, points>, 3> w{};
  w[0][0] = 1.0;
  double product = 1.0, distance = -3.0 - s;
  for (int n = 1; n < points; ++n) {
    double own = 1.0;
    const double before = distance;
    distance = n - 3.0 - s;
    for (int k = 0; k < n; ++k) {
      const double apart = n - k;
      own *= apart;
      if (k == n - 1)
        for (int m = 2; m >= 0; --m) w[m][n] = product / own * ((m > 0 ? m * w[m - 1][k] : 0.0) - before * w[m][k]);
      for (int m = 2; m >= 0; --m) w[m][k] = (distance * w[m][k] - (m > 0 ? m * w[m - 1][k] : 0.0)) / apart;
    }
    product = own;
  }
  return w;
}

}  // namespace

MotionFunction::MotionFunction(const formats::TimeFunctionSpec& spec, double spacing, const ExpressionScope& scope)
    : function_(spec, scope), spacing_(spacing) {
  if (const auto* table = std::get_if<formats::TimeTable>(&spec))
    table_.emplace(*table);
  else
    breakpoints_ = function_.breakpoints();
  std::ranges::sort(breakpoints_);
}

MotionFunction::Value MotionFunction::operator()(double t, double side) {
  if (t != last_time_ || side != last_side_) {
    last_ = table_ ? (*table_)(t) : differences(t, side);
    last_time_ = t;
    last_side_ = side;
  }
  return last_;
}

MotionFunction::Value MotionFunction::differences(double t, double side) {
  // Round-off of t must not move a point to the next piece, whose value at the breakpoint may differ.
  constexpr double ulps = 4.0 * std::numeric_limits<double>::epsilon();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double d = spacing_, center = t, first = -infinity, last = infinity;
  const auto next = std::ranges::upper_bound(breakpoints_, side);
  const bool begins = next != breakpoints_.begin(), ends = next != breakpoints_.end();
  if (begins) first = *(next - 1) + ulps * std::abs(*(next - 1));
  if (ends) last = *next - ulps * std::abs(*next);
  if (begins && ends) d = std::min(d, (last - first) / (points - 1));
  if (begins) center = std::max(center, first + 3.0 * d);
  if (ends) center = std::min(center, last - 3.0 * d);
  std::array<double, points> f{};
  for (int k = 0; k < points; ++k) f[k] = function_(center + (k - 3) * d);
  Value v;
  if (center == t) {  // central differences of order six
    v.value = f[3];
    v.rate = (45.0 * (f[4] - f[2]) - 9.0 * (f[5] - f[1]) + (f[6] - f[0])) / (60.0 * d);
    v.acceleration =
        (270.0 * (f[4] + f[2]) - 27.0 * (f[5] + f[1]) + 2.0 * (f[6] + f[0]) - 490.0 * f[3]) / (180.0 * d * d);
    return v;
  }
  const auto w = weights_at((t - center) / d);
  const bool inside = first <= t && t <= last;
  if (inside) v.value = function_(t);
  for (int k = 0; k < points; ++k) {
    if (!inside) v.value += w[0][k] * f[k];
    v.rate += w[1][k] * f[k] / d;
    v.acceleration += w[2][k] * f[k] / (d * d);
  }
  return v;
}

}  // namespace tisserand::mechanism
