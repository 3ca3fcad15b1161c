// SPDX-License-Identifier: GPL-3.0-or-later
// Local error of a step, and the size of the next one.
#include "mechanism/step/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanism/model/node_coordinates.hpp"
#include "mechanism/step/step.hpp"

namespace tisserand::mechanism {
namespace {

/// Safety factor and bounds of the change, as usual for one-step methods. [HW96] IV.8 has 0.9, 0.2 and 1.2, below which
/// steps stay and keep their factors. Growth is bounded by 2, since multipliers have a transient after each change
/// (DECISIONS.md, "Index 3 and a change of step").
constexpr double safety = 0.9;
constexpr double most_growth = 2.0;
constexpr double least_growth = 1.2;
constexpr double most_reduction = 0.2;

}  // namespace

void estimate_error(const formats::IntegratorSpec& options, double step, const State& state, const State& last,
                    Eigen::VectorXd& error) {
  const AlphaParameters p = alpha_parameters(options);
  const double C = std::abs(1.0 / 6.0 - p.beta - 0.5 * (p.alpha_m - p.alpha_f));
  const double rebuilt = last.step() > 0.0 ? step / last.step() : 1.0;
  error = (C * step * step) * (state.algorithmic() - last.vdot() - rebuilt * (last.algorithmic() - last.vdot()));
}

LocalError measure_error(const Model& model, const formats::ErrorControl& control, double share,
                         const Eigen::Ref<const Eigen::VectorXd>& error) {
  LocalError worst;
  // Takes the largest of `size` coordinates from `first`. `unit`: one unit of the tolerance. The first NaN stays.
  const auto look_at = [&](int first, int size, double unit) {
    for (int k = first; k < first + size; ++k) {
      const double ratio = std::abs(error[k]) / (unit * share);
      if (ratio <= worst.ratio || std::isnan(worst.ratio)) continue;
      worst = {ratio, k};
    }
  };
  const double length = control.tolerance * model.length;
  for (const Node& node : model.nodes) {
    if (node.translation >= 0) look_at(node.translation, translations_of(model), length);
    if (node.rotation >= 0) look_at(node.rotation, rotations_of(model), control.tolerance);
  }
  for (const ModalBody& body : model.modal_bodies)
    look_at(model.sizes.first_modal() + body.offset, body.modes, length * std::sqrt(body.mass));
  for (const Tyre& tyre : model.tyres)
    if (tyre.relaxes()) look_at(model.sizes.first_modal() + tyre.lag, 2, length);
  for (std::size_t i = 0; i < model.superelements.size(); ++i)
    look_at(model.sizes.boundary + model.internal_offset[i], body_of(model, i).modes,
            length * std::sqrt(body_of(model, i).mass));
  return worst;
}

double next_step(const formats::IntegratorSpec& options, double step, double ratio) {
  double factor = ratio > 0.0 ? std::clamp(safety / std::sqrt(ratio), most_reduction, most_growth) : most_growth;
  if (factor > 1.0 && factor < least_growth) factor = 1.0;
  return std::clamp(factor * step, least_step(options), greatest_step(options));
}

double shorter_step(double step, double ratio) {
  const double factor = ratio > 0.0 ? std::clamp(safety / std::sqrt(ratio), most_reduction, safety) : 0.5;
  return factor * step;
}

double instant_tolerance(double step, double time) {
  const double written = std::min(1e-11 * std::abs(time), 1e-3 * step);  // rounding of scene values with 12 digits
  return std::max({1e-9 * step, written, 8.0 * std::numeric_limits<double>::epsilon() * std::abs(time)});
}

double least_step(const formats::IntegratorSpec& options) {
  return options.error_control.min_step > 0.0 ? options.error_control.min_step : 1e-12 * (options.end - options.start);
}

double greatest_step(const formats::IntegratorSpec& options) {
  return options.error_control.max_step > 0.0 ? options.error_control.max_step : 0.1 * (options.end - options.start);
}

}  // namespace tisserand::mechanism
