// Findings of a scene: names, references to bodies and nodes, ranges of settings.
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

constexpr int most_elements = 100'000;  ///< of one beam

const std::string& name_of(const BodySpec& body) {
  return std::visit([](const auto& spec) -> const std::string& { return spec.name; }, body);
}

void check_start(const InitialMotion& start, const std::string& subject, const std::string& where, Faults& faults) {
  const auto finite = [&](const Eigen::Vector3d& vector, const char* key) {
    if (!vector.allFinite()) faults.add(where, key, fmt::format("{}: {} must be finite", subject, key), "");
  };
  finite(start.pose.position, "pose.position");
  if (start.velocity) finite(*start.velocity, "velocity");
  if (start.angular_velocity) finite(*start.angular_velocity, "angular_velocity");
  if (!(std::abs(start.pose.orientation.norm() - 1.0) < 1e-9))
    faults.add(where, "pose.orientation",
               fmt::format("{}: the quaternion of the orientation has length {:g}, not 1", subject,
                           start.pose.orientation.norm()),
               "");
}

void check_weights(const std::vector<NodeWeight>& weights, const std::string& subject, const std::string& where,
                   const std::string& key, Faults& faults) {
  double sum = 0.0;
  for (const NodeWeight& weight : weights) sum += weight.weight;
  if (!weights.empty() && !(std::abs(sum - 1.0) < 1e-6))
    faults.add(where, key, fmt::format("{}: {} have the sum {:.9g}", subject, key, sum), "their sum must be 1");
}

void check_damping(const Damping& damping, const std::string& subject, const std::string& where, Faults& faults) {
  const auto not_negative = [&](double value, const char* key) {
    if (!(value >= 0.0) || !std::isfinite(value))
      faults.add(where, fmt::format("damping.{}", key),
                 fmt::format("{}: damping: {} {:g} must not be negative", subject, key, value), "");
  };
  not_negative(damping.mass, "mass");
  not_negative(damping.stiffness, "stiffness");
  not_negative(damping.ratio, "ratio");
  for (const double ratio : damping.ratios) not_negative(ratio, "ratios");
  not_negative(damping.ratio_internal, "ratio_internal");
  for (const double ratio : damping.ratios_internal) not_negative(ratio, "ratios_internal");
}

void check_gravity(const std::optional<Eigen::Vector3d>& gravity, const std::string& subject, const std::string& where,
                   Faults& faults) {
  if (gravity && !gravity->allFinite())
    faults.add(where, "gravity", fmt::format("{}: gravity must be finite", subject), "");
}

/// What bodies with modes from a file have in common.
template <class Body>
void check_modal_choice(const Body& body, const std::string& subject, const std::string& noun, Faults& faults) {
  if (body.file.empty()) faults.add(body.where, "file", fmt::format("{}: has no {}", subject, noun), "");
  if (body.modes && *body.modes < 0)
    faults.add(body.where, "modes", fmt::format("{}: modes {} must not be negative", subject, *body.modes),
               "modes: 0 uses none");
  if (body.cutoff && !(*body.cutoff > 0.0 && std::isfinite(*body.cutoff)))
    faults.add(body.where, "cutoff", fmt::format("{}: cutoff {:g} must be positive", subject, *body.cutoff), "");
  check_damping(body.damping, subject, body.where, faults);
}

void check_body(const ModalBodySpec& body, const std::string& subject, Faults& faults) {
  check_modal_choice(body, subject, "modal body file", faults);
  if (body.damping.ratio_internal != 0.0 || !body.damping.ratios_internal.empty())
    faults.add(body.where, "damping",
               fmt::format("{}: damping: modal bodies have no internal modes, whose boundary is held", subject),
               "write ratio or ratios, which count the modes of the file");
}

void check_body(const SuperelementBodySpec& body, const std::string& subject, Faults& faults) {
  check_modal_choice(body, subject, "superelement file", faults);
  if (body.frame == FrameKind::node && body.frame_node.empty())
    faults.add(body.where, "frame", fmt::format("{}: frame has no node", subject), "write frame: {node: name}");
  if (body.frame == FrameKind::node && !(body.position_weights.empty() && body.rotation_weights.empty()))
    faults.add(
        body.where, "weights",
        fmt::format("{}: weights have no effect on a frame that is attached to node '{}'", subject, body.frame_node),
        "remove them, or give frame: karcher or paper");
  check_weights(body.position_weights, subject, body.where, "weights.positions", faults);
  check_weights(body.rotation_weights, subject, body.where, "weights.rotations", faults);
}

void check_nodes(const std::vector<RigidNodeSpec>& nodes, const std::string& subject, const std::string& where,
                 Faults& faults) {
  std::vector<std::string> names;
  for (const RigidNodeSpec& node : nodes) {
    check_name(subject + ": node", node.name, where, names, faults);
    if (!node.pose.position.allFinite())
      faults.add(where, fmt::format("nodes.{}.position", node.name),
                 fmt::format("{}: node '{}': position must be finite", subject, node.name), "");
  }
}

void check_body(const RigidBodySpec& body, const std::string& subject, Faults& faults) {
  check_mass({subject, body.where, body.mass, body.inertia}, MassSign::positive, faults);
  if (!body.center_of_mass.allFinite())
    faults.add(body.where, "center_of_mass", fmt::format("{}: center_of_mass must be finite", subject), "");
  check_nodes(body.nodes, subject, body.where, faults);
}

void check_body(const VirtualBodySpec& body, const std::string& subject, Faults& faults) {
  check_nodes(body.nodes, subject, body.where, faults);
}

void check_body(const BeamBodySpec& body, const std::string& subject, Faults& faults) {
  if (!body.from.allFinite()) faults.add(body.where, "from", fmt::format("{}: from must be finite", subject), "");
  if (!body.to.allFinite()) faults.add(body.where, "to", fmt::format("{}: to must be finite", subject), "");
  check_line({subject, body.where, body.from, body.to, body.through, body.orientation}, faults);
  if (body.elements < 1 || body.elements > most_elements)
    faults.add(body.where, "elements",
               fmt::format("{}: elements {} must lie between 1 and {}", subject, body.elements, most_elements), "");
  if (body.nodes_per_element != 2 && body.nodes_per_element != 3)
    faults.add(body.where, "nodes_per_element",
               fmt::format("{}: nodes_per_element {} must be 2 or 3", subject, body.nodes_per_element), "");
  const Section& section = body.section;
  const Material& material = body.material;
  check_section(section, section.name.empty() ? subject + ": section" : fmt::format("section '{}'", section.name),
                section.name.empty() ? "section." : "", faults);
  if (!section.by_stiffness)
    check_material(material,
                   material.name.empty() ? subject + ": material" : fmt::format("material '{}'", material.name),
                   material.name.empty() ? "material." : "", faults);
  if (section.area > 0.0 && section.shear_area_y == 0.0 && section.shear_area_z == 0.0)
    faults.add(body.where, "section", fmt::format("{}: its section has no shear areas, which this beam needs", subject),
               section.by_stiffness ? "give GAy and GAz" : "give shear_area_y and shear_area_z");
}

/// Whether a beam has the node: 0 to N, start or end. Beams whose numbers are wrong already are given the benefit of
/// doubt.
bool has_node(const BeamBodySpec& beam, const std::string& node) {
  if (node == "start" || node == "end" || beam.elements < 1 || beam.elements > most_elements) return true;
  int index = -1;
  const auto [end, status] = std::from_chars(node.data(), node.data() + node.size(), index);
  const bool plain = status == std::errc{} && end == node.data() + node.size() && std::to_string(index) == node;
  return plain && index >= 0 && index <= beam.elements * (beam.nodes_per_element - 1);
}

/// Nodes of superelements stand in their files and are checked when those are read.
void check_node_of_body(const BodySpec& body, const std::string& node, const std::string& subject,
                        const std::string& where, const std::string& key, Faults& faults) {
  const RigidBodySpec* rigid = std::get_if<RigidBodySpec>(&body);
  const VirtualBodySpec* massless = std::get_if<VirtualBodySpec>(&body);
  if (rigid != nullptr || massless != nullptr) {
    std::vector<std::string> names;
    for (const RigidNodeSpec& one : rigid != nullptr ? rigid->nodes : massless->nodes) names.push_back(one.name);
    check_reference(fmt::format("{}: body '{}'", subject, name_of(body)), "node", node, names, where, key, faults);
  } else if (const BeamBodySpec* beam = std::get_if<BeamBodySpec>(&body); beam != nullptr && !has_node(*beam, node)) {
    const auto near = nearest(node, {"start", "end"});
    const std::string hint = near ? fmt::format("did you mean '{}'? ", *near) : "";
    faults.add(
        where, key, fmt::format("{}: body '{}': there is no node '{}'", subject, beam->name, node),
        fmt::format("{}its nodes are 0 to {}, start and end", hint, beam->elements * (beam->nodes_per_element - 1)));
  }
}

void check_node(const SceneIndex& scene, const MarkerSpec& marker, const std::string& subject, const std::string& where,
                const std::string& key, Faults& faults) {
  // Names of bodies in assemblies hold slashes, those of nodes do not.
  std::size_t slash = std::string::npos;
  auto found = scene.bodies.find(marker.node);
  if (found == scene.bodies.end()) {
    slash = marker.node.rfind('/');
    found = scene.bodies.find(std::string_view(marker.node).substr(0, slash));
  }
  const std::string body_name = marker.node.substr(0, slash);
  if (found == scene.bodies.end()) {
    std::vector<std::string> bodies;
    for (const BodySpec& body : scene.scene.bodies) bodies.push_back(name_of(body));
    if (key != "at") bodies.push_back("ground");
    check_reference(subject, "body", body_name, bodies, where, key, faults);
    return;
  }
  const BodySpec& body = *found->second;
  if (slash != std::string::npos) {
    check_node_of_body(body, marker.node.substr(slash + 1), subject, where, key, faults);
    return;
  }
  const SuperelementBodySpec* element = std::get_if<SuperelementBodySpec>(&body);
  const bool rigid = std::holds_alternative<RigidBodySpec>(body) || std::holds_alternative<VirtualBodySpec>(body) ||
                     std::holds_alternative<ModalBodySpec>(body) || (element != nullptr && element->rigid);
  const bool beam = std::holds_alternative<BeamBodySpec>(body);
  if (!rigid)
    faults.add(where, key,
               fmt::format("{}: body '{}' is flexible; '{}' names no node", subject, body_name, marker.node),
               fmt::format("write {}/<node>{}", body_name, beam ? fmt::format(", for example {}/end", body_name) : ""));
}

/// Names of all that can have an effect of this owner.
std::vector<std::string> effect_owners(EffectOwner owner, const Scene& scene) {
  std::vector<std::string> names;
  if (owner == EffectOwner::body)
    for (const BodySpec& body : scene.bodies) names.push_back(name_of(body));
  if (owner == EffectOwner::joint)
    for (const JointSpec& joint : scene.joints) names.push_back(joint.name);
  if (owner == EffectOwner::spring)
    for (const SpringSpec& spring : scene.springs) names.push_back(spring.name);
  return names;
}

/// Whether they have what is switched hangs on files too and is told where the model is built.
void check_effects(const Scene& scene, Faults& faults) {
  constexpr const char* nouns[] = {"body", "joint", "spring"};
  std::map<EffectOwner, std::vector<std::string>> names;
  std::set<std::pair<EffectOwner, std::string>> told;
  for (const EffectSwitch& one : scene.effects) {
    const EffectOwner owner = owner_of(one.effect);
    if (one.owner.empty() || !told.insert({owner, one.owner}).second) continue;
    if (!names.contains(owner)) names[owner] = effect_owners(owner, scene);
    check_reference(fmt::format("effects: {}", effect_word(one.effect)), nouns[static_cast<int>(owner)], one.owner,
                    names[owner], one.where, "", faults);
  }
}

}  // namespace

void check_marker(const SceneIndex& scene, const MarkerSpec& marker, const std::string& subject,
                  const std::string& where, const std::string& key, Faults& faults) {
  const bool at_ground = marker.node == "ground";
  if (at_ground && key == "at")
    faults.add(where, key, fmt::format("{}: acts on the ground", subject), "name a node of a body");
  if (!at_ground) check_node(scene, marker, subject, where, key, faults);
  if (marker.position && !marker.position->allFinite())
    faults.add(where, key + ".position", fmt::format("{}: {}: position must be finite", subject, key), "");
  if (marker.orientation && !(std::abs(marker.orientation->norm() - 1.0) < 1e-9))
    faults.add(where, key + ".orientation",
               fmt::format("{}: {}: the quaternion of the orientation has length {:g}, not 1", subject, key,
                           marker.orientation->norm()),
               "");
}

void check_marker_pair(const SceneIndex& scene, const MarkerPairSpec& pair, const std::string& subject,
                       const std::string& where, Faults& faults) {
  check_marker(scene, pair.a, subject, where, "a", faults);
  check_marker(scene, pair.b, subject, where, "b", faults);
  if (pair.a.node == pair.b.node)
    faults.add(where, "b", fmt::format("{}: joins '{}' to itself", subject, pair.a.node), "name two different nodes");
  if (pair.position && !pair.position->allFinite())
    faults.add(where, "position", fmt::format("{}: position must be finite", subject), "");
  if (pair.axis && !pair.axis->allFinite())
    faults.add(where, "axis", fmt::format("{}: axis must be finite", subject), "");
  else if (pair.axis && pair.axis->stableNorm() == 0.0)
    faults.add(where, "axis", fmt::format("{}: axis has zero length", subject),
               "give a direction, for example [0, 0, 1]");
  if (pair.position && pair.a.position && pair.b.position)
    faults.add(where, "position", fmt::format("{}: position has no effect, since both a and b have one", subject),
               "remove it, or the position of a or b");
  if (pair.axis && pair.a.orientation && pair.b.orientation)
    faults.add(where, "axis", fmt::format("{}: axis has no effect, since both a and b have an orientation", subject),
               "remove it, or the orientation of a or b");
  if (pair.x_axis && !pair.axis)
    faults.add(where, "x_axis", fmt::format("{}: x_axis has no effect without axis", subject),
               "give axis too, or an orientation to a or b");
  if (pair.x_axis && pair.axis &&
      !(pair.axis->cross(*pair.x_axis).stableNorm() > 1e-6 * pair.axis->stableNorm() * pair.x_axis->stableNorm()))
    faults.add(where, "x_axis", fmt::format("{}: x_axis is zero or parallel to axis", subject),
               "give a direction across the axis");
}

void check_coordinate(const CoordinateRef& coordinate, const SceneIndex& scene, const std::string& subject,
                      const std::string& where, const std::string& key, Faults& faults) {
  const std::string joint = coordinate.name.substr(0, coordinate.name.rfind('/'));
  if (scene.joints.contains(coordinate.name) || scene.joints.contains(joint)) return;
  std::vector<std::string> names;
  for (const JointSpec& spec : scene.scene.joints) names.push_back(spec.name);
  const auto near = nearest(joint, names);
  faults.add(where, key, fmt::format("{}: there is no joint '{}'", subject, joint),
             near ? fmt::format("did you mean '{}'?", *near) : "name a joint, or joint/coordinate as in slide/z");
}

namespace {

void check_joint(const SceneIndex& scene, const JointSpec& joint, Faults& faults) {
  const std::string subject = fmt::format("joint '{}'", joint.name);
  const JointKindRow& kind = joint_kind(joint.kind);
  check_marker_pair(scene, joint, subject, joint.where, faults);
  if (kind.axes == JointAxes::required && !joint.axis && !joint.a.orientation && !joint.b.orientation)
    faults.add(joint.where, "", fmt::format("{}: a {} joint needs an axis", subject, kind.word),
               "give axis: [x, y, z], or an orientation to a or b");
  if (joint.friction) check_friction(joint, subject, faults);
  if (!std::isfinite(joint.pitch) || (kind.key == JointKey::pitch && joint.pitch == 0.0))
    faults.add(joint.where, "pitch",
               fmt::format("{}: pitch {:g} must be a finite length that is not zero", subject, joint.pitch),
               "use a revolute joint for no advance");
  if (joint.length && !(*joint.length > 0.0 && std::isfinite(*joint.length)))
    faults.add(joint.where, "length", fmt::format("{}: length {:g} must be positive", subject, *joint.length),
               "use a spherical joint for a distance of zero");
  if (kind.key == JointKey::hold && std::none_of(joint.hold.begin(), joint.hold.end(), [](bool held) { return held; }))
    faults.add(joint.where, "hold", fmt::format("{}: holds no direction", subject), "name some of x, y, z, rx, ry, rz");
}

void check_gear(const SceneIndex& scene, const GearSpec& gear, Faults& faults) {
  const std::string subject = fmt::format("joint '{}'", gear.name);
  check_coordinate(gear.first, scene, subject, gear.where, "between", faults);
  check_coordinate(gear.second, scene, subject, gear.where, "between", faults);
  if (!std::isfinite(gear.ratio) || gear.ratio == 0.0)
    faults.add(gear.where, "ratio", fmt::format("{}: ratio {:g} must be finite and not zero", subject, gear.ratio), "");
}

/// Whether an analysis of the scene takes forces from accelerations.
bool has_dynamics(const Scene& scene) {
  const auto dynamic = [](AnalysisKind kind) {
    return kind == AnalysisKind::dynamics || kind == AnalysisKind::inverse_dynamics;
  };
  if (scene.analyses.empty()) return dynamic(scene.analysis);
  return std::ranges::any_of(scene.analyses, [&](const Analysis& analysis) { return dynamic(analysis.kind); });
}

/// Inputs step in velocity where they are linear between points: a motion that uses one does so too.
void check_motion_inputs(const Scene& scene, const MotionSpec& motion, const std::string& subject, Faults& faults) {
  const auto* expression = std::get_if<TimeExpression>(&motion.value);
  if (expression == nullptr) return;
  const std::set<std::string> names = names_of(expression->text);
  for (const InputSpec& input : scene.inputs)
    if (input.interpolation == Interpolation::linear && input.table.time.size() > 2 &&
        names.contains(expression_name(input.name)))
      faults.add(motion.where, "value",
                 fmt::format("{}: input '{}' is linear between its points and steps in velocity, which no mass can "
                             "follow",
                             subject, input.name),
                 "give the input interpolation: cubic, or the motion a table");
}

void check_motion(const SceneIndex& scene, const MotionSpec& motion, bool dynamic, Faults& faults) {
  const std::string subject = fmt::format("motion '{}'", motion.name);
  check_coordinate(motion.coordinate, scene, subject, motion.where, "coordinate", faults);
  check_time_function(motion.value, subject, motion.where, "value", faults);
  if (dynamic) check_motion_inputs(scene.scene, motion, subject, faults);
  const auto* table = std::get_if<TimeTable>(&motion.value);
  if (dynamic && table != nullptr && table->motion == TableMotion::linear && table->time.size() > 2)
    faults.add(
        motion.where, "value",
        fmt::format("{}: a table with interpolation: linear steps in velocity, which no mass can follow", subject),
        "leave 'interpolation' out, or give natural; linear is for statics, assembly, kinematics and modes");
}

}  // namespace

void check_definitions(const std::vector<Material>& materials, const std::vector<Section>& sections, Faults& faults) {
  std::vector<std::string> names;
  for (const Material& material : materials) {
    check_name("material", material.name, material.where, names, faults);
    check_material(material, fmt::format("material '{}'", material.name), "", faults);
  }
  names.clear();
  for (const Section& section : sections) {
    check_name("section", section.name, section.where, names, faults);
    check_section(section, fmt::format("section '{}'", section.name), "", faults);
  }
}

Faults find_faults(const Scene& scene) {
  Faults faults;
  if (scene.name.empty()) faults.add(scene.file, "scene", "the scene has no name", "scene: <name>");
  if (!scene.gravity.allFinite()) faults.add(scene.file, "gravity", "gravity must be finite", "");
  if (scene.bodies.empty()) faults.add(scene.file, "bodies", "the scene has no bodies", "");
  check_effects(scene, faults);
  const SceneIndex index(scene);
  std::unordered_set<std::string> bodies, joints, motions, springs, bushings, roads, tyres, loads;
  for (const BodySpec& body : scene.bodies) {
    std::visit(
        [&](const auto& spec) {
          const std::string subject = fmt::format("body '{}'", spec.name);
          check_path_name("body", spec.name, spec.where, bodies, faults);
          if (spec.name == "ground")
            faults.add(spec.where, "", "body 'ground': the name is taken by the fixed world", "rename it");
          check_start(spec.start, subject, spec.where, faults);
          if constexpr (requires { spec.gravity; }) check_gravity(spec.gravity, subject, spec.where, faults);
          check_body(spec, subject, faults);
          if constexpr (requires { spec.shapes; })
            for (const ShapeSpec& shape : spec.shapes) check_shape(shape, subject, faults);
        },
        body);
  }
  for (const JointSpec& joint : scene.joints) {
    check_path_name("joint", joint.name, joint.where, joints, faults);
    check_joint(index, joint, faults);
  }
  for (const GearSpec& gear : scene.gears) {
    check_path_name("joint", gear.name, gear.where, joints, faults);
    check_gear(index, gear, faults);
  }
  check_channels(index, faults);
  for (const MotionSpec& motion : scene.motions) {
    check_path_name("motion", motion.name, motion.where, motions, faults);
    check_motion(index, motion, has_dynamics(scene), faults);
  }
  for (const InitialSpec& initial : scene.initial) check_initial(index, initial, faults);
  for (const SpringSpec& spring : scene.springs) {
    check_path_name("spring", spring.name, spring.where, springs, faults);
    check_spring(index, spring, faults);
  }
  for (const BushingSpec& bushing : scene.bushings) {
    check_path_name("bushing", bushing.name, bushing.where, bushings, faults);
    check_bushing(index, bushing, faults);
  }
  for (const RoadSpec& road : scene.roads) {
    check_path_name("road", road.name, road.where, roads, faults);
    check_road(road, faults);
  }
  for (const TyreSpec& tyre : scene.tyres) {
    check_path_name("tyre", tyre.name, tyre.where, tyres, faults);
    check_tyre(index, tyre, faults);
  }
  for (const LoadSpec& load : scene.loads) {
    check_path_name("load", load.name, load.where, loads, faults);
    check_load(index, load, faults);
  }
  for (const PartLoadSpec& load : scene.part_loads) {
    check_path_name("load", load.name, load.where, loads, faults);
    check_part_load(index, load, faults);
  }
  check_settings(scene, faults);
  return faults;
}

void check(const Scene& scene) { find_faults(scene).raise(); }

}  // namespace tisserand::formats
