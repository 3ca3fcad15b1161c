// SPDX-License-Identifier: GPL-3.0-or-later
// Predictive control of steps, [HW96] IV.8 (8.21) to (8.25).
#include "mechanism/radau/step_size.hpp"

#include <algorithm>
#include <cmath>

namespace tisserand::mechanism::radau {
namespace {

/// Smaller errors, relative to the tolerance, count as this value. A very small error of one step predicts nothing.
constexpr double least_error = 1e-2;

double quotient(const Tuning& tuning, double quotient) {
  return std::clamp(quotient, 1.0 / tuning.most_growth, 1.0 / tuning.most_reduction);
}

/// Quotient of this step and the next, from the error of this step alone. Fewer iterations allow a longer next step.
double by_error(const Tuning& tuning, double error, int iterations) {
  const int n = 2 * tuning.most_iterations;
  const double factor = std::min(tuning.safety, tuning.safety * (1 + n) / (iterations + n));
  return quotient(tuning, std::pow(error, 0.25) / factor);
}

}  // namespace

formats::ErrorControl estimate_tolerance(const formats::ErrorControl& control) {
  formats::ErrorControl inner = control;
  inner.tolerance = 0.1 * std::pow(control.tolerance, 2.0 / 3.0);
  return inner;
}

double StepSize::after(const Tuning& tuning, double step, double error, int iterations, double contraction) {
  double ratio = by_error(tuning, error, iterations);
  if (last_step > 0.0)
    ratio = std::max(ratio,
                     quotient(tuning, last_step / step * std::pow(error * error / last_error, 0.25) / tuning.safety));
  last_step = step;
  last_error = std::max(least_error, error);
  double next = step / ratio;
  if (rejected) next = std::min(next, step);
  rejected = false;
  const bool stays = contraction <= tuning.renew_rate && next >= step && next <= tuning.keep_growth * step;
  return stays ? step : next;
}

double StepSize::instead(const Tuning& tuning, double step, double error, int iterations) {
  rejected = true;
  return last_step == 0.0 ? 0.1 * step : step / std::max(by_error(tuning, error, iterations), 1.0 / tuning.safety);
}

}  // namespace tisserand::mechanism::radau
