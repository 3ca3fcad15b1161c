// Functions of time and laws between two quantities, as a scene gives them.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "formats/tables/time_table.hpp"

namespace tisserand::formats {

/// Function of time: a number, a table (linear between points, constant outside) or an expression in t.
struct TimeExpression {
  std::string text;
  std::vector<double> breakpoints;  ///< steps end here
  std::string where;
};
using TimeFunctionSpec = std::variant<double, TimeTable, TimeExpression>;

/// A law between two quantities: proportional, or a table y(x) with ascending x.
enum class Interpolation { linear, cubic };
struct CurveSpec {
  Interpolation interpolation = Interpolation::linear;
  std::vector<double> x;
  std::vector<double> y;
};
using LawSpec = std::variant<double, CurveSpec>;

}  // namespace tisserand::formats
