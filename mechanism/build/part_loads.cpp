// SPDX-License-Identifier: GPL-3.0-or-later
// Load cases by name, resultants on rigid bodies, and the functions of time of part loads.
#include "mechanism/build/part_loads.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/build/bodies.hpp"
#include "mechanism/build/joints.hpp"

namespace tisserand::mechanism {
namespace {

Error missing_load_case(const formats::PartLoadSpec& load, const formats::SuperelementBodySpec& spec,
                        const formats::Companion* companion) {
  const std::string path = formats::companion_path(spec.file);
  const std::string who =
      fmt::format("load '{}': body '{}' has no load case '{}'", load.name, load.body, load.load_case);
  if (companion == nullptr)
    return {fmt::format("{}: there is no file {}", who, path), load.where,
            "write load cases with `load_cases` in the part file"};
  if (companion->load_cases.empty())
    return {fmt::format("{}: the file {} has no load cases", who, path), load.where,
            "write load cases with `load_cases` in the part file"};
  std::vector<std::string> names;
  for (const formats::LoadCase& one : companion->load_cases) names.push_back(one.name);
  return {fmt::format("{} in {}", who, path), load.where, "its load cases are " + listed(names)};
}

}  // namespace

bool bears_part_load(const formats::Scene& scene, const std::string& body) {
  return std::ranges::any_of(scene.part_loads, [&](const formats::PartLoadSpec& load) { return load.body == body; });
}

std::map<std::string, std::vector<std::string>> load_cases_by_file(const formats::Scene& scene) {
  std::map<std::string, std::vector<std::string>> list;
  if (scene.part_loads.empty()) return list;
  std::map<std::string, std::set<std::string>> sets;
  for (const formats::BodySpec& body : scene.bodies)
    if (const auto* spec = std::get_if<formats::SuperelementBodySpec>(&body))
      for (const formats::PartLoadSpec& load : scene.part_loads)
        if (load.body == spec->name) sets[spec->file].insert(load.load_case);
  for (const auto& [file, names] : sets) list[file] = {names.begin(), names.end()};
  return list;
}

void require_load_cases(const formats::Scene& scene, const formats::SuperelementBodySpec& spec,
                        const formats::Companion* companion) {
  std::vector<Error> errors;
  for (const formats::PartLoadSpec& load : scene.part_loads) {
    if (load.body != spec.name) continue;
    if (companion == nullptr || std::ranges::find(companion->load_cases, load.load_case, &formats::LoadCase::name) ==
                                    companion->load_cases.end())
      errors.push_back(missing_load_case(load, spec, companion));
  }
  if (!errors.empty()) throw merge_errors(errors);
}

std::vector<PartResultant> part_resultants(const formats::Companion& companion, const formats::Superelement& element,
                                           const Eigen::Vector3d& center, const UnitConversion& units) {
  const Eigen::MatrixXd R = formats::rigid_motions(element, center);
  const double force = units.mass * units.length / (units.time * units.time);
  std::vector<PartResultant> list;
  for (const formats::LoadCase& load : companion.load_cases) {
    PartResultant resultant{load.name};
    if (load.force.size() > 0) {
      resultant.force = force * (R.leftCols<3>().transpose() * load.force);
      resultant.moment = force * units.length * (R.rightCols<3>().transpose() * load.force);
    }
    list.push_back(std::move(resultant));
  }
  return list;
}

void add_part_load(const formats::PartLoadSpec& spec, Construction& c) {
  PartLoad load;
  load.name = spec.name;
  load.value = spec.value;
  load.where = spec.where;
  for (int i = 0; i < std::ssize(c.model.superelements); ++i) {
    if (c.model.superelements[i].name != spec.body) continue;
    const std::vector<BodyLoadCase>& cases = body_of(c.model, i).load_cases;
    const auto found = std::ranges::find(cases, spec.load_case, &BodyLoadCase::name);
    load.superelement = i;
    load.load_case = static_cast<int>(found - cases.begin());
    load.force = found->total;
  }
  if (load.superelement < 0) {
    const std::vector<PartResultant>& cases = c.part_resultants.at(spec.body);
    const auto found = std::ranges::find(cases, spec.load_case, &PartResultant::name);
    load.node = c.markers.places.at(spec.body).node;
    load.force = found->force;
    load.moment = found->moment;
  }
  const int index = count_of(c.model.part_loads);
  note_function(spec.value, {ChannelUse::Owner::part_load, index, 0, 0, 0}, c.model, c.breakpoints);
  c.model.part_loads.push_back(std::move(load));
}

}  // namespace tisserand::mechanism
