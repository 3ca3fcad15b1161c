// SPDX-License-Identifier: GPL-3.0-or-later
// Reference line: spline, search by boxes, Newton's method.
#include "mechanism/tyres/reference_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tisserand::mechanism {
namespace {

using Eigen::Vector2d;

/// Number of points in the smallest boxes.
constexpr int points_of_leaf = 8;
/// Least value of 1 − (p − r)·r''/(r'·r'), which bounds the derivative of (p − r)·r': the line must not bend more.
constexpr double least_slope = 0.1;

/// r'' of the cubic spline: r''ᵢ₋₁ + 4 r''ᵢ + r''ᵢ₊₁ = 6 (rᵢ₋₁ − 2 rᵢ + rᵢ₊₁)/h², with r''₀ = r''₁, r''ₙ = r''ₙ₋₁.
std::vector<Vector2d> spline_curvature(const std::vector<Vector2d>& r, double h) {
  const std::size_t n = r.size() - 1;
  std::vector<Vector2d> second(n + 1, Vector2d::Zero());
  std::vector<double> upper(n + 1, 0.0);
  for (std::size_t i = 1; i < n; ++i) {
    const double pivot = 4.0 - upper[i - 1] + (i == 1 ? 1.0 : 0.0) + (i + 1 == n ? 1.0 : 0.0);
    upper[i] = 1.0 / pivot;
    second[i] = (6.0 / (h * h) * (r[i - 1] - 2.0 * r[i] + r[i + 1]) - second[i - 1]) / pivot;
  }
  for (std::size_t i = n; i-- > 1;) second[i] -= upper[i] * second[i + 1];
  if (n > 1) {
    second[0] = second[1];
    second[n] = second[n - 1];
  }
  return second;
}

Vector2d left_of(const Vector2d& d) { return Vector2d(-d.y(), d.x()).normalized(); }

}  // namespace

ReferenceLine::ReferenceLine(const Eigen::Matrix2Xd& points, double u_begin, double u_end)
    : u_begin_(u_begin), step_((u_end - u_begin) / static_cast<double>(points.cols() - 1)) {
  for (Eigen::Index i = 0; i < points.cols(); ++i) points_.emplace_back(points.col(i));
  second_ = spline_curvature(points_, step_);
  build(0, 0, last() + 1);
}

void ReferenceLine::build(int box, int first, int end) {
  if (box >= count_of(boxes_)) boxes_.resize(box + 1);
  for (int i = first; i < end; ++i) boxes_[box].extend(points_[i]);
  if (end - first <= points_of_leaf) return;
  const int middle = (first + end) / 2;
  build(2 * box + 1, first, middle);
  build(2 * box + 2, middle, end);
}

void ReferenceLine::search(int box, int first, int end, const Vector2d& p, Nearest& nearest) const {
  if (end - first <= points_of_leaf) {
    for (int i = first; i < end; ++i)
      if (const double distance = (p - points_[i]).squaredNorm(); distance < nearest.distance) nearest = {distance, i};
    return;
  }
  const int middle = (first + end) / 2, lower = 2 * box + 1, upper = lower + 1;
  const double to_lower = boxes_[lower].squaredExteriorDistance(p), to_upper = boxes_[upper].squaredExteriorDistance(p);
  const bool begin_lower = to_lower <= to_upper;
  for (const bool low : {begin_lower, !begin_lower})
    if ((low ? to_lower : to_upper) < nearest.distance)
      search(low ? lower : upper, low ? first : middle, low ? middle : end, p, nearest);
}

ReferenceLine::At ReferenceLine::at(double u) const {
  const double along = (u - u_begin_) / step_;
  const int i =
      std::clamp(static_cast<int>(std::floor(std::clamp(along, 0.0, static_cast<double>(last())))), 0, last() - 1);
  const Vector2d &a = second_[i], &b = second_[i + 1], chord = (points_[i + 1] - points_[i]) / step_;
  const double x = std::clamp(along - i, 0.0, 1.0), y = 1.0 - x, h = step_;
  At at;
  at.r = y * points_[i] + x * points_[i + 1] + h * h / 6.0 * ((y * y * y - y) * a + (x * x * x - x) * b);
  at.d1 = chord + h / 6.0 * ((1.0 - 3.0 * y * y) * a + (3.0 * x * x - 1.0) * b);
  at.d2 = y * a + x * b;
  if (const double beyond = along < 0.0 ? along : along > last() ? along - last() : 0.0; beyond != 0.0) {
    at.r += beyond * h * at.d1;
    at.d2.setZero();
  }
  return at;
}

LinePlace ReferenceLine::find(const Vector2d& p) const {
  Nearest nearest{std::numeric_limits<double>::infinity(), 0};
  search(0, 0, last() + 1, p, nearest);
  double u = u_begin_ + step_ * nearest.point;
  At line = at(u);
  const auto derivative = [&] {
    const double square = line.d1.squaredNorm();
    return std::max(square - (p - line.r).dot(line.d2), least_slope * square);
  };
  const double enough = 1e-15 * (std::abs(u) + step_ + p.lpNorm<1>());
  for (int i = 0; i < 50; ++i) {
    const double full = (p - line.r).dot(line.d1) / derivative();
    // The solution is near the nearest of the points, except beyond the ends, where the line is straight.
    const bool bent = last() > 1 && u > u_begin_ && u < u_begin_ + step_ * last();
    const double change = bent ? std::clamp(full, -step_, step_) : full;
    u += change;
    line = at(u);
    if (std::abs(change) <= enough) break;
  }
  const Vector2d n = left_of(line.d1);
  return {u, (p - line.r).dot(n), line.d1 / derivative(), n};
}

Vector2d ReferenceLine::point(double u, double v) const {
  const At line = at(u);
  return line.r + v * left_of(line.d1);
}

double ReferenceLine::sharp_bend(double v_right, double v_left) const {
  for (int i = 1; i < last(); ++i) {
    const double u = u_begin_ + step_ * i;
    const At line = at(u);
    const double bend = line.d2.dot(left_of(line.d1)) / line.d1.squaredNorm();
    if (1.0 - bend * v_left < least_slope || 1.0 - bend * v_right < least_slope) return u;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace tisserand::mechanism
