// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of dynamics, by the steps of a schedule, and of statics.
#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/doubts/failure_cause.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/run/automatic_effects.hpp"
#include "mechanism/run/checkpoint.hpp"
#include "mechanism/run/output.hpp"
#include "mechanism/run/run.hpp"
#include "mechanism/run/schedule.hpp"
#include "mechanism/run/stepper.hpp"
#include "mechanism/step/road_ahead.hpp"
#include "mechanism/step/step.hpp"

namespace tisserand::mechanism {
namespace {

/// Data of the loop of steps besides the run.
struct StepLoop {
  Stepper stepper;
  Schedule schedule;
  Checkpoints checkpoints;
  StepReport last;  ///< report of the last accepted step
  double last_size = 0.0;
  double tried_at, first_tried = 0.0;  ///< start of the present step, and its size before it was shortened
};

/// Stores the last accepted state of a run that ends early, if the schedule has not stored it.
void write_last_row(Run& run, const StepReport& step, double size, RowWriter& out) {
  const double time = run.built.state.time();
  if (run.report.steps == 0 || out.row.time == time || time < run.scene.output.from) return;
  write_row(run, step, size, out);
}

/// Stores the rows that the step to the present state has passed without ending there.
void store_rows_between(Run& run, StepLoop& loop, RowWriter& out) {
  State& state = run.built.state;
  std::optional<State> end;
  while (const std::optional<double> due = loop.schedule.pass_instant(end ? end->time() : state.time())) {
    if (!end) end.emplace(state);
    loop.stepper.interpolate(*due, state, run.workspace);
    write_row(run, loop.last, loop.last_size, out);
  }
  if (end) state.block() = end->block();
}

/// Reason to end the run after a failed step; empty: a shorter step follows.
std::string failure_of(Run& run, const StepReport& step, const StepEnd& target, StepLoop& loop) {
  RunReport& report = run.report;
  const double before = run.built.state.time();
  ++report.rejected;
  if (step.outcome == StepOutcome::inaccurate) ++report.inaccurate;
  const std::string why =
      fmt::format("t = {:.6g}{}, step {:.3g}{}: {}", before, after_time(run.scene.units), target.time - before,
                  after_time(run.scene.units), explain(run.built.model, step));
  if (report.rejections.size() < 20) report.rejections.push_back(why);
  const std::string load = nonfinite_load(run, target.load_time);
  if (!load.empty()) return load + "; correct the formula, or end the run earlier";
  if (loop.schedule.retry(before, step)) return {};
  return fmt::format("{} ({}){}", why, loop.schedule.limit(run.scene.units),
                     failure_cause(run.built.model, run.scene.integrator, run.doubts, {step, loop.first_tried},
                                   run.built.state, run.workspace));
}

/// Massless bodies are where forces balance. If they start elsewhere, they jump there in the first step. A note reports
/// the energy of this jump, and the balance does not count it as lost.
void settle_start(Run& run, formats::ResultsRow row) {
  constexpr double felt = 1e-3;
  fill_row(run.built.model, run.built.state, run.workspace.now, row);
  const double energy = row.kinetic + std::abs(row.strain) + std::abs(row.work) + std::abs(row.dissipated);
  if (!(std::abs(row.balance) > felt * energy)) return;
  run.built.state.initial_energy() += row.balance;
  run.report.notes.push_back(
      fmt::format("the initial state is not in equilibrium: massless bodies jump to equilibrium in the first step, in "
                  "which {:.3g} of the energy is {}. Start from an analysis `statics`, or give massless bodies the "
                  "poses in which their forces balance",
                  std::abs(row.balance) / (energy + std::abs(row.balance)), row.balance < 0.0 ? "lost" : "gained"));
}

/// Limits the next step by the road ahead.
void look_ahead(Run& run, const RoadAhead& ahead, Schedule& schedule) {
  if (!run.scene.integrator.error_control.active || !ahead.has_marks()) return;
  // Rows between the ends of steps have overwritten the evaluation.
  if (run.scene.integrator.method == formats::Method::radau)
    evaluate(run.built.model, run.built.state, run.workspace.now);
  schedule.bound(ahead.time_to_next(run.built.model, run.workspace.now, schedule.proposal()));
}

/// Updates report and loop after an accepted step to the present state, and stores its rows.
void take_note(Run& run, const StepReport& step, double size, StepLoop& loop, RowWriter& out) {
  RunReport& report = run.report;
  State& state = run.built.state;
  ++report.steps;
  run.doubts.after_step(run.workspace.memory.previous, run.instant());
  loop.last = step;
  loop.last_size = size;
  report.least_step = report.steps == 1 ? size : std::min(report.least_step, size);
  report.greatest_step = std::max(report.greatest_step, size);
  loop.schedule.adapt(step, size);
  report.largest_constraint = std::max(report.largest_constraint, step.constraint);
  store_rows_between(run, loop, out);
  const Schedule::Event event = loop.schedule.accept(state.time());
  if (report.steps == 1 && run.massless) settle_start(run, out.row);
  if (event.output) write_row(run, step, size, out);
  if (!event.breakpoint) return;
  pass_breakpoint(run.built.model, run.scene, state, run.workspace);
  loop.stepper.pass_jump();
}

/// Reports the stability of the equilibrium that was found, from its stiffness.
void report_stability(const StaticsReport& statics, RunReport& report) {
  const Stability& stability = statics.stability;
  if (statics.descents > 0)
    report.notes.push_back(
        fmt::format("the equilibrium was found in {} steps downhill in potential energy", statics.descents));
  if (statics.load_steps > 1 && statics.unstable_from <= 1.0 && stability.symmetric)
    report.notes.push_back(fmt::format("the equilibrium loses its stability between {:.4g} and {:.4g} of the load",
                                       statics.stable_until, statics.unstable_from));
  if (!stability.counted) return;
  const std::string count =
      fmt::format("{} direction{}{}", stability.unstable, stability.unstable == 1 ? "" : "s",
                  stability.direction.empty() ? "" : fmt::format(", first {}", stability.direction));
  if (!stability.symmetric) {
    report.notes.push_back(fmt::format(
        "the stiffness is not symmetric (follower forces, moments, tyres, unsymmetric bushings), so the number of its "
        "negative directions ({}) does not show whether the equilibrium is stable. Run `modes` from it to find out",
        stability.unstable == 0 ? "none" : count));
    return;
  }
  if (stability.unstable == 0) return;
  report.end(
      RunOutcome::unstable,
      fmt::format("the equilibrium is unstable in {}: `statics: {{stable: yes}}` continues to a stable one", count));
}

}  // namespace

void integrate(Run& run, RowWriter& out) {
  const Model& model = run.built.model;
  State& state = run.built.state;
  RunReport& report = run.report;
  StepLoop loop{Stepper(model, run.scene.integrator),
                Schedule(run.scene, model.breakpoints),
                Checkpoints(run.scene, out.results, state.time()),
                {},
                0.0,
                std::numeric_limits<double>::quiet_NaN()};
  if (!run.schedule_memory.empty()) loop.schedule.restore(run.schedule_memory);
  const RoadAhead ahead(run.scene, model);
  // An appended run already has the row of this instant, if the previous run was to store it.
  const bool begins_with_row = run.schedule_memory.empty() ? loop.schedule.output_at_start() : !run.beginning;
  if (begins_with_row) write_row(run, {}, 0.0, out);
  while (!loop.schedule.finished(state.time())) {
    if (is_interrupted(run)) break;
    const double before = state.time();
    if (loop.tried_at != before) look_ahead(run, ahead, loop.schedule);
    const StepEnd target = loop.schedule.next(before);
    if (loop.tried_at != before) {
      loop.tried_at = before;
      loop.first_tried = target.time - before;
    }
    const StepReport step = loop.stepper.advance(target, state, run.workspace);
    report.iterations += step.iterations;
    report.factorisations += step.factorisations;
    report.row_choices += step.row_choices;
    if (step.outcome != StepOutcome::accepted) {
      std::string failure = failure_of(run, step, target, loop);
      if (failure.empty()) continue;
      report.end(RunOutcome::not_converged, std::move(failure));
      break;
    }
    take_note(run, step, state.time() - before, loop, out);
    std::string end = why_to_end(run);
    const bool ends = loop.schedule.finished(state.time()) || !end.empty();
    if (run.automatic != nullptr && run.automatic->missed(run, ends)) return loop.checkpoints.discard();
    loop.checkpoints.after_step(run, loop.schedule, loop.stepper, out.writer);
    if (run.control.progress) run.control.progress(state.time());
    if (!end.empty()) {
      report.end(RunOutcome::not_converged, std::move(end));
      break;
    }
  }
  report.time = state.time();
  run.angles.tell(model, report);
  report.solver_health = loop.stepper.health(run.workspace);
  if (report.outcome != RunOutcome::completed) write_last_row(run, loop.last, loop.last_size, out);
}

void equilibrate(Run& run, RowWriter& out) {
  const StaticsReport statics =
      solve_statics(run.built.model, run.scene.statics, run.control.interrupted, run.built.state, run.workspace);
  run.report.steps = statics.load_steps;
  run.report.iterations = run.report.factorisations = statics.iterations;
  run.report.largest_constraint = statics.constraint;
  run.report.time = run.built.state.time();
  if (statics.outcome != StepOutcome::accepted) {
    if (statics.interrupted) return run.report.end(RunOutcome::interrupted, "interrupted");
    return run.report.end(RunOutcome::not_converged, statics.explanation);
  }
  StepReport step;
  step.iterations = statics.iterations;
  step.residual = statics.residual;
  step.constraint = statics.constraint;
  run.doubts.at_state(run.instant());
  if (std::string reason = why_to_end(run); !reason.empty())
    run.report.end(RunOutcome::not_converged, std::move(reason));
  run.angles.tell(run.built.model, run.report);
  if (run.report.outcome == RunOutcome::completed && !run.scene.statics.rotation) report_stability(statics, run.report);
  write_row(run, step, 0.0, out);
}

}  // namespace tisserand::mechanism
