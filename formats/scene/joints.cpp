// `joints` of scene.yaml, and the markers that joints and forces use.
#include <algorithm>

#include "formats/scene/reader.hpp"
#include "formats/yaml/geometry.hpp"

namespace tisserand::formats {

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

void read_marker_pair(const MapReader& map, MarkerPairSpec& pair) {
  pair.a = read_marker(map, "a");
  pair.b = read_marker(map, "b");
  pair.axis = read_optional_vector(map, "axis");
  pair.x_axis = read_optional_vector(map, "x_axis");
  pair.position = read_optional_vector(map, "position");
}

CoordinateRef read_coordinate(const MapReader& map, const YamlNode& node, const std::string& key) {
  return {read_text(map.context(), node, key), map.context().reader.where(node.place)};
}

namespace {

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

JointKind read_kind(const MapReader& map) {
  const YamlNode* node = map.require("type");
  if (node == nullptr) return JointKind::spherical;
  std::vector<std::string> words;
  for (const JointKindRow& row : joint_kinds()) words.emplace_back(row.word);
  const auto index = read_word(map.context(), *node, "type", words);
  return index ? joint_kinds()[*index].kind : JointKind::spherical;
}

/// The key that this kind alone or with some others takes; those of other kinds are errors.
void read_own_key(const MapReader& map, JointSpec& joint) {
  const JointKey own = joint_kind(joint.kind).key;
  if (own == JointKey::hold) joint.hold = read_hold(map);
  if (own == JointKey::pitch) joint.pitch = map.number("pitch");
  if (own == JointKey::length && map.has("length")) joint.length = map.number("length");
  for (const JointKindRow& other : joint_kinds()) {
    const std::string_view key = joint_key_word(other.key);
    if (other.key == JointKey::none || other.key == own) continue;
    if (const YamlNode* node = map.find(key))
      map.context().fail(node->key_place, fmt::format("'{}' belongs to joints of type {}", key, other.word),
                         "remove it");
  }
}

FrictionSpec read_friction(const Context& context, const YamlNode& node, JointKind kind) {
  const MapReader map({context.reader, context.subject + ": friction", context.entry}, node, "friction", "friction.");
  FrictionSpec friction;
  friction.coefficient = map.number("coefficient");
  if (map.has("static_coefficient")) friction.static_coefficient = map.number("static_coefficient");
  friction.velocity = map.number("velocity");
  const FrictionKeys keys = joint_kind(kind).friction;
  const YamlNode* radius = map.find("radius");
  if (radius && keys.has_friction && !keys.radius)
    map.context().fail(radius->key_place, fmt::format("'radius' has no effect in a {} joint", joint_word(kind)),
                       "remove it");
  if (keys.radius) friction.radius = map.number("radius");
  if (map.has("arm")) friction.arm = map.number("arm");
  return friction;
}

JointSpec read_joint(const Context& context, const YamlNode& node) {
  const MapReader map(context, node, "joint");
  JointSpec joint;
  joint.name = node.key;
  joint.where = context.entry;
  joint.kind = read_kind(map);
  read_marker_pair(map, joint);
  read_own_key(map, joint);
  if (const YamlNode* friction = map.find("friction")) joint.friction = read_friction(context, *friction, joint.kind);
  return joint;
}

/// `{type: gear, between: [hinge_1, hinge_2], ratio: -2}` or `{type: rack_and_pinion, between: [hinge, slide], radius:
/// r}`.
GearSpec read_gear(const Context& context, const YamlNode& node, const GearKindRow& kind) {
  const MapReader map(context, node, kind.word);
  GearSpec gear;
  gear.name = node.key;
  gear.where = context.entry;
  gear.ratio = map.number(kind.key);
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

}  // namespace

void read_joints(const MapReader& map, Scene& scene) {
  for (const YamlNode* node : map.entries("joints", "joint")) {
    const Context context = entry_context(map.context().reader, "joint", *node);
    const std::string type = type_of(*node);
    const auto gear = std::ranges::find(gear_kinds, type, &GearKindRow::word);
    if (gear != gear_kinds.end())
      scene.gears.push_back(read_gear(context, *node, *gear));
    else
      scene.joints.push_back(read_joint(context, *node));
  }
}

}  // namespace tisserand::formats
