// `joints` and `loads` of scene.yaml, and the markers that both use.
#include "formats/geometry_reader.hpp"
#include "formats/scene_reader.hpp"
#include "formats/time_function_reader.hpp"

namespace tisserand::formats {

namespace {

/// "ground", "body", "body/node", or {node: .., position: .., orientation: ..}.
MarkerSpec read_marker(const MapReader& map, const std::string& key) {
  MarkerSpec marker;
  marker.where = map.context().entry;
  const YamlNode* node = map.require(key);
  if (node == nullptr) return marker;
  const Context context{map.context().reader, fmt::format("{}: {}", map.context().subject, key), map.context().entry};
  marker.where = context.reader.where(node->place);
  if (node->kind != YamlKind::map) {
    marker.node = read_text(map.context(), *node, key);
    return marker;
  }
  const MapReader inner(context, *node, "marker", key + ".");
  marker.node = inner.text("node");
  if (const YamlNode* place = inner.find("node")) marker.where = context.reader.where(place->place);
  marker.position = read_optional_vector(inner, "position");
  if (const YamlNode* orientation = inner.find("orientation"))
    marker.orientation = read_orientation(context, *orientation, "orientation");
  return marker;
}

JointSpec read_joint(const Context& context, const YamlNode& node) {
  const MapReader map(context, node, "joint");
  JointSpec joint;
  joint.name = node.key;
  joint.where = context.entry;
  map.require("type");
  joint.kind = map.choice("type",
                          {Choice<JointKind>{"fixed", JointKind::fixed},
                           {"revolute", JointKind::revolute},
                           {"spherical", JointKind::spherical}},
                          JointKind::spherical);
  joint.a = read_marker(map, "a");
  joint.b = read_marker(map, "b");
  joint.axis = read_optional_vector(map, "axis");
  joint.position = read_optional_vector(map, "position");
  return joint;
}

LoadSpec read_load(const Context& context, const YamlNode& node, const SceneDefinitions& definitions) {
  const MapReader map(context, node, "load");
  LoadSpec load;
  load.name = node.key;
  load.where = context.entry;
  map.require("type");
  load.kind =
      map.choice("type", {Choice<LoadKind>{"force", LoadKind::force}, {"moment", LoadKind::moment}}, LoadKind::force);
  load.at = read_marker(map, "at");
  load.axes =
      map.choice("axes", {Choice<LoadAxes>{"world", LoadAxes::world}, {"body", LoadAxes::body}}, LoadAxes::world);
  const YamlNode* value = map.require("value");
  if (value == nullptr) return load;
  if (value->kind != YamlKind::sequence || value->children.size() != 3) {
    context.fail(value->place, fmt::format("value must have three components, not {}", describe(*value)),
                 "write it as [0, 0, \"sin(t)\"]");
    return load;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string what = fmt::format("value[{}]", i);
    context.reader.note(context.entry, what, value->children[i]);
    load.components[i] = read_time_function(context, value->children[i], what, definitions.folder);
  }
  return load;
}

}  // namespace

std::vector<JointSpec> read_joints(const MapReader& map) {
  std::vector<JointSpec> joints;
  for (const YamlNode* node : map.entries("joints", "joint"))
    joints.push_back(read_joint(entry_context(map.context().reader, "joint", *node), *node));
  return joints;
}

std::vector<LoadSpec> read_loads(const MapReader& map, const SceneDefinitions& definitions) {
  std::vector<LoadSpec> loads;
  for (const YamlNode* node : map.entries("loads", "load"))
    loads.push_back(read_load(entry_context(map.context().reader, "load", *node), *node, definitions));
  return loads;
}

}  // namespace tisserand::formats
