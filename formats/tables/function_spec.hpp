// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of time and laws between two quantities, as given in a scene.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "formats/tables/time_table.hpp"

namespace tisserand::formats {

/// Function of time: a number, a table (linear between points, constant outside) or an expression in t.
struct TimeExpression {
  std::string text;
  std::vector<double> breakpoints;  ///< instants at which steps must end
  std::string where;
};
using TimeFunctionSpec = std::variant<double, TimeTable, TimeExpression>;

/// Law between two quantities: proportional, or a table y(x) with ascending x.
enum class Interpolation { linear, cubic };
struct CurveSpec {
  Interpolation interpolation = Interpolation::linear;
  std::vector<double> x;
  std::vector<double> y;
};
using LawSpec = std::variant<double, CurveSpec>;

}  // namespace tisserand::formats
