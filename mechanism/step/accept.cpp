// SPDX-License-Identifier: GPL-3.0-or-later
// Work done once per step.
#include "mechanism/step/accept.hpp"

#include <algorithm>

#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/round_off.hpp"
#include "mechanism/step/convergence.hpp"
#include "mechanism/step/redundancy.hpp"
#include "mechanism/step/step_control.hpp"

namespace tisserand::mechanism {
namespace {

/// Stores what all methods keep, and integrates powers by the trapezoidal rule, except those of damped superelements.
void accept(const Model& model, double step, const Evaluation& now, Dissipation& dissipation, State& state) {
  settle(model, now, state);
  state.acceleration_scale() = std::max(state.acceleration_scale(), size_of(model, state.algorithmic()));
  state.work() += 0.5 * step * (state.load_power() + now.load_power);
  const double damping = damping_power(model, now);
  state.dissipated() += 0.5 * step * (state.damping_power() + damping) + dissipation.beyond_trapezoid(model, step, now);
  state.load_power() = now.load_power;
  state.damping_power() = damping;
}

}  // namespace

void settle(const Model& model, const Evaluation& now, State& state) {
  // A length off by ε would be off by ε tan²(θ/2) after a step: beyond a quarter of a turn that grows without bound.
  auto Q = state.Q();
  for (Eigen::Index i = 0; i < Q.cols(); ++i) Q.col(i).normalize();
  auto frames = state.frames();
  for (std::size_t i = 0; i < model.superelements.size(); ++i)
    frames.col(i) = wxyz(Eigen::Quaterniond(now.superelements[i].motion.R0).normalized());
  unwrap_hinges(model, now, state);
  for (int k = 0; k < 3; ++k) state.force_scale(k) = std::max(state.force_scale(k), now.force_scale[k]);
}

bool begin(const Model& model, const StepScheme& scheme, const State& state, Workspace& workspace, StepReport& report) {
  if (Dissipation& dissipation = workspace.memory.dissipation; dissipation.begins()) {
    evaluate(model, state, workspace.now);
    dissipation.begin(model, workspace.now);
  }
  if (!scheme.projects) return true;
  const FactorReport factors = prepare_projection(model, state, scheme, workspace.now, workspace.memory.projection);
  if (factors.regular && factors.reciprocal_condition >= singular_condition) return true;
  report.outcome = StepOutcome::singular;
  report.singular_column = factors.singular_column;
  return false;
}

void finish(Iteration& it) {
  const formats::IntegratorSpec& options = it.options;
  const double step = it.scheme.step;
  StepMemory& memory = it.workspace.memory;
  if (options.error_control.active) {
    Eigen::VectorXd& error = it.workspace.matrix.increment;
    estimate_error(options, step, it.state, memory.previous, error);
    const LocalError worst =
        measure_error(it.model, options.error_control, step / (options.end - options.start), error);
    it.report.error_ratio = worst.ratio;
    if (!(worst.ratio <= 1.0)) {
      it.report.outcome = StepOutcome::inaccurate;
      it.report.worst_coordinate = worst.worst_coordinate;
      it.report.worst_constraint = -1;
      it.state.block() = memory.previous.block();
      return;
    }
  }
  // Index 3 integrates twice what Newton's iteration leaves of its constraints. There a step has to end far below the
  // tolerance, as it does from the constant prediction.
  if (options.formulation == formats::Formulation::stabilised_index2) {
    memory.predictor.learn(it.model, step, memory.tuning.smooth_rate, memory.previous, it.state);
    age_projection(it.model, memory.tuning, it.workspace.now, memory.projection);
  }
  accept(it.model, step, it.workspace.now, memory.dissipation, it.state);
  memory.rows.note_turn(it.model, step, it.state);
}

bool rows_are_doubtful(const Model& model, const StepReport& report, const State& state, const Evaluation& evaluation) {
  if (report.outcome == StepOutcome::inaccurate) return false;
  if (report.outcome == StepOutcome::accepted)
    return largest_violation(model, evaluation, Rows::left_out).value > largest_left_out;
  return is_overconstrained(state) || report.outcome == StepOutcome::singular;
}

bool renew_rows(const Model& model, State& state, Workspace& workspace) {
  if (!workspace.memory.rows.renew(model, state, workspace.now)) return false;
  workspace.forget();
  return true;
}

bool choose_rows_again(const Model& model, State& state, Workspace& workspace) {
  const State end = state;
  state.block() = workspace.memory.previous.block();
  if (!choose_active_rows(model, state, workspace.now) || state.active().sum() < end.active().sum()) {
    state.block() = end.block();
    if (!choose_active_rows(model, state, workspace.now)) return false;
    const Eigen::VectorXd rows = state.active();
    state.block() = workspace.memory.previous.block();
    state.active() = rows;
  }
  workspace.forget();
  return true;
}

}  // namespace tisserand::mechanism
