// SPDX-License-Identifier: GPL-3.0-or-later
// Reads points, places, groups and the mesh file of part.yaml.
#include <algorithm>
#include <limits>

#include "formats/part/reader.hpp"
#include "formats/yaml/fields.hpp"
#include "formats/yaml/geometry.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

constexpr Choice<Dimension> dimensions[] = {
    {"nodes", Dimension::node}, {"edges", Dimension::edge}, {"faces", Dimension::face}, {"volumes", Dimension::volume}};
constexpr Choice<CoincidentNodes> coincident_ways[] = {{"report", CoincidentNodes::report},
                                                       {"merge", CoincidentNodes::merge}};
constexpr Choice<UnknownContent> unknown_ways[] = {{"refuse", UnknownContent::refuse},
                                                   {"ignore", UnknownContent::ignore}};

Eigen::Vector3d unreadable() { return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()); }

std::vector<long> read_numbers_of(const MapReader& map, std::string_view key) {
  std::vector<long> numbers;
  const YamlNode* node = map.find(key);
  if (node == nullptr) return numbers;
  for (const YamlNode& item : items_of(*node))
    if (const auto number = read_integer(map.context(), item, std::string(key))) numbers.push_back(*number);
  return numbers;
}

BoxSelection read_box(const MapReader& map) {
  const YamlNode& node = *map.find("box");
  if (!map.context().require_list(node, "box must be two corners", "write it as [[0, 0, 0], [1, 1, 1]]", 2))
    return {unreadable(), unreadable()};
  const Eigen::Vector3d a = read_vector(map.context(), node.children[0], "box[0]");
  const Eigen::Vector3d b = read_vector(map.context(), node.children[1], "box[1]");
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

CylinderSelection read_bore(const MapReader& map, const Part& part) {
  const MapReader bore(map.context(), *map.find("cylinder"), "group_cylinder", "cylinder.");
  CylinderSelection selection{unreadable(), unreadable(), 0.0};
  if (const YamlNode* node = bore.require("from")) selection.from = read_position(bore.context(), *node, "from", part);
  if (const YamlNode* node = bore.require("to")) selection.to = read_position(bore.context(), *node, "to", part);
  read_fields(bore, selection);
  return selection;
}

/// Reads faces, edges, volumes or nodes by number. The key gives the dimension.
void read_numbered(const MapReader& map, GroupDefinition& group) {
  struct Numbered {
    const char* key;
    Dimension of;
  };
  int kinds = 0;
  for (const Numbered& numbered : {Numbered{"nodes", Dimension::node}, Numbered{"edges", Dimension::edge},
                                   Numbered{"faces", Dimension::face}, Numbered{"volumes", Dimension::volume}})
    if (map.has(numbered.key)) {
      group.of = numbered.of;
      group.numbers = read_numbers_of(map, numbered.key);
      ++kinds;
    }
  if (kinds > 1) map.fail("entities of different kinds are given", "make one group of each kind");
  if (kinds == 1)
    map.refuse({"of"}, "cannot be combined with numbers of entities",
               "remove it: the key of the numbers gives their kind");
}

void read_group(const MapReader& map, const Part& part, GroupDefinition& group) {
  read_numbered(map, group);
  if (map.has("box")) group.box = read_box(map);
  if (map.has("cylinder")) group.cylinder = read_bore(map, part);
  if (const YamlNode* near = map.find("near")) group.near = read_position(map.context(), *near, "near", part);
}

}  // namespace

Eigen::Vector3d read_position(const Context& context, const YamlNode& node, const std::string& what, const Part& part) {
  if (node.kind != YamlKind::scalar) return read_vector(context, node, what);
  const auto index = read_word(context, node, "point", texts_of(part.points, &NamedPoint::name));
  if (!index) return unreadable();
  if (!part.points[*index].place) return part.points[*index].position;
  context.fail(node.place, fmt::format("{}: point '{}' is a node of the mesh file", what, node.text),
               "use a point that is given by coordinates");
  return unreadable();
}

Place read_place_keys(const MapReader& map, const Part& part) {
  Place place;
  const int given =
      static_cast<int>(map.has("node")) + static_cast<int>(map.has("near")) + static_cast<int>(map.has("centroid"));
  if (given != 1)
    map.fail(given == 0 ? "none of 'node', 'near', 'centroid' is given"
                        : "more than one of 'node', 'near', 'centroid' is given",
             "give one: {near: [x, y, z]}");
  if (!map.has("near")) map.refuse({"tolerance"}, "has no effect without 'near'", "remove it");
  if (const YamlNode* node = map.find("node")) {
    place.kind = PlaceKind::node;
    place.node = read_integer(map.context(), *node, "node").value_or(0);
  }
  if (const YamlNode* node = map.find("near")) {
    place.kind = PlaceKind::near;
    place.position = read_position(map.context(), *node, "near", part);
    if (map.has("tolerance")) place.tolerance = map.number("tolerance");
  }
  if (map.has("centroid")) {
    place.kind = PlaceKind::centroid;
    place.name = map.text("centroid");
  }
  return place;
}

Place read_place(const Context& context, const YamlNode& node, const std::string& what, const Part& part) {
  Place place;
  if (node.kind == YamlKind::map) return read_place_keys(MapReader(context, node, "place", what + "."), part);
  if (node.kind == YamlKind::sequence) {
    place.kind = PlaceKind::position;
    place.position = read_vector(context, node, what);
    return place;
  }
  place.name = read_text(context, node, what);
  return place;
}

double read_angle(const MapReader& map, double fallback) {
  return map.has("angle_deg") ? map.number("angle_deg") * (M_PI / 180.0) : fallback;
}

std::vector<KeySet> place_key_sets() {
  return {{"mesh",
           {plain<&MeshFile::file>("file", "text+",
                                   "a relative name starts at the folder of this file. Geometry: `.geo` of gmsh, "
                                   "`.step .stp .iges .igs .brep`. Meshes: `.msh` 2.2 and 4.1, text or binary. Decks: "
                                   "Nastran `.bdf .nas .dat`, Abaqus and CalculiX `.inp`",
                                   "required"),
            plain<&MeshFile::size>("size", "positive", "geometry: largest edge of an element", "by gmsh"),
            plain<&MeshFile::smallest>("smallest", "positive", "geometry: lower bound of the size"),
            plain<&MeshFile::curvature>("curvature", "number_of", "geometry: elements per full turn of curved faces",
                                        "off"),
            {"sizes", "{text: positive}+", "geometry: group -> largest edge of an element on it", "none"},
            plain<&MeshFile::order>("order", "1 | 2", "geometry: 1, or 2 for solids of 10, 15 and 20 nodes",
                                    "1, or that of the `.geo` file"),
            words<cell_words>("cells", "geometry: `triangles` or `quadrilaterals` (gmsh recombines) on faces",
                              "triangles, or those of the `.geo` file"),
            plain<&MeshFile::scale>("scale", "positive", "factor on all coordinates (not of decks)"),
            choice<&MeshFile::unknown, unknown_ways>(
                "unknown", "decks: `refuse` cards that are not understood, or `ignore` and list them"),
            choice<&MeshFile::coincident, coincident_ways>(
                "coincident", "unconnected nodes at the same place: `report` them, or `merge` them into one"),
            plain<&MeshFile::ignore>("ignore", "text_list", "groups that need no property", "none")}},
          {"group",
           {{"faces", "numbers", "numbers of entities of a geometry; only one of these keys", "-"},
            {"edges", "numbers", ditto},
            {"volumes", "numbers", ditto},
            {"nodes", "numbers", "numbers of the mesh file", "-"},
            plain<&GroupDefinition::groups>("groups", "text_list", "names of other groups", "-"),
            choice<&GroupDefinition::of, dimensions>(
                "of", "what `box`, `cylinder` and `near` select: `nodes`, `edges`, `faces` or `volumes`"),
            {"box", "[vector]2", "two opposite corners; selects what lies completely inside", "-"},
            {"cylinder", "group_cylinder",
             "`{from, to, radius}`; selects what lies completely on this cylindrical wall, such as a bore", "-"},
            {"near", "position", "a position; selects the nearest entity. Two equally near ones are an error", "-"},
            plain<&GroupDefinition::tolerance>(
                "tolerance", "not_negative", "tolerance of `box`, `cylinder` and `near` [length]",
                "box: 1e-6 of the extent; cylinder: 1e-3 of the radius; near: a tenth of the extent")},
           {},
           {1, 0}},
          {"group_cylinder",
           {{"from", "position", "", "required"},
            {"to", "position", "", "required"},
            plain<&CylinderSelection::radius>("radius", "positive", "", "required")}},
          {"place",
           {{"node", "integer", "number of the node in the mesh file", "one of these three"},
            {"near", "position",
             "`[x, y, z]` or a point: the nearest node of the mesh file that belongs to an element. Two equally near "
             "nodes are an error",
             "-"},
            {"centroid", "text+", "a new node at the centroid of a group's area (length, volume)", "-"},
            {"tolerance", "not_negative", "largest distance of the node from `near`; beyond it is an error [length]",
             "1e-3 of the extent of the mesh"}}}};
}

void read_part_points(const MapReader& map, Part& part) {
  for (const YamlNode* node : map.entries("points", "point")) {
    const Context context = entry_context(map.context().reader, "point", *node);
    NamedPoint point{node->key, Eigen::Vector3d::Zero(), context.entry};
    if (node->kind == YamlKind::map)
      point.place = read_place(context, *node, "position", part);
    else
      point.position = read_vector(context, *node, "position");
    part.points.push_back(std::move(point));
  }
}

void read_groups(const MapReader& map, Part& part) {
  read_entries(map, "groups", "group", part.groups,
               [&](const MapReader& inner, GroupDefinition& group) { read_group(inner, part, group); });
}

void read_mesh_file(const MapReader& top, Part& part) {
  const YamlNode* node = top.find("mesh");
  if (node == nullptr) return;
  YamlReader& reader = top.context().reader;
  const Context context = key_context(reader, *node);
  const MapReader map(context, *node, "mesh");
  MeshFile& mesh = part.mesh;
  mesh.where = context.entry;
  read_fields(map, mesh);
  if (!mesh.file.empty() && mesh.file.front() != '/')
    mesh.file = (reader.folder() / mesh.file).lexically_normal().string();
  for (const YamlNode* entry : map.entries("sizes", "group"))
    mesh.sizes.push_back({entry->key, read_number(context, *entry, "size"), reader.where(entry->key_place)});
  if (map.has("cells")) mesh.cells = map.choice("cells", cell_words, Cells::quadrilaterals);
}

}  // namespace tisserand::formats
