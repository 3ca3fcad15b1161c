// `bodies` of scene.yaml: superelements, modal bodies, rigid bodies, beams, virtual bodies.
#include <filesystem>
#include <limits>

#include "formats/scene/reader.hpp"
#include "formats/sections/axis.hpp"
#include "formats/sections/reader.hpp"
#include "formats/yaml/geometry.hpp"

namespace tisserand::formats {

namespace {

std::string resolve(const std::string& folder, const std::string& file) {
  return file.empty() ? file : (std::filesystem::path(folder) / file).lexically_normal().string();
}

Pose read_pose(const Context& context, const YamlNode& node, const std::string& prefix) {
  const MapReader map(context, node, "pose", prefix);
  Pose pose;
  pose.position = read_vector(map, "position", pose.position);
  if (const YamlNode* orientation = map.find("orientation"))
    pose.orientation = read_orientation(context, *orientation, "orientation");
  return pose;
}

InitialMotion read_start(const MapReader& map) {
  InitialMotion start;
  if (const YamlNode* pose = map.find("pose")) start.pose = read_pose(map.context(), *pose, "pose.");
  start.velocity = read_vector(map, "velocity", start.velocity);
  start.angular_velocity = read_vector(map, "angular_velocity", start.angular_velocity);
  return start;
}

/// `karcher`, `paper`, {node: name}, or the text "node: name".
void read_frame(const Context& context, const YamlNode& node, SuperelementBodySpec& body) {
  const std::string prefix = "node:";
  if (node.kind == YamlKind::map) {
    body.frame = FrameKind::node;
    body.frame_node = MapReader(context, node, "frame", "frame.").text("node");
  } else if (node.kind == YamlKind::scalar && node.text.starts_with(prefix)) {
    body.frame = FrameKind::node;
    const std::size_t begin = node.text.find_first_not_of(' ', prefix.size());
    body.frame_node = begin == std::string::npos ? "" : node.text.substr(begin);
  } else {
    const auto index = read_word(context, node, "frame", {"karcher", "paper", "node: <name>"});
    body.frame = index == std::size_t{1} ? FrameKind::paper : FrameKind::karcher;
  }
}

/// Planes of the part frame, one or a list: −1 along the axes across them.
Eigen::Vector3d read_mirror(const MapReader& map) {
  Eigen::Vector3d axes = Eigen::Vector3d::Ones();
  const auto apply = [&](const YamlNode& plane) {
    if (const auto axis = read_mirror_plane(map.context(), plane)) axes[*axis] *= -1.0;
  };
  const YamlNode* node = map.find("mirror");
  if (node == nullptr) return axes;
  if (node->kind != YamlKind::sequence)
    apply(*node);
  else
    for (const YamlNode& plane : node->children) apply(plane);
  return axes;
}

std::vector<NodeWeight> read_weights(const MapReader& map, std::string_view key) {
  std::vector<NodeWeight> weights;
  for (const YamlNode* node : map.entries(key, "node"))
    weights.push_back({node->key, read_number(map.context(), *node, fmt::format("weight of '{}'", node->key))});
  return weights;
}

Damping read_damping(const MapReader& map) {
  Damping damping;
  damping.mass = map.number("mass", 0.0);
  damping.stiffness = map.number("stiffness", 0.0);
  damping.ratio = map.number("ratio", 0.0);
  if (const YamlNode* ratios = map.find("ratios")) damping.ratios = read_numbers(map.context(), *ratios, "ratios");
  return damping;
}

/// Keys of a flexible superelement, which would be ignored where the body is rigid.
void refuse_flexible_keys(const MapReader& map) {
  for (const char* key : {"modes", "cutoff", "inertia", "frame", "weights", "damping"})
    if (const YamlNode* node = map.find(key))
      map.context().fail(node->key_place, fmt::format("'{}' has no effect with use: rigid", key),
                         "remove it, or give use: flexible");
}

/// The context of a map inside a body: "body 'beam': damping".
Context inside(const Context& context, const std::string& what) {
  return {context.reader, fmt::format("{}: {}", context.subject, what), context.entry};
}

/// `modes` or `cutoff`, not both.
template <class Body>
void read_mode_choice(const MapReader& map, Body& body) {
  if (map.has("modes")) body.modes = map.integer("modes", 0);
  if (map.has("cutoff")) body.cutoff = map.number("cutoff");
  if (body.modes && body.cutoff)
    map.context().fail(map.find("cutoff")->key_place, "both 'modes' and 'cutoff' are given", "give one of them");
}

SuperelementBodySpec read_superelement(const Context& context, const YamlNode& node,
                                       const SceneDefinitions& definitions) {
  const MapReader map(context, node, "body_superelement");
  SuperelementBodySpec body;
  body.name = node.key;
  body.where = context.entry;
  body.file = resolve(definitions.folder, map.text("file"));
  body.mirror = read_mirror(map);
  body.start = read_start(map);
  body.gravity = read_optional_vector(map, "gravity");
  body.rigid = map.choice("use", {Choice<bool>{"flexible", false}, {"rigid", true}}, false);
  if (body.rigid) refuse_flexible_keys(map);
  read_mode_choice(map, body);
  body.inertia = map.choice(
      "inertia", {Choice<InertiaOption>{"A", InertiaOption::A}, {"B", InertiaOption::B}, {"M", InertiaOption::M}},
      InertiaOption::B);
  if (const YamlNode* frame = map.find("frame")) read_frame(context, *frame, body);
  if (const YamlNode* weights = map.find("weights")) {
    const MapReader inner(inside(context, "weights"), *weights, "weights", "weights.");
    body.position_weights = read_weights(inner, "positions");
    body.rotation_weights = read_weights(inner, "rotations");
  }
  if (const YamlNode* damping = map.find("damping"))
    body.damping = read_damping(MapReader(inside(context, "damping"), *damping, "damping", "damping."));
  return body;
}

ModalBodySpec read_modal(const Context& context, const YamlNode& node, const SceneDefinitions& definitions) {
  const MapReader map(context, node, "body_modal");
  ModalBodySpec body;
  body.name = node.key;
  body.where = context.entry;
  body.file = resolve(definitions.folder, map.text("file"));
  body.mirror = read_mirror(map);
  body.start = read_start(map);
  body.gravity = read_optional_vector(map, "gravity");
  read_mode_choice(map, body);
  if (const YamlNode* damping = map.find("damping"))
    body.damping = read_damping(MapReader(inside(context, "damping"), *damping, "damping", "damping."));
  return body;
}

SuperelementBodySpec read_rigid_from(const Context& context, const YamlNode& node,
                                     const SceneDefinitions& definitions) {
  const MapReader map(context, node, "body_rigid_from");
  SuperelementBodySpec body;
  body.name = node.key;
  body.where = context.entry;
  body.file = resolve(definitions.folder, map.text("from"));
  body.mirror = read_mirror(map);
  body.start = read_start(map);
  body.gravity = read_optional_vector(map, "gravity");
  body.rigid = true;
  return body;
}

std::vector<RigidNodeSpec> read_nodes(const MapReader& map) {
  const Context& context = map.context();
  std::vector<RigidNodeSpec> nodes;
  for (const YamlNode* place : map.entries("nodes", "node")) {
    const Context inner{context.reader, fmt::format("{}: node '{}'", context.subject, place->key), context.entry};
    nodes.push_back({place->key, read_pose(inner, *place, fmt::format("nodes.{}.", place->key))});
  }
  return nodes;
}

RigidBodySpec read_rigid(const Context& context, const YamlNode& node) {
  const MapReader map(context, node, "body_rigid");
  RigidBodySpec body;
  body.name = node.key;
  body.where = context.entry;
  body.start = read_start(map);
  body.gravity = read_optional_vector(map, "gravity");
  body.mass = map.number("mass");
  body.center_of_mass = read_vector(map, "center_of_mass", body.center_of_mass);
  if (const YamlNode* inertia = map.require("inertia")) body.inertia = read_inertia(context, *inertia, "inertia");
  body.nodes = read_nodes(map);
  return body;
}

VirtualBodySpec read_virtual(const Context& context, const YamlNode& node) {
  const MapReader map(context, node, "body_virtual");
  VirtualBodySpec body;
  body.name = node.key;
  body.where = context.entry;
  body.start = read_start(map);
  body.nodes = read_nodes(map);
  return body;
}

/// The definition with the name that `node` gives, or null and an error with the nearest name.
template <class T>
const T* find_named(const Context& context, const YamlNode& node, const std::string& noun, const std::vector<T>& all) {
  std::vector<std::string> names;
  for (const T& one : all) names.push_back(one.name);
  const auto index = read_word(context, node, noun, names);
  return index ? &all[*index] : nullptr;
}

void read_properties(const MapReader& map, const SceneDefinitions& definitions, BeamBodySpec& body) {
  const Context& context = map.context();
  body.section.where = body.material.where = context.entry;
  if (const YamlNode* node = map.require("section")) {
    if (node->kind == YamlKind::map) {
      body.section = read_section(inside(context, "section"), *node, definitions.units, "section.");
      body.section.name.clear();
    } else if (const Section* found = find_named(context, *node, "section", definitions.sections)) {
      body.section = *found;
    }
    if (const auto text = off_axis_text(body.section))
      context.fail(
          node->place, "the section does not fit a nonlinear beam: " + *text,
          "use a section with two axes of symmetry, give `Iy`, `Iz` about principal axes without `shear_center`, "
          "or reduce the beam with `reducer` to a superelement");
  }
  if (const YamlNode* node = map.require("material")) {
    if (node->kind == YamlKind::map) {
      body.material = read_material(inside(context, "material"), *node, "material.");
      body.material.name.clear();
    } else if (const Material* found = find_named(context, *node, "material", definitions.materials)) {
      body.material = *found;
    }
  }
}

BeamBodySpec read_beam(const Context& context, const YamlNode& node, const SceneDefinitions& definitions) {
  const MapReader map(context, node, "body_beam");
  const Eigen::Vector3d absent = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  BeamBodySpec body;
  body.name = node.key;
  body.where = context.entry;
  body.start = read_start(map);
  body.gravity = read_optional_vector(map, "gravity");
  map.require("from");
  map.require("to");
  body.from = read_vector(map, "from", absent);
  body.to = read_vector(map, "to", absent);
  body.through = read_optional_vector(map, "through");
  body.orientation = read_optional_vector(map, "orientation");
  map.require("elements");
  body.elements = map.integer("elements", 0);
  body.nodes_per_element = map.integer("nodes_per_element", 2);
  read_properties(map, definitions, body);
  return body;
}

/// Stands for a body whose type cannot be read, so that references to it are not errors too.
SuperelementBodySpec unreadable_body(const Context& context, const YamlNode& node) {
  SuperelementBodySpec body;
  body.name = node.key;
  body.where = context.entry;
  body.rigid = true;
  return body;
}

}  // namespace

std::vector<BodySpec> read_bodies(const MapReader& map, const SceneDefinitions& definitions) {
  std::vector<BodySpec> bodies;
  for (const YamlNode* node : map.entries("bodies", "body")) {
    const Context context = entry_context(map.context().reader, "body", *node);
    const YamlNode* type = find_child(*node, "type");
    if (type == nullptr) {
      context.fail(
          node->key_place,
          node->kind == YamlKind::map ? "missing key 'type'" : fmt::format("must be a map, not {}", describe(*node)),
          "give type: superelement, rigid, beam, virtual or modal");
      bodies.emplace_back(unreadable_body(context, *node));
      continue;
    }
    switch (read_word(context, *type, "type", {"superelement", "rigid", "beam", "virtual", "modal"}).value_or(5)) {
      case 0:
        bodies.emplace_back(read_superelement(context, *node, definitions));
        break;
      case 1:
        if (find_child(*node, "from") != nullptr) {
          bodies.emplace_back(read_rigid_from(context, *node, definitions));
        } else {
          bodies.emplace_back(read_rigid(context, *node));
        }
        break;
      case 2:
        bodies.emplace_back(read_beam(context, *node, definitions));
        break;
      case 3:
        bodies.emplace_back(read_virtual(context, *node));
        break;
      case 4:
        bodies.emplace_back(read_modal(context, *node, definitions));
        break;
      default:
        bodies.emplace_back(unreadable_body(context, *node));
    }
  }
  return bodies;
}

}  // namespace tisserand::formats
