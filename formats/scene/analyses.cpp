// SPDX-License-Identifier: GPL-3.0-or-later
// Reads `analysis` or `analyses` of a scene, with the settings of each one and those that they share.
#include <algorithm>

#include "common/text.hpp"
#include "formats/scene/reader.hpp"
#include "formats/yaml/fields.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

constexpr const char* groups[] = {"integrator", "statics", "modes", "output", "checkpoint"};

/// The analysis with the groups of the scene added; its own values have priority.
YamlNode with_groups_of(const YamlNode& scene, YamlNode analysis) {
  for (const char* name : groups) {
    const YamlNode* shared = find_child(scene, name);
    if (shared == nullptr) continue;
    const auto own = std::ranges::find(analysis.children, name, &YamlNode::key);
    if (own == analysis.children.end()) {
      analysis.children.push_back(*shared);
    } else if (own->kind == YamlKind::map && shared->kind == YamlKind::map) {
      for (const YamlNode& value : shared->children) {
        // `every` and `interval` exclude each other, so either one of the analysis replaces both of the scene.
        const bool rhythm = value.key == "every" || value.key == "interval";
        const bool given =
            find_child(*own, value.key) != nullptr ||
            (rhythm && (find_child(*own, "every") != nullptr || find_child(*own, "interval") != nullptr));
        if (!given) own->children.push_back(value);
      }
    }
  }
  return analysis;
}

double end_time(const Analysis& analysis) {
  return takes_steps(analysis.kind) ? analysis.integrator.end : analysis.integrator.start;
}

/// The analysis that `from` names. It must come earlier.
const Analysis* read_from(const MapReader& map, const std::vector<Analysis>& before, Analysis& analysis) {
  const YamlNode* node = map.find("from");
  if (node == nullptr) return nullptr;
  analysis.from = read_text(map.context(), *node, "from");
  const auto found = std::ranges::find(before, analysis.from, &Analysis::name);
  if (found != before.end()) return &*found;
  map.context().fail(
      node->place, fmt::format("from: there is no analysis '{}' before this one", analysis.from),
      did_you_mean(analysis.from, texts_of(before, &Analysis::name), "move it before this one, or remove `from`"));
  return nullptr;
}

Analysis read_analysis(const Context& context, const YamlNode& scene, const YamlNode& own,
                       const std::vector<Analysis>& before) {
  const YamlNode node = with_groups_of(scene, own);
  const MapReader map(context, node, "analysis");
  auto analysis = read_entry<Analysis>(map);
  const Analysis* from = read_from(map, before, analysis);
  std::optional<double> start;
  if (from != nullptr) start = end_time(*from);
  read_groups(map, start, analysis);
  // An analysis that starts from a steady rotation inherits it.
  if (from != nullptr && from->statics.rotation && from->kind == AnalysisKind::statics && !analysis.modes.rotation)
    analysis.modes.rotation = from->statics.rotation->angular_velocity;
  return analysis;
}

}  // namespace

std::string analysis_word(AnalysisKind kind) {
  const auto found = std::ranges::find(analysis_kinds, kind, &Choice<AnalysisKind>::value);
  return std::string(found->word);
}

bool takes_steps(AnalysisKind kind) {
  switch (kind) {
    case AnalysisKind::dynamics:
    case AnalysisKind::kinematics:
    case AnalysisKind::inverse_dynamics:
      return true;
    case AnalysisKind::statics:
    case AnalysisKind::assembly:
    case AnalysisKind::modes:
      return false;
  }
  return false;
}

Scene scene_of(const Scene& scene, const Analysis& analysis) {
  Scene one = scene;
  one.analysis = analysis.kind;
  one.integrator = analysis.integrator;
  one.statics = analysis.statics;
  one.modes = analysis.modes;
  one.output = analysis.output;
  one.checkpoint = analysis.checkpoint;
  one.analyses.clear();
  return one;
}

std::vector<KeySet> analysis_key_sets() {
  return {{"analysis",
           {choice<&Analysis::kind, analysis_kinds>("type", "kind of the analysis", "required"),
            {"from", "text",
             "an earlier analysis in this list: start from the positions and velocities at its end instead of the "
             "poses of the bodies",
             "none"},
            {"integrator", "integrator", "as for the scene; single values replace those of the scene",
             "those of the scene"},
            nested<&Analysis::statics>("statics", "statics", ditto),
            nested<&Analysis::modes>("modes", "modes", ditto),
            {"output", "output", ditto},
            {"checkpoint", "checkpoint", ditto}}}};
}

void read_analyses(const MapReader& map, Scene& scene) {
  const YamlNode* several = map.find("analyses");
  if (several == nullptr) {
    Analysis only;
    read_fields(map, only);
    read_groups(map, std::nullopt, only);
    scene = scene_of(scene, only);
    return;
  }
  if (const YamlNode* one = map.find("analysis"))
    map.context().fail(one->key_place, "both 'analysis' and 'analyses' are given", "give one of them");
  for (const YamlNode* node : map.entries("analyses", "analysis"))
    scene.analyses.push_back(read_analysis(entry_context(map.context().reader, "analysis", *node),
                                           map.context().reader.root(), *node, scene.analyses));
}

}  // namespace tisserand::formats
