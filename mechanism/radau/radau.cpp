// SPDX-License-Identifier: GPL-3.0-or-later
// One step: predict, iterate, estimate, close, accept. Formula numbers are those of docs/THEORY.md.
#include "mechanism/radau/radau.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/round_off.hpp"
#include "mechanism/model/node_coordinates.hpp"
#include "mechanism/step/accept.hpp"
#include "mechanism/step/convergence.hpp"
#include "mechanism/step/step_control.hpp"

namespace tisserand::mechanism {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
/// Largest turn of a node in a step with error control [rad]: angles of joints are unwrapped from step to step.
constexpr double longest_turn = 1.5;
constexpr int most_projections = 4;
/// A violation that projections do not reduce is round-off if it is below this times the allowed one.
constexpr double stuck = 1e3;

}  // namespace

Radau::Radau(const Model& model, const formats::IntegratorSpec& options)
    : model_(model), options_(options), newton_(model), stages_(model.sizes), last_(model.sizes) {}

void Radau::forget() {
  newton_.forget();
  size_.forget();
  last_.step = 0.0;
  parts_age_ = 0;
}

radau::Accuracy Radau::accuracy() const {
  radau::Accuracy accuracy;
  accuracy.fresh_parts = parts_age_ == 0;
  // Multipliers have order 3 where positions have 5 ([HW96] VII.4).
  accuracy.multipliers =
      std::pow(options_.error_control.active ? options_.error_control.tolerance : options_.tolerance, 3.0 / 5.0);
  if (options_.error_control.active) {
    accuracy.units = radau::estimate_tolerance(options_.error_control);
    accuracy.newton = std::min(tuning_.newton_share, std::sqrt(accuracy.units.tolerance));
    accuracy.most_iterations = std::min(tuning_.most_iterations, options_.max_iterations);
    return accuracy;
  }
  // The tolerance is relative to the motion of the step, but not below round-off.
  formats::ErrorControl whole;
  whole.tolerance = 1.0;
  double motion = 0.0;
  for (int i = 0; i < 3; ++i) motion = std::max(motion, measure_error(model_, whole, 1.0, stages_.d.col(i)).ratio);
  accuracy.units.tolerance = std::max(options_.tolerance * motion, 16.0 * epsilon);
  accuracy.most_iterations = options_.max_iterations;
  return accuracy;
}

double Radau::farthest_turn() const {
  double turn = 0.0;
  for (const Node& node : model_.nodes)
    if (node.rotation >= 0) turn = std::max(turn, rotation_at(model_, stages_.d.col(2), node.rotation).norm());
  return turn;
}

bool Radau::solve_stages(const StepEnd& end, State& state, Workspace& workspace, StepReport& report) {
  const State& begin = workspace.memory.previous;
  if (!newton_.ready(end.time - begin.time(), report)) return false;
  radau::predict(model_, begin, end, last_, stages_);
  return newton_.iterate(accuracy(), stages_, state, workspace, report);  // THEORY (73), (74), (77)
}

bool Radau::accurate(const State& begin, StepReport& report) {
  if (!options_.error_control.active) return true;
  newton_.estimate(stages_, begin);  // THEORY (76)
  const LocalError worst =
      measure_error(model_, radau::estimate_tolerance(options_.error_control), 1.0, newton_.correction);
  const double turn = farthest_turn() / longest_turn;
  report.error_ratio = turn > 1.0 ? std::max(worst.ratio, std::pow(turn, 4.0)) : worst.ratio;
  if (std::isnan(worst.ratio)) report.error_ratio = worst.ratio;
  if (report.error_ratio <= 1.0) {
    report.proposed = size_.after(tuning_, stages_.step, report.error_ratio, report.iterations, newton_.contraction());
    return true;
  }
  report.outcome = StepOutcome::inaccurate;
  report.worst_coordinate = worst.worst_coordinate;
  report.proposed = std::isnan(report.error_ratio)
                        ? 0.5 * stages_.step
                        : size_.instead(tuning_, stages_.step, report.error_ratio, report.iterations);
  return false;
}

bool Radau::ready_to_close(const State& state, Evaluation& now, StepReport& report) {
  if (newton_.contraction() <= tuning_.renew_rate) return true;
  newton_.renew(state, now);
  parts_age_ = -1;  // these are the parts of the next step
  return newton_.ready_real(report.proposed > 0.0 ? report.proposed : stages_.step, report);
}

bool Radau::close(State& state, Evaluation& now, StepReport& report) {
  const double reach = state.x().cols() > 0 ? state.x().cwiseAbs().maxCoeff() / model_.length : 0.0;
  const double closed = std::max(options_.constraint_tolerance, 4.0 * epsilon * (1.0 + reach));
  double last = 0.0;
  for (int count = 0;; ++count) {
    evaluate(model_, state, now);
    const auto [worst, row] = largest_violation(model_, now, Rows::solved);
    if (row >= 0) report.worst_constraint = row;
    report.constraint = worst * model_.length;
    report.constraint_ratio = worst / closed;
    if (worst <= closed || (count > 1 && worst > 0.5 * last && worst < stuck * closed)) break;
    last = worst;
    if (count == 0 && !ready_to_close(state, now, report)) return false;
    if (count == most_projections || std::isnan(worst)) {
      report.outcome = std::isnan(worst) ? StepOutcome::diverged : StepOutcome::too_many_iterations;
      return false;
    }
    newton_.project(now.constraint, now);
    retract(model_, state, newton_.correction, state);
  }
  report.worst_constraint = -1;
  if (parts_age_ >= 0 && !ready_to_close(state, now, report)) return false;
  if (model_.sizes.constraints == 0) return true;
  newton_.project(now.constraint_rate, now);
  state.v() += newton_.correction;
  return true;
}

void Radau::accept(State& state, Workspace& workspace, StepReport& report) {
  const Evaluation& now = workspace.now;
  report.residual =
      now.residual.cwiseProduct(model_.equation_scale.head(model_.sizes.boundary).matrix()).lpNorm<Eigen::Infinity>();
  settle(model_, now, state);
  state.algorithmic() = state.vdot();
  state.step() = stages_.step;
  state.acceleration_scale() = std::max(state.acceleration_scale(), size_of(model_, state.vdot()));
  state.work() += integral(stages_, stages_.load_power, 1.0);
  state.dissipated() += integral(stages_, stages_.damping_power, 1.0);
  state.load_power() = now.load_power;
  state.damping_power() = damping_power(model_, now);
  workspace.memory.rows.note_turn(model_, stages_.step, state);
  std::swap(stages_, last_);
  ++parts_age_;
}

StepReport Radau::take_step(const StepEnd& end, State& state, Workspace& workspace) {
  StepReport report;
  State& begin = workspace.memory.previous;
  begin.block() = state.block();
  const auto renew = [&] {
    evaluate(model_, state, workspace.now);
    newton_.renew(state, workspace.now);
    parts_age_ = 0;
  };
  if (!newton_.has_parts()) renew();
  bool solved = solve_stages(end, state, workspace, report);
  if (!solved && parts_age_ > 0 && report.outcome != StepOutcome::singular) {
    report.outcome = StepOutcome::accepted;
    state.block() = begin.block();
    renew();
    solved = solve_stages(end, state, workspace, report);
  }
  if (!solved && options_.error_control.active) report.proposed = newton_.shorter() * (end.time - begin.time());
  if (solved && accurate(begin, report)) {
    radau::set_stage(model_, begin, 2, stages_, state);
    if (close(state, workspace.now, report)) {  // THEORY (75)
      accept(state, workspace, report);
      return report;
    }
    report.proposed = options_.error_control.active ? 0.5 * stages_.step : 0.0;
  }
  if (parts_age_ < 0) parts_age_ = 1;  // renewed at the end of a rejected step
  state.block() = begin.block();
  return report;
}

StepReport Radau::advance(const StepEnd& end, State& state, Workspace& workspace) {
  bool chosen = renew_rows(model_, state, workspace);
  if (chosen) forget();
  StepReport report = take_step(end, state, workspace);
  if (rows_are_doubtful(model_, report, state, workspace.now) && choose_rows_again(model_, state, workspace)) {
    forget();
    const StepReport first = report;
    report = take_step(end, state, workspace);
    report.count(first);
    chosen = true;
  }
  report.row_choices = chosen;
  return report;
}

void Radau::interpolate(double time, State& state, Workspace& workspace) {
  const State& begin = workspace.memory.previous;
  const double tau = (time - begin.time()) / last_.step;
  state.time() = time;
  state.load_time() = time;
  radau::interpolate(model_, begin, tau, last_, state);
  state.hinges() = begin.hinges();
  state.frames() = begin.frames();
  evaluate(model_, state, workspace.now);
  for (int count = 0; count < most_projections; ++count) {
    if (!(largest_violation(model_, workspace.now, Rows::solved).value > options_.constraint_tolerance)) break;
    newton_.project(workspace.now.constraint, workspace.now);
    retract(model_, state, newton_.correction, state);
    evaluate(model_, state, workspace.now);
  }
  newton_.project(workspace.now.constraint_rate, workspace.now);
  state.v() += newton_.correction;
  settle(model_, workspace.now, state);
  state.work() = begin.work() + integral(last_, last_.load_power, tau);
  state.dissipated() = begin.dissipated() + integral(last_, last_.damping_power, tau);
}

}  // namespace tisserand::mechanism
