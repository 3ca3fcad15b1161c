// Differences of expressions and splines of tables.
#include "mechanism/forces/motion_function.hpp"

#include <algorithm>
#include <array>

namespace tisserand::mechanism {
namespace {

/// Second derivatives at the points of the natural cubic spline (tridiagonal elimination).
std::vector<double> spline_curvature(const std::vector<double>& t, const std::vector<double>& y) {
  const std::size_t n = t.size();
  std::vector<double> m(n, 0.0), upper(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double h0 = t[i] - t[i - 1], h1 = t[i + 1] - t[i];
    const double right = 6.0 * ((y[i + 1] - y[i]) / h1 - (y[i] - y[i - 1]) / h0);
    const double pivot = 2.0 * (h0 + h1) - h0 * upper[i - 1];
    upper[i] = h1 / pivot;
    m[i] = (right - h0 * m[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) m[i] -= upper[i] * m[i + 1];
  return m;
}

}  // namespace

MotionFunction::MotionFunction(const formats::TimeFunctionSpec& spec, double spacing, const ExpressionScope& scope)
    : function_(spec, scope), spacing_(spacing) {
  const auto* table = std::get_if<formats::TimeTable>(&spec);
  if (table == nullptr || table->time.size() < 2) return;
  time_ = table->time;
  value_ = table->value;
  curvature_ = spline_curvature(time_, value_);
}

MotionFunction::Value MotionFunction::spline(double t) const {
  const double inside = std::clamp(t, time_.front(), time_.back());
  const auto next = std::upper_bound(time_.begin() + 1, time_.end() - 1, inside);
  const auto i = static_cast<std::size_t>(next - time_.begin());
  const double h = time_[i] - time_[i - 1], a = (time_[i] - inside) / h, b = 1.0 - a;
  const double m0 = curvature_[i - 1], m1 = curvature_[i];
  Value v;
  v.value = a * value_[i - 1] + b * value_[i] + ((a * a * a - a) * m0 + (b * b * b - b) * m1) * h * h / 6.0;
  v.rate = (value_[i] - value_[i - 1]) / h + ((3.0 * b * b - 1.0) * m1 - (3.0 * a * a - 1.0) * m0) * h / 6.0;
  v.acceleration = a * m0 + b * m1;
  if (t == inside) return v;
  v.value += v.rate * (t - inside);
  v.acceleration = 0.0;
  return v;
}

MotionFunction::Value MotionFunction::operator()(double t) {
  if (t != last_time_) {
    last_ = time_.empty() ? differences(t) : spline(t);
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
