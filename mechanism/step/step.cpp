// SPDX-License-Identifier: GPL-3.0-or-later
// Time step: predict, evaluate, check, factor, solve, correct, accept. Formula numbers are those of docs/THEORY.md.
#include "mechanism/step/step.hpp"

#include "mechanism/equations/increments.hpp"
#include "mechanism/step/accept.hpp"
#include "mechanism/step/newton.hpp"

namespace tisserand::mechanism {
namespace {

/// Newton's iteration from the prediction. Returns true if it converges. Returns false without an outcome in the report
/// if kept factors are discarded.
bool iterate(Iteration& it, const StepEnd& end) {
  Evaluation& now = it.workspace.now;
  const StepMemory& memory = it.workspace.memory;
  it.state.block() = memory.previous.block();
  if (!change_step(it)) return false;
  it.state.time() = end.time;
  it.state.load_time() = end.load_time;
  it.workspace.matrix.correction.setZero();
  start_projection(it.workspace.memory.projection);
  predict(it.scheme, it.state, now);  // THEORY (62) to (64)
  foresee(memory.predictor, it.scheme, memory.previous, it.state, now);
  for (;; ++it.count) {
    retract(it.model, memory.previous, now.displacement, it.state);
    evaluate_in_step(it.model, it.state, now);  // THEORY (58)
    if (converged(it)) return true;
    if (it.report.outcome != StepOutcome::accepted) return false;
    if (!ready_factors(it)) return false;
    solve(it);                                               // THEORY (69), (67)
    correct(it.scheme, it.workspace.matrix, it.state, now);  // THEORY (68)
    ++it.report.iterations;
  }
}

/// Takes a step with the constraint rows that are active in the state.
StepReport take_step(const Model& model, const formats::IntegratorSpec& options, const StepEnd& end, State& state,
                     Workspace& workspace) {
  const StepScheme scheme = step_scheme(model, options, state, end.time);
  StepMemory& memory = workspace.memory;
  StepReport report;
  memory.previous.block() = state.block();
  if (!begin(model, scheme, state, workspace, report)) return report;
  const auto cost = [&] { return report.iterations + model.solver.renewal * report.factorisations; };
  const auto succeeds_with = [&](Factors factors) {
    Iteration iteration{model, options, scheme, state, workspace, report, factors};
    const double before = cost();
    const bool succeeded = iterate(iteration, end);
    memory.reuse.count(factors, succeeded, cost() - before, memory.tuning);
    if (succeeded) finish(iteration);
    return succeeded;
  };
  if (workspace.matrix.serves(scheme.request, workspace.now) && memory.reuse.tries_kept()) {
    if (succeeds_with(Factors::kept)) return report;
    report.outcome = StepOutcome::accepted;
  }
  if (succeeds_with(Factors::fresh)) return report;
  workspace.matrix.invalidate();
  state.block() = memory.previous.block();
  return report;
}

}  // namespace

StepReport advance(const Model& model, const formats::IntegratorSpec& options, const StepEnd& end, State& state,
                   Workspace& workspace) {
  bool chosen = renew_rows(model, state, workspace);
  StepReport report = take_step(model, options, end, state, workspace);
  if (rows_are_doubtful(model, report, state, workspace.now) && choose_rows_again(model, state, workspace)) {
    const StepReport first = report;
    report = take_step(model, options, end, state, workspace);
    report.count(first);
    chosen = true;
  }
  report.row_choices = chosen;
  return report;
}

}  // namespace tisserand::mechanism
