// Sections by constants, materials, and the checks of both.
#include "formats/sections/reader.hpp"

#include <cmath>

#include "formats/sections/shape_reader.hpp"
#include "formats/yaml/fields.hpp"

namespace tisserand::formats {

namespace {

Section read_constants(const Context& context, const YamlNode& node, const std::string& prefix) {
  const MapReader map(context, node, "section_constants", prefix);
  Section section;
  read_fields(map, section);
  section.polar_moment = section.second_moment_y + section.second_moment_z;
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

std::vector<NamedType> section_types() {
  static const std::string either = [] {
    std::string text = "section_constants";
    for (const KeySet& set : shape_key_sets())
      if (set.noun != "section_wall") text += fmt::format(" | {}", set.noun);
    return text;
  }();
  return {{"section_point", "[number]2"}, {"section_ring", "[section_point]2.."}, {"section", either}};
}

std::vector<KeySet> section_key_sets() {
  std::vector<KeySet> sets{
      {"material",
       {plain<&Material::youngs_modulus>("E", "positive", "Young's modulus [mass/(length time²)]", "required"),
        plain<&Material::poisson_ratio>("nu", "number>-1<0.5",
                                        "Poisson's ratio, between -1 and 0.5; G = E / (2 (1 + nu))", "required"),
        plain<&Material::density>("density", "positive", "[mass/length³]", "required")}},
      {"section_constants",
       {plain<&Section::area>("A", "positive", "area [length²]", "required"),
        plain<&Section::second_moment_y>("Iy", "positive",
                                         "∫ z² dA about the centroid: bending in the x-z plane [length⁴]", "required"),
        plain<&Section::second_moment_z>("Iz", "positive",
                                         "∫ y² dA about the centroid: bending in the x-y plane [length⁴]", "required"),
        plain<&Section::second_moment_yz>("Iyz", "number",
                                          "∫ y z dA about the centroid: 0 in principal axes [length⁴]"),
        plain<&Section::torsion_constant>("J", "positive", "torsion constant [length⁴]", "required"),
        plain<&Section::shear_area_y>("shear_area_y", "not_negative",
                                      "shear areas for shear forces along y and z [length²]; both or none. Without "
                                      "them only `theory: euler_bernoulli` is possible",
                                      "none"),
        plain<&Section::shear_area_z>("shear_area_z", "not_negative", ditto),
        {"centroid", "section_point",
         "[y, z] of the centroid from the axis of the beam, the line through its points [length]", "[0, 0]"},
        {"shear_center", "section_point",
         "[y, z] of the shear centre from the centroid: forces beside it twist the beam [length]", "[0, 0]"}}}};
  const std::vector<KeySet> shapes = shape_key_sets();
  sets.insert(sets.end(), shapes.begin(), shapes.end());
  return sets;
}

Material read_material(const Context& context, const YamlNode& node, const std::string& prefix) {
  const MapReader map(context, node, "material", prefix);
  Material material;
  material.name = node.key;
  read_fields(map, material);
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
