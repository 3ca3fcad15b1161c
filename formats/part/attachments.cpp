// SPDX-License-Identifier: GPL-3.0-or-later
// Reads beams, point masses, springs, spiders and boundary nodes of part.yaml.

#include "formats/part/reader.hpp"
#include "formats/yaml/fields.hpp"
#include "formats/yaml/geometry.hpp"

namespace tisserand::formats {
namespace {

constexpr Choice<BeamTheory> theories[] = {{"timoshenko", BeamTheory::timoshenko},
                                           {"euler_bernoulli", BeamTheory::euler_bernoulli}};
constexpr Choice<bool> rotary_words[] = {{"on", true}, {"off", false}, {"true", true}, {"false", false}};
constexpr Choice<SpiderType> spider_types[] = {{"rigid", SpiderType::rigid}, {"averaging", SpiderType::averaging}};
constexpr Choice<SpiderWeights> spider_weights[] = {{"area", SpiderWeights::area}, {"equal", SpiderWeights::equal}};

void read_division(const MapReader& map, BeamLine& beam) {
  map.require_one("elements", "size", "give one of them");
  if (const YamlNode* node = map.find("elements")) {
    beam.elements = read_integer(map.context(), *node, "elements").value_or(1);
    if (beam.elements < 1)
      map.context().fail(node->place, fmt::format("elements {} must be 1 or more", beam.elements), "");
  }
}

/// Reads a beam: its ends and division, or groups of lines.
void read_line(const MapReader& map, BeamLine& beam, const Part& part) {
  if (const YamlNode* on = map.find("on")) {
    beam.on = read_texts(map.context(), *on, "on");
    map.refuse({"from", "to", "through", "elements", "size", "to_section"}, "cannot be combined with 'on'",
               "remove it: beams on a group get their lines and elements from the group");
    return;
  }
  if (const YamlNode* from = map.require("from")) beam.from = read_place(map.context(), *from, "from", part);
  if (const YamlNode* to = map.require("to")) beam.to = read_place(map.context(), *to, "to", part);
  if (const YamlNode* through = map.find("through"))
    beam.through = read_position(map.context(), *through, "through", part);
  read_division(map, beam);
}

unsigned read_components(const MapReader& map, std::string_view key) {
  const YamlNode* node = map.find(key);
  return node == nullptr ? 0 : read_component_bits(map.context(), *node, "release");
}

void read_ends(const MapReader& map, BeamLine& beam) {
  beam.angle = read_angle(map, 0.0);
  beam.from_offset = beam.to_offset = read_vector(map, "offset", Eigen::Vector3d::Zero());
  beam.from_offset = read_vector(map, "from_offset", beam.from_offset);
  beam.to_offset = read_vector(map, "to_offset", beam.to_offset);
  if (const YamlNode* node = map.find("releases")) {
    const MapReader releases(map.context(), *node, "releases", "releases.");
    beam.releases = {read_components(releases, "start"), read_components(releases, "end")};
  }
}

/// Reads a 6 x 6 stiffness: six numbers of the diagonal, or six rows.
Eigen::Matrix<double, 6, 6> read_stiffness(const Context& context, const YamlNode& node) {
  Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();
  const auto fail = [&](const YamlNode& part, std::size_t count) {
    context.fail(part.place, fmt::format("stiffness has {} numbers instead of 6", count),
                 "give [kx, ky, kz, krx, kry, krz] or six rows of six");
  };
  if (!has_rows(node)) {
    const std::vector<double> k = read_numbers(context, node, "stiffness");
    if (k.size() != 6) return fail(node, k.size()), stiffness;
    for (int i = 0; i < 6; ++i) stiffness(i, i) = k[i];
    return stiffness;
  }
  if (node.children.size() != 6) return fail(node, node.children.size()), stiffness;
  for (int i = 0; i < 6; ++i) {
    const YamlNode& row = node.children[i];
    const std::vector<double> k = read_numbers(context, row, fmt::format("stiffness[{}]", i));
    if (k.size() != 6) return fail(row, k.size()), stiffness;
    for (int j = 0; j < 6; ++j) stiffness(i, j) = k[j];
  }
  return stiffness;
}

/// Reads names of groups or numbers of nodes, one or a list.
void read_legs(const MapReader& map, SpiderLine& spider) {
  const YamlNode* on = map.require("on");
  if (on == nullptr) return;
  for (const YamlNode& item : items_of(*on)) {
    if (!looks_like_number(item))
      spider.on.push_back(read_text(map.context(), item, "on"));
    else if (const auto node = read_integer(map.context(), item, "on"))
      spider.nodes.push_back(*node);
  }
}

void read_spider(const MapReader& map, const Part& part, SpiderLine& spider) {
  const Context& context = map.context();
  const YamlNode* at = map.find("at");
  if (at == nullptr || (at->kind == YamlKind::scalar && at->text == "centroid"))
    spider.at.kind = PlaceKind::centroid;
  else
    spider.at = read_place(context, *at, "at", part);
  read_legs(map, spider);
  if (spider.type == SpiderType::rigid && map.has("weights"))
    context.fail(map.find("weights")->key_place, "a rigid spider has no weights", "remove them, or kind: averaging");
}

void keep(BoundaryNode& boundary, std::size_t kind) {
  boundary.translations = kind != 2;
  boundary.rotations = kind != 1;
}

/// Reads `tip: all`, or `tip: {near: [..], keep: translations}`.
BoundaryNode read_boundary_entry(const Context& context, const YamlNode& entry, const Part& part) {
  const std::vector<std::string> kinds{"all", "translations", "rotations"};
  BoundaryNode boundary{entry.key, entry.key, true, true, context.entry};
  if (entry.kind != YamlKind::map) {
    keep(boundary, read_word(context, entry, "value", kinds).value_or(0));
    return boundary;
  }
  const MapReader map(context, entry, "boundary_entry");
  if (const YamlNode* kind = map.find("keep")) keep(boundary, read_word(context, *kind, "keep", kinds).value_or(0));
  const YamlNode* at = map.find("at");
  const bool by_keys = map.has("node") || map.has("near") || map.has("centroid");
  if (at != nullptr && by_keys)
    context.fail(at->key_place, "both 'at' and another place are given", "give one of at, node, near, centroid");
  if (at != nullptr) boundary.at = read_place(context, *at, "at", part);
  if (at == nullptr && (by_keys || map.has("tolerance"))) boundary.at = read_place_keys(map, part);
  return boundary;
}

/// Reads `mean_axis`, a place, or `{left: [x, y, z, rx], right: [y, z]}`.
std::vector<ModalBodyRequest::Held> read_reference(const MapReader& map) {
  const YamlNode* node = map.require("reference");
  if (node == nullptr) return {};
  std::vector<ModalBodyRequest::Held> held;
  if (node->kind == YamlKind::scalar) {
    const std::string word = read_text(map.context(), *node, "reference");
    if (word != "mean_axis") held.push_back({word});
    return held;
  }
  for (const YamlNode* entry : map.entries("reference", "held place")) {
    const bool all = entry->kind == YamlKind::scalar && entry->text == "all";
    held.push_back({entry->key, all ? 0b111111U : read_component_bits(map.context(), *entry, "component")});
  }
  if (held.empty()) map.context().fail(node->place, "reference holds no component", "name a place, or mean_axis");
  return held;
}

}  // namespace

unsigned read_component_bits(const Context& context, const YamlNode& node, const std::string& what) {
  unsigned bits = 0;
  const std::vector<std::string> words{"x", "y", "z", "rx", "ry", "rz"};
  for (const YamlNode& item : items_of(node))
    if (const auto index = read_word(context, item, what, words)) bits |= 1U << *index;
  return bits;
}

void read_modal_body(const MapReader& map, Part& part) {
  const YamlNode* node = map.find("modal_body");
  if (node == nullptr) return;
  const MapReader own(key_context(map.context().reader, *node), *node, "modal_body");
  ModalBodyRequest& body = part.modal_body.emplace();
  body.where = own.context().entry;
  read_fields(own, body);
  body.held = read_reference(own);
  body.all_nodes = own.choice("nodes", {Choice<bool>{"boundary", false}, {"all", true}}, false);
}

std::vector<KeySet> attachment_key_sets() {
  return {
      {"beam",
       {{"from", "at", "places of the two ends; the local x axis points from `from` to `to`", "required without `on`"},
        {"to", "at", ditto},
        {"on", "text_list", "instead: groups of edges, whose line elements become beam elements", "-"},
        {"through", "position",
         "a third point of a circular arc, by name or as `[x, y, z]`, not on the line through the ends", "straight"},
        plain<&BeamLine::section>("section", "name", "name of the section", "required"),
        plain<&BeamLine::material>("material", "name", "name of the material; none with a section by `stiffness`",
                                   "required otherwise"),
        plain<&BeamLine::to_section>("to_section", "name",
                                     "section at `to` of a tapered beam. If both have the same shape its sizes vary "
                                     "linearly, else the section constants do",
                                     "`section`"),
        {"elements", "count", "number of equal elements, 1 or more", "one of both"},
        plain<&BeamLine::size>("size", "positive", "instead: largest length of an element [length]", "one of both"),
        plain<&BeamLine::orientation>(
            "orientation", "vector",
            "direction whose component normal to the beam axis is the local y axis; not parallel to the axis",
            "the global axis most nearly normal to the axis (the first of y, z, x among equals)"),
        {"angle_deg", "number", "turns the section from there about x, right-handed [degrees]", "0"},
        {"offset", "vector", "vector from the nodes to the axis of the beam, in part axes [length]", "[0, 0, 0]"},
        {"from_offset", "vector", "offset at one end; linear between the ends", "`offset`"},
        {"to_offset", "vector", ditto},
        {"releases", "releases",
         "`{start: [ry, rz], end: [rx]}`: forces x, y, z and moments rx, ry, rz at an end, in beam axes, that are "
         "zero. With `on`: at the ends of every element",
         "none"},
        choice<&BeamLine::theory, theories>("theory", "`timoshenko` or `euler_bernoulli` (no shear deformation)"),
        choice<&BeamLine::mass_matrix, mass_matrices>("mass_matrix", "`consistent` or `lumped`"),
        {"rotary_inertia", "'on' | 'off' | true | false",
         "`on` or `off`. `off` omits the rotary inertia of bending; that of torsion stays", "`on`"}}},
      {"releases", {{"start", "components", ""}, {"end", "components", ""}}},
      {"point_mass",
       {{"at", "at", "place of the mass", "required"},
        plain<&PointMass::offset>("offset", "vector",
                                  "vector from the place to the centre of mass, in part axes [length]"),
        plain<&PointMass::mass>("mass", "not_negative", "mass, not negative [mass]", "required"),
        plain<&PointMass::inertia>(
            "inertia", "inertia_tensor",
            "about the centre of mass, in part axes [mass length²]: `[Ixx, Iyy, Izz]`, `[Ixx, Iyy, Izz, Ixy, Ixz, "
            "Iyz]`, or three rows. Off-diagonal numbers are entries of the tensor: Ixy = -∫ x y dm. Positive "
            "semidefinite. No principal moment may exceed the sum of the other two by more than 1e-3; a smaller excess "
            "(rounded input) gives a note",
            "0")}},
      {"spring",
       {{"from", "at", "the two places that it connects", "required"},
        {"to", "at", ditto},
        {"stiffness", "six_by_six",
         "six numbers (the diagonal) or six rows (symmetric, positive semidefinite). The matrix gives [force; moment] "
         "from [relative displacement; relative rotation] at the point midway between the nodes, to which rigid arms "
         "lead [force/length, force, force length]",
         "required"},
        {"axes", "rotation",
         "axes of the stiffness, written as orientations in SCENE.md: `{x: [..], y: [..]}`, `{axis: [..], angle_deg: "
         "30}`, a quaternion or three rows",
         "part axes"}}},
      {"spider",
       {choice<&SpiderLine::type, spider_types>(
            "kind",
            "`rigid`: the nodes of the group follow the spider's node (RBE2). `averaging`: the spider's node follows "
            "the weighted mean motion of the group, which can still deform (RBE3)",
            "required"),
        {"at", "at", "place of the spider's own node, or `centroid` of the group", "`centroid`"},
        {"on", "text | integer | [text | integer]", "groups, or node numbers", "required"},
        choice<&SpiderLine::weights, spider_weights>(
            "weights", "for averaging spiders: the `area` (or length, volume) that belongs to each node, or `equal`")}},
      {"boundary_entry",
       {{"at", "at", ""},
        {"node", "integer", ""},
        {"near", "position", ""},
        {"tolerance", "not_negative", ""},
        {"centroid", "text+", ""},
        {"keep", "'all' | 'translations' | 'rotations'", ""}}},
      {"modal_body",
       {{"reference", "'mean_axis' | name | {name: 'all' | components}+",
         "what ties the body frame to the body: the boundary node, point or spider that is held; six held components "
         "that exclude every rigid motion, `{left: [x, y, z, rx], right: [y, z]}`; or `mean_axis`",
         "required"},
        plain<&ModalBodyRequest::modes>("modes", "count", "number of modes, lowest first", "required"),
        plain<&ModalBodyRequest::damping>("damping", "not_negative", "damping ratio of every mode"),
        {"nodes", "'boundary' | 'all'",
         "nodes in the file: `boundary` (boundary nodes and held ones), or `all` nodes of the mesh (the others are "
         "named `n1`, `n2`, ... in their order)",
         "`boundary`"}}}};
}

void read_beams(const MapReader& map, Part& part) {
  read_entries(map, "beams", "beam", part.beams, [&](const MapReader& inner, BeamLine& beam) {
    read_line(inner, beam, part);
    beam.rotary_inertia = inner.choice("rotary_inertia", rotary_words, true);
    read_ends(inner, beam);
  });
}

void read_attachments(const MapReader& top, Part& part) {
  read_entries(top, "point_masses", "point mass", part.point_masses, [&](const MapReader& map, PointMass& mass) {
    if (const YamlNode* at = map.require("at")) mass.at = read_place(map.context(), *at, "at", part);
  });
  read_entries(top, "springs", "spring", part.springs, [&](const MapReader& map, SpringLine& spring) {
    if (const YamlNode* from = map.require("from")) spring.from = read_place(map.context(), *from, "from", part);
    if (const YamlNode* to = map.require("to")) spring.to = read_place(map.context(), *to, "to", part);
    if (const YamlNode* node = map.require("stiffness")) spring.stiffness = read_stiffness(map.context(), *node);
    if (const YamlNode* axes = map.find("axes"))
      spring.axes = read_orientation(map.context(), *axes, "axes").toRotationMatrix();
  });
  read_entries(top, "spiders", "spider", part.spiders,
               [&](const MapReader& map, SpiderLine& spider) { read_spider(map, part, spider); });
}

void read_boundary(const MapReader& map, Part& part) {
  const bool required = part.mesh.file.empty() && !map.has("supports") && !map.has("load_cases");
  const YamlNode* node = required ? map.require("boundary") : map.find("boundary");
  if (node == nullptr) return;
  YamlReader& reader = map.context().reader;
  if (node->kind == YamlKind::map) {
    for (const YamlNode* entry : map.entries("boundary", "boundary node"))
      part.boundary.push_back(read_boundary_entry(entry_context(reader, "boundary node", *entry), *entry, part));
    return;
  }
  if (!map.context().require_list(*node, "boundary must be a list of points",
                                  "write it as [base, tip] or {base: all, tip: translations}"))
    return;
  for (const YamlNode& item : node->children) {
    const Context context{reader, "boundary", reader.where(item.place)};
    reader.note_place(context.entry, item.place);
    const std::string name = read_text(context, item, "an entry");
    part.boundary.push_back({name, name, true, true, context.entry});
  }
}

}  // namespace tisserand::formats
