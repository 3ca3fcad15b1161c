// SPDX-License-Identifier: GPL-3.0-or-later
// Sequence of calls of one run: scene -> model -> start -> steps -> results.
#include "mechanism/simulate.hpp"

#include <utility>
#include <vector>

#include "mechanism/build/effects.hpp"
#include "mechanism/run/output.hpp"

namespace tisserand::mechanism {

RunEnd simulate(const RunRequest& request, const RunControl& control) {
  Attempt whole(request, request.scene, control);
  std::vector<EffectUse> uses = automatic_effects(request.scene, request.files);
  const bool chooses = !uses.empty() && request.scene.analysis == formats::AnalysisKind::dynamics;
  if (request.restart.empty() || !chooses) whole.start_from(request.begin);
  if (!chooses) return *whole.finish(nullptr);
  AutomaticEffects automatic(request.scene, std::move(uses));
  if (request.restart.empty())
    automatic.begin(whole.run(), request.begin);
  else
    automatic.go_on(whole.run(), effects_off(request.restart, automatic.effects()));
  return run_with_fewest(request, control, automatic, whole);
}

RunReport simulate(const formats::Scene& scene, const std::string& path, const RunControl& control) {
  const BodyFiles files = read_body_files(scene);
  return simulate(RunRequest{scene, files, {}, path}, control).report;
}

RunReport inspect(const formats::Scene& scene, const RunControl& control) {
  const BodyFiles files = read_body_files(scene);
  Run run(scene, files, control);
  start(run);
  keep_chosen_places(run.scene, run.built.model);
  note_large_output(run.scene, run.built.model, scene.integrator.start, run.report.notes);
  std::vector<EffectUse> uses = automatic_effects(scene, files);
  if (uses.empty() || scene.analysis != formats::AnalysisKind::dynamics) return run.report;
  AutomaticEffects automatic(scene, std::move(uses));
  automatic.begin(run, std::nullopt);
  automatic.report_begin(run.report);
  return run.report;
}

}  // namespace tisserand::mechanism
