// Sections by constants, materials, and the checks of both.
#include "formats/sections/reader.hpp"

#include <cmath>

#include "formats/sections/shape_reader.hpp"

namespace tisserand::formats {

namespace {

Section read_constants(const Context& context, const YamlNode& node, const std::string& prefix) {
  const MapReader map(context, node, "section_constants", prefix);
  Section section;
  section.area = map.number("A");
  section.second_moment_y = map.number("Iy");
  section.second_moment_z = map.number("Iz");
  section.torsion_constant = map.number("J");
  section.polar_moment = section.second_moment_y + section.second_moment_z;
  section.shear_area_y = map.number("shear_area_y", 0.0);
  section.shear_area_z = map.number("shear_area_z", 0.0);
  section.second_moment_yz = map.number("Iyz", 0.0);
  const auto pair = [&map](std::string_view key, double& y, double& z) {
    const YamlNode* entry = map.find(key);
    if (entry == nullptr) return;
    const std::vector<double> numbers = read_numbers(map.context(), *entry, std::string(key));
    if (numbers.size() == 2)
      y = numbers[0], z = numbers[1];
    else if (!numbers.empty())
      map.context().fail(entry->place, fmt::format("{} has {} numbers", key, numbers.size()), "give [y, z]");
  };
  pair("centroid", section.centroid_y, section.centroid_z);
  pair("shear_center", section.shear_center_y, section.shear_center_z);
  return section;
}

}  // namespace

std::vector<KeySet> section_key_sets() {
  std::vector<KeySet> sets{
      {"material", {"E", "nu", "density"}},
      {"section_constants", {"A", "Iy", "Iz", "J", "Iyz", "shear_area_y", "shear_area_z", "centroid", "shear_center"}}};
  const std::vector<KeySet> shapes = shape_key_sets();
  sets.insert(sets.end(), shapes.begin(), shapes.end());
  return sets;
}

Material read_material(const Context& context, const YamlNode& node, const std::string& prefix) {
  const MapReader map(context, node, "material", prefix);
  Material material;
  material.name = node.key;
  material.youngs_modulus = map.number("E");
  material.poisson_ratio = map.number("nu");
  material.density = map.number("density");
  material.where = context.entry;
  return material;
}

Section read_section(const Context& context, const YamlNode& node, const Units& units, const std::string& prefix) {
  const YamlNode* shape = find_child(node, "shape");
  Section section =
      shape != nullptr ? read_shape(context, node, *shape, units, prefix) : read_constants(context, node, prefix);
  section.name = node.key;
  section.where = context.entry;
  return section;
}

std::vector<Material> read_materials(const MapReader& map) {
  std::vector<Material> materials;
  for (const YamlNode* node : map.entries("materials", "material"))
    materials.push_back(read_material(entry_context(map.context().reader, "material", *node), *node, ""));
  return materials;
}

std::vector<Section> read_sections(const MapReader& map, const Units& units) {
  std::vector<Section> sections;
  for (const YamlNode* node : map.entries("sections", "section"))
    sections.push_back(read_section(entry_context(map.context().reader, "section", *node), *node, units, ""));
  return sections;
}

void check_material(const Material& material, const std::string& subject, const std::string& prefix, Faults& faults) {
  const auto positive = [&](const char* key, double value) {
    if (!(value > 0.0) || !std::isfinite(value))
      faults.add(material.where, prefix + key, fmt::format("{}: {} {:g} must be positive", subject, key, value), "");
  };
  positive("E", material.youngs_modulus);
  positive("density", material.density);
  const double nu = material.poisson_ratio;
  if (!(nu > -1.0 && nu < 0.5))
    faults.add(material.where, prefix + "nu", fmt::format("{}: nu {:g} must lie between -1 and 0.5", subject, nu), "");
}

void check_section(const Section& section, const std::string& subject, const std::string& prefix, Faults& faults) {
  const auto positive = [&](const char* key, double value) {
    if (!(value > 0.0) || !std::isfinite(value))
      faults.add(section.where, prefix + key, fmt::format("{}: {} {:g} must be positive", subject, key, value), "");
  };
  const auto positive_or_zero = [&](const char* key, double value) {
    if (!(value >= 0.0) || !std::isfinite(value))
      faults.add(section.where, prefix + key, fmt::format("{}: {} {:g} must be positive or 0", subject, key, value),
                 "");
  };
  positive("A", section.area);
  if (section.shape == "rod") {
    positive_or_zero("J", section.torsion_constant);
    return;
  }
  positive("Iy", section.second_moment_y);
  positive("Iz", section.second_moment_z);
  positive("J", section.torsion_constant);
  const double Iyz = section.second_moment_yz, product = section.second_moment_y * section.second_moment_z;
  if (!(Iyz * Iyz < product) && product > 0.0)
    faults.add(section.where, prefix + "Iyz",
               fmt::format("{}: Iyz {:g} is not less than sqrt(Iy Iz) {:g}", subject, Iyz, std::sqrt(product)), "");
  for (const double value : {section.centroid_y, section.centroid_z, section.shear_center_y, section.shear_center_z})
    if (!std::isfinite(value))
      faults.add(section.where, "", fmt::format("{}: centroid or shear centre is not finite", subject), "");
  positive_or_zero("shear_area_y", section.shear_area_y);
  positive_or_zero("shear_area_z", section.shear_area_z);
  if ((section.shear_area_y == 0.0) != (section.shear_area_z == 0.0))
    faults.add(section.where, prefix + (section.shear_area_y == 0.0 ? "shear_area_y" : "shear_area_z"),
               fmt::format("{}: only one of the two shear areas is given", subject),
               "give both, or neither for beams without shear deformation");
  const double polar = section.second_moment_y + section.second_moment_z;
  if (polar > 0.0 && std::abs(section.polar_moment - polar) > 1e-9 * polar)
    faults.add(section.where, "",
               fmt::format("{}: polar moment {:g} is not Iy + Iz = {:g}", subject, section.polar_moment, polar), "");
}

}  // namespace tisserand::formats
