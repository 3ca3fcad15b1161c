// SPDX-License-Identifier: GPL-3.0-or-later
// Prescribed motion of a coordinate: value, rate and acceleration over time.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "mechanism/forces/motion_table.hpp"
#include "mechanism/forces/time_function.hpp"

namespace tisserand::mechanism {

/// Prescribed motion of a coordinate: value f, rate ḟ and acceleration f̈ of a formats::TimeFunctionSpec. Tables become
/// a MotionTable. Expressions get central differences of order six, exact for polynomials of degree six. The caller
/// chooses their `spacing`; a quarter of the step resolves all that the step resolves. Near a breakpoint all seven
/// points move to the side of the requested derivatives. So each side of a jump has its own value and acceleration,
/// whichever piece the formula assigns to the breakpoint.
class MotionFunction {
 public:
  MotionFunction(const formats::TimeFunctionSpec& spec, double spacing, const ExpressionScope& scope);
  MotionFunction(const formats::TimeFunctionSpec& spec, double spacing)
      : MotionFunction(spec, spacing, ExpressionScope{}) {}

  using Value = MotionValue;
  /// Values at t. At a breakpoint they are those of the side of the instant `side`: before, or after the breakpoint if
  /// `side` is equal to it or later. Caches the last instant, because the iterations of a step use one instant.
  Value operator()(double t, double side);
  Value operator()(double t) { return (*this)(t, t); }

 private:
  Value differences(double t, double side);

  TimeFunction function_;
  double spacing_;
  std::vector<double> breakpoints_;  ///< breakpoints of an expression, ascending
  double last_time_ = std::numeric_limits<double>::quiet_NaN(), last_side_ = last_time_;
  Value last_;
  std::optional<MotionTable> table_;  ///< absent: `function_` is used
};

}  // namespace tisserand::mechanism
