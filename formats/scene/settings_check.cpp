// SPDX-License-Identifier: GPL-3.0-or-later
// Checks ranges of the settings of integrator, statics and output.
#include "formats/scene/check_parts.hpp"

#include <cmath>

#include "formats/results/blocks.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

/// Subject of findings about a group of settings, for example "integrator".
Subject settings(const std::string& group, const std::string& where, Faults& faults) {
  return {group, where, faults, group + "."};
}

void check_times(const IntegratorSpec& spec, const Subject& group) {
  group.positive("step", spec.step);
  group.finite("start", spec.start);
  if (!(spec.end > spec.start) || !std::isfinite(spec.end)) {
    group.add("end", fmt::format("end {:g} must be later than start {:g}", spec.end, spec.start));
    return;
  }
  const double steps = (spec.end - spec.start) / spec.step;
  constexpr double most = 1e12;
  if (spec.step > 0.0 && steps > most)
    group.add("step", fmt::format("step {:g} makes {:.3g} steps; the limit is {:g}", spec.step, steps, most),
              "give a larger step");
}

void check_accuracy(const IntegratorSpec& spec, const Subject& group) {
  const ErrorControl& control = spec.error_control;
  group.positive("error_control.tolerance", control.tolerance);
  group.not_negative("error_control.min_step", control.min_step);
  group.not_negative("error_control.max_step", control.max_step);
  if (control.max_step > 0.0 && control.max_step < control.min_step)
    group.add("error_control.max_step",
              fmt::format("max_step {:g} is smaller than min_step {:g}", control.max_step, control.min_step));
  if (spec.accuracy) {
    group.positive("accuracy.error", spec.accuracy->error);
    if (spec.accuracy->error > 0.5)
      group.add("accuracy.error", fmt::format("accuracy.error {:g} must be at most 0.5", spec.accuracy->error),
                "give a relative error, such as 1e-3");
    if (spec.accuracy->of.empty()) group.add("accuracy.of", "'of' is empty", "name a channel of the results");
  }
  group.positive("relative_tolerance", spec.bdf.relative_tolerance);
  group.positive("absolute_tolerance", spec.bdf.absolute_tolerance);
}

/// Checks the settings of the scene, or of the analysis at `where`.
void check_groups(const Scene& scene, const std::string& where, Faults& faults) {
  const Subject integrator = settings("integrator", where, faults), statics = settings("statics", where, faults),
                output = settings("output", where, faults), modes = settings("modes", where, faults),
                checkpoint = settings("checkpoint", where, faults);
  const IntegratorSpec& spec = scene.integrator;
  if (takes_steps(scene.analysis)) check_times(spec, integrator);
  check_accuracy(spec, integrator);
  if (spec.method == Method::radau && spec.linear_solver == LinearSolver::qr)
    integrator.add("linear_solver", "linear_solver: qr does not support complex values, which method: radau needs",
                   "use auto, klu, umfpack or dense");
  integrator.between("rho", spec.rho, 0.0, 1.0);
  integrator.between("alpha", spec.alpha, 0.0, 1.0 / 3.0);
  integrator.positive("tolerance", spec.tolerance);
  integrator.positive("constraint_tolerance", spec.constraint_tolerance);
  integrator.at_least("max_iterations", spec.max_iterations, 1);
  integrator.at_least("max_halvings", spec.max_halvings, 0);
  statics.at_least("load_steps", scene.statics.load_steps, 1);
  statics.positive("tolerance", scene.statics.tolerance);
  statics.at_least("max_iterations", scene.statics.max_iterations, 1);
  output.at_least("every", scene.output.every, 1);
  output.positive("interval", scene.output.interval);
  output.finite("from", scene.output.from);
  if (takes_steps(scene.analysis) && scene.output.from > spec.end && spec.end > spec.start)
    output.add("from",
               fmt::format("from {:g} is later than the end {:g} of the integrator", scene.output.from, spec.end),
               "nothing would be stored; give an earlier time");
  for (const std::string& channel : scene.output.channels)
    if (channel.empty())
      output.add("channels", "a channel has no name");
    else if (const auto fault = fault_of_selection(channel))
      output.add("channels", fault->first, fault->second);
  if (const auto& rotation = scene.statics.rotation)
    if (!rotation->angular_velocity.allFinite() || !rotation->about.allFinite())
      statics.add("rotation", "rotation must be finite");
  modes.at_least("count", scene.modes.count, 1);
  if (scene.modes.rotation) modes.finite("rotation", *scene.modes.rotation);
  checkpoint.at_least("every", scene.checkpoint.every, 1);
  checkpoint.positive("interval", scene.checkpoint.interval);
  if ((scene.checkpoint.every || scene.checkpoint.interval) && spec.method == Method::bdf &&
      scene.analysis == AnalysisKind::dynamics)
    checkpoint.add(scene.checkpoint.every ? "every" : "interval", "method: bdf writes no checkpoints",
                   "use generalised_alpha or hht, or remove 'checkpoint'");
}

}  // namespace

void check_settings(const Scene& scene, Faults& faults) {
  std::vector<std::string> names;
  for (const Analysis& analysis : scene.analyses) {
    check_name("analysis", analysis, names, faults);
    check_groups(scene_of(scene, analysis), analysis.where, faults);
  }
  if (scene.analyses.empty()) check_groups(scene, scene.file, faults);
  Subject{"", scene.file, faults}.positive("initial_tolerance", scene.initial_tolerance);
}

}  // namespace tisserand::formats
