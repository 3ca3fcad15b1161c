// part.yaml to the struct Part.
#include "formats/part.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/geometry_reader.hpp"
#include "formats/part_check.hpp"
#include "formats/part_keys.hpp"
#include "formats/section_reader.hpp"
#include "formats/units_reader.hpp"
#include "formats/yaml_reader.hpp"

namespace tisserand::formats {

namespace {

std::vector<NamedPoint> read_points(const MapReader& map) {
  std::vector<NamedPoint> points;
  for (const YamlNode* node : map.entries("points", "point")) {
    const Context context = entry_context(map.context().reader, "point", *node);
    points.push_back({node->key, read_vector(context, *node, "position"), context.entry});
  }
  return points;
}

/// Coordinates, or the name of a point. An unknown name gives not-a-number: that is an error with a suggestion here.
Eigen::Vector3d read_point_or_name(const MapReader& map, const YamlNode& node, const Part& part) {
  if (node.kind != YamlKind::scalar) return read_vector(map.context(), node, "through");
  std::vector<std::string> names;
  for (const NamedPoint& point : part.points) names.push_back(point.name);
  const auto index = read_word(map.context(), node, "point", names);
  return index ? part.points[*index].position : Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

void read_division(const MapReader& map, BeamLine& beam) {
  if (map.has("elements") == map.has("size"))
    map.fail(map.has("size") ? "both 'elements' and 'size' are given" : "neither 'elements' nor 'size' is given",
             "give one of them");
  if (const YamlNode* node = map.find("elements")) {
    beam.elements = read_integer(map.context(), *node, "elements").value_or(1);
    if (beam.elements < 1)
      map.context().fail(node->place, fmt::format("elements {} must be 1 or more", beam.elements), "");
  }
  if (map.has("size")) beam.size = map.number("size");
}

BeamLine read_beam(const Context& context, const YamlNode& node, const Part& part) {
  const MapReader map(context, node, "beam");
  BeamLine beam;
  beam.name = node.key;
  beam.where = context.entry;
  beam.from = map.text("from");
  beam.to = map.text("to");
  if (const YamlNode* through = map.find("through")) beam.through = read_point_or_name(map, *through, part);
  beam.section = map.text("section");
  beam.material = map.text("material");
  read_division(map, beam);
  beam.orientation = read_optional_vector(map, "orientation");
  beam.theory = map.choice(
      "theory",
      {Choice<BeamTheory>{"timoshenko", BeamTheory::timoshenko}, {"euler_bernoulli", BeamTheory::euler_bernoulli}},
      BeamTheory::timoshenko);
  beam.mass_matrix = map.choice(
      "mass_matrix", {Choice<MassMatrix>{"consistent", MassMatrix::consistent}, {"lumped", MassMatrix::lumped}},
      MassMatrix::consistent);
  beam.rotary_inertia =
      map.choice("rotary_inertia", {Choice<bool>{"on", true}, {"off", false}, {"true", true}, {"false", false}}, true);
  return beam;
}

PointMass read_point_mass(const Context& context, const YamlNode& node) {
  const MapReader map(context, node, "point_mass");
  PointMass mass;
  mass.name = node.key;
  mass.where = context.entry;
  mass.at = map.text("at");
  mass.mass = map.number("mass");
  if (const YamlNode* inertia = map.find("inertia")) mass.inertia = read_inertia(context, *inertia, "inertia");
  return mass;
}

/// `boundary: [base, tip]`, or a map from points to all, translations or rotations.
std::vector<BoundaryNode> read_boundary(const MapReader& map) {
  std::vector<BoundaryNode> boundary;
  const YamlNode* node = map.require("boundary");
  if (node == nullptr) return boundary;
  YamlReader& reader = map.context().reader;
  if (node->kind == YamlKind::map) {
    for (const YamlNode* entry : map.entries("boundary", "boundary node")) {
      const Context context = entry_context(reader, "boundary node", *entry);
      const auto kind = read_word(context, *entry, "value", {"all", "translations", "rotations"}).value_or(0);
      boundary.push_back({entry->key, entry->key, kind != 2, kind != 1, context.entry});
    }
    return boundary;
  }
  if (node->kind != YamlKind::sequence) {
    map.context().fail(node->place, fmt::format("boundary must be a list of points, not {}", describe(*node)),
                       "write it as [base, tip] or {base: all, tip: translations}");
    return boundary;
  }
  for (const YamlNode& item : node->children) {
    const Context context{reader, "boundary", reader.where(item.place)};
    reader.note_place(context.entry, item.place);
    const std::string name = read_text(context, item, "an entry");
    boundary.push_back({name, name, true, true, context.entry});
  }
  return boundary;
}

ModeSelection read_modes(const MapReader& map) {
  ModeSelection modes;
  const bool both = map.has("modes") && map.has("cutoff");
  if (both)
    map.context().fail(map.find("cutoff")->key_place, "both 'modes' and 'cutoff' are given", "give one of them");
  modes.where = map.context().entry;
  modes.count = map.integer("modes", 0);
  if (map.has("cutoff")) modes.cutoff = map.number("cutoff");
  return modes;
}

Part read_tree(YamlReader& reader, const std::string& path) {
  const Context context{reader, "", path};
  const MapReader map(context, reader.root(), "part");
  Part part;
  part.file = path;
  part.name = map.text("part");
  part.units = read_units(map);
  part.materials = read_materials(map);
  part.sections = read_sections(map, part.units);
  part.points = read_points(map);
  for (const YamlNode* node : map.entries("beams", "beam"))
    part.beams.push_back(read_beam(entry_context(reader, "beam", *node), *node, part));
  for (const YamlNode* node : map.entries("point_masses", "point mass"))
    part.point_masses.push_back(read_point_mass(entry_context(reader, "point mass", *node), *node));
  part.boundary = read_boundary(map);
  part.modes = read_modes(map);
  return part;
}

}  // namespace

Part read_part(const std::string& path, const std::vector<Override>& overrides) {
  YamlDocument document = load_yaml(path);
  apply_overrides(document, overrides, {"materials", "sections", "points", "beams", "point_masses"});
  YamlReader reader(document, part_key_sets());
  require_kind(reader, "part", "scene", "give it to `mechanism run`");
  Part part = read_tree(reader, path);
  reader.raise(find_faults(part));
  return part;
}

}  // namespace tisserand::formats
