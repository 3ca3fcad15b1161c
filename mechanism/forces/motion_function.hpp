// Prescribed motion of a coordinate: value, rate and acceleration over time.
#pragma once

#include <limits>
#include <optional>

#include "mechanism/forces/motion_table.hpp"
#include "mechanism/forces/time_function.hpp"

namespace tisserand::mechanism {

/// f, ḟ, f̈ of a formats::TimeFunctionSpec. Tables become a MotionTable; expressions are differentiated by central
/// differences of order six with a spacing that the caller chooses (a quarter of the step resolves all that the step
/// resolves), which are exact for polynomials of degree six.
class MotionFunction {
 public:
  MotionFunction(const formats::TimeFunctionSpec& spec, double spacing, const ExpressionScope& scope);
  MotionFunction(const formats::TimeFunctionSpec& spec, double spacing)
      : MotionFunction(spec, spacing, ExpressionScope{}) {}

  using Value = MotionValue;
  /// Remembers the last instant: the iterations of a step ask for the same.
  Value operator()(double t);

 private:
  Value differences(double t);

  TimeFunction function_;
  double spacing_;
  double last_time_ = std::numeric_limits<double>::quiet_NaN();
  Value last_;
  std::optional<MotionTable> table_;  ///< absent: function_
};

}  // namespace tisserand::mechanism
