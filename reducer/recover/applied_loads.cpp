// SPDX-License-Identifier: GPL-3.0-or-later
// Notes on load cases, and on forces on nodes of modal bodies.
#include "reducer/recover/inertia_loads.hpp"

#include <fmt/format.h>

#include "common/text.hpp"
#include "formats/recovery/load_factors.hpp"
#include "formats/yaml/tree.hpp"

namespace tisserand::reducer {
namespace {

/// Names of the scene's loads with load cases of the body; empty if the results do not hold the scene.
std::vector<std::string> loads_of_scene(const formats::SimulatedScene& scene, const std::string& body) {
  if (scene.text.empty()) return {};
  const formats::YamlDocument document = formats::parse_yaml(scene.text, "/scene/text");
  const formats::YamlNode* loads = formats::find_child(document.root, "loads");
  std::vector<std::string> names;
  for (const formats::YamlNode& load : loads == nullptr ? std::vector<formats::YamlNode>{} : loads->children) {
    const formats::YamlNode *type = formats::find_child(load, "type"), *of = formats::find_child(load, "body");
    if (type != nullptr && of != nullptr && type->text == "part_load" && of->text == body) names.push_back(load.key);
  }
  return names;
}

std::string quoted_names(std::vector<std::string> names) {
  for (std::string& name : names) name = "'" + printable_line(name, 60) + "'";
  return join(names, ", ");
}

}  // namespace

std::vector<std::string> applied_loads_notes(const formats::Recovery& recovery, const formats::ResultsLayout& layout,
                                             const BodyRow& body) {
  std::vector<std::string> notes;
  formats::LoadedBody loaded;
  loaded.row = body.row;
  loaded.is_modal = body.is_modal;
  const std::vector<std::string> unanswered = formats::loads_without_answer(recovery, layout, loaded);
  if (body.is_modal) {
    if (recovery.loads && !unanswered.empty())
      notes.push_back(fmt::format(
          "forces act on the body at {}, but the recovery file has no static answers to them. The part of their stress "
          "that the modes omit is neither added nor estimated. Make these nodes `boundary` nodes in the part file.",
          quoted_names(unanswered)));
    return notes;
  }
  if (!unanswered.empty())
    notes.push_back(
        fmt::format("load cases of the part act on the body ({}), but the recovery file has no static answers to them. "
                    "The part of their stress that the modes omit is neither added nor estimated. Reduce the part "
                    "again with `recovery: yes`, but not with method: macneal, which has no static answers.",
                    quoted_names(unanswered)));
  const std::size_t row = body.row;
  const bool stored =
      row + 1 < layout.load_case_offset.size() && layout.load_case_offset[row + 1] > layout.load_case_offset[row];
  if (stored) return notes;
  if (const std::vector<std::string> names = loads_of_scene(layout.simulated, body.name); !names.empty())
    notes.push_back(fmt::format(
        "load cases of the part act on the body ({}), but the results do not hold their factors. The part of their "
        "stress that the modes omit is neither added nor estimated. The results were written before version 1.11, or "
        "without the channel superelements/load_factor. Run the scene again with this channel.",
        quoted_names(names)));
  return notes;
}

std::string answered_loads(const formats::Recovery& recovery) {
  bool cases = false, nodes = false;
  if (recovery.loads)
    for (const formats::AppliedLoad& load : recovery.loads->applied) (load.node.empty() ? cases : nodes) = true;
  return nodes   ? "inertia, weight and forces at its nodes"
         : cases ? "inertia, weight and load cases"
                 : "inertia and weight";
}

}  // namespace tisserand::reducer
