// SPDX-License-Identifier: GPL-3.0-or-later
// Planning, running and reading back of trial scenes.
#include "tests/support/scenes/trial.hpp"

#include <optional>
#include <utility>

#include "formats/results/results.hpp"
#include "formats/scene/scene.hpp"
#include "formats/yaml/override.hpp"
#include "mechanism/histories/series.hpp"
#include "mechanism/run/analyses.hpp"
#include "mechanism/simulate.hpp"
#include "mechanism/study/accuracy.hpp"

namespace tisserand::test_support {

Trial::Trial(const std::string& name, const std::vector<std::string>& settings) {
  std::vector<formats::Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(formats::parse_override(setting));
  const std::string path = TISSERAND_SOURCE_DIR "/tests/verification/references/trials/" + name + ".scene.yaml";
  const formats::Scene scene = formats::read_scene(path, overrides);
  const mechanism::BodyFiles files = mechanism::read_body_files(scene);
  std::map<std::string, mechanism::State> ends;
  for (const mechanism::PlannedAnalysis& one :
       mechanism::plan(scene, "", {folder_.file(name + ".results.h5"), false})) {
    std::optional<mechanism::State> begin;
    if (!one.from.empty()) begin = ends.at(one.from);
    const mechanism::RunRequest request{one.scene, files, begin, one.results, "", std::nullopt};
    mechanism::RunEnd end = one.scene.integrator.accuracy ? mechanism::simulate_to_accuracy(request, {})
                                                          : mechanism::simulate(request, {});
    reports_[one.name] = std::move(end.report);
    ends.emplace(one.name, std::move(end.state));
    last_ = one.name;
  }
}

const mechanism::RunReport& Trial::report(const std::string& analysis) const { return reports_.at(chosen(analysis)); }

std::vector<double> Trial::channel(const std::string& name, const std::string& analysis) const {
  return mechanism::read_series({{report(analysis).results}, {}, {name}, {}}).front().y;
}

std::vector<double> Trial::time(const std::string& analysis) const {
  return formats::ResultsReader(report(analysis).results).time();
}

std::vector<double> Trial::frequencies(const std::string& analysis) const {
  return formats::ResultsReader(report(analysis).results).read("modes/frequency");
}

}  // namespace tisserand::test_support
