// scene -> model -> start -> steps -> results, as a page of calls.
#include "mechanism/simulate.hpp"

#include <utility>

#include "formats/results/results.hpp"
#include "mechanism/run/bdf_run.hpp"
#include "mechanism/run/checkpoint.hpp"
#include "mechanism/run/output.hpp"
#include "mechanism/run/run.hpp"

namespace tisserand::mechanism {

RunEnd simulate(const RunRequest& request, const RunControl& control) {
  const double begin_model = control.clock ? control.clock() : 0.0;
  Run run(request.scene, request.files, control);
  const double begin_start = run.seconds();
  run.listener = request.listener;
  if (request.begin) begin_from(run, *request.begin);
  if (request.restart.empty())
    start(run);
  else
    resume(run, request.restart, request.at, request.joining, request.changed);
  const double begin_output = run.seconds();
  const formats::ResultsLayout layout = begin_rows(run, request.files);
  formats::ResultsRow row;
  row.resize(layout);
  formats::ResultsWriter writer(request.path, layout, run.beginning.value_or(formats::ResultsBeginning{}));
  RowWriter out{row, writer, request.path};
  if (run.listener != nullptr) run.listener->begin(layout);
  run.report.seconds_output = run.seconds() - begin_output;
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
  tell_doubts(run);
  if (run.scene.analysis != formats::AnalysisKind::dynamics) report.solver_health = run.workspace.matrix.health();
  report.seconds_model = begin_start - begin_model;
  report.seconds_start = begin_output - begin_start;
  report.seconds_steps = run.seconds() - begin_output - report.seconds_output;
  if (run.listener != nullptr) run.listener->end(report);
  writer.finish(is_finished(report.outcome), is_finished(report.outcome) ? "" : report.reason, report_json(report));
  return {std::move(report), run.automatic ? run.automatic->whole_state(run) : std::move(run.built.state)};
}

RunReport simulate(const formats::Scene& scene, const std::string& path, const RunControl& control) {
  const BodyFiles files = read_body_files(scene);
  return simulate(RunRequest{scene, files, std::nullopt, path, "", std::nullopt}, control).report;
}

RunReport inspect(const formats::Scene& scene, const RunControl& control) {
  const BodyFiles files = read_body_files(scene);
  Run run(scene, files, control);
  start(run);
  keep_chosen_places(run.scene, run.built.model);
  note_large_output(run.scene, run.built.model, scene.integrator.start, run.report.notes);
  if (run.automatic) run.automatic->hold_stressed(run);
  return run.report;
}

}  // namespace tisserand::mechanism
