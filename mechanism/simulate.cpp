// scene -> model -> start -> steps -> results, as a page of calls.
#include "mechanism/simulate.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/results/results.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/run/bdf_run.hpp"
#include "mechanism/run/checkpoint.hpp"
#include "mechanism/run/output.hpp"
#include "mechanism/run/run.hpp"
#include "mechanism/run/schedule.hpp"

namespace tisserand::mechanism {
namespace {

/// The last accepted state of a run that ends early, if the schedule has not stored it.
void write_last_row(Run& run, const StepReport& step, double size, RowWriter& out) {
  const double time = run.built.state.time();
  if (run.report.steps == 0 || out.row.time == time || time < run.scene.output.from) return;
  write_row(run, step, size, out);
}

/// Takes the steps of the schedule; a step that fails is taken again in halves.
void integrate(Run& run, RowWriter& out) {
  const Model& model = run.built.model;
  State& state = run.built.state;
  RunReport& report = run.report;
  Schedule schedule(run.scene, model.breakpoints);
  Checkpoints checkpoints(run.scene, out.results, state.time());
  StepReport last;
  double last_size = 0.0;
  if (!run.schedule_memory.empty()) schedule.restore(run.schedule_memory);
  if (schedule.output_at_start() || !run.schedule_memory.empty()) write_row(run, {}, 0.0, out);
  while (!schedule.finished(state.time())) {
    if (run.control.interrupted && run.control.interrupted()) {
      report.outcome = RunOutcome::interrupted;
      report.reason = fmt::format("interrupted at t = {:.6g}", state.time());
      break;
    }
    const double before = state.time();
    const StepEnd target = schedule.next(before);
    const StepReport step = advance(model, run.scene.integrator, target, state, run.workspace);
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
      report.reason = load.empty() ? fmt::format("{} ({})", why, schedule.limit())
                                   : load + "; correct the formula or end the run before";
      break;
    }
    ++report.steps;
    last = step;
    last_size = state.time() - before;
    report.least_step = report.steps == 1 ? last_size : std::min(report.least_step, last_size);
    report.greatest_step = std::max(report.greatest_step, last_size);
    schedule.adapt(step, last_size);
    report.largest_constraint = std::max(report.largest_constraint, step.constraint);
    const Schedule::Event event = schedule.accept(state.time());
    if (event.output) write_row(run, step, last_size, out);
    if (event.breakpoint) pass_breakpoint(model, run.scene, state, run.workspace);
    checkpoints.after_step(model, schedule, state, run.workspace);
    if (run.control.progress) run.control.progress(state.time());
  }
  report.time = state.time();
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
  write_row(run, step, 0.0, out);
}

/// Each once, in the order of the bodies.
std::vector<std::string> superelement_files(const formats::Scene& scene) {
  std::vector<std::string> files;
  for (const formats::BodySpec& body : scene.bodies)
    if (const auto* spec = std::get_if<formats::SuperelementBodySpec>(&body))
      if (std::find(files.begin(), files.end(), spec->file) == files.end()) files.push_back(spec->file);
  return files;
}

}  // namespace

BodyFiles read_body_files(const formats::Scene& scene) {
  BodyFiles files;
  const bool rehearsed = formats::rehearse_superelements(superelement_files(scene));
  const auto read_superelement = rehearsed ? formats::read_rehearsed_superelement : formats::read_superelement;
  std::vector<Error> errors;
  std::set<std::string> superelements, modal_bodies;  // also those that cannot be read, which are named once
  for (const formats::BodySpec& body : scene.bodies) {
    const auto* superelement = std::get_if<formats::SuperelementBodySpec>(&body);
    const auto* modal = std::get_if<formats::ModalBodySpec>(&body);
    try {
      if (superelement != nullptr && superelements.insert(superelement->file).second)
        files.superelements[superelement->file] = read_superelement(superelement->file);
      if (modal != nullptr && modal_bodies.insert(modal->file).second)
        files.modal_bodies[modal->file] = formats::read_modal_body(modal->file);
    } catch (const Error& error) {
      errors.push_back(error);
    }
  }
  if (!errors.empty()) throw merge_errors(errors);
  return files;
}

RunEnd simulate(const RunRequest& request, const RunControl& control) {
  const double begin_model = control.clock ? control.clock() : 0.0;
  Run run(request.scene, request.files, control);
  const double begin_start = run.seconds();
  if (request.begin) begin_from(run, *request.begin);
  if (request.restart.empty())
    start(run);
  else
    resume(run, request.restart, request.at);
  const double begin_steps = run.seconds();
  const formats::ResultsLayout layout = results_layout(run.built.model, run.scene);
  formats::ResultsRow row;
  row.resize(layout);
  formats::ResultsWriter writer(request.path, layout);
  RowWriter out{row, writer, request.path};
  switch (run.scene.analysis) {
    case formats::AnalysisKind::dynamics:
      if (run.scene.integrator.method == formats::Method::bdf)
        integrate_bdf(run, out);
      else
        integrate(run, out);
      break;
    case formats::AnalysisKind::statics:
      equilibrate(run, out);
      break;
    case formats::AnalysisKind::assembly:
      assemble(run, out);
      break;
    case formats::AnalysisKind::kinematics:
    case formats::AnalysisKind::inverse_dynamics:
      move_along(run, out);
      break;
    case formats::AnalysisKind::modes:
      find_modes(run, out);
      break;
  }
  RunReport& report = run.report;
  report.results = request.path;
  report.solver_health = run.workspace.matrix.health();
  report.seconds_model = begin_start - begin_model;
  report.seconds_start = begin_steps - begin_start;
  report.seconds_steps = run.seconds() - begin_steps - report.seconds_output;
  writer.finish(report.outcome == RunOutcome::completed, report.reason, report_json(report));
  return {std::move(report), std::move(run.built.state)};
}

RunReport simulate(const formats::Scene& scene, const std::string& path, const RunControl& control) {
  const BodyFiles files = read_body_files(scene);
  return simulate(RunRequest{scene, files, std::nullopt, path, "", std::nullopt}, control).report;
}

RunReport inspect(const formats::Scene& scene, const RunControl& control) {
  Run run(scene, read_body_files(scene), control);
  start(run);
  return run.report;
}

}  // namespace tisserand::mechanism
