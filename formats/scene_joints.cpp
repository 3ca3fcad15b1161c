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

CoordinateRef read_coordinate(const MapReader& map, const YamlNode& node, const std::string& key) {
  return {read_text(map.context(), node, key), map.context().reader.where(node.place)};
}

/// `hold: [x, y, rz]`: the directions of a generic joint that are held.
std::array<bool, 6> read_hold(const MapReader& map) {
  std::array<bool, 6> held{};
  const YamlNode* node = map.require("hold");
  if (node == nullptr) return held;
  if (node->kind != YamlKind::sequence) {
    map.context().fail(node->place, fmt::format("hold must be a list of directions, not {}", describe(*node)),
                       "write it as [x, y, rz]");
    return held;
  }
  for (const YamlNode& item : node->children)
    if (const auto index = read_word(map.context(), item, "direction", {"x", "y", "z", "rx", "ry", "rz"}))
      held[*index] = true;
  return held;
}

constexpr Choice<JointKind> joint_kinds[] = {{"fixed", JointKind::fixed},
                                             {"revolute", JointKind::revolute},
                                             {"spherical", JointKind::spherical},
                                             {"universal", JointKind::universal},
                                             {"constant_velocity", JointKind::constant_velocity},
                                             {"cylindrical", JointKind::cylindrical},
                                             {"screw", JointKind::screw},
                                             {"prismatic", JointKind::prismatic},
                                             {"planar", JointKind::planar},
                                             {"point_on_line", JointKind::point_on_line},
                                             {"point_on_plane", JointKind::point_on_plane},
                                             {"distance", JointKind::distance},
                                             {"constant_orientation", JointKind::constant_orientation},
                                             {"parallel_axes", JointKind::parallel_axes},
                                             {"generic", JointKind::generic}};

void refuse_without(const MapReader& map, const char* key, bool used, const char* kind) {
  if (const YamlNode* node = map.find(key); node != nullptr && !used)
    map.context().fail(node->key_place, fmt::format("'{}' belongs to joints of type {}", key, kind), "remove it");
}

JointSpec read_joint(const Context& context, const YamlNode& node) {
  const MapReader map(context, node, "joint");
  JointSpec joint;
  joint.name = node.key;
  joint.where = context.entry;
  map.require("type");
  joint.kind = map.choice("type", joint_kinds, JointKind::spherical);
  joint.a = read_marker(map, "a");
  joint.b = read_marker(map, "b");
  joint.axis = read_optional_vector(map, "axis");
  joint.x_axis = read_optional_vector(map, "x_axis");
  joint.position = read_optional_vector(map, "position");
  if (joint.kind == JointKind::generic) joint.hold = read_hold(map);
  if (joint.kind == JointKind::screw) joint.pitch = map.number("pitch");
  if (joint.kind == JointKind::distance && map.has("length")) joint.length = map.number("length");
  refuse_without(map, "hold", joint.kind == JointKind::generic, "generic");
  refuse_without(map, "pitch", joint.kind == JointKind::screw, "screw");
  refuse_without(map, "length", joint.kind == JointKind::distance, "distance");
  return joint;
}

/// `{type: gear, between: [hinge_1, hinge_2], ratio: -2}` or `{type: rack_and_pinion, between: [hinge, slide], radius:
/// r}`.
GearSpec read_gear(const Context& context, const YamlNode& node, const std::string& ratio_key) {
  const MapReader map(context, node, ratio_key == "ratio" ? "gear" : "rack_and_pinion");
  GearSpec gear;
  gear.name = node.key;
  gear.where = context.entry;
  gear.ratio = map.number(ratio_key);
  const YamlNode* between = map.require("between");
  if (between == nullptr) return gear;
  if (between->kind != YamlKind::sequence || between->children.size() != 2) {
    context.fail(between->place, fmt::format("between must name two joint coordinates, not {}", describe(*between)),
                 "write it as [hinge_1, hinge_2]");
    return gear;
  }
  gear.first = read_coordinate(map, between->children[0], "between[0]");
  gear.second = read_coordinate(map, between->children[1], "between[1]");
  return gear;
}

/// The word after `type`, or nothing.
std::string type_of(const YamlNode& joint) {
  for (const YamlNode& child : joint.children)
    if (child.key == "type" && child.kind == YamlKind::scalar) return child.text;
  return {};
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

TimeFunctionSpec read_function(const MapReader& map, const YamlNode& node, const std::string& key,
                               const SceneDefinitions& definitions) {
  map.context().reader.note(map.context().entry, key, node);
  return read_time_function(map.context(), node, key, definitions.folder);
}

}  // namespace

std::string joint_word(JointKind kind) {
  for (const Choice<JointKind>& choice : joint_kinds)
    if (choice.value == kind) return std::string(choice.word);
  return {};
}

bool needs_axis(JointKind kind) {
  switch (kind) {
    case JointKind::revolute:
    case JointKind::universal:
    case JointKind::constant_velocity:
    case JointKind::cylindrical:
    case JointKind::screw:
    case JointKind::prismatic:
    case JointKind::planar:
    case JointKind::point_on_line:
    case JointKind::point_on_plane:
    case JointKind::parallel_axes:
      return true;
    case JointKind::fixed:
    case JointKind::spherical:
    case JointKind::distance:
    case JointKind::constant_orientation:
    case JointKind::generic:
      return false;
  }
  return false;
}

void read_joints(const MapReader& map, Scene& scene) {
  for (const YamlNode* node : map.entries("joints", "joint")) {
    const Context context = entry_context(map.context().reader, "joint", *node);
    const std::string type = type_of(*node);
    if (type == "gear" || type == "rack_and_pinion")
      scene.gears.push_back(read_gear(context, *node, type == "gear" ? "ratio" : "radius"));
    else
      scene.joints.push_back(read_joint(context, *node));
  }
}

std::vector<MotionSpec> read_motions(const MapReader& map, const SceneDefinitions& definitions) {
  std::vector<MotionSpec> motions;
  for (const YamlNode* node : map.entries("motions", "motion")) {
    const Context context = entry_context(map.context().reader, "motion", *node);
    const MapReader inner(context, *node, "motion");
    MotionSpec motion;
    motion.name = node->key;
    motion.where = context.entry;
    if (const YamlNode* coordinate = inner.require("coordinate"))
      motion.coordinate = read_coordinate(inner, *coordinate, "coordinate");
    if (const YamlNode* value = inner.require("value"))
      motion.value = read_function(inner, *value, "value", definitions);
    motions.push_back(std::move(motion));
  }
  return motions;
}

std::vector<SpringSpec> read_springs(const MapReader& map, const SceneDefinitions& definitions) {
  std::vector<SpringSpec> springs;
  for (const YamlNode* node : map.entries("springs", "spring")) {
    const Context context = entry_context(map.context().reader, "spring", *node);
    const MapReader inner(context, *node, "spring");
    SpringSpec spring;
    spring.name = node->key;
    spring.where = context.entry;
    if (const YamlNode* coordinate = inner.find("coordinate")) {
      spring.coordinate = read_coordinate(inner, *coordinate, "coordinate");
      if (inner.has("a") || inner.has("b"))
        inner.fail("both 'coordinate' and the markers 'a', 'b' are given", "give one of them");
    } else {
      spring.a = read_marker(inner, "a");
      spring.b = read_marker(inner, "b");
    }
    spring.stiffness = inner.number("stiffness", 0.0);
    spring.damping = inner.number("damping", 0.0);
    if (inner.has("free")) spring.free = inner.number("free");
    if (inner.has("lower")) spring.lower = inner.number("lower");
    if (inner.has("upper")) spring.upper = inner.number("upper");
    if (spring.lower || spring.upper) spring.stop_stiffness = inner.number("stop_stiffness");
    spring.stop_damping = inner.number("stop_damping", 0.0);
    if (const YamlNode* force = inner.find("force")) spring.force = read_function(inner, *force, "force", definitions);
    springs.push_back(std::move(spring));
  }
  return springs;
}

std::vector<LoadSpec> read_loads(const MapReader& map, const SceneDefinitions& definitions) {
  std::vector<LoadSpec> loads;
  for (const YamlNode* node : map.entries("loads", "load"))
    loads.push_back(read_load(entry_context(map.context().reader, "load", *node), *node, definitions));
  return loads;
}

}  // namespace tisserand::formats
