// scene -> model -> start -> steps -> results, as a page of calls.
#include "mechanism/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/results.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/output.hpp"
#include "mechanism/redundancy.hpp"
#include "mechanism/schedule.hpp"
#include "mechanism/statics.hpp"

namespace tisserand::mechanism {
namespace {

/// Everything that one run owns.
struct Run {
  const formats::Scene& scene;
  const RunControl& control;
  RunReport report;
  BuiltModel built;
  Workspace workspace;

  Run(const formats::Scene& scene_, const RunControl& control_)
      : scene(scene_),
        control(control_),
        built(build_model(scene_, read_superelements(scene_))),
        workspace(built.model) {
    report.analysis = scene.analysis;
    report.notes = built.notes;
    report.solver = workspace.solver.name();
    report.unknowns = built.model.pattern->size();
    report.nonzeros = built.model.pattern->nonzeros();
    report.effects = effects(built.model);
  }

  static std::vector<std::string> effects(const Model& model) {
    std::vector<std::string> list;
    const auto add = [&list](std::size_t count, std::string what) {
      if (count == 1) what = what == "rigid bodies" ? "rigid body" : what.substr(0, what.size() - 1);
      if (count > 0) list.push_back(fmt::format("{} {}", count, what));
    };
    add(model.superelements.size(), "superelements");
    add(model.rigid_bodies.size(), "rigid bodies");
    add(model.beams2.size() + model.beams3.size(), "nonlinear beam elements");
    add(model.joints.size(), "joints");
    add(model.couplings.size(), "couplings");
    add(model.springs.size(), "springs");
    add(model.loads.size(), "loads");
    if (!model.gravity.isZero(0.0)) list.push_back("gravity");
    const bool damped = std::any_of(model.superelements.begin(), model.superelements.end(),
                                    [](const SuperelementBody& body) { return body.damping.active; });
    if (damped) list.push_back("damping");
    return list;
  }

  double seconds() const { return control.clock ? control.clock() : 0.0; }
};

/// "load 'motor', x component": the value at `time`, with its formula, if it is no finite number.
std::string nonfinite_text(const std::string& what, const formats::TimeFunctionSpec& spec, double time, double value) {
  if (std::isfinite(value)) return {};
  const auto* expression = std::get_if<formats::TimeExpression>(&spec);
  return fmt::format("{}{}: the value at t = {:.6g} is {}, not a finite number", what,
                     expression == nullptr ? "" : " '" + expression->text + "'", time, value);
}

/// The first load, force of a spring or motion that is no number at `time`, or empty.
std::string nonfinite_load(Run& run, double time) {
  const Model& model = run.built.model;
  Workspace& workspace = run.workspace;
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string what = fmt::format("load '{}', {} component", model.loads[i].name, "xyz"[k]);
      const std::string text =
          nonfinite_text(what, model.loads[i].components[k], time, workspace.load_functions[i][k](time));
      if (!text.empty()) return text;
    }
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    if (!workspace.spring_forces[i]) continue;
    const std::string what = fmt::format("spring '{}', force", model.springs[i].name);
    const std::string text = nonfinite_text(what, model.springs[i].force, time, (*workspace.spring_forces[i])(time));
    if (!text.empty()) return text;
  }
  for (const Coupling& coupling : model.couplings) {
    if (coupling.motion < 0) continue;
    const auto at = static_cast<std::size_t>(coupling.motion);
    const MotionFunction::Value f = workspace.motions[at](time);
    const std::string text = nonfinite_text(coupling.name, model.motions[at], time, f.value + f.rate + f.acceleration);
    if (!text.empty()) return text;
  }
  return {};
}

void require_finite_loads(Run& run) {
  const std::string bad = nonfinite_load(run, run.scene.integrator.start);
  if (!bad.empty()) throw Error(bad, run.scene.file, "correct the formula, for example with t > 0 ? .. : ..");
}

/// Which equations repeat what others demand, and whose reactions are not unique for that reason.
void note_redundancy(Run& run) {
  const Mobility& mobility = run.report.mobility;
  if (mobility.redundant.empty()) return;
  std::vector<std::string> rows;
  for (const int row : mobility.redundant) rows.push_back("'" + constraint_name(run.built.model, row) + "'");
  if (rows.size() > 20) rows.resize(20), rows.push_back("...");
  evaluate(run.built.model, run.built.state, run.workspace);
  run.report.not_unique = joints_without_unique_reaction(run.built.model, run.workspace);
  run.report.notes.push_back(fmt::format(
      "{} of {} constraint equations repeat what the others already demand: {}. The motion is right; the "
      "reactions of {} are not unique, those of least norm are stored",
      mobility.redundant.size(), mobility.constraints, join(rows, ", "), join(run.report.not_unique, ", ")));
}

void start(Run& run) {
  require_finite_loads(run);
  const StartReport report = start(run.scene, run.built.model, run.built.state, run.workspace);
  run.report.mobility = report.mobility;
  run.report.projection = report.projection;
  note_redundancy(run);
  if (report.massless)
    run.report.notes.push_back(
        "the mass matrix is singular: accelerations of its massless directions come from statics");
  if (run.scene.analysis != formats::AnalysisKind::statics) return;
  const std::string free = free_motion(run.built.model, run.built.state, run.workspace);
  if (!free.empty())
    throw Error(fmt::format("statics: the scene can move freely: nothing holds {}", free), run.scene.file,
                "hold it with a joint, or use `analysis: dynamics`");
}

void write_row(Run& run, const StepReport& step, double size, formats::ResultsRow& row,
               formats::ResultsWriter& writer) {
  const double before = run.seconds();
  fill_row(run.built.model, run.built.state, run.workspace, row);
  row.step = size;
  row.iterations = step.iterations;
  row.residual = step.residual;
  row.constraint = step.constraint;
  if (run.report.analysis == formats::AnalysisKind::statics)
    row.work = row.dissipated = row.balance = std::numeric_limits<double>::quiet_NaN();
  writer.append(row);
  RunReport& report = run.report;
  ++report.rows;
  report.balance = row.balance;
  report.largest_balance = std::max(report.largest_balance, std::abs(row.balance));
  report.energy_reference =
      std::max(report.energy_reference, std::abs(row.kinetic) + std::abs(row.strain) + std::abs(row.work));
  report.seconds_output += run.seconds() - before;
}

/// The last accepted state of a run that ends early, if the schedule has not stored it.
void write_last_row(Run& run, const StepReport& step, double size, formats::ResultsRow& row,
                    formats::ResultsWriter& writer) {
  const double time = run.built.state.time();
  if (run.report.steps == 0 || row.time == time || time < run.scene.output.from) return;
  run.workspace.displacement.setZero();
  write_row(run, step, size, row, writer);
}

/// Takes the steps of the schedule; a step that fails is taken again in halves.
void integrate(Run& run, formats::ResultsRow& row, formats::ResultsWriter& writer) {
  const Model& model = run.built.model;
  State& state = run.built.state;
  RunReport& report = run.report;
  Schedule schedule(run.scene, model.breakpoints);
  StepReport last;
  double last_size = 0.0;
  if (schedule.output_at_start()) write_row(run, {}, 0.0, row, writer);
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
    if (step.outcome != StepOutcome::accepted) {
      ++report.rejected;
      const std::string why =
          fmt::format("t = {:.6g}, step {:.3g}: {}", before, target.time - before, explain(model, step));
      if (report.rejections.size() < 20) report.rejections.push_back(why);
      const std::string load = nonfinite_load(run, target.load_time);
      if (load.empty() && schedule.halve(before)) continue;
      report.outcome = RunOutcome::not_converged;
      report.reason = load.empty()
                          ? fmt::format("{} (after {} halvings of the step)", why, run.scene.integrator.max_halvings)
                          : load + "; correct the formula or end the run before";
      break;
    }
    ++report.steps;
    last = step;
    last_size = state.time() - before;
    report.largest_constraint = std::max(report.largest_constraint, step.constraint);
    const Schedule::Event event = schedule.accept(state.time());
    if (event.output) write_row(run, step, last_size, row, writer);
    if (event.breakpoint) pass_breakpoint(model, run.scene, state, run.workspace);
    if (run.control.progress) run.control.progress(state.time());
  }
  report.time = state.time();
  if (report.outcome != RunOutcome::completed) write_last_row(run, last, last_size, row, writer);
}

void equilibrate(Run& run, formats::ResultsRow& row, formats::ResultsWriter& writer) {
  const StaticsReport statics = solve_statics(run.built.model, run.scene.statics, run.built.state, run.workspace);
  run.report.steps = statics.load_steps;
  run.report.iterations = run.report.factorisations = statics.iterations;
  run.report.largest_constraint = statics.constraint;
  run.report.time = run.built.state.time();
  if (statics.outcome != StepOutcome::accepted) {
    run.report.outcome = RunOutcome::not_converged;
    run.report.reason = statics.explanation;
    return;
  }
  StepReport step;
  step.iterations = statics.iterations;
  step.residual = statics.residual;
  step.constraint = statics.constraint;
  write_row(run, step, 0.0, row, writer);
}

}  // namespace

SuperelementFiles read_superelements(const formats::Scene& scene) {
  SuperelementFiles files;
  std::vector<Error> errors;
  for (const formats::BodySpec& body : scene.bodies) {
    const auto* spec = std::get_if<formats::SuperelementBodySpec>(&body);
    if (spec == nullptr || files.contains(spec->file)) continue;
    try {
      files[spec->file] = formats::read_superelement(spec->file);
    } catch (const Error& error) {
      errors.push_back(error);
    }
  }
  if (!errors.empty()) throw merge_errors(errors);
  return files;
}

RunReport simulate(const formats::Scene& scene, const std::string& path, const RunControl& control) {
  const double begin_model = control.clock ? control.clock() : 0.0;
  Run run(scene, control);
  const double begin_start = run.seconds();
  start(run);
  const double begin_steps = run.seconds();
  const formats::ResultsLayout layout = results_layout(run.built.model, scene);
  formats::ResultsRow row;
  row.resize(layout);
  formats::ResultsWriter writer(path, layout);
  switch (scene.analysis) {
    case formats::AnalysisKind::dynamics:
      integrate(run, row, writer);
      break;
    case formats::AnalysisKind::statics:
      equilibrate(run, row, writer);
      break;
  }
  RunReport& report = run.report;
  report.results = path;
  report.seconds_model = begin_start - begin_model;
  report.seconds_start = begin_steps - begin_start;
  report.seconds_steps = run.seconds() - begin_steps - report.seconds_output;
  writer.finish(report.outcome == RunOutcome::completed, report.reason, report_json(report));
  return report;
}

RunReport inspect(const formats::Scene& scene, const RunControl& control) {
  Run run(scene, control);
  start(run);
  return run.report;
}

}  // namespace tisserand::mechanism
