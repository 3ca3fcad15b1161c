// SPDX-License-Identifier: GPL-3.0-or-later
// Checks a scene: names, references to bodies and nodes, ranges of settings.
#include "formats/scene/check.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <unordered_set>

#include "common/text.hpp"
#include "formats/scene/check_parts.hpp"
#include "formats/scene/expand/expression.hpp"
#include "formats/scene/time_function_reader.hpp"
#include "formats/sections/reader.hpp"
#include "formats/yaml/line_check.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

constexpr int most_elements = 100'000;  ///< limit of one beam

const std::string& name_of(const BodySpec& body) {
  return std::visit([](const auto& spec) -> const std::string& { return spec.name; }, body);
}

void check_start(const InitialMotion& start, const Subject& subject) {
  subject.finite("pose.position", start.pose.position);
  if (start.velocity) subject.finite("velocity", *start.velocity);
  if (start.angular_velocity) subject.finite("angular_velocity", *start.angular_velocity);
  if (const double length = start.pose.orientation.norm(); !(std::abs(length - 1.0) < 1e-9))
    subject.add("pose.orientation", fmt::format("the quaternion of the orientation has length {:g}, not 1", length));
}

void check_weights(const std::vector<NodeWeight>& weights, const std::string& key, const Subject& subject) {
  double sum = 0.0;
  for (const NodeWeight& weight : weights) sum += weight.weight;
  if (!weights.empty() && !(std::abs(sum - 1.0) < 1e-6))
    subject.add(key, fmt::format("{} have the sum {:.9g}", key, sum), "their sum must be 1");
}

void check_damping(const Damping& damping, const Subject& subject) {
  subject.not_negative("mass", damping.mass);
  subject.not_negative("stiffness", damping.stiffness);
  subject.not_negative("ratio", damping.ratio);
  for (const double ratio : damping.ratios) subject.not_negative("ratios", ratio);
  subject.not_negative("ratio_internal", damping.ratio_internal);
  for (const double ratio : damping.ratios_internal) subject.not_negative("ratios_internal", ratio);
}

/// Checks that bodies with modes from a file share.
template <class Body>
void check_modal_choice(const Body& body, const std::string& noun, const Subject& subject) {
  if (body.file.empty()) subject.add("file", fmt::format("has no {}", noun));
  if (body.modes && *body.modes < 0)
    subject.add("modes", fmt::format("modes {} must not be negative", *body.modes), "write modes: 0 to use no modes");
  subject.positive("cutoff", body.cutoff);
  check_damping(body.damping, subject.inside("damping"));
}

void check_body(const ModalBodySpec& body, const Subject& subject) {
  check_modal_choice(body, "modal body file", subject);
  if (body.damping.ratio_internal != 0.0 || !body.damping.ratios_internal.empty())
    subject.add("damping", "damping: modal bodies have no internal modes (modes with a fixed boundary)",
                "give ratio or ratios, which apply to the modes of the file");
}

void check_body(const SuperelementBodySpec& body, const Subject& subject) {
  check_modal_choice(body, "superelement file", subject);
  if (body.frame == FrameKind::node && body.frame_node.empty())
    subject.add("frame", "frame has no node", "write frame: {node: name}");
  if (body.frame == FrameKind::node && !(body.position_weights.empty() && body.rotation_weights.empty()))
    subject.add("weights",
                fmt::format("weights have no effect on a frame that is attached to node '{}'", body.frame_node),
                "remove them, or give frame: karcher or paper");
  check_weights(body.position_weights, "weights.positions", subject);
  check_weights(body.rotation_weights, "weights.rotations", subject);
}

void check_nodes(const std::vector<RigidNodeSpec>& nodes, const Subject& subject) {
  std::vector<std::string> names;
  for (const RigidNodeSpec& node : nodes) {
    const std::string noun = fmt::format("{}: node '{}'", subject.name, node.name);
    check_name({noun, subject.where, subject.faults}, node.name, names);
    Subject{noun, subject.where, subject.faults, fmt::format("nodes.{}.", node.name)}.finite("position",
                                                                                             node.pose.position);
  }
}

void check_body(const RigidBodySpec& body, const Subject& subject) {
  check_mass(body.mass, body.inertia, MassSign::positive, subject);
  subject.finite("center_of_mass", body.center_of_mass);
  check_nodes(body.nodes, subject);
}

void check_body(const VirtualBodySpec& body, const Subject& subject) { check_nodes(body.nodes, subject); }

void check_body(const BeamBodySpec& body, const Subject& subject) {
  subject.finite("from", body.from);
  subject.finite("to", body.to);
  check_line({body.from, body.to, body.through, body.orientation}, subject);
  if (body.elements < 1 || body.elements > most_elements)
    subject.add("elements", fmt::format("elements {} must lie between 1 and {}", body.elements, most_elements));
  if (body.nodes_per_element != 2 && body.nodes_per_element != 3)
    subject.add("nodes_per_element", fmt::format("nodes_per_element {} must be 2 or 3", body.nodes_per_element));
  const Section& section = body.section;
  const Material& material = body.material;
  check_section(section,
                section.name.empty() ? subject.inside("section") : subject_of("section", section, subject.faults));
  if (!section.by_stiffness)
    check_material(material, material.name.empty() ? subject.inside("material")
                                                   : subject_of("material", material, subject.faults));
  if (section.area > 0.0 && section.shear_area_y == 0.0 && section.shear_area_z == 0.0)
    subject.add("section", "its section has no shear areas, which this beam needs",
                section.by_stiffness ? "give GAy and GAz" : "give shear_area_y and shear_area_z");
}

template <class Body>
void check_any_body(const Body& body, const Subject& subject) {
  if (body.name == "ground") subject.add("", "the name is reserved for the fixed world", "rename it");
  check_start(body.start, subject);
  if constexpr (requires { body.gravity; })
    if (body.gravity) subject.finite("gravity", *body.gravity);
  check_body(body, subject);
  if constexpr (requires { body.shapes; })
    for (const ShapeSpec& shape : body.shapes) check_shape(shape, subject.inside("shape"));
}

/// Whether a beam has the node: 0 to N, start or end. Also true for beams whose number of elements is faulty.
bool has_node(const BeamBodySpec& beam, const std::string& node) {
  if (node == "start" || node == "end" || beam.elements < 1 || beam.elements > most_elements) return true;
  int index = -1;
  const auto [end, status] = std::from_chars(node.data(), node.data() + node.size(), index);
  const bool plain = status == std::errc{} && end == node.data() + node.size() && std::to_string(index) == node;
  return plain && index >= 0 && index <= beam.elements * (beam.nodes_per_element - 1);
}

/// Checks a node of a body. Nodes of superelements are checked when their files are read.
void check_node_of_body(const BodySpec& body, const std::string& node, const std::string& key, const Subject& subject) {
  const RigidBodySpec* rigid = std::get_if<RigidBodySpec>(&body);
  const VirtualBodySpec* massless = std::get_if<VirtualBodySpec>(&body);
  if (rigid != nullptr || massless != nullptr) {
    const std::vector<RigidNodeSpec>& nodes = rigid != nullptr ? rigid->nodes : massless->nodes;
    check_reference({fmt::format("{}: body '{}'", subject.name, name_of(body)), subject.where, subject.faults}, key,
                    "node", node, texts_of(nodes, &RigidNodeSpec::name));
  } else if (const BeamBodySpec* beam = std::get_if<BeamBodySpec>(&body); beam != nullptr && !has_node(*beam, node)) {
    const auto near = nearest(node, {"start", "end"});
    const std::string hint = near ? fmt::format("did you mean '{}'? ", *near) : "";
    subject.add(
        key, fmt::format("body '{}': there is no node '{}'", beam->name, node),
        fmt::format("{}its nodes are 0 to {}, start and end", hint, beam->elements * (beam->nodes_per_element - 1)));
  }
}

void check_node(const SceneIndex& scene, const MarkerSpec& marker, const std::string& key, const Subject& subject) {
  // Names of bodies in assemblies contain slashes, names of nodes do not.
  std::size_t slash = std::string::npos;
  auto found = scene.bodies.find(marker.node);
  if (found == scene.bodies.end()) {
    slash = marker.node.rfind('/');
    found = scene.bodies.find(std::string_view(marker.node).substr(0, slash));
  }
  const std::string body_name = marker.node.substr(0, slash);
  if (found == scene.bodies.end()) {
    std::vector<std::string> bodies = texts_of(scene.scene.bodies, name_of);
    if (key != "at") bodies.push_back("ground");
    check_reference(subject, key, "body", body_name, bodies);
    return;
  }
  const BodySpec& body = *found->second;
  if (slash != std::string::npos) {
    check_node_of_body(body, marker.node.substr(slash + 1), key, subject);
    return;
  }
  const SuperelementBodySpec* element = std::get_if<SuperelementBodySpec>(&body);
  const bool rigid = std::holds_alternative<RigidBodySpec>(body) || std::holds_alternative<VirtualBodySpec>(body) ||
                     std::holds_alternative<ModalBodySpec>(body) || (element != nullptr && element->rigid);
  const bool beam = std::holds_alternative<BeamBodySpec>(body);
  if (!rigid)
    subject.add(
        key, fmt::format("body '{}' is flexible; '{}' names no node", body_name, marker.node),
        fmt::format("write {}/<node>{}", body_name, beam ? fmt::format(", for example {}/end", body_name) : ""));
}

/// Names of all possible owners of an effect.
std::vector<std::string> effect_owners(EffectOwner owner, const Scene& scene) {
  switch (owner) {
    case EffectOwner::body:
      return texts_of(scene.bodies, name_of);
    case EffectOwner::joint:
      return texts_of(scene.joints, &JointSpec::name);
    case EffectOwner::spring:
      return texts_of(scene.springs, &SpringSpec::name);
  }
  return {};
}

/// Checks the owners of effects. Whether they have the effect depends on files and is reported when the model is built.
void check_effects(const Scene& scene, Faults& faults) {
  constexpr const char* nouns[] = {"body", "joint", "spring"};
  std::map<EffectOwner, std::vector<std::string>> names;
  std::set<std::pair<EffectOwner, std::string>> reported;
  for (const EffectSwitch& one : scene.effects) {
    const EffectOwner owner = owner_of(one.effect);
    if (one.owner.empty() || !reported.insert({owner, one.owner}).second) continue;
    if (!names.contains(owner)) names[owner] = effect_owners(owner, scene);
    check_reference({fmt::format("effects: {}", effect_word(one.effect)), one.where, faults}, "",
                    nouns[static_cast<int>(owner)], one.owner, names[owner]);
  }
}

void check_joint(const SceneIndex& scene, const JointSpec& joint, const Subject& subject) {
  const JointKindRow& kind = joint_kind(joint.kind);
  check_marker_pair(scene, joint, subject);
  if (kind.axes == JointAxes::required && !joint.axis && !joint.a.orientation && !joint.b.orientation)
    subject.add("", fmt::format("a {} joint needs an axis", kind.word),
                "give axis: [x, y, z], or an orientation to a or b");
  if (joint.friction) check_friction(joint, subject);
  if (!std::isfinite(joint.pitch) || (kind.key == JointKey::pitch && joint.pitch == 0.0))
    subject.add("pitch", fmt::format("pitch {:g} must be a finite length that is not zero", joint.pitch),
                "use a revolute joint if there is no advance");
  if (joint.length && !(*joint.length > 0.0 && std::isfinite(*joint.length)))
    subject.add("length", fmt::format("length {:g} must be positive", *joint.length),
                "use a spherical joint for a distance of zero");
  if (kind.key == JointKey::hold && std::none_of(joint.hold.begin(), joint.hold.end(), [](bool held) { return held; }))
    subject.add("hold", "hold names no direction", "name one or more of x, y, z, rx, ry, rz");
}

void check_gear(const SceneIndex& scene, const GearSpec& gear, const Subject& subject) {
  check_coordinate(gear.first, scene, "between", subject);
  check_coordinate(gear.second, scene, "between", subject);
  if (!std::isfinite(gear.ratio) || gear.ratio == 0.0)
    subject.add("ratio", fmt::format("ratio {:g} must be finite and not zero", gear.ratio));
}

/// Whether an analysis of the scene computes forces from accelerations.
bool has_dynamics(const Scene& scene) {
  const auto dynamic = [](AnalysisKind kind) {
    return kind == AnalysisKind::dynamics || kind == AnalysisKind::inverse_dynamics;
  };
  if (scene.analyses.empty()) return dynamic(scene.analysis);
  return std::ranges::any_of(scene.analyses, [&](const Analysis& analysis) { return dynamic(analysis.kind); });
}

/// Checks that a motion uses no linear input: between its points such an input has jumps in velocity.
void check_motion_inputs(const Scene& scene, const MotionSpec& motion, const Subject& subject) {
  const auto* expression = std::get_if<TimeExpression>(&motion.value);
  if (expression == nullptr) return;
  const std::set<std::string> names = names_of(expression->text);
  for (const InputSpec& input : scene.inputs)
    if (input.interpolation == Interpolation::linear && input.table.time.size() > 2 &&
        names.contains(expression_name(input.name)))
      subject.add(
          "value",
          fmt::format(
              "input '{}' is linear between its points. Its velocity jumps there, and no mass can follow a jump",
              input.name),
          "give the input interpolation: cubic, or use a table for the motion");
}

void check_motion(const SceneIndex& scene, const MotionSpec& motion, bool dynamic, const Subject& subject) {
  check_coordinate(motion.coordinate, scene, "coordinate", subject);
  check_time_function(motion.value, "value", subject);
  if (dynamic) check_motion_inputs(scene.scene, motion, subject);
  const auto* table = std::get_if<TimeTable>(&motion.value);
  if (dynamic && table != nullptr && table->motion == TableMotion::linear && table->time.size() > 2)
    subject.add("value", "the velocity of a linear table jumps at its points, and no mass can follow a jump",
                "remove 'interpolation', or write natural; linear is for statics, assembly, kinematics and modes");
}

}  // namespace

void check_marker(const SceneIndex& scene, const MarkerSpec& marker, const std::string& key, const Subject& subject) {
  const bool at_ground = marker.node == "ground";
  if (at_ground && key == "at") subject.add(key, "acts on the ground", "name a node of a body");
  if (!at_ground) check_node(scene, marker, key, subject);
  if (marker.position && !marker.position->allFinite())
    subject.add(key + ".position", fmt::format("{}: position must be finite", key));
  if (marker.orientation && !(std::abs(marker.orientation->norm() - 1.0) < 1e-9))
    subject.add(key + ".orientation", fmt::format("{}: the quaternion of the orientation has length {:g}, not 1", key,
                                                  marker.orientation->norm()));
}

void check_marker_pair(const SceneIndex& scene, const MarkerPairSpec& pair, const Subject& subject) {
  check_marker(scene, pair.a, "a", subject);
  check_marker(scene, pair.b, "b", subject);
  if (pair.a.node == pair.b.node)
    subject.add("b", fmt::format("joins '{}' to itself", pair.a.node), "name two different nodes");
  if (pair.position) subject.finite("position", *pair.position);
  if (pair.axis && subject.finite("axis", *pair.axis) && pair.axis->stableNorm() == 0.0)
    subject.add("axis", "axis has zero length", "give a direction, for example [0, 0, 1]");
  if (pair.position && pair.a.position && pair.b.position)
    subject.add("position", "position has no effect, since both a and b have one",
                "remove it, or the position of a or b");
  if (pair.axis && pair.a.orientation && pair.b.orientation)
    subject.add("axis", "axis has no effect, since both a and b have an orientation",
                "remove it, or the orientation of a or b");
  if (pair.x_axis && !pair.axis)
    subject.add("x_axis", "x_axis has no effect without axis", "give axis too, or an orientation to a or b");
  if (pair.x_axis && pair.axis &&
      !(pair.axis->cross(*pair.x_axis).stableNorm() > 1e-6 * pair.axis->stableNorm() * pair.x_axis->stableNorm()))
    subject.add("x_axis", "x_axis is zero or parallel to axis", "give a direction that is not parallel to axis");
}

void check_coordinate(const CoordinateRef& coordinate, const SceneIndex& scene, const std::string& key,
                      const Subject& subject) {
  const std::string joint = coordinate.name.substr(0, coordinate.name.rfind('/'));
  if (scene.joints.contains(coordinate.name) || scene.joints.contains(joint)) return;
  subject.add(key, fmt::format("there is no joint '{}'", joint),
              did_you_mean(joint, texts_of(scene.scene.joints, &JointSpec::name),
                           "name a joint, or joint/coordinate as in slide/z"));
}

void check_definitions(const std::vector<Material>& materials, const std::vector<Section>& sections, Faults& faults) {
  std::vector<std::string> names;
  for (const Material& material : materials) check_material(material, check_name("material", material, names, faults));
  names.clear();
  for (const Section& section : sections) check_section(section, check_name("section", section, names, faults));
}

Faults find_faults(const Scene& scene) {
  Faults faults;
  const Subject whole{"", scene.file, faults};
  if (scene.name.empty()) whole.add("scene", "the scene has no name", "write scene: <name>");
  whole.finite("gravity", scene.gravity);
  if (scene.bodies.empty()) whole.add("bodies", "the scene has no bodies", "define one or more bodies");
  check_effects(scene, faults);
  const SceneIndex index(scene);
  std::unordered_set<std::string> bodies, joints, motions, springs, bushings, roads, tyres, loads;
  for (const BodySpec& body : scene.bodies)
    std::visit([&](const auto& spec) { check_any_body(spec, check_path_name("body", spec, bodies, faults)); }, body);
  for (const JointSpec& joint : scene.joints)
    check_joint(index, joint, check_path_name("joint", joint, joints, faults));
  for (const GearSpec& gear : scene.gears) check_gear(index, gear, check_path_name("joint", gear, joints, faults));
  check_channels(index, faults);
  for (const MotionSpec& motion : scene.motions)
    check_motion(index, motion, has_dynamics(scene), check_path_name("motion", motion, motions, faults));
  for (const InitialSpec& initial : scene.initial) check_initial(index, initial, faults);
  for (const SpringSpec& spring : scene.springs)
    check_spring(index, spring, check_path_name("spring", spring, springs, faults));
  for (const BushingSpec& bushing : scene.bushings)
    check_bushing(index, bushing, check_path_name("bushing", bushing, bushings, faults));
  for (const RoadSpec& road : scene.roads) check_road(road, check_path_name("road", road, roads, faults));
  for (const TyreSpec& tyre : scene.tyres) check_tyre(index, tyre, check_path_name("tyre", tyre, tyres, faults));
  for (const LoadSpec& load : scene.loads) check_load(index, load, check_path_name("load", load, loads, faults));
  for (const PartLoadSpec& load : scene.part_loads)
    check_part_load(index, load, check_path_name("load", load, loads, faults));
  check_settings(scene, faults);
  return faults;
}

void check(const Scene& scene) { find_faults(scene).raise(); }

}  // namespace tisserand::formats
