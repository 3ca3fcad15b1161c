// SPDX-License-Identifier: GPL-3.0-or-later
// Steps by CVODE, rows between them, and a restart after every breakpoint.
#include "mechanism/run/bdf_run.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "mechanism/bdf/bdf.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/run/automatic_effects.hpp"
#include "mechanism/step/road_ahead.hpp"

namespace tisserand::mechanism {
namespace {

/// Instants closer than this fraction of the whole time are equal.
constexpr double same_instant = 1e-11;

/// Instants of rows and breakpoints of loads.
struct Instants {
  const formats::Scene& scene;
  const std::vector<double>& breakpoints;
  double round_off;
  std::size_t breakpoint = 0;  ///< index of the next one
  long row = 1;                ///< number of the next row of `interval`
  long steps = 0;

  StepEnd stop() const {
    const double end = scene.integrator.end;
    if (breakpoint >= breakpoints.size() || breakpoints[breakpoint] > end - round_off) return {end, end};
    return {breakpoints[breakpoint], breakpoints[breakpoint] - round_off};
  }
  void pass(double time) {
    while (breakpoint < breakpoints.size() && breakpoints[breakpoint] <= time + round_off) ++breakpoint;
  }
  double due() const { return scene.integrator.start + static_cast<double>(row) * scene.output.interval.value_or(0.0); }
};

void store(Run& run, const Bdf& bdf, StepReport& step, double size, RowWriter& out) {
  if (run.built.state.time() < run.scene.output.from) return;
  step.constraint = bdf.violation();
  write_row(run, step, size, out);
  run.doubts.at_state(run.instant());
}

/// Stores the rows of a step from `before` to the present state.
void store_rows(Run& run, Bdf& bdf, Instants& instants, double before, RowWriter& out) {
  const State& state = run.built.state;
  const double now = state.time();
  const bool finished = now >= run.scene.integrator.end - instants.round_off;
  StepReport step;
  step.iterations = static_cast<int>(bdf.counts().iterations - run.report.iterations);
  if (!run.scene.output.interval) {
    if (++instants.steps % run.scene.output.every == 0 || finished) store(run, bdf, step, now - before, out);
    return;
  }
  bool at_end = false;
  for (; instants.due() <= now + instants.round_off; ++instants.row) {
    bdf.go_to(std::min(instants.due(), now));
    store(run, bdf, step, now - before, out);
    at_end = state.time() == now;
  }
  if (state.time() != now) bdf.go_to(now);
  if (finished && !at_end) store(run, bdf, step, now - before, out);
}

/// Reason to end the run at the accepted state; empty: none. CVODE's last evaluation belongs to another state.
std::string observe(Run& run) {
  const Model& model = run.built.model;
  if (model.superelements.empty() && model.tyres.empty()) return {};
  evaluate(model, run.built.state, run.workspace.now);
  return why_to_end(run);
}

/// Latest end of the next step: the next breakpoint of loads, or the next mark of a road.
StepEnd bounded(Run& run, const RoadAhead& ahead, const StepEnd& stop, double step) {
  if (!ahead.has_marks()) return stop;
  evaluate(run.built.model, run.built.state, run.workspace.now);
  const double time = run.built.state.time() + ahead.time_to_next(run.built.model, run.workspace.now, step);
  return time < stop.load_time ? StepEnd{time, time} : stop;
}

void note_counts(Run& run, const BdfCounts& counts) {
  RunReport& report = run.report;
  report.steps = counts.steps;
  report.iterations = counts.iterations;
  report.factorisations = counts.factorisations;
  report.inaccurate = counts.error_failures;
  report.rejected = counts.error_failures + counts.convergence_failures;
  report.row_choices = counts.row_choices;
}

}  // namespace

void integrate_bdf(Run& run, RowWriter& out) {
  RunReport& report = run.report;
  State& state = run.built.state;
  const formats::IntegratorSpec& options = run.scene.integrator;
  Bdf bdf(run.scene, run.built.model, state, run.workspace);
  Instants instants{run.scene, run.built.model.breakpoints, same_instant * (options.end - options.start)};
  instants.pass(options.start);
  const RoadAhead ahead(run.scene, run.built.model);
  StepReport none;
  store(run, bdf, none, 0.0, out);
  while (state.time() < options.end - instants.round_off) {
    if (is_interrupted(run)) break;
    const double before = state.time();
    const std::string failure = bdf.step(bounded(run, ahead, instants.stop(), report.greatest_step));
    if (!failure.empty()) {
      const std::string load = nonfinite_load(run, before);
      report.end(RunOutcome::not_converged,
                 fmt::format("t = {:.6g}{}: {}", before, after_time(run.scene.units), load.empty() ? failure : load));
      break;
    }
    const double size = state.time() - before;
    report.least_step = report.greatest_step == 0.0 ? size : std::min(report.least_step, size);
    report.greatest_step = std::max(report.greatest_step, size);
    report.largest_constraint = std::max(report.largest_constraint, bdf.violation());
    store_rows(run, bdf, instants, before, out);
    note_counts(run, bdf.counts());
    report.reason = observe(run);
    const bool ends = !report.reason.empty() || state.time() >= options.end - instants.round_off;
    if (run.automatic != nullptr && run.automatic->missed(run, ends)) return;
    if (!report.reason.empty()) {
      report.outcome = RunOutcome::not_converged;
      break;
    }
    if (instants.stop().time < options.end && state.time() >= instants.stop().time - instants.round_off) {
      instants.pass(state.time());
      bdf.restart(state.time() + instants.round_off);
    }
    if (run.control.progress) run.control.progress(state.time());
  }
  report.time = state.time();
  run.angles.tell(run.built.model, report);
  report.solver_health = run.workspace.matrix.health();
}

}  // namespace tisserand::mechanism
