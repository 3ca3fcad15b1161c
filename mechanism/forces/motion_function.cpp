// Differences of expressions.
#include "mechanism/forces/motion_function.hpp"

#include <array>

namespace tisserand::mechanism {

MotionFunction::MotionFunction(const formats::TimeFunctionSpec& spec, double spacing, const ExpressionScope& scope)
    : function_(spec, scope), spacing_(spacing) {
  if (const auto* table = std::get_if<formats::TimeTable>(&spec)) table_.emplace(*table);
}

MotionFunction::Value MotionFunction::operator()(double t) {
  if (t != last_time_) {
    last_ = table_ ? (*table_)(t) : differences(t);
    last_time_ = t;
  }
  return last_;
}

MotionFunction::Value MotionFunction::differences(double t) {
  const double d = spacing_;
  const double f0 = function_(t);
  const std::array<double, 3> ahead{function_(t + d), function_(t + 2.0 * d), function_(t + 3.0 * d)};
  const std::array<double, 3> back{function_(t - d), function_(t - 2.0 * d), function_(t - 3.0 * d)};
  // Central differences of order six.
  Value v;
  v.value = f0;
  v.rate = (45.0 * (ahead[0] - back[0]) - 9.0 * (ahead[1] - back[1]) + (ahead[2] - back[2])) / (60.0 * d);
  v.acceleration =
      (270.0 * (ahead[0] + back[0]) - 27.0 * (ahead[1] + back[1]) + 2.0 * (ahead[2] + back[2]) - 490.0 * f0) /
      (180.0 * d * d);
  return v;
}

}  // namespace tisserand::mechanism
