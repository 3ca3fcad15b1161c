// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of time and laws between two quantities, as given in a scene.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "formats/tables/time_table.hpp"

namespace tisserand::formats {

/// Expression in the time t, one of the three forms of TimeFunctionSpec. The others are a number and a table (linear
/// between points, constant outside).
struct TimeExpression {
  std::string text;
  std::vector<double> breakpoints;  ///< instants at which time steps must end
  std::string where;
};
using TimeFunctionSpec = std::variant<double, TimeTable, TimeExpression>;

/// Interpolation between the points of a CurveSpec.
enum class Interpolation { linear, cubic };
/// Curve y(x) with ascending x. With LawSpec, a law between two quantities is a factor (proportional) or a curve.
struct CurveSpec {
  Interpolation interpolation = Interpolation::linear;
  std::vector<double> x;
  std::vector<double> y;
};
using LawSpec = std::variant<double, CurveSpec>;

}  // namespace tisserand::formats
