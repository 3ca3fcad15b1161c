// SPDX-License-Identifier: GPL-3.0-or-later
// Rates and accelerations at the points of a table, and the polynomials between them.
#include "mechanism/forces/motion_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/math/count.hpp"

namespace tisserand::mechanism {
namespace {

/// Rate and acceleration at a point.
struct Slopes {
  double d = 0.0;
  double s = 0.0;
};

/// Slopes at point i of Newton's polynomial through the five points nearest by number (all, if there are fewer).
Slopes polynomial_slopes(const std::vector<double>& t, const std::vector<double>& y, int i) {
  const int count = std::min<int>(5, count_of(t));
  const int first = std::clamp(i - 2, 0, count_of(t) - count);
  std::array<double, 5> x{}, c{};
  for (int k = 0; k < count; ++k) {
    x[k] = t[first + k] - t[i];
    c[k] = y[first + k] - y[i];
  }
  for (int order = 1; order < count; ++order)
    for (int k = count - 1; k >= order; --k) c[k] = (c[k] - c[k - 1]) / (x[k] - x[k - order]);
  double p = 0.0;
  Slopes out;
  for (int k = count - 1; k >= 0; --k) {
    out.s = -x[k] * out.s + 2.0 * out.d;
    out.d = -x[k] * out.d + p;
    p = -x[k] * p + c[k];
  }
  return out;
}

/// An interval of the table, seen from one of its ends.
struct Side {
  double h = 0.0;       ///< length of the interval
  double secant = 0.0;  ///< mean rate of the interval
  double share = 0.5;   ///< share of its rise within which the control points of this end stay
};

/// Limits the slopes so that the quintic is monotone. It is monotone if its control points are, in steps of h/5: y,
/// y + h d/5, y + 2 h d/5 + h² s/20, and likewise from the other end. Those of one end stay ascending within a share of
/// the rise, those of the other within the rest: −4 d/h ≤ s ≤ (20 share Δ − 8 d)/h after the point, with −s before it.
/// A solution s exists if d is below the limit computed here. `sign` makes rates of the rise positive.
Slopes limited(Slopes given, double sign, const Side* behind, const Side* ahead) {
  double most = std::numeric_limits<double>::infinity();
  for (const Side* side : {behind, ahead})
    if (side != nullptr) most = std::min(most, 5.0 * side->share * sign * side->secant);
  if (behind != nullptr && ahead != nullptr)
    most = std::min(most, 2.5 * sign *
                              (behind->share * behind->secant * ahead->h + ahead->share * ahead->secant * behind->h) /
                              (behind->h + ahead->h));
  const double d = std::clamp(sign * given.d, 0.0, most);
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  const auto room = [&](const Side& side) { return (20.0 * side.share * sign * side.secant - 8.0 * d) / side.h; };
  if (ahead != nullptr) {
    low = std::max(low, -4.0 * d / ahead->h);
    high = std::min(high, room(*ahead));
  }
  if (behind != nullptr) {
    low = std::max(low, -room(*behind));
    high = std::min(high, 4.0 * d / behind->h);
  }
  return {sign * d, sign * std::min(std::max(sign * given.s, low), high)};
}

/// Slopes at an extremum of the data: rate 0, and an acceleration inwards on both sides (`sign` of the rise before).
Slopes turning(Slopes given, double sign, const Side& behind, const Side& ahead) {
  const double most = 20.0 * std::min(behind.share * std::abs(behind.secant) / behind.h,
                                      ahead.share * std::abs(ahead.secant) / ahead.h);
  return {0.0, -sign * std::clamp(-sign * given.s, 0.0, most)};
}

/// Share of the rise of an interval that belongs to its first end: halfway between the inner control points of the
/// requested slopes.
double first_share(double h, double secant, const Slopes& a, const Slopes& b) {
  if (secant == 0.0) return 0.5;
  const double from_a = 0.4 * a.d + h * a.s / 20.0, from_b = secant - 0.4 * b.d + h * b.s / 20.0;
  return std::clamp(0.5 * (from_a + from_b) / secant, 0.125, 0.875);
}

std::vector<Slopes> smooth_slopes(const std::vector<double>& t, const std::vector<double>& y) {
  const int n = count_of(t);
  std::vector<double> h(n - 1), secant(n - 1), share(n - 1);
  for (int i = 0; i + 1 < n; ++i) {
    h[i] = t[i + 1] - t[i];
    secant[i] = (y[i + 1] - y[i]) / h[i];
  }
  const auto held = [&](int i) { return (i > 0 && y[i] == y[i - 1]) || (i + 1 < n && y[i] == y[i + 1]); };
  const auto turns = [&](int i) { return i > 0 && i + 1 < n && (y[i] > y[i - 1]) != (y[i + 1] > y[i]); };
  std::vector<Slopes> slopes(n);
  for (int i = 0; i < n; ++i) {
    if (held(i)) continue;
    slopes[i] = polynomial_slopes(t, y, i);
    if (turns(i)) slopes[i].d = 0.0;
  }
  for (int i = 0; i + 1 < n; ++i) share[i] = first_share(h[i], secant[i], slopes[i], slopes[i + 1]);
  for (int i = 0; i < n; ++i) {
    if (held(i)) continue;
    Side behind, ahead;
    if (i > 0) behind = {h[i - 1], secant[i - 1], 1.0 - share[i - 1]};
    if (i + 1 < n) ahead = {h[i], secant[i], share[i]};
    const double rise = i > 0 ? behind.secant : ahead.secant, sign = rise > 0.0 ? 1.0 : -1.0;
    slopes[i] = turns(i) ? turning(slopes[i], sign, behind, ahead)
                         : limited(slopes[i], sign, i > 0 ? &behind : nullptr, i + 1 < n ? &ahead : nullptr);
  }
  return slopes;
}

/// Second derivatives of the natural cubic spline at the points (tridiagonal elimination).
std::vector<double> spline_curvature(const std::vector<double>& t, const std::vector<double>& y) {
  const int n = count_of(t);
  std::vector<double> m(n, 0.0), upper(n, 0.0);
  for (int i = 1; i + 1 < n; ++i) {
    const double h0 = t[i] - t[i - 1], h1 = t[i + 1] - t[i];
    const double right = 6.0 * ((y[i + 1] - y[i]) / h1 - (y[i] - y[i - 1]) / h0);
    const double pivot = 2.0 * (h0 + h1) - h0 * upper[i - 1];
    upper[i] = h1 / pivot;
    m[i] = (right - h0 * m[i - 1]) / pivot;
  }
  for (int i = n - 1; i-- > 1;) m[i] -= upper[i] * m[i + 1];
  return m;
}

/// Coefficients of the Hermite quintic over a length h with the rise `rise`.
std::array<double, 6> quintic(double y, double rise, double h, const Slopes& a, const Slopes& b) {
  const double da = h * a.d, db = h * b.d, sa = h * h * a.s, sb = h * h * b.s;
  const double h3 = h * h * h;
  return {y,
          a.d,
          0.5 * a.s,
          (10.0 * rise - 6.0 * da - 4.0 * db - 1.5 * sa + 0.5 * sb) / h3,
          (-15.0 * rise + 8.0 * da + 7.0 * db + 1.5 * sa - sb) / (h3 * h),
          (6.0 * rise - 3.0 * (da + db) + 0.5 * (sb - sa)) / (h3 * h * h)};
}

}  // namespace

MotionTable::MotionTable(const formats::TimeTable& table) {
  const std::vector<double>&t = table.time, &y = table.value;
  const int n = count_of(t);
  last_ = t.back();
  if (n == 1) pieces_.push_back({t[0], {y[0]}});
  const std::vector<Slopes> slopes =
      table.motion == formats::TableMotion::smooth && n > 1 ? smooth_slopes(t, y) : std::vector<Slopes>{};
  const std::vector<double> curvature =
      table.motion == formats::TableMotion::natural ? spline_curvature(t, y) : std::vector<double>(n, 0.0);
  for (int i = 0; i + 1 < n; ++i) {
    const double h = t[i + 1] - t[i], rise = y[i + 1] - y[i], m0 = curvature[i], m1 = curvature[i + 1];
    if (slopes.empty())
      pieces_.push_back({t[i], {y[i], rise / h - h * (2.0 * m0 + m1) / 6.0, 0.5 * m0, (m1 - m0) / (6.0 * h)}});
    else
      pieces_.push_back({t[i], quintic(y[i], rise, h, slopes[i], slopes[i + 1])});
  }
}

MotionValue MotionTable::Piece::at(double t) const {
  const double x = t - start;
  return {c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5])))),
          c[1] + x * (2.0 * c[2] + x * (3.0 * c[3] + x * (4.0 * c[4] + x * 5.0 * c[5]))),
          2.0 * c[2] + x * (6.0 * c[3] + x * (12.0 * c[4] + x * 20.0 * c[5]))};
}

MotionValue MotionTable::operator()(double t) const {
  const double inside = std::clamp(t, pieces_.front().start, last_);
  const auto next = std::upper_bound(pieces_.begin() + 1, pieces_.end(), inside,
                                     [](double at, const Piece& candidate) { return at < candidate.start; });
  MotionValue v = (next - 1)->at(inside);
  if (t == inside) return v;
  return {v.value + v.rate * (t - inside), v.rate, 0.0};
}

}  // namespace tisserand::mechanism
