// Sections by constants or by shape, and materials.
#include "formats/section_reader.hpp"

#include <cmath>
#include <optional>

#include "formats/section_shapes.hpp"

namespace tisserand::formats {

namespace {

const std::vector<std::string> shapes{"circle", "hollow_circle", "rectangle", "hollow_rectangle"};

std::string with_unit(double value, const Units& units) {
  const std::string label = unit_label(units, 1, 0, 0);
  return label.empty() ? fmt::format("{:g}", value) : fmt::format("{:g} {}", value, label);
}

/// A size of a shape; nothing after an error.
std::optional<double> size(const MapReader& map, std::string_view key, const Units& units) {
  const double value = map.number(key);
  if (std::isnan(value)) return std::nullopt;
  if (value > 0.0) return value;
  map.context().fail(map.find(key)->place, fmt::format("{} {} must be positive", key, with_unit(value, units)), "");
  return std::nullopt;
}

Section read_circle(const MapReader& map, const Units& units) {
  const auto radius = size(map, "radius", units);
  return radius ? circle_section(*radius) : Section{};
}

Section read_hollow_circle(const MapReader& map, const Units& units) {
  const auto radius = size(map, "radius", units), thickness = size(map, "thickness", units);
  if (!radius || !thickness) return {};
  if (*thickness < *radius) return hollow_circle_section(*radius, *thickness);
  map.context().fail(map.find("thickness")->place,
                     fmt::format("thickness {} {} radius {}", with_unit(*thickness, units),
                                 *thickness > *radius ? "exceeds" : "equals", with_unit(*radius, units)),
                     "use a solid section or reduce thickness");
  return {};
}

Section read_rectangle(const MapReader& map, const Units& units) {
  const auto width = size(map, "width", units), height = size(map, "height", units);
  return width && height ? rectangle_section(*width, *height) : Section{};
}

Section read_hollow_rectangle(const MapReader& map, const Units& units) {
  const auto width = size(map, "width", units), height = size(map, "height", units);
  const auto thickness = size(map, "thickness", units);
  if (!width || !height || !thickness) return {};
  const double half = 0.5 * std::min(*width, *height);
  if (*thickness < half) return hollow_rectangle_section(*width, *height, *thickness);
  map.context().fail(map.find("thickness")->place,
                     fmt::format("thickness {} {} half of the {} {}", with_unit(*thickness, units),
                                 *thickness > half ? "exceeds" : "equals", *width <= *height ? "width" : "height",
                                 with_unit(2.0 * half, units)),
                     "use a solid section or reduce thickness");
  return {};
}

Section read_shape(const Context& context, const YamlNode& node, const YamlNode& shape, const Units& units,
                   const std::string& prefix) {
  const auto index = read_word(context, shape, "shape", shapes);
  if (!index) return {};
  const MapReader map(context, node, "section_" + shapes[*index], prefix);
  switch (*index) {
    case 0:
      return read_circle(map, units);
    case 1:
      return read_hollow_circle(map, units);
    case 2:
      return read_rectangle(map, units);
    default:
      return read_hollow_rectangle(map, units);
  }
}

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
  return section;
}

}  // namespace

std::vector<KeySet> section_key_sets() {
  return {{"material", {"E", "nu", "density"}},
          {"section_constants", {"A", "Iy", "Iz", "J", "shear_area_y", "shear_area_z"}},
          {"section_circle", {"shape", "radius"}},
          {"section_hollow_circle", {"shape", "radius", "thickness"}},
          {"section_rectangle", {"shape", "width", "height"}},
          {"section_hollow_rectangle", {"shape", "width", "height", "thickness"}}};
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
  positive("Iy", section.second_moment_y);
  positive("Iz", section.second_moment_z);
  positive("J", section.torsion_constant);
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
