// SPDX-License-Identifier: GPL-3.0-or-later
// Reads materials, plates, discs, cylinders, extrusions, shells and solids of part.yaml.
#include "formats/part/shells.hpp"

#include <limits>

#include "formats/part/reader.hpp"
#include "formats/sections/reader.hpp"
#include "formats/yaml/fields.hpp"
#include "formats/yaml/geometry.hpp"

namespace tisserand::formats {
namespace {

std::vector<Ply> read_plies(const MapReader& map) {
  std::vector<Ply> plies;
  const YamlNode& list = *map.find("laminate");
  if (list.kind != YamlKind::sequence || list.children.empty()) {
    map.context().fail(list.place, fmt::format("laminate must be a list of plies, not {}", describe(list)),
                       "write it as [{material: ply, thickness: 0.2, angle_deg: 45}, ...]");
    return plies;
  }
  for (std::size_t i = 0; i < list.children.size(); ++i) {
    const MapReader ply(map.context(), list.children[i], "ply", fmt::format("laminate.{}.", i));
    read_fields(ply, plies.emplace_back());
    plies.back().angle = read_angle(ply, 0.0);
  }
  return plies;
}

/// Reads the keys of the layout of a shell across its thickness.
ShellLayout read_layout(const MapReader& map) {
  ShellLayout layout;
  if (map.has("laminate")) {
    for (const char* key : {"thickness", "material"})
      map.refuse_both("laminate", key, "give the plies, or thickness and material");
    layout.plies = read_plies(map);
    for (const Ply& ply : layout.plies) layout.thickness += ply.thickness;
  } else {
    layout.thickness = map.number("thickness");
    layout.material = map.text("material");
  }
  read_fields(map, layout);
  return layout;
}

bool has_layout(const MapReader& map) {
  for (const char* key : {"laminate", "thickness", "material", "offset", "x", "mass_matrix"})
    if (map.has(key)) return true;
  return false;
}

std::vector<Eigen::Vector3d> read_positions(const MapReader& map, std::string_view key, const Part& part) {
  std::vector<Eigen::Vector3d> positions;
  const YamlNode* list = map.require(key);
  if (list == nullptr) return positions;
  map.context().require_list(*list, fmt::format("{} must be a list of points", key),
                             "write it as [a, b, c, d] or [[0, 0, 0], ...]");
  for (const YamlNode& item : list->children)
    positions.push_back(read_position(map.context(), item, fmt::format("{}[{}]", key, positions.size()), part));
  return positions;
}

Eigen::Vector3d require_position(const MapReader& map, std::string_view key, const Part& part) {
  const YamlNode* node = map.require(key);
  return node == nullptr ? Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())
                         : read_position(map.context(), *node, std::string(key), part);
}

Plate read_plate(const MapReader& map, const Part& part) {
  Plate plate{read_positions(map, "corners", part)};
  if (plate.corners.size() == 3) plate.corners.push_back(plate.corners[0] + plate.corners[2] - plate.corners[1]);
  return plate;
}

Disc read_disc(const MapReader& map, const Part& part) {
  Disc disc;
  disc.center = require_position(map, "center", part);
  disc.normal = Eigen::Vector3d::UnitZ();
  read_fields(map, disc);
  return disc;
}

Cylinder read_cylinder(const MapReader& map, const Part& part) {
  Cylinder cylinder;
  cylinder.from = require_position(map, "from", part);
  cylinder.to = require_position(map, "to", part);
  read_fields(map, cylinder);
  cylinder.end_radius = map.number("end_radius", cylinder.radius);
  cylinder.angle = read_angle(map, 2.0 * M_PI);
  return cylinder;
}

Extrusion read_extrusion(const MapReader& map, const Part& part) {
  Extrusion extrusion;
  extrusion.section = read_positions(map, "profile", part);
  map.require_one("along", "arc", "along: [x, y, z], or arc: {through: [..], axis: [..], angle_deg: 90}");
  if (const YamlNode* along = map.find("along")) extrusion.path = read_vector(map.context(), *along, "along");
  if (const YamlNode* arc = map.find("arc")) {
    const MapReader turn(map.context(), *arc, "arc", "arc.");
    ArcPath path{require_position(turn, "through", part), Eigen::Vector3d::UnitZ(),
                 turn.number("angle_deg") * (M_PI / 180.0)};
    read_fields(turn, path);
    extrusion.path = path;
  }
  return extrusion;
}

void read_division(const MapReader& map, ShellPatch& patch) {
  map.require_one("elements", "size", "give one of them: elements: [10, 20]");
  const YamlNode* elements = map.find("elements");
  if (elements == nullptr) return;
  if (!map.context().require_list(*elements, "elements must be two counts", "write it as [10, 20]", 2)) return;
  for (const YamlNode& item : elements->children)
    patch.elements.push_back(read_integer(map.context(), item, "elements").value_or(1));
}

template <class Read>
void read_patches_of(const MapReader& top, const char* key, const char* noun, Part& part, Read read) {
  read_entries(top, key, noun, part.patches, [&](const MapReader& map, ShellPatch& patch) {
    patch.shape = read(map, part);
    read_division(map, patch);
    if (has_layout(map)) patch.layout = read_layout(map);
  });
}

std::vector<Field> layout_fields() {
  return shared_fields(
      "layout",
      {{"thickness", "positive", "thickness and material of a single layer", "these two"},
       {"material", "name", ditto},
       {"laminate", "[ply]1..",
        "instead: plies `{material, thickness, angle_deg}`, listed in the direction of the normal. `angle_deg` "
        "(default 0) turns from the x axis to the fibres, right-handed about the normal",
        "or this"},
       plain<&ShellLayout::x>("x", "vector", "direction whose projection on the element is the x axis of the laminate",
                              "the first edge of each element"),
       plain<&ShellLayout::offset>("offset", "number",
                                   "distance of the middle surface from the mesh along the normal [length]"),
       choice<&ShellLayout::mass_matrix, mass_matrices>("mass_matrix", "`consistent` or `lumped`")});
}

/// Fields that all patches share, after the fields of each kind.
std::vector<Field> patch_fields() {
  std::vector<Field> fields = shared_fields(
      "patch", {plain<&ShellPatch::size>("size", "positive",
                                         "instead of `elements`: largest edge of an element [length]", "one of both"),
                choice<&ShellPatch::cells, cell_words>("cells", "`quadrilaterals` or `triangles`")});
  const std::vector<Field> layout = layout_fields();
  fields.insert(fields.end(), layout.begin(), layout.end());
  return fields;
}

}  // namespace

std::vector<KeySet> patch_key_sets() {
  return {
      {"plate",
       {{"corners", "[position]3..4",
         "four points or positions in order, right-handed about the normal; three give a parallelogram", "required"},
        {"elements", "[count]2", "number along corners 1-2, number along corners 1-4", "these or `size`"}},
       patch_fields()},
      {"disc",
       {{"center", "position", "a point or position", "required"},
        plain<&Disc::radius>("radius", "positive", "outer radius", "required"),
        plain<&Disc::inner_radius>("inner_radius", "not_negative", "radius of the hole"),
        plain<&Disc::normal>("normal", "vector", "direction of the normal", "[0, 0, 1]"),
        plain<&Disc::start>("start", "vector", "direction at which angles begin", "see below"),
        {"elements", "[count]2", "number around (full disc: a multiple of 4), number in radial direction",
         "these or `size`"}},
       patch_fields()},
      {"cylinder",
       {{"from", "position", "ends of the axis; the normal points outwards", "required"},
        {"to", "position", ditto},
        plain<&Cylinder::radius>("radius", "positive", "radius at `from`", "required"),
        {"end_radius", "positive", "radius at `to`", "`radius`"},
        plain<&Cylinder::start>("start", "vector", "direction at which angles begin", "see below"),
        {"angle_deg", "number>0<=360", "angle of the wall [degrees]", "360"},
        {"elements", "[count]2", "number around, number along the axis", "these or `size`"}},
       patch_fields()},
      {"extrusion",
       {{"profile", "[position]2..",
         "points of a polyline, closed if the last is the first. Normal: (direction of the profile) × (direction of "
         "the path)",
         "required"},
        {"along", "vector", "straight path, a vector", "one of both"},
        {"arc", "arc",
         "circular path `{through, axis, angle_deg}`: the axis (default [0, 0, 1]) goes through the point `through`"},
        {"elements", "[count]2", "number per segment of the profile, number along the path", "these or `size`"}},
       patch_fields()},
      {"arc",
       {{"through", "position", "", "required"},
        plain<&ArcPath::axis>("axis", "vector", ""),
        {"angle_deg", "number>=-360<=360", "", "required"}}}};
}

std::vector<KeySet> shell_key_sets() {
  return {
      {"material_orthotropic",
       {plain<&OrthotropicMaterial::E1>("E1", "positive", "Young's moduli along and across the fibres", "required"),
        plain<&OrthotropicMaterial::E2>("E2", "positive", ditto),
        plain<&OrthotropicMaterial::nu12>("nu12", "number", "contraction along 2 under tension along 1; nu12² < E1/E2",
                                          "required"),
        plain<&OrthotropicMaterial::G12>("G12", "positive", "shear moduli", "required"),
        plain<&OrthotropicMaterial::G13>("G13", "positive", ditto),
        plain<&OrthotropicMaterial::G23>("G23", "positive", ditto),
        plain<&OrthotropicMaterial::density>("density", "positive", "[mass/length³]", "required")}},
      {"ply",
       {plain<&Ply::material>("material", "name", "", "required"),
        plain<&Ply::thickness>("thickness", "positive", "", "required"),
        {"angle_deg", "number", ""}}},
      {"shell", {plain<&ShellGroup::on>("on", "text_list", "groups of faces, or `all`", "required")}, layout_fields()},
      {"solid",
       {plain<&SolidGroup::on>("on", "text_list", "groups of volumes, or `all`", "required"),
        plain<&SolidGroup::material>("material", "name", "name of an isotropic material", "required"),
        choice<&SolidGroup::mass_matrix, mass_matrices>("mass_matrix", "`consistent` or `lumped`")}}};
}

void read_part_materials(const MapReader& map, Part& part) {
  for (const YamlNode* node : map.entries("materials", "material")) {
    const Context context = entry_context(map.context().reader, "material", *node);
    if (find_child(*node, "E1") != nullptr || find_child(*node, "E2") != nullptr)
      part.orthotropic.push_back(read_entry<OrthotropicMaterial>(MapReader(context, *node, "material_orthotropic")));
    else
      part.materials.push_back(read_material(context, *node, ""));
  }
}

void read_patches(const MapReader& map, Part& part) {
  read_patches_of(map, "plates", "plate", part, read_plate);
  read_patches_of(map, "discs", "disc", part, read_disc);
  read_patches_of(map, "cylinders", "cylinder", part, read_cylinder);
  read_patches_of(map, "extrusions", "extrusion", part, read_extrusion);
}

void read_shells_and_solids(const MapReader& top, Part& part) {
  read_entries(top, "shells", "shell", part.shells,
               [](const MapReader& map, ShellGroup& shell) { shell.layout = read_layout(map); });
  read_entries(top, "solids", "solid", part.solids);
}

}  // namespace tisserand::formats
