// SPDX-License-Identifier: GPL-3.0-or-later
// Resolution of the names of groups.
#include "reducer/sources/selection.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/sources/group_geometry.hpp"

namespace tisserand::reducer {
namespace {

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool is_empty(const Selection& selection) {
  const ElementSet& e = selection.elements;
  return selection.entities.empty() && selection.nodes.empty() && e.beams.empty() && e.shells.empty() &&
         e.solids.empty() && e.springs.empty();
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

void append(Selection& to, const Selection& from) {
  append(to.entities, from.entities);
  append(to.nodes, from.nodes);
  append(to.elements.beams, from.elements.beams);
  append(to.elements.shells, from.elements.shells);
  append(to.elements.solids, from.elements.solids);
  append(to.elements.springs, from.elements.springs);
}

template <class T>
void make_unique(std::vector<T>& values) {
  std::ranges::sort(values);
  const auto rest = std::ranges::unique(values);
  values.erase(rest.begin(), rest.end());
}

/// Entity of a geometry with this number, or -1.
int entity_of_number(const CellMesh& cells, int dimension, long number) {
  for (int e = 0; e < std::ssize(cells.entities); ++e)
    if (cells.entities[e].dimension == dimension && cells.entities[e].number == number && number > 0) return e;
  return -1;
}

[[noreturn]] void refuse_number(const CellMesh& cells, int dimension, long number, const User& user) {
  long highest = 0;
  for (const Entity& entity : cells.entities)
    if (entity.dimension == dimension) highest = std::max<long>(highest, entity.number);
  const char* word = dimension_word(dimension);
  throw Error(fmt::format("{}: {} {} does not exist", user.name, word, number), user.where,
              highest > 0 ? fmt::format("{}s have numbers up to {}; `reducer groups` lists them", word, highest)
                          : fmt::format("there are no {}s with numbers", word));
}

/// Selection by a number such as "face 12".
Selection by_number(const MeshBuilder& builder, const std::string& name, const User& user) {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    const std::string word = std::string(dimension_word(dimension)) + " ";
    if (!name.starts_with(word)) continue;
    long number = 0;
    const char* begin = name.data() + word.size();
    const char* end = name.data() + name.size();
    if (const auto [stop, status] = std::from_chars(begin, end, number); status != std::errc() || stop != end) continue;
    const int entity = entity_of_number(builder.cells, dimension, number);
    if (entity < 0) refuse_number(builder.cells, dimension, number, user);
    return {{entity}, {}, {}};
  }
  return {};
}

/// Selection by label. Labels of CAD files are paths of assembly, part and face; a unique last name suffices.
Selection by_label(const MeshBuilder& builder, const std::string& name, int dimension, const User& user) {
  Selection whole, last;
  for (int e = 0; e < std::ssize(builder.cells.entities); ++e) {
    const Entity& entity = builder.cells.entities[e];
    if (entity.label.empty() || (dimension > 0 && entity.dimension != dimension)) continue;
    if (entity.label == name) whole.entities.push_back(e);
    if (entity.number > 0 && entity.label.ends_with("/" + name)) last.entities.push_back(e);
  }
  const Selection& found = whole.entities.empty() ? last : whole;
  if (found.entities.size() < 2) return found;
  std::vector<std::string> names;
  for (const int e : found.entities) names.push_back(name_of(builder.cells.entities[e]));
  throw Error(fmt::format("{}: the label '{}' belongs to {}", user.name, name, listed(names)), user.where,
              "name one of them by its number");
}

/// Selection by physical group. A name may occur in several dimensions; the requested or the highest one counts.
Selection by_physical_group(const MeshBuilder& builder, const std::string& name, int dimension) {
  const EntityGroup* best = nullptr;
  for (const EntityGroup& group : builder.cells.groups) {
    if (group.name != name || (best != nullptr && best->dimension == dimension)) continue;
    if (best == nullptr || group.dimension == dimension || group.dimension > best->dimension) best = &group;
  }
  return best == nullptr ? Selection{} : Selection{best->entities, {}, {}};
}

Selection by_set(const MeshBuilder& builder, const std::string& name) {
  Selection selection;
  if (const auto set = builder.element_sets.find(lower(name)); set != builder.element_sets.end())
    selection.elements = set->second;
  else if (const auto nodes = builder.node_sets.find(lower(name)); nodes != builder.node_sets.end())
    selection.nodes = nodes->second;
  return selection;
}

/// All of this dimension from the mesh file, and patches that need a layout.
Selection all_of(const MeshBuilder& builder, int dimension) {
  Selection selection;
  for (int e = 0; e < std::ssize(builder.cells.entities); ++e) {
    const Entity& entity = builder.cells.entities[e];
    if (entity.dimension != dimension) continue;
    const auto patch = std::ranges::find(builder.part.patches, entity.label, &formats::ShellPatch::name);
    const bool drawn = entity.number == 0;
    if (!drawn || (dimension == 2 && patch != builder.part.patches.end() && !patch->layout))
      selection.entities.push_back(e);
  }
  return selection;
}

Selection by_name(const MeshBuilder& builder, const std::string& name, int dimension, const User& user, int depth);

/// Union of the selections by the definition's keys.
Selection by_definition(const MeshBuilder& builder, const formats::GroupDefinition& group, int depth) {
  const User user{fmt::format("group '{}'", group.name), group.where};
  if (depth > 20)
    throw Error(user.name + " contains itself", group.where, "remove the circular reference between groups");
  const int dimension = static_cast<int>(group.of);
  Selection selection;
  for (const long number : group.numbers) {
    if (dimension == 0) {
      selection.nodes.push_back(find_file_node(builder, number, user));
      continue;
    }
    const int entity = entity_of_number(builder.cells, dimension, number);
    if (entity < 0) refuse_number(builder.cells, dimension, number, user);
    selection.entities.push_back(entity);
  }
  for (const std::string& name : group.groups) append(selection, by_name(builder, name, -1, user, depth + 1));
  if (group.box || group.cylinder) {
    const auto [entities, nodes] = inside(builder, group);
    append(selection.entities, entities);
    append(selection.nodes, nodes);
  }
  if (group.near) {
    if (dimension == 0)
      selection.nodes.push_back(nearest_file_node(builder, *group.near, group.tolerance, user));
    else
      selection.entities.push_back(nearest_entity(builder, group, user));
  }
  if (is_empty(selection))
    throw Error(user.name + " selects nothing", group.where,
                "`reducer groups` lists all entities with bounding boxes; a tolerance enlarges boxes");
  return selection;
}

Selection by_name(const MeshBuilder& builder, const std::string& name, int dimension, const User& user, int depth) {
  const auto defined = std::ranges::find(builder.part.groups, name, &formats::GroupDefinition::name);
  if (defined != builder.part.groups.end()) return by_definition(builder, *defined, depth);
  if (name == "all" && dimension > 0) return all_of(builder, dimension);
  Selection selection = by_physical_group(builder, name, dimension);
  if (is_empty(selection)) selection = by_number(builder, name, user);
  if (is_empty(selection)) selection = by_label(builder, name, dimension, user);
  if (is_empty(selection)) selection = by_set(builder, name);
  return selection;
}

[[noreturn]] void refuse_name(const MeshBuilder& builder, const std::string& name, int dimension, const User& user) {
  if (name == "all" && dimension > 0)
    throw Error(fmt::format("{}: there are no {}s", user.name, dimension_word(dimension)), user.where,
                "`reducer groups` lists all entities");
  std::vector<std::string> known = group_names(builder);
  const std::optional<std::string> guess = nearest(name, known);
  throw Error(fmt::format("{}: there is no group '{}'", user.name, name), user.where,
              guess           ? fmt::format("did you mean '{}'?", *guess)
              : known.empty() ? "there are no named groups; define one under groups"
                              : "known are " + listed(known));
}

}  // namespace

std::vector<std::string> group_names(const MeshBuilder& builder) {
  std::vector<std::string> names;
  for (const formats::GroupDefinition& group : builder.part.groups) names.push_back(group.name);
  for (const EntityGroup& group : builder.cells.groups) names.push_back(group.name);
  for (const Entity& entity : builder.cells.entities)
    if (!entity.label.empty()) names.push_back(entity.label);
  for (const auto& [name, set] : builder.element_sets) names.push_back(name);
  for (const auto& [name, set] : builder.node_sets) names.push_back(name);
  return names;
}

Selection select(const MeshBuilder& builder, const std::string& name, int dimension, const User& user) {
  Selection selection = by_name(builder, name, dimension, user, 0);
  if (is_empty(selection) && dimension > 0) selection = by_name(builder, name, -1, user, 0);  // of another dimension
  make_unique(selection.entities);
  make_unique(selection.nodes);
  make_unique(selection.elements.beams);
  make_unique(selection.elements.shells);
  make_unique(selection.elements.solids);
  if (is_empty(selection)) refuse_name(builder, name, dimension, user);
  for (const int e : selection.entities) {
    const Entity& entity = builder.cells.entities[e];
    if (dimension > 0 && entity.dimension != dimension)
      throw Error(fmt::format("{}: '{}' holds {}s, but {}s are needed ({})", user.name, name,
                              dimension_word(entity.dimension), dimension_word(dimension), name_of(entity)),
                  user.where, "name a group of the right kind");
  }
  return selection;
}

Eigen::Vector3d centroid(const MeshBuilder& builder, const std::vector<std::string>& names, const User& user) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double total = 0.0;
  for (const std::string& name : names)
    for (const auto& [node, weight] : node_weights(builder, select(builder, name, -1, user))) {
      sum += weight * builder.position(node);
      total += weight;
    }
  if (!(total > 0.0)) throw Error(user.name + ": the group has no length, area or volume", user.where, "");
  return sum / total;
}

}  // namespace tisserand::reducer
