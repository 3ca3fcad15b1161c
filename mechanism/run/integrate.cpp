// Dynamics: the steps of a schedule, and statics as a run.
#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/doubts/failure_cause.hpp"
#include "mechanism/run/checkpoint.hpp"
#include "mechanism/run/frame_angles.hpp"
#include "mechanism/run/off_road.hpp"
#include "mechanism/run/run.hpp"
#include "mechanism/run/schedule.hpp"
#include "mechanism/step/step.hpp"

namespace tisserand::mechanism {
namespace {

/// The last accepted state of a run that ends early, if the schedule has not stored it.
void write_last_row(Run& run, const StepReport& step, double size, RowWriter& out) {
  const double time = run.built.state.time();
  if (run.report.steps == 0 || out.row.time == time || time < run.scene.output.from) return;
  write_row(run, step, size, out);
}

/// Rows that the step to the present state has passed without ending there.
void write_rows_between(Run& run, const StepReport& step, double size, Schedule& schedule, Stepper& stepper,
                        RowWriter& out) {
  State& state = run.built.state;
  std::optional<State> end;
  while (const std::optional<double> due = schedule.pass_instant(end ? end->time() : state.time())) {
    if (!end) end.emplace(state);
    stepper.interpolate(*due, state, run.workspace);
    write_row(run, step, size, out);
  }
  if (end) state.block() = end->block();
}

}  // namespace

void integrate(Run& run, RowWriter& out) {
  const Model& model = run.built.model;
  State& state = run.built.state;
  RunReport& report = run.report;
  Schedule schedule(run.scene, model.breakpoints);
  Stepper stepper(model, run.scene.integrator);
  Checkpoints checkpoints(run.scene, out.results, state.time());
  FrameAngles angles(model);
  StepReport last;
  double last_size = 0.0;
  double tried_at = std::numeric_limits<double>::quiet_NaN(), first_tried = 0.0;
  if (!run.schedule_memory.empty()) schedule.restore(run.schedule_memory);
  // A run that is appended has the row of this instant, if the run before it was to store one.
  const bool begins_with_row = run.schedule_memory.empty() ? schedule.output_at_start() : !run.beginning;
  if (begins_with_row) write_row(run, {}, 0.0, out);
  while (!schedule.finished(state.time())) {
    if (run.control.interrupted && run.control.interrupted()) {
      report.outcome = RunOutcome::interrupted;
      report.reason = fmt::format("interrupted at t = {:.6g}", state.time());
      break;
    }
    const double before = state.time();
    const StepEnd target = schedule.next(before);
    if (tried_at != before) {
      tried_at = before;
      first_tried = target.time - before;
    }
    const StepReport step = stepper.advance(target, state, run.workspace);
    report.iterations += step.iterations;
    report.factorisations += step.factorisations;
    report.row_choices += step.row_choices;
    if (step.outcome != StepOutcome::accepted) {
      ++report.rejected;
      if (step.outcome == StepOutcome::inaccurate) ++report.inaccurate;
      const std::string why =
          fmt::format("t = {:.6g}, step {:.3g}: {}", before, target.time - before, explain(model, step));
      if (report.rejections.size() < 20) report.rejections.push_back(why);
      const std::string load = nonfinite_load(run, target.load_time);
      if (load.empty() && schedule.retry(before, step)) continue;
      report.outcome = RunOutcome::not_converged;
      report.reason = load.empty() ? fmt::format("{} ({}){}", why, schedule.limit(),
                                                 failure_cause(model, run.scene.integrator, run.doubts,
                                                               {step, first_tried}, state, run.workspace))
                                   : load + "; correct the formula or end the run before";
      break;
    }
    ++report.steps;
    run.doubts.after_step(model, run.workspace.memory.previous, state, run.workspace.now);
    last = step;
    last_size = state.time() - before;
    report.least_step = report.steps == 1 ? last_size : std::min(report.least_step, last_size);
    report.greatest_step = std::max(report.greatest_step, last_size);
    schedule.adapt(step, last_size);
    report.largest_constraint = std::max(report.largest_constraint, step.constraint);
    write_rows_between(run, step, last_size, schedule, stepper, out);
    const Schedule::Event event = schedule.accept(state.time());
    if (event.output) write_row(run, step, last_size, out);
    if (event.breakpoint) {
      pass_breakpoint(model, run.scene, state, run.workspace);
      stepper.pass_jump();
    }
    checkpoints.after_step(model, schedule, state, run.workspace, stepper, out.writer);
    if (run.control.progress) run.control.progress(state.time());
    std::string end = angles.observe(model, state, run.workspace.now);
    if (end.empty()) end = off_road(model, state, run.workspace.now);
    if (!end.empty()) {
      report.outcome = RunOutcome::not_converged;
      report.reason = std::move(end);
      break;
    }
  }
  report.time = state.time();
  angles.tell(model, report);
  report.solver_health = stepper.health(run.workspace);
  if (report.outcome != RunOutcome::completed) write_last_row(run, last, last_size, out);
}

void equilibrate(Run& run, RowWriter& out) {
  const StaticsReport statics =
      solve_statics(run.built.model, run.scene.statics, run.control.interrupted, run.built.state, run.workspace);
  run.report.steps = statics.load_steps;
  run.report.iterations = run.report.factorisations = statics.iterations;
  run.report.largest_constraint = statics.constraint;
  run.report.time = run.built.state.time();
  if (statics.outcome != StepOutcome::accepted) {
    run.report.outcome = statics.interrupted ? RunOutcome::interrupted : RunOutcome::not_converged;
    run.report.reason = statics.interrupted ? "interrupted" : statics.explanation;
    return;
  }
  StepReport step;
  step.iterations = statics.iterations;
  step.residual = statics.residual;
  step.constraint = statics.constraint;
  run.doubts.at_state(run.built.model, run.built.state, run.workspace.now);
  FrameAngles angles(run.built.model);
  run.report.reason = angles.observe(run.built.model, run.built.state, run.workspace.now);
  if (run.report.reason.empty()) run.report.reason = off_road(run.built.model, run.built.state, run.workspace.now);
  if (!run.report.reason.empty()) run.report.outcome = RunOutcome::not_converged;
  angles.tell(run.built.model, run.report);
  write_row(run, step, 0.0, out);
}

}  // namespace tisserand::mechanism
