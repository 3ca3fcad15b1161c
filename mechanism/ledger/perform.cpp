// SPDX-License-Identifier: GPL-3.0-or-later
// Analyses before a ledger, and the choice of its analysis.
#include "mechanism/ledger/perform.hpp"

#include <map>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "mechanism/build/effects.hpp"
#include "mechanism/simulate.hpp"

namespace tisserand::mechanism {
namespace {

/// Start of the last planned analysis: the end state of the analysis before it, which runs here. Absent: the poses.
std::optional<State> beginning_of_last(const std::vector<PlannedAnalysis>& planned, const BodyFiles& files,
                                       const RunControl& control) {
  std::map<std::string, State> ends;
  for (const PlannedAnalysis& one : planned) {
    std::optional<State> begin;
    if (!one.from.empty()) begin = ends.at(one.from);
    if (&one == &planned.back()) return begin;
    RunEnd end = simulate(RunRequest{one.scene, files, std::move(begin)}, control);
    if (end.report.outcome == RunOutcome::interrupted) return std::nullopt;
    if (end.report.outcome != RunOutcome::completed)
      throw Error(fmt::format("analysis '{}', from which '{}' begins, did not reach its end: {}", one.name,
                              planned.back().name, end.report.reason),
                  one.scene.file, "correct it, or choose another one with --analysis");
    ends.insert_or_assign(one.name, std::move(end.state));
  }
  return std::nullopt;
}

/// The chosen analysis (default: the last dynamics analysis) and those from which it starts.
std::vector<PlannedAnalysis> planned_for(const formats::Scene& scene, std::string analysis) {
  if (analysis.empty())
    for (const formats::Analysis& one : scene.analyses)
      if (one.kind == formats::AnalysisKind::dynamics) analysis = one.name;
  return plan(scene, analysis, {});
}

}  // namespace

Ledger perform_ledger(const formats::Scene& scene, const std::string& analysis, const LedgerSettings& settings,
                      const RunControl& control, const LedgerProgress& progress) {
  if (const double share = settings.windows.share; !(share >= 0.0 && share <= 1.0))
    throw Error(fmt::format("--share: {} is not between 0 and 1", share), "", "give a number from 0 to 1");
  const std::vector<PlannedAnalysis> planned = planned_for(scene, analysis);
  const BodyFiles files = read_ledger_files(scene);
  const formats::Scene whole = with_switches(planned.back().scene, {});  // auto: on
  return make_ledger({whole, beginning_of_last(planned, files, control), settings, progress}, files, control);
}

}  // namespace tisserand::mechanism
