// SPDX-License-Identifier: GPL-3.0-or-later
// Reads supports and load cases of part.yaml.
#include "formats/part/loads.hpp"

#include <algorithm>

#include "formats/part/reader.hpp"
#include "formats/yaml/fields.hpp"
#include "formats/yaml/geometry.hpp"

namespace tisserand::formats {
namespace {

constexpr unsigned translation_bits = 0b000111, rotation_bits = 0b111000;

/// Whether the name is that of a point, spider or boundary node.
bool is_place(const Part& part, const std::string& name) {
  return std::ranges::find(part.points, name, &NamedPoint::name) != part.points.end() ||
         std::ranges::find(part.spiders, name, &SpiderLine::name) != part.spiders.end() ||
         std::ranges::find(part.boundary, name, &BoundaryNode::name) != part.boundary.end();
}

/// Reads `all`, `translations`, `rotations`, or one or a list of x ... rz.
void read_directions(const Context& context, const YamlNode& node, Support& support) {
  const std::string word = node.kind == YamlKind::scalar ? node.text : "";
  support.where_present = word == "all";
  if (word == "all" || word == "translations") support.components |= translation_bits;
  if (word == "all" || word == "rotations") support.components |= rotation_bits;
  if (support.components == 0) support.components = read_component_bits(context, node, "direction");
}

/// Reads a plane of symmetry with this normal: no motion across it, no rotation about axes in it.
void read_symmetry(const MapReader& map, Support& support) {
  const auto axis = read_word(map.context(), *map.find("symmetry"), "symmetry", {"x", "y", "z"});
  if (!axis) return;
  support.symmetry = static_cast<int>(*axis);
  support.components = (rotation_bits & ~(0b001000U << *axis)) | (0b000001U << *axis);
  support.where_present = true;
}

/// Reads `at` or the keys of a place. Returns whether one of them is present.
bool read_where(const MapReader& map, const Part& part, Place& place) {
  const YamlNode* at = map.find("at");
  const bool by_keys = map.has("node") || map.has("near") || map.has("tolerance") || map.has("centroid");
  if (at != nullptr && by_keys)
    map.context().fail(at->key_place, "both 'at' and another place are given", "give one of at, node, near");
  if (at != nullptr)
    place = read_place(map.context(), *at, "at", part);
  else if (by_keys)
    place = read_place_keys(map, part);
  return at != nullptr || by_keys;
}

Support read_support(const Context& context, const YamlNode& node, const Part& part) {
  Support support;
  support.name = node.key;
  support.where = context.entry;
  bool placed = false;
  if (node.kind != YamlKind::map) {
    read_directions(context, node, support);
  } else {
    const MapReader map(context, node, "support");
    map.require_one("directions", "symmetry", "give one of them");
    if (const YamlNode* directions = map.find("directions")) read_directions(context, *directions, support);
    if (map.has("symmetry")) read_symmetry(map, support);
    placed = read_where(map, part, support.at);
    if (const YamlNode* on = map.find("on")) {
      if (placed) context.fail(on->key_place, "both 'on' and a place are given", "give one of them");
      support.on = read_texts(context, *on, "on");
      placed = true;
    }
  }
  if (placed) return support;
  if (is_place(part, node.key))
    support.at = Place(node.key);
  else
    support.on = {node.key};
  return support;
}

PlaceLoad read_force(const Context& context, const YamlNode& node, const Part& part) {
  PlaceLoad load;
  load.name = node.key;
  load.at = Place(node.key);
  load.where = context.entry;
  if (node.kind != YamlKind::map) {
    load.force = read_vector(context, node, "force");
    return load;
  }
  const MapReader map(context, node, "place_load");
  if (!map.has("force") && !map.has("moment")) map.fail("neither 'force' nor 'moment' is given", "give one of them");
  read_fields(map, load);
  read_where(map, part, load.at);
  return load;
}

PartLoadCase read_load_case(const Context& context, const YamlNode& node, const Part& part) {
  const MapReader map(context, node, "load_case");
  YamlReader& reader = context.reader;
  PartLoadCase load;
  load.name = node.key;
  load.where = context.entry;
  read_fields(map, load);
  for (const YamlNode* entry : map.entries("forces", "force"))
    load.forces.push_back(read_force(entry_context(reader, "force", *entry), *entry, part));
  for (const YamlNode* entry : map.entries("pressures", "pressure")) {
    const Context own = entry_context(reader, "pressure", *entry);
    load.pressures.push_back({entry->key, read_number(own, *entry, "pressure"), own.entry});
  }
  for (const YamlNode* entry : map.entries("line_loads", "line load")) {
    const Context own = entry_context(reader, "line load", *entry);
    load.line_loads.push_back({entry->key, read_vector(own, *entry, "force per length"), own.entry});
  }
  return load;
}

}  // namespace

void read_loads(const MapReader& map, Part& part) {
  YamlReader& reader = map.context().reader;
  for (const YamlNode* node : map.entries("supports", "support"))
    part.supports.push_back(read_support(entry_context(reader, "support", *node), *node, part));
  for (const YamlNode* node : map.entries("load_cases", "load case"))
    part.load_cases.push_back(read_load_case(entry_context(reader, "load case", *node), *node, part));
}

std::vector<KeySet> load_key_sets() {
  return {
      {"support",
       {{"at", "at", "a point, spider or boundary node", "the name of the support"},
        {"node", "integer", "instead: a node of the mesh file, as a [place](#place)", "-"},
        {"near", "position", ditto},
        {"tolerance", "not_negative", ditto},
        {"centroid", "text+", ""},
        {"on", "text_list", "instead: the nodes of groups", "-"},
        {"directions", "held",
         "`all`, `translations`, `rotations`, or one or a list of `x`, `y`, `z`, `rx`, `ry`, `rz`, in part axes",
         "one of both"},
        {"symmetry", "'x' | 'y' | 'z'",
         "normal of the plane of symmetry in which the nodes lie. Holds the translation along the normal and the "
         "rotations about the other two axes",
         "one of both"}}},
      {"load_case",
       {{"forces", "{text: vector | place_load}",
         "place -> force `[x, y, z]` in part axes, or a map with `force` and `moment`", "none"},
        {"pressures", "{text: number}",
         "group of faces -> pressure [force/length²]. It acts against the normal of shells, and against the outward "
         "normal of solids",
         "none"},
        {"line_loads", "{text: vector}",
         "beam, or group of edges of beams, shells or solids -> force per length in part axes [force/length]", "none"},
        plain<&PartLoadCase::gravity>("gravity", "vector",
                                      "acceleration of gravity, `[0, 0, -9.81]` where z points up; the force on each "
                                      "mass is the mass times it [length/time²]")}},
      {"place_load",
       {plain<&PlaceLoad::force>("force", "vector", "force in part axes [force]"),
        plain<&PlaceLoad::moment>("moment", "vector", "moment in part axes [force length]"),
        {"at", "at", "a point, spider or boundary node", "the name of the load"},
        {"node", "integer", "instead: a node of the mesh file, as a [place](#place)", "-"},
        {"near", "position", ditto},
        {"tolerance", "not_negative", ditto},
        {"centroid", "text+", ""}}}};
}

}  // namespace tisserand::formats
