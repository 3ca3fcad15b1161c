// SPDX-License-Identifier: GPL-3.0-or-later
// A law between two quantities: proportional, or a table with its slope and integral.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "formats/scene/scene.hpp"

namespace tisserand::mechanism {

/// Law y(x): proportional, or a table that is linear or monotone cubic between its points. The cubic of an interval is
/// that of Hermite with the slopes of [FB84] (2), 0 where the secants change sign. So it has no extremum between the
/// points. The curvature is zero at the ends. Outside the table the law continues straight with its last slope.
class Curve {
 public:
  Curve(double factor) : factor_(factor) {}  // NOLINT(google-explicit-constructor): a number is a law
  explicit Curve(const formats::LawSpec& law);

  /// Value of a curve at a point, with its slope there and its integral from 0.
  struct Value {
    double value = 0.0;
    double slope = 0.0;
    double integral = 0.0;  ///< ∫₀ˣ y dx
  };
  Value operator()(double x) const;

  /// First and last x of a table, outside which the law continues straight. A proportional law has no range.
  std::optional<std::pair<double, double>> range() const {
    if (pieces_.empty()) return std::nullopt;
    return std::pair(pieces_[1].start, pieces_.back().start);
  }

 private:
  /// Cubic value + c1 t + c2 t² + c3 t³ with t = x − start; integral: ∫ y dx from the first point to start.
  struct Piece {
    double start = 0.0, value = 0.0, c1 = 0.0, c2 = 0.0, c3 = 0.0, integral = 0.0;
    Value at(double x) const;
  };
  const Piece& piece(double x) const;

  double factor_ = 0.0;
  double at_zero_ = 0.0;       ///< integral from the first point to 0
  std::vector<Piece> pieces_;  ///< before, in and after the table; empty: proportional
};

}  // namespace tisserand::mechanism
