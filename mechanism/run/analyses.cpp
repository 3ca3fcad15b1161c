// SPDX-License-Identifier: GPL-3.0-or-later
// Order of the analyses of a scene, and names of their files.
#include "mechanism/run/analyses.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/output_path.hpp"
#include "common/text.hpp"

namespace tisserand::mechanism {
namespace {

const formats::Analysis& find(const formats::Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.analyses, name, &formats::Analysis::name);
  if (found != scene.analyses.end()) return *found;
  std::vector<std::string> names;
  for (const formats::Analysis& one : scene.analyses) names.push_back(one.name);
  const auto near = nearest(name, names);
  throw Error(fmt::format("there is no analysis '{}'", name), scene.file,
              names.empty() ? std::string("the scene has no `analyses:`; omit --analysis")
              : near        ? fmt::format("did you mean '{}'?", *near)
                            : fmt::format("its analyses are {}", listed(names)));
}

}  // namespace

std::string with_name(const std::string& results, const std::string& name) {
  const std::string stem = without_ending(results, {".results.h5", ".h5"});
  return stem + "." + name + results.substr(stem.size());
}

std::vector<PlannedAnalysis> plan(const formats::Scene& scene, const std::string& name, const OutputName& output) {
  if (name.empty() && scene.analyses.empty()) return {{"", "", scene, output.path}};
  std::set<std::string> wanted;
  for (std::string one = name; !one.empty(); one = find(scene, one).from) wanted.insert(one);
  std::vector<PlannedAnalysis> planned;
  for (const formats::Analysis& analysis : scene.analyses) {
    if (!name.empty() && !wanted.contains(analysis.name)) continue;
    const bool alone = scene.analyses.size() == 1 || (output.chosen && analysis.name == name);
    planned.push_back({analysis.name, analysis.from, formats::scene_of(scene, analysis),
                       alone ? output.path : with_name(output.path, analysis.name)});
  }
  return planned;
}

}  // namespace tisserand::mechanism
