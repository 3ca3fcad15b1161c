// SPDX-License-Identifier: GPL-3.0-or-later
// Slopes and pieces of tables.
#include "mechanism/forces/curve.hpp"

#include <algorithm>

namespace tisserand::mechanism {
namespace {

/// Slopes at the points: [FB84] (2) inside, zero curvature at the ends.
std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  std::vector<double> secant(n - 1), slope(n, 0.0);
  for (std::size_t i = 0; i + 1 < n; ++i) secant[i] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = secant[i - 1], after = secant[i];
    if (before * after <= 0.0) continue;
    const double h0 = x[i] - x[i - 1], h1 = x[i + 1] - x[i];
    const double alpha = (h0 + 2.0 * h1) / (3.0 * (h0 + h1));
    slope[i] = before * after / (alpha * after + (1.0 - alpha) * before);
  }
  if (n == 2) {
    slope.assign(2, secant[0]);
  } else {
    slope.front() = 0.5 * (3.0 * secant.front() - slope[1]);
    slope.back() = 0.5 * (3.0 * secant.back() - slope[n - 2]);
  }
  return slope;
}

}  // namespace

Curve::Curve(const formats::LawSpec& law) {
  if (const double* factor = std::get_if<double>(&law)) {
    factor_ = *factor;
    return;
  }
  const formats::CurveSpec& table = std::get<formats::CurveSpec>(law);
  const std::vector<double>&x = table.x, &y = table.y;
  const bool cubic = table.interpolation == formats::Interpolation::cubic;
  const std::vector<double> slope = cubic ? monotone_slopes(x, y) : std::vector<double>{};
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double h = x[i + 1] - x[i], secant = (y[i + 1] - y[i]) / h;
    Piece p{x[i], y[i], secant, 0.0, 0.0, 0.0};
    if (cubic) {
      p.c1 = slope[i];
      p.c2 = (3.0 * secant - 2.0 * slope[i] - slope[i + 1]) / h;
      p.c3 = (slope[i] + slope[i + 1] - 2.0 * secant) / (h * h);
    }
    if (i == 0)
      pieces_.push_back({x[0], y[0], p.c1, 0.0, 0.0, 0.0});
    else
      p.integral = pieces_.back().at(x[i]).integral;
    pieces_.push_back(p);
  }
  const Value end = pieces_.back().at(x.back());
  pieces_.push_back({x.back(), y.back(), end.slope, 0.0, 0.0, end.integral});
  at_zero_ = piece(0.0).at(0.0).integral;
}

Curve::Value Curve::Piece::at(double x) const {
  const double t = x - start;
  return {value + t * (c1 + t * (c2 + t * c3)), c1 + t * (2.0 * c2 + t * 3.0 * c3),
          integral + t * (value + t * (c1 / 2.0 + t * (c2 / 3.0 + t * c3 / 4.0)))};
}

const Curve::Piece& Curve::piece(double x) const {
  if (x < pieces_.front().start) return pieces_.front();
  const auto next = std::upper_bound(pieces_.begin() + 1, pieces_.end(), x,
                                     [](double at, const Piece& candidate) { return at < candidate.start; });
  return *(next - 1);
}

Curve::Value Curve::operator()(double x) const {
  if (pieces_.empty()) return {factor_ * x, factor_, 0.5 * factor_ * x * x};
  Value v = piece(x).at(x);
  v.integral -= at_zero_;
  return v;
}

}  // namespace tisserand::mechanism
