// SPDX-License-Identifier: GPL-3.0-or-later
// Reads sections by constants and materials, and checks both.
#include "formats/sections/reader.hpp"

#include <cmath>

#include "formats/sections/shape_reader.hpp"
#include "formats/yaml/fields.hpp"

namespace tisserand::formats {
namespace {

/// Reads [y, z] of the key `key`. Without the key both are unchanged.
void read_pair(const MapReader& map, std::string_view key, double& y, double& z) {
  const YamlNode* entry = map.find(key);
  if (entry == nullptr) return;
  const std::vector<double> numbers = read_numbers(map.context(), *entry, std::string(key));
  if (numbers.size() == 2)
    y = numbers[0], z = numbers[1];
  else if (!numbers.empty())
    map.context().fail(entry->place, fmt::format("{} has {} numbers", key, numbers.size()), "give [y, z]");
}

Section read_constants(const Context& context, const YamlNode& node, const std::string& prefix) {
  const MapReader map(context, node, "section_constants", prefix);
  Section section;
  read_fields(map, section);
  section.polar_moment = section.second_moment_y + section.second_moment_z;
  read_pair(map, "centroid", section.centroid_y, section.centroid_z);
  read_pair(map, "shear_center", section.shear_center_y, section.shear_center_z);
  return section;
}

/// Reads a section by stiffness: EA, EI, ... replace A, I, ...; see struct Section.
Section read_by_stiffness(const Context& context, const YamlNode& node, const YamlNode& values,
                          const std::string& prefix) {
  const MapReader map(context, node, "section_by_stiffness", prefix);
  Section section;
  section.by_stiffness = true;
  read_fields(map, section);
  if (map.require("rotary_inertia") != nullptr)
    read_pair(map, "rotary_inertia", section.rotary_inertia_y, section.rotary_inertia_z);
  if (values.kind != YamlKind::map) {
    context.fail(values.place, "stiffness is not a map",
                 "write {EA: 1e7, GAy: 3e6, GAz: 3e6, EIy: 1e3, EIz: 1e3, GJ: 8e2}");
    return section;
  }
  read_fields(MapReader(context, values, "section_stiffness", prefix + "stiffness."), section);
  section.polar_moment = section.second_moment_y + section.second_moment_z;
  return section;
}

}  // namespace

std::vector<NamedType> section_types() {
  static const std::string either = [] {
    std::string text = "section_constants | section_by_stiffness";
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
         "[y, z] of the shear centre from the centroid: forces that do not act through it twist the beam [length]",
         "[0, 0]"}}}};
  sets.push_back(
      {"section_by_stiffness",
       {{"stiffness", "section_stiffness", "the map of the next table, instead of constants or a shape; no `material`",
         "required"},
        plain<&Section::mass_per_length>("mass_per_length", "positive", "[mass/length]", "required"),
        {"rotary_inertia", "section_point",
         "[about y, about z] per length, ∫ρ z² dA and ∫ρ y² dA; about x their sum [mass length]", "required"}}});
  sets.push_back(
      {"section_stiffness",
       {plain<&Section::area>("EA", "positive", "axial stiffness [force]", "required"),
        plain<&Section::second_moment_y>("EIy", "positive", "bending in the x-z plane [force length²]", "required"),
        plain<&Section::second_moment_z>("EIz", "positive", "bending in the x-y plane [force length²]", "required"),
        plain<&Section::torsion_constant>("GJ", "positive", "torsion [force length²]", "required"),
        plain<&Section::shear_area_y>("GAy", "not_negative",
                                      "for shear forces along y and z, shear factor included [force]; both or none. "
                                      "Without them only `theory: euler_bernoulli` is possible",
                                      "none"),
        plain<&Section::shear_area_z>("GAz", "not_negative", ditto)}});
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
  const YamlNode *shape = find_child(node, "shape"), *stiffness = find_child(node, "stiffness");
  Section section = shape != nullptr       ? read_shape(context, node, *shape, units, prefix)
                    : stiffness != nullptr ? read_by_stiffness(context, node, *stiffness, prefix)
                                           : read_constants(context, node, prefix);
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

void check_material(const Material& material, const Subject& subject) {
  subject.positive("E", material.youngs_modulus);
  subject.positive("density", material.density);
  const double nu = material.poisson_ratio;
  if (!(nu > -1.0 && nu < 0.5)) subject.add("nu", fmt::format("nu {:g} must lie between -1 and 0.5", nu));
}

void check_section(const Section& section, const Subject& subject) {
  const auto positive_or_zero = [&](const char* key, double value) {
    if (!(value >= 0.0) || !std::isfinite(value))
      subject.add(key, fmt::format("{} {:g} must be positive or 0", key, value));
  };
  if (section.by_stiffness) {
    subject.positive("mass_per_length", section.mass_per_length);
    const double y = section.rotary_inertia_y, z = section.rotary_inertia_z;
    if (!(y >= 0.0 && z >= 0.0 && y + z > 0.0) || !std::isfinite(y + z))
      subject.add("rotary_inertia", fmt::format("rotary_inertia [{:g}, {:g}] must be positive", y, z));
  }
  struct Words {
    const char *area, *Iy, *Iz, *J, *shear_y, *shear_z;
  };
  const Words words = section.by_stiffness ? Words{"stiffness.EA", "stiffness.EIy", "stiffness.EIz",
                                                   "stiffness.GJ", "stiffness.GAy", "stiffness.GAz"}
                                           : Words{"A", "Iy", "Iz", "J", "shear_area_y", "shear_area_z"};
  subject.positive(words.area, section.area);
  if (section.shape == "rod") {
    positive_or_zero("J", section.torsion_constant);
    return;
  }
  subject.positive(words.Iy, section.second_moment_y);
  subject.positive(words.Iz, section.second_moment_z);
  subject.positive(words.J, section.torsion_constant);
  const double Iyz = section.second_moment_yz, product = section.second_moment_y * section.second_moment_z;
  if (!(Iyz * Iyz < product) && product > 0.0)
    subject.add("Iyz", fmt::format("Iyz {:g} is not less than sqrt(Iy Iz) {:g}", Iyz, std::sqrt(product)));
  for (const double value : {section.centroid_y, section.centroid_z, section.shear_center_y, section.shear_center_z})
    if (!std::isfinite(value)) subject.add("", "centroid or shear centre is not finite");
  positive_or_zero(words.shear_y, section.shear_area_y);
  positive_or_zero(words.shear_z, section.shear_area_z);
  if ((section.shear_area_y == 0.0) != (section.shear_area_z == 0.0))
    subject.add((section.shear_area_y == 0.0 ? words.shear_y : words.shear_z),
                fmt::format("only one of {} is given", section.by_stiffness ? "GAy and GAz" : "the two shear areas"),
                "give both, or neither for beams without shear deformation");
  const double polar = section.second_moment_y + section.second_moment_z;
  if (polar > 0.0 && std::abs(section.polar_moment - polar) > 1e-9 * polar)
    subject.add("", fmt::format("polar moment {:g} is not Iy + Iz = {:g}", section.polar_moment, polar));
}

}  // namespace tisserand::formats
