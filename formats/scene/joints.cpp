// SPDX-License-Identifier: GPL-3.0-or-later
// Reads `joints` of scene.yaml, and the markers of joints and forces.
#include <algorithm>

#include "formats/scene/reader.hpp"
#include "formats/yaml/fields.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {

MarkerSpec read_marker(const MapReader& map, const std::string& key) {
  MarkerSpec marker;
  marker.where = map.context().entry;
  const YamlNode* node = map.require(key);
  if (node == nullptr) return marker;
  marker.where = map.context().reader.where(node->place);
  if (node->kind != YamlKind::map) {
    marker.node = read_text(map.context(), *node, key);
    return marker;
  }
  const MapReader inner = map.inside(*node, "marker");
  read_fields(inner, marker);
  if (const YamlNode* place = inner.find("node")) marker.where = map.context().reader.where(place->place);
  return marker;
}

void read_value(const MapReader& map, const Field& field, MarkerSpec& value) {
  value = read_marker(map, std::string(field.key));
}

CoordinateRef read_coordinate(const MapReader& map, const YamlNode& node, const std::string& key) {
  return {read_text(map.context(), node, key), map.context().reader.where(node.place)};
}

void read_value(const MapReader& map, const Field& field, CoordinateRef& value) {
  if (const YamlNode* node = find_or_require(map, field)) value = read_coordinate(map, *node, std::string(field.key));
}

void read_value(const MapReader& map, const Field& field, std::optional<CoordinateRef>& value) {
  if (map.has(field.key)) read_value(map, field, value.emplace());
}

namespace {

/// Reads `hold: [x, y, rz]`: held directions of a generic joint.
std::array<bool, 6> read_hold(const MapReader& map) {
  std::array<bool, 6> held{};
  const YamlNode* node = map.require("hold");
  if (node == nullptr) return held;
  if (!map.context().require_list(*node, "hold must be a list of directions", "write it as [x, y, rz]")) return held;
  for (const YamlNode& item : node->children)
    if (const auto index = read_word(map.context(), item, "direction", {"x", "y", "z", "rx", "ry", "rz"}))
      held[*index] = true;
  return held;
}

JointKind read_kind(const MapReader& map) {
  const YamlNode* node = map.require("type");
  if (node == nullptr) return JointKind::spherical;
  const auto index = read_word(map.context(), *node, "type", texts_of(joint_kinds(), &JointKindRow::word));
  return index ? joint_kinds()[*index].kind : JointKind::spherical;
}

/// Reads the key that this kind of joint takes, and refuses those of other kinds.
void read_own_key(const MapReader& map, JointSpec& joint) {
  const JointKey own = joint_kind(joint.kind).key;
  if (own == JointKey::hold) joint.hold = read_hold(map);
  if (own == JointKey::pitch) joint.pitch = map.number("pitch");
  if (own == JointKey::length && map.has("length")) joint.length = map.number("length");
  for (const JointKindRow& other : joint_kinds()) {
    const std::string_view key = joint_key_word(other.key);
    if (other.key != JointKey::none && other.key != own)
      map.refuse({key}, fmt::format("belongs to joints of type {}", other.word), "remove it");
  }
}

FrictionSpec read_friction(const MapReader& map, JointKind kind) {
  FrictionSpec friction;
  read_fields(map, friction);
  const FrictionKeys keys = joint_kind(kind).friction;
  if (keys.has_friction && !keys.radius)
    map.refuse({"radius"}, fmt::format("has no effect in a {} joint", joint_word(kind)), "remove it");
  if (keys.radius) friction.radius = map.number("radius");
  return friction;
}

JointSpec read_joint(const MapReader& map) {
  auto joint = read_entry<JointSpec>(map);
  joint.kind = read_kind(map);
  read_fields<MarkerPairSpec>(map, joint);
  read_own_key(map, joint);
  if (const YamlNode* node = map.find("friction"))
    joint.friction = read_friction(map.inside(*node, "friction"), joint.kind);
  return joint;
}

/// Reads `{type: gear, between: [hinge_1, hinge_2], ratio: -2}` or
/// `{type: rack_and_pinion, between: [hinge, slide], radius: r}`.
GearSpec read_gear(const MapReader& map, const GearKindRow& kind) {
  auto gear = read_entry<GearSpec>(map);
  gear.ratio = map.number(kind.key);
  const YamlNode* between = map.require("between");
  if (between == nullptr) return gear;
  if (!map.context().require_list(*between, "between must name two joint coordinates", "write it as [hinge_1, hinge_2]",
                                  2))
    return gear;
  gear.first = read_coordinate(map, between->children[0], "between[0]");
  gear.second = read_coordinate(map, between->children[1], "between[1]");
  return gear;
}

}  // namespace

std::vector<KeySet> joint_key_sets() {
  static const std::vector<std::string_view> words = [] {
    std::vector<std::string_view> all;
    for (const JointKindRow& row : joint_kinds()) all.push_back(row.word);
    return all;
  }();
  return {{"joint",
           {{"type", "", "kind of joint, see [kinds of joints](#kinds-of-joints)", "required", words},
            plain<&MarkerPairSpec::a>("a", "place",
                                      "markers on two nodes: `ground`, `block`, `beam/base`, or `{node: beam/base, "
                                      "position: [..], orientation: ..}` with an offset in the axes of the node",
                                      "required"),
            plain<&MarkerPairSpec::b>("b", "place", ditto),
            plain<&MarkerPairSpec::position>(
                "position", "vector",
                "place of the joint at the start, world frame. It applies to markers without a `position` of their "
                "own; an error if both have one",
                "place of node or marker b; that of a if b is `ground` or if only a has a `position`"),
            plain<&MarkerPairSpec::axis>("axis", "vector",
                                         "z axis of the joint at the start, world axes. It applies to markers without "
                                         "an `orientation` of their own; an error if both have one",
                                         "-"),
            plain<&MarkerPairSpec::x_axis>("x_axis", "vector",
                                           "with `axis`: a direction whose component normal to `axis` is the x axis",
                                           "the world axis most nearly normal to `axis`"),
            {"hold", "['x' | 'y' | 'z' | 'rx' | 'ry' | 'rz']1..",
             "`generic`: list of the directions of a's axes that are held, from `x y z rx ry rz`",
             "required for this kind"},
            {"pitch", "number", "`screw`: advance along z per turn [length]; negative: left-handed",
             "required for this kind"},
            {"length", "positive", "`distance`: the distance that is kept [length]", "value at the start"},
            {"friction", "friction", "Coulomb friction, for kinds with a contact surface: see [friction](#friction)",
             "none"}}},
          {"friction",
           {plain<&FrictionSpec::coefficient>("coefficient", "not_negative", "coefficient of friction μ while sliding",
                                              "required"),
            plain<&FrictionSpec::static_coefficient>("static_coefficient", "not_negative",
                                                     "coefficient of friction μ_s at which sliding begins, not below μ",
                                                     "μ"),
            plain<&FrictionSpec::velocity>("velocity", "positive",
                                           "sliding velocity v at which μ_s is reached [length/time]", "required"),
            {"radius", "positive",
             "r of the contact surface [length]; not for `prismatic`, `point_on_line`, `point_on_plane`",
             "required by the others"},
            plain<&FrictionSpec::arm>("arm", "positive",
                                      "distance of two supports that take the reaction moment [length]; not for "
                                      "`spherical`, `point_on_line`, `point_on_plane`",
                                      "moments do not count")}},
          {"gear",
           {{"type", "'gear'", "", "required"},
            {"between", "[text]2", "", "required"},
            {"ratio", "number", "", "required"}}},
          {"rack_and_pinion",
           {{"type", "'rack_and_pinion'", "", "required"},
            {"between", "[text]2", "", "required"},
            {"radius", "number", "", "required"}}},
          {"marker",
           {plain<&MarkerSpec::node>("node", "text", "", "required"),
            plain<&MarkerSpec::position>("position", "vector", ""),
            plain<&MarkerSpec::orientation>("orientation", "rotation", "")}}};
}

void read_joints(const MapReader& map, Scene& scene) {
  for (const YamlNode* node : map.entries("joints", "joint")) {
    const Context context = entry_context(map.context().reader, "joint", *node);
    const YamlNode* type = find_child(*node, "type");
    const auto gear =
        std::ranges::find(gear_kinds, type == nullptr ? "" : std::string_view(type->text), &GearKindRow::word);
    if (gear != gear_kinds.end())
      scene.gears.push_back(read_gear(MapReader(context, *node, gear->word), *gear));
    else
      scene.joints.push_back(read_joint(MapReader(context, *node, "joint")));
  }
}

}  // namespace tisserand::formats
