// Prescribed motion of a coordinate: value, rate and acceleration over time.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "mechanism/forces/motion_table.hpp"
#include "mechanism/forces/time_function.hpp"

namespace tisserand::mechanism {

/// f, ḟ, f̈ of a formats::TimeFunctionSpec. Tables become a MotionTable; expressions are differentiated by central
/// differences of order six with a spacing that the caller chooses (a quarter of the step resolves all that the step
/// resolves), which are exact for polynomials of degree six. Near a breakpoint the seven points move to the side on
/// which the derivatives are asked for, so that none lies beyond it: where an acceleration jumps, each side has its
/// own. So has the value, whichever piece the comparison in the formula gives to the breakpoint itself.
class MotionFunction {
 public:
  MotionFunction(const formats::TimeFunctionSpec& spec, double spacing, const ExpressionScope& scope);
  MotionFunction(const formats::TimeFunctionSpec& spec, double spacing)
      : MotionFunction(spec, spacing, ExpressionScope{}) {}

  using Value = MotionValue;
  /// At t; at a breakpoint, of the side on which `side` lies (from the breakpoint itself on: after it). Remembers the
  /// last instant: the iterations of a step ask for the same.
  Value operator()(double t, double side);
  Value operator()(double t) { return (*this)(t, t); }

 private:
  Value differences(double t, double side);

  TimeFunction function_;
  double spacing_;
  std::vector<double> breakpoints_;  ///< of an expression, ascending
  double last_time_ = std::numeric_limits<double>::quiet_NaN(), last_side_ = last_time_;
  Value last_;
  std::optional<MotionTable> table_;  ///< absent: function_
};

}  // namespace tisserand::mechanism
