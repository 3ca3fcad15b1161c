// SPDX-License-Identifier: GPL-3.0-or-later
// Reads `bodies` of scene.yaml: superelements, modal bodies, rigid bodies, beams, virtual bodies.

#include "formats/scene/reader.hpp"
#include "formats/sections/axis.hpp"
#include "formats/sections/reader.hpp"
#include "formats/yaml/fields.hpp"
#include "formats/yaml/geometry.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

constexpr Choice<bool> uses[] = {{"flexible", false}, {"rigid", true}};
constexpr Choice<InertiaOption> inertia_options[] = {
    {"A", InertiaOption::A}, {"B", InertiaOption::B}, {"M", InertiaOption::M}, {"F", InertiaOption::F}};
constexpr Choice<StiffeningOption> stiffening_options[] = {
    {"off", StiffeningOption::off}, {"stress", StiffeningOption::stress}, {"full", StiffeningOption::full}};

/// Reads a frame: `karcher`, `paper`, {node: name}, or the text "node: name".
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

/// Reads mirror planes of the part frame, one or a list. Returns −1 along the axes normal to them.
Eigen::Vector3d read_mirror(const MapReader& map) {
  Eigen::Vector3d axes = Eigen::Vector3d::Ones();
  const YamlNode* node = map.find("mirror");
  if (node == nullptr) return axes;
  for (const YamlNode& plane : items_of(*node))
    if (const auto axis = read_mirror_plane(map.context(), plane)) axes[*axis] *= -1.0;
  return axes;
}

/// Checks that `second_order`, which sets `inertia` and `stiffening`, excludes both.
void check_second_order(const MapReader& map) {
  const YamlNode* both = map.find("second_order");
  if (both == nullptr) return;
  for (const char* key : {"inertia", "stiffening"})
    if (map.find(key) != nullptr)
      map.context().fail(both->key_place, fmt::format("both 'second_order' and '{}' are given", key),
                         "give second_order, or inertia and stiffening");
}

std::vector<RigidNodeSpec> read_nodes(const MapReader& map) {
  const Context& context = map.context();
  std::vector<RigidNodeSpec> nodes;
  for (const YamlNode* place : map.entries("nodes", "node")) {
    const Context inner = context.inside(fmt::format("node '{}'", place->key));
    nodes.push_back({place->key, read_pose(inner, *place, fmt::format("nodes.{}.", place->key))});
  }
  return nodes;
}

/// Reads the shared keys of bodies that this kind has. `body` keeps its values for absent keys.
template <class Body>
Body read_body(const MapReader& map, const SceneDefinitions& definitions, Body body = {}) {
  body = read_entry<Body>(map, std::move(body));
  read_fields(map, body.start);
  if constexpr (requires { body.mirror; }) {
    if (!body.file.empty()) body.file = (map.context().reader.folder() / body.file).lexically_normal().string();
    body.mirror = read_mirror(map);
    if (body.modes && body.cutoff) map.refuse_both("modes", "cutoff", "give one of them");
  }
  if constexpr (requires { body.nodes; }) body.nodes = read_nodes(map);
  if constexpr (requires { body.shapes; }) body.shapes = read_shapes(map, definitions);
  return body;
}

SuperelementBodySpec read_superelement(const MapReader& map, const SceneDefinitions& definitions) {
  auto body = read_body<SuperelementBodySpec>(map, definitions);
  if (body.rigid)  // they would be ignored
    map.refuse(
        {"modes", "cutoff", "inertia", "stiffening", "second_order", "double_curvature", "frame", "weights", "damping"},
        "has no effect with use: rigid", "remove it, or give use: flexible");
  check_second_order(map);
  if (const YamlNode* frame = map.find("frame")) read_frame(map.context(), *frame, body);
  if (const YamlNode* weights = map.find("weights")) read_fields(map.inside(*weights, "weights"), body);
  return body;
}

/// Definition of the name that `node` gives, or null and an error with the nearest name.
template <class T>
const T* find_named(const Context& context, const YamlNode& node, const std::string& noun, const std::vector<T>& all) {
  const auto index = read_word(context, node, noun, texts_of(all, &T::name));
  return index ? &all[*index] : nullptr;
}

void read_properties(const MapReader& map, const SceneDefinitions& definitions, BeamBodySpec& body) {
  const Context& context = map.context();
  body.section.where = body.material.where = context.entry;
  if (const YamlNode* node = map.require("section")) {
    if (node->kind == YamlKind::map) {
      body.section = read_section(context.inside("section"), *node, definitions.units, "section.");
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
  if (body.section.by_stiffness) {
    body.material = unit_material(context.entry);
    map.refuse({"material"}, "has no effect with a section by stiffness", "remove it");
  } else if (const YamlNode* node = map.require("material")) {
    if (node->kind == YamlKind::map) {
      body.material = read_material(context.inside("material"), *node, "material.");
      body.material.name.clear();
    } else if (const Material* found = find_named(context, *node, "material", definitions.materials)) {
      body.material = *found;
    }
  }
}

BeamBodySpec read_beam(const MapReader& map, const SceneDefinitions& definitions) {
  BeamBodySpec none;
  none.elements = 0;
  auto body = read_body<BeamBodySpec>(map, definitions, none);
  read_properties(map, definitions, body);
  return body;
}

/// Substitute for a body of unreadable type, so that references to it cause no further errors.
SuperelementBodySpec unreadable_body(const Context& context, const YamlNode& node) {
  SuperelementBodySpec body;
  body.name = node.key;
  body.where = context.entry;
  body.rigid = true;
  return body;
}

/// Fields of the start of a body, for all kinds. `gravity` applies to kinds with mass only.
std::vector<Field> start_fields(std::vector<Field> gravity) {
  std::vector<Field> fields{
      plain<&InitialMotion::pose>("pose", "pose",
                                  "pose of the part frame in the world: `{position: [x, y, z], orientation: ..}`",
                                  "at the origin, unrotated"),
      plain<&InitialMotion::velocity>("velocity", "vector",
                                      "velocity of the origin of the part frame, world axes [length/time]",
                                      "free: see [initial](#initial)"),
      plain<&InitialMotion::angular_velocity>("angular_velocity", "vector", "angular velocity, world axes [rad/time]",
                                              "free")};
  fields.insert(fields.end(), gravity.begin(), gravity.end());
  return shared_fields("body_start", fields);
}

template <class Body>
std::vector<Field> start_fields() {
  return start_fields({plain<&Body::gravity>(
      "gravity", "vector",
      "gravity of this body instead of that of the scene, world axes [length/time²]; `[0, 0, 0]`: no weight",
      "that of the scene")});
}

KeySet superelement_fields() {
  return {"body_superelement",
          {{"type", "'superelement'", "", "required"},
           plain<&SuperelementBodySpec::file>("file", "text", "superelement file", "required"),
           {"mirror", "mirror",
            "`yz`, `xz` or `xy`: mirror the part at this plane of its frame, before the pose is applied. A list "
            "mirrors at one plane after another",
            "no"},
           choice<&SuperelementBodySpec::rigid, uses>("use",
                                                      "`flexible`, or `rigid`: a rigid body with the mass and inertia "
                                                      "of the file. The keys below, except `shape`, are then errors"),
           plain<&SuperelementBodySpec::modes>(
               "modes", "number_of", "number of internal modes to use, lowest first, from 0 to the number in the file",
               "all"),
           plain<&SuperelementBodySpec::cutoff>(
               "cutoff", "positive",
               "instead of `modes`: use the internal modes below this frequency [cycles per unit of time]", "all"),
           choice<&SuperelementBodySpec::inertia, inertia_options>(
               "inertia",
               "inertia option `A`, `B`, `M` or `F`: see [inertia options](#inertia-options). `M` and `F` cannot be "
               "combined with `frame: paper`",
               "`B`; `F` with `second_order`"),
           choice<&SuperelementBodySpec::stiffening, stiffening_options>(
               "stiffening",
               "geometric stiffness from the companion file. `off`: none. `stress`: from the stress in the body (needs "
               "inertia `M` or `F`). `full`: from its stress and its inertia (needs inertia `F`)",
               "`off`; `full` with `second_order`"),
           choice<&SuperelementBodySpec::second_order, on_or_off>(
               "second_order",
               "`on`: `inertia: F` and `stiffening: full`. `off`: `inertia: B` and `stiffening: off`, as without a "
               "companion file. See [second order](#second-order)",
               "`on` if a companion file lies beside the superelement file and neither `inertia` nor `stiffening` is "
               "given"),
           choice<&SuperelementBodySpec::double_curvature, on_or_off>(
               "double_curvature",
               "with stiffening: include the membrane stress of plates that bend into double curvature. The companion "
               "file has it if the part file has `double_curvature`",
               "`on` if the companion file has it"),
           {"frame", "/^(karcher|paper|node: ?[^ ]+)$/ | frame",
            "floating frame. `karcher`: mean rotation of the nodes. `paper`: mean of increments ([Car00] equation 16). "
            "`{node: base}` or the text `\"node: base\"`: attached to a node",
            "`karcher`"},
           {"weights", "weights",
            "weights of the nodes in the mean: `{positions: {base: 0.5, tip: 0.5}, rotations: {..}}`. The sum of each "
            "map must be 1. An error with `frame: {node: ..}`",
            "weights that put the origin of the frame nearest to the centre of mass"},
           nested<&SuperelementBodySpec::damping>("damping", "damping",
                                                  "map of `mass`, `stiffness`, `ratio`, `ratios`, `ratio_internal`, "
                                                  "`ratios_internal`: see [damping](#damping)",
                                                  "0"),
           shape_field()},
          start_fields<SuperelementBodySpec>()};
}

KeySet modal_fields() {
  return {"body_modal",
          {{"type", "'modal'", "", "required"},
           plain<&ModalBodySpec::file>("file", "text", "modal body file", "required"),
           {"mirror", "mirror", "mirror the body; values as for a superelement", "no"},
           plain<&ModalBodySpec::modes>(
               "modes", "number_of", "number of modes to use, lowest first, from 0 to the number in the file", "all"),
           plain<&ModalBodySpec::cutoff>(
               "cutoff", "positive", "instead of `modes`: use the modes below this frequency [cycles per unit of time]",
               "all"),
           nested<&ModalBodySpec::damping>(
               "damping", "damping",
               "map of `mass`, `stiffness`, `ratio`, `ratios` for its modes, added to the ratios of the file", "0"),
           shape_field()},
          start_fields<ModalBodySpec>()};
}

KeySet beam_fields() {
  return {
      "body_beam",
      {{"type", "'beam'", "", "required"},
       plain<&BeamBodySpec::from>("from", "vector", "ends of the beam in the part frame [length]", "required"),
       plain<&BeamBodySpec::to>("to", "vector", ditto, "required"),
       plain<&BeamBodySpec::through>("through", "vector",
                                     "a third point on the axis of the beam, which is then a circular arc [length]",
                                     "straight"),
       plain<&BeamBodySpec::orientation>(
           "orientation", "vector",
           "vector in the part frame; its component normal to the beam axis gives the y axis of the section",
           "the axis of the part frame that is most nearly normal to the beam; if two are equal, the first of y, z, x"),
       plain<&BeamBodySpec::elements>("elements", "integer>=1<=100000", "number of elements, 1 to 100 000", "required"),
       plain<&BeamBodySpec::nodes_per_element>("nodes_per_element", "2 | 3", "nodes of each element, 2 or 3"),
       {"section", "name | section", "a name from `sections` and `materials`, or the map itself; limits are below",
        "required"},
       {"material", "name | material", ditto, "required without `stiffness`"}},
      start_fields<BeamBodySpec>()};
}

}  // namespace

std::vector<KeySet> body_key_sets() {
  const Field nodes{"nodes", "{name: pose}", "name -> pose of the node in the part frame, `{position, orientation}`",
                    "none"};
  return {
      superelement_fields(),
      modal_fields(),
      beam_fields(),
      {"body_rigid",
       {{"type", "'rigid'", "", "required"},
        plain<&RigidBodySpec::mass>("mass", "positive", "mass of the body, positive [mass]", "required"),
        plain<&RigidBodySpec::center_of_mass>("center_of_mass", "vector", "centre of mass in the part frame [length]"),
        plain<&RigidBodySpec::inertia>(
            "inertia", "inertia_tensor",
            "inertia about the centre of mass, part axes [mass length²]: `[Ixx, Iyy, Izz]`, `[Ixx, Iyy, Izz, Ixy, Ixz, "
            "Iyz]` or three rows; limits as in [PART.md](PART.md)",
            "required"),
        nodes,
        shape_field()},
       start_fields<RigidBodySpec>()},
      {"body_rigid_from",
       {{"type", "'rigid'", "", "required"},
        plain<&SuperelementBodySpec::file>("from", "text", "", "required"),
        {"mirror", "mirror", ""},
        {"shape", "shape_of_body | [shape_of_body]", ""}},
       start_fields<SuperelementBodySpec>()},
      {"body_virtual", {{"type", "'virtual'", "", "required"}, nodes, shape_field()}, start_fields({})},
      {"pose",
       {plain<&Pose::position>("position", "vector", ""), plain<&Pose::orientation>("orientation", "rotation", "")}},
      {"frame", {{"node", "text", "", "required"}}},
      {"weights",
       {plain<&SuperelementBodySpec::position_weights>("positions", "{text: number}+", ""),
        plain<&SuperelementBodySpec::rotation_weights>("rotations", "{text: number}+", "")}},
      {"damping",
       {plain<&Damping::mass>("mass", "not_negative", ""), plain<&Damping::stiffness>("stiffness", "not_negative", ""),
        plain<&Damping::ratio>("ratio", "not_negative", ""), plain<&Damping::ratios>("ratios", "[not_negative]", ""),
        plain<&Damping::ratio_internal>("ratio_internal", "not_negative", ""),
        plain<&Damping::ratios_internal>("ratios_internal", "[not_negative]", "")}}};
}

Pose read_pose(const Context& context, const YamlNode& node, const std::string& prefix) {
  const MapReader map(context, node, "pose", prefix);
  Pose pose;
  read_fields(map, pose);
  return pose;
}

void read_value(const MapReader& map, const Field& field, Pose& value) {
  if (const YamlNode* node = find_or_require(map, field))
    value = read_pose(map.context(), *node, fmt::format("{}.", field.key));
}

void read_value(const MapReader& map, const Field& field, std::vector<NodeWeight>& value) {
  for (const YamlNode* node : map.entries(field.key, "node"))
    value.push_back({node->key, read_number(map.context(), *node, fmt::format("weight of '{}'", node->key))});
}

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
    const auto kind = read_word(context, *type, "type", {"superelement", "rigid", "beam", "virtual", "modal"});
    switch (kind.value_or(std::string::npos)) {
      case 0:
        bodies.emplace_back(read_superelement(MapReader(context, *node, "body_superelement"), definitions));
        break;
      case 1:
        if (find_child(*node, "from") != nullptr) {
          auto body = read_body<SuperelementBodySpec>(MapReader(context, *node, "body_rigid_from"), definitions);
          body.rigid = true;
          bodies.emplace_back(std::move(body));
        } else {
          bodies.emplace_back(read_body<RigidBodySpec>(MapReader(context, *node, "body_rigid"), definitions));
        }
        break;
      case 2:
        bodies.emplace_back(read_beam(MapReader(context, *node, "body_beam"), definitions));
        break;
      case 3:
        bodies.emplace_back(read_body<VirtualBodySpec>(MapReader(context, *node, "body_virtual"), definitions));
        break;
      case 4:
        bodies.emplace_back(read_body<ModalBodySpec>(MapReader(context, *node, "body_modal"), definitions));
        break;
      default:
        bodies.emplace_back(unreadable_body(context, *node));
    }
  }
  return bodies;
}

}  // namespace tisserand::formats
