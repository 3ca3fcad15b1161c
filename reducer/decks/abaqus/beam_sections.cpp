// SPDX-License-Identifier: GPL-3.0-or-later
// *BEAM SECTION and *BEAM GENERAL SECTION: shapes and constants of beams, and the keywords after them.
#include <array>

#include <fmt/format.h>

#include "formats/sections/profiles.hpp"
#include "formats/sections/shapes.hpp"
#include "reducer/decks/abaqus/materials.hpp"
#include "reducer/decks/abaqus/sections.hpp"

namespace tisserand::reducer::abaqus {
namespace {

using formats::Section;

/// All sizes of the first data line; throws Error unless there are `count` and each is finite and > 0.
std::vector<double> sizes_of(Model& model, const Block& block, std::size_t count) {
  if (block.data.empty())
    throw Error(fmt::format("{} without sizes", block.title), model.where(block), "give them in the data lines");
  const Line& line = block.data[0];
  std::vector<double> sizes;
  for (const std::string_view field : split(line.text)) {
    if (field.empty() && sizes.size() >= count) continue;
    const std::optional<double> size = to_number(field);
    if (!size || *size < 0.0)
      throw model.error(fmt::format("{}: size '{}'", block.title, field), line, "give finite sizes >= 0");
    sizes.push_back(*size);
  }
  if (sizes.size() < count)
    throw model.error(fmt::format("{}: {} of {} sizes are given", block.title, sizes.size(), count), line,
                      "give all sizes");
  for (std::size_t k = 0; k < count; ++k)
    if (!(sizes[k] > 0.0))
      throw model.error(fmt::format("{}: size {} is 0", block.title, k + 1), line, "give sizes > 0");
  return sizes;
}

/// Circle. One value: the radius of Abaqus. Two: the diameters along n1 and n2 of CalculiX.
Section circle(Model& model, const Block& block) {
  const std::vector<double> sizes = sizes_of(model, block, 1);
  if (sizes.size() == 1) return formats::circle_section(sizes[0]);
  if (sizes.size() == 2 && sizes[0] == sizes[1]) {
    model.deck.mesh.warnings.push_back(fmt::format(
        "{}: SECTION=CIRC with two sizes is read as CalculiX does, diameter {}", model.where(block.data[0]), sizes[0]));
    return formats::circle_section(0.5 * sizes[0]);
  }
  throw model.error("SECTION=CIRC with the sizes of an ellipse", block.data[0],
                    "give one radius (Abaqus) or two equal diameters (CalculiX), or use *BEAM GENERAL SECTION");
}

Section pipe(Model& model, const Block& block) {
  const std::vector<double> sizes = sizes_of(model, block, 2);
  if (sizes[1] > sizes[0])
    throw model.error(fmt::format("SECTION=PIPE: thickness {} exceeds radius {}", sizes[1], sizes[0]), block.data[0],
                      "give the outer radius, then the thickness");
  if (sizes[1] == sizes[0]) return formats::circle_section(sizes[0]);
  return formats::hollow_circle_section(sizes[0], sizes[1]);
}

/// Throws Error for sizes that do not make such a shape.
void check_profile(Model& model, const Block& block, const char* shape, const std::vector<double>& sizes) {
  if (const std::optional<std::string> what = formats::profile_fault(shape, sizes))
    throw model.error(fmt::format("{}: {}", block.title, *what), block.data[0], "correct the sizes of the section");
}

Section box(Model& model, const Block& block) {
  const std::vector<double> s = sizes_of(model, block, 6);
  if (s[2] != s[3] || s[2] != s[4] || s[2] != s[5])
    throw model.error("SECTION=BOX with walls of different thickness is not understood", block.data[0],
                      "give equal thicknesses, or use *BEAM GENERAL SECTION, SECTION=GENERAL");
  const std::vector<double> sizes = {s[1], s[0], s[2], s[3], s[4], s[5]};
  check_profile(model, block, "box", sizes);
  return formats::profile_section("box", sizes);
}

/// I section of l, h, b1, b2, t1, t2, t3: the node is at height l above the bottom of the lower flange; n2 points up.
Section i_section(Model& model, const Block& block) {
  if (block.data.empty() || split(block.data[0].text).size() < 7)
    throw Error("SECTION=I needs seven sizes", model.where(block), "give l, h, b1, b2, t1, t2, t3");
  std::array<double, 7> s{};
  if (!read_numbers(model, block, block.data[0], s)) return {};
  const std::vector<double> sizes = {s[1], s[3], s[6], s[5], s[2], s[4]};
  check_profile(model, block, "I", sizes);
  Section section = formats::profile_section("I", sizes);
  const formats::SectionPolygon polygon = formats::profile_polygon("I", sizes);
  double bottom = polygon.outer[0].y();
  for (const Eigen::Vector2d& corner : polygon.outer) bottom = std::min(bottom, corner.y());
  section.centroid_y = 0.0;
  section.centroid_z = formats::area_moments(polygon).centroid.y() - bottom - s[0];
  return section;
}

/// Section of A, I11, I12, I22, J; the warping constants after them are ignored. k = 1 as in Abaqus.
Section general(Model& model, const Block& block) {
  if (block.keyword != "BEAMGENERALSECTION")
    throw Error("*BEAM SECTION, SECTION=GENERAL is not understood", model.where(block),
                "use *BEAM GENERAL SECTION, SECTION=GENERAL");
  std::array<double, 7> c{};
  if (block.data.empty() || !read_numbers(model, block, block.data[0], c)) return {};
  const auto [A, I11, I12, I22, J, sectorial_moment, warping] = c;
  if (!(A > 0.0 && I11 > 0.0 && I22 > 0.0 && J > 0.0 && I11 * I22 > I12 * I12))
    throw model.error(fmt::format("A = {}, I11 = {}, I12 = {}, I22 = {}, J = {}", A, I11, I12, I22, J), block.data[0],
                      "give A, I11, I22, J > 0 and I12² < I11 I22");
  if (sectorial_moment != 0.0)
    throw model.error(fmt::format("sectorial moment {} is not understood", sectorial_moment), block.data[0],
                      "give the section constants about the shear centre and 0 as sectorial moment");
  Section section;
  section.area = section.shear_area_y = section.shear_area_z = A;
  section.second_moment_y = I11;
  section.second_moment_z = I22;
  section.second_moment_yz = I12;
  section.torsion_constant = J;
  section.polar_moment = I11 + I22;
  section.warping_constant = warping;
  return section;
}

Section section_of(Model& model, const Block& block) {
  const bool is_general = block.keyword == "BEAMGENERALSECTION";
  const std::string shape = block.word_of("SECTION", is_general ? "GENERAL" : "");
  if (shape == "RECT") {
    const std::vector<double> sizes = sizes_of(model, block, 2);
    return formats::rectangle_section(sizes[0], sizes[1]);
  }
  if (shape == "CIRC") return circle(model, block);
  if (shape == "PIPE") return pipe(model, block);
  if (shape == "BOX") return box(model, block);
  if (shape == "I") return i_section(model, block);
  if (shape == "GENERAL") return general(model, block);
  throw Error(fmt::format("{}, SECTION={} is not understood", block.title, shape), model.where(block),
              "use RECT, CIRC, PIPE, BOX or I, or *BEAM GENERAL SECTION, SECTION=GENERAL");
}

/// E and G of the third data line, DENSITY of the keyword line.
formats::Material general_material(Model& model, const Block& block) {
  const std::optional<double> E = number_at(model, block, 2, 0, "Young's modulus in the third data line");
  const std::optional<double> G = number_at(model, block, 2, 1, "shear modulus in the third data line");
  if (!E || !G) return {};
  if (!(*E > 0.0 && *G > 0.0)) throw model.error(fmt::format("E = {}, G = {}", *E, *G), block.data[2], "give E, G > 0");
  formats::Material material;
  material.youngs_modulus = *E;
  material.poisson_ratio = 0.5 * *E / *G - 1.0;  // makes E / (2 (1 + ν)) equal to G
  const std::string* density = block.find("DENSITY");
  const std::optional<double> value = density == nullptr ? 0.0 : to_number(*density);
  if (!value || *value < 0.0)
    throw Error(fmt::format("{}: DENSITY={}", block.title, *density), model.where(block), "give a density >= 0");
  material.density = *value;
  return material;
}

/// Reads *CENTROID, *SHEAR CENTER and *TRANSVERSE SHEAR STIFFNESS (K23, K13) after the section.
void read_following(Model& model, const Block& block, double shear_modulus, Section& section) {
  std::array<double, 3> v{};
  if (block.data.empty() || !read_numbers(model, block, block.data[0], v)) return;
  if (block.keyword == "CENTROID") {
    section.centroid_y = v[0];
    section.centroid_z = v[1];
  } else if (block.keyword == "SHEARCENTER") {
    section.shear_center_y = v[0];
    section.shear_center_z = v[1];
  } else {
    if (!(v[0] > 0.0 && v[1] > 0.0))
      throw model.error(fmt::format("K23 = {}, K13 = {}", v[0], v[1]), block.data[0], "give both > 0");
    section.shear_area_z = v[0] / shear_modulus;
    section.shear_area_y = v[1] / shear_modulus;
    section.shear_coupling = 0.0;
  }
}

bool belongs_to_section(const Block& block) {
  return block.keyword == "CENTROID" || block.keyword == "SHEARCENTER" || block.keyword == "TRANSVERSESHEARSTIFFNESS";
}

/// Reads them. A section by constants without *SHEAR CENTER has it in the node, as in Abaqus; shapes compute it.
void read_all_following(Model& model, const std::vector<const Block*>& blocks, std::size_t index,
                        BeamElementData& beam) {
  const std::string* shape = blocks[index]->find("SECTION");
  const bool is_general = shape == nullptr || upper_without_blanks(*shape) == "GENERAL";
  for (std::size_t k = index + 1; k < blocks.size() && belongs_to_section(*blocks[k]); ++k) {
    const Block& block = *blocks[k];
    if (!is_general && block.keyword != "TRANSVERSESHEARSTIFFNESS")
      throw Error(fmt::format("{} after SECTION={}", block.title, *shape), model.where(block),
                  "use it with SECTION=GENERAL only");
    read_following(model, block, beam.material.shear_modulus(), beam.section);
  }
  if (!is_general) return;
  beam.section.shear_center_y -= beam.section.centroid_y;
  beam.section.shear_center_z -= beam.section.centroid_z;
}

}  // namespace

void read_beam_section(Model& model, int scope, std::size_t index) {
  const Scope& owner = model.scopes[scope];
  const Block& block = *owner.blocks[index];
  const std::string where = model.where(block);
  for (const char* name : {"OFFSET1", "OFFSET2"})
    if (const std::string* value = block.find(name); value != nullptr && to_number(*value) != 0.0)
      throw Error(fmt::format("{}: {}={} is not understood", block.title, name, *value), where,
                  "move the nodes, or use *BEAM GENERAL SECTION with *CENTROID");
  BeamProperty property;
  property.name = block.name_of("ELSET");
  property.data.section = section_of(model, block);
  if (block.keyword == "BEAMGENERALSECTION") {
    property.data.material = general_material(model, block);
  } else {
    const AbaqusMaterial* material = find_material(model, block);
    if (material == nullptr) return;
    if (material->kind != AbaqusMaterial::Kind::isotropic)
      throw Error(fmt::format("{}: material '{}' is not isotropic", block.title, material->name), where,
                  "use *ELASTIC, TYPE=ISOTROPIC for beams");
    property.data.material = {material->name, material->E, material->nu, material->density, material->where};
  }
  if (!(property.data.section.area > 0.0) || !(property.data.material.youngs_modulus > 0.0)) return;
  Section& section = property.data.section;
  section.name = property.name;
  read_all_following(model, owner.blocks, index, property.data);
  SectionUse use;
  use.kind = ElementKind::beam;
  std::array<double, 3> n1{0.0, 0.0, -1.0};
  if (block.data.size() > 1 && !split(block.data[1].text).empty()) {
    n1 = {0.0, 0.0, 0.0};
    if (!read_numbers(model, block, block.data[1], n1)) return;
  }
  use.direction = owner.placement.R * Eigen::Vector3d(n1[0], n1[1], n1[2]);
  if (!(use.direction.norm() > 0.0)) throw model.error("n1 is zero", block.data[1], "give a vector that is not zero");
  use.property = add_row(model.deck.mesh.beam_properties, std::move(property));
  give_section(model, scope, block, use);
}

}  // namespace tisserand::reducer::abaqus
