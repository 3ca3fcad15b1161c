// SPDX-License-Identifier: GPL-3.0-or-later
// The curve of a prescribed motion through the points of a table.
#pragma once

#include <array>
#include <vector>

#include "formats/tables/time_table.hpp"

namespace tisserand::mechanism {

/// Value, rate and acceleration of a prescribed motion at one instant.
struct MotionValue {
  double value = 0.0;
  double rate = 0.0;
  double acceleration = 0.0;
};

/// Curve of polynomials through the points of a table with ascending times. Outside the table it is straight with the
/// last rate. The interpolation of the table chooses the polynomials:
/// smooth: Hermite quintics, twice continuously differentiable, monotone between any two points. Rates and
///   accelerations at the points are those of the quartic through the five nearest points, reduced where a quintic
///   would not be monotone. Equal values stay constant, and the rate is 0 at an extremum of the data. Without a limit
///   polynomials of degree 4 are exact; values err by O(h⁵) of the spacing h, rates and accelerations by O(h⁴) and
///   O(h³). Next to an extremum between two points the errors are O(h²), O(h), O(1).
/// natural: the natural cubic spline, which overshoots.
/// linear: straight, with jumps of the rate.
class MotionTable {
 public:
  explicit MotionTable(const formats::TimeTable& table);
  MotionValue operator()(double t) const;

 private:
  /// Polynomial Σ cₖ (t − start)ᵏ.
  struct Piece {
    double start = 0.0;
    std::array<double, 6> c{};
    MotionValue at(double t) const;
  };
  std::vector<Piece> pieces_;  ///< one per interval
  double last_ = 0.0;          ///< end of the table
};

}  // namespace tisserand::mechanism
