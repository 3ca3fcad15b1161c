// SPDX-License-Identifier: GPL-3.0-or-later
// Start, analysis and end of a run, and its repetition with more effects.
#include "mechanism/run/attempt.hpp"

#include <algorithm>
#include <utility>

#include "formats/results/results.hpp"
#include "mechanism/run/bdf_run.hpp"

namespace tisserand::mechanism {
namespace {

void carry_out(Run& run, RowWriter& out) {
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
}

/// First samples of a run without output: most effects that matter are found there, and results cost more.
formats::Scene first_window(formats::Scene scene, double window) {
  scene.integrator.end = std::min(scene.integrator.end, scene.integrator.start + window);
  scene.checkpoint = {};
  scene.output = {};
  scene.output.from = scene.integrator.end;
  return scene;
}

}  // namespace

Attempt::Attempt(const RunRequest& request, const formats::Scene& scene, const RunControl& control)
    : request_(request), began_(control.clock ? control.clock() : 0.0), run_(scene, request.files, control) {
  run_.listener = request.listener;
}

void Attempt::start_from(const std::optional<State>& begin) {
  began_start_ = run_.seconds();
  if (begin) begin_from(run_, *begin);
  if (request_.restart.empty())
    start(run_);
  else
    resume(run_, request_.restart, request_.at, request_.joining, request_.changed);
}

std::optional<RunEnd> Attempt::finish(AutomaticEffects* automatic) {
  run_.automatic = automatic;
  if (automatic != nullptr && automatic->watch(run_)) return std::nullopt;
  RunReport& report = run_.report;
  const double begin_output = run_.seconds();
  const formats::ResultsLayout layout = begin_rows(run_, request_.files);
  formats::ResultsRow row;
  row.resize(layout);
  formats::ResultsWriter writer(request_.path, layout, run_.beginning.value_or(formats::ResultsBeginning{}));
  RowWriter out{row, writer, request_.path};
  if (run_.listener != nullptr) run_.listener->begin(layout);
  report.seconds_output = run_.seconds() - begin_output;
  carry_out(run_, out);
  if (automatic != nullptr && automatic->begins_again()) {
    writer.discard();
    return std::nullopt;
  }
  report.results = request_.path;
  if (automatic != nullptr) automatic->tell(run_);
  report_doubts(run_);
  if (run_.scene.analysis != formats::AnalysisKind::dynamics) report.solver_health = run_.workspace.matrix.health();
  report.seconds_model = began_start_ - began_;
  report.seconds_start = begin_output - began_start_;
  report.seconds_steps = run_.seconds() - begin_output - report.seconds_output;
  if (run_.listener != nullptr) run_.listener->end(report);
  writer.finish(is_finished(report.outcome), is_finished(report.outcome) ? "" : report.reason, report_json(report));
  return RunEnd{std::move(report), automatic != nullptr ? automatic->whole_state(run_) : run_.built.state};
}

RunEnd run_with_fewest(const RunRequest& request, const RunControl& control, AutomaticEffects& automatic,
                       Attempt& whole) {
  const bool from_file = !request.restart.empty();
  const auto begin_of = [&](Attempt& attempt) { return automatic.begin_of(attempt.run().built.model); };
  const RunControl silent{control.interrupted, {}, control.clock, {}};
  RunControl again = control;  // messages before the steps are announced once
  while (automatic.any_off()) {
    const formats::Scene scene = automatic.scene();
    if (!from_file) {
      const formats::Scene first = first_window(scene, automatic.window());
      const RunRequest nowhere{first, request.files, request.begin};
      Attempt attempt(nowhere, first, silent);
      attempt.start_from(begin_of(attempt));
      if (!attempt.finish(&automatic)) continue;
    }
    Attempt attempt(request, scene, again);
    attempt.run().values = whole.run().values;
    attempt.run().report.switches = whole.run().report.switches;
    attempt.start_from(begin_of(attempt));
    if (std::optional<RunEnd> end = attempt.finish(&automatic)) return std::move(*end);
    again.announce = {};
  }
  if (from_file) whole.start_from(request.begin);
  return *whole.finish(&automatic);
}

}  // namespace tisserand::mechanism
