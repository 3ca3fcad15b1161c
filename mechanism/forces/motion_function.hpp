// Prescribed motion of a coordinate: value, rate and acceleration over time.
#pragma once

#include <limits>
#include <vector>

#include "mechanism/forces/time_function.hpp"

namespace tisserand::mechanism {

/// f, ḟ, f̈ of a formats::TimeFunctionSpec. Tables become a natural cubic spline (twice differentiable; outside the
/// table it goes on with its last slope); expressions are differentiated by central differences of order six with a
/// spacing that the caller chooses (a quarter of the step resolves all that the step resolves).
class MotionFunction {
 public:
  MotionFunction(const formats::TimeFunctionSpec& spec, double spacing, const ExpressionScope& scope);
  MotionFunction(const formats::TimeFunctionSpec& spec, double spacing)
      : MotionFunction(spec, spacing, ExpressionScope{}) {}

  struct Value {
    double value = 0.0;
    double rate = 0.0;
    double acceleration = 0.0;
  };
  /// Remembers the last instant: the iterations of a step ask for the same.
  Value operator()(double t);

 private:
  Value spline(double t) const;
  Value differences(double t);

  TimeFunction function_;
  double spacing_;
  double last_time_ = std::numeric_limits<double>::quiet_NaN();
  Value last_;
  std::vector<double> time_, value_, curvature_;  ///< of the spline; empty: function_
};

}  // namespace tisserand::mechanism
