// SPDX-License-Identifier: GPL-3.0-or-later
// Sections of shells, solids and trusses; point masses, rotary inertia and springs.
#include "reducer/decks/abaqus/sections.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "reducer/decks/abaqus/materials.hpp"
#include "reducer/decks/abaqus/sets.hpp"

namespace tisserand::reducer::abaqus {
namespace {

using Kind = AbaqusMaterial::Kind;

Error not_positive(const std::string& what, double value, const std::string& where) {
  return Error(fmt::format("{} = {:.6g}", what, value), where, "give a value > 0");
}

/// Adds faults for parameters that change the meaning of a section and are not supported.
bool refuse_parameters(Model& model, const Block& block, std::initializer_list<const char*> names) {
  bool found = false;
  for (const char* name : names)
    if (block.find(name) != nullptr) {
      model.fault(fmt::format("{}: parameter {} is not understood", block.title, name), block,
                  "give constant values for each set");
      found = true;
    }
  return found;
}

/// Distance of the middle surface from the nodes along the normal. OFFSET is the fraction of the thickness from the
/// middle surface to the reference surface with the nodes; SPOS = +1/2, SNEG = −1/2 (CalculiX manual, *SHELL SECTION:
/// with OFFSET=0.5 the reference surface is the top surface of the shell).
std::optional<double> shell_offset(Model& model, const Block& block, double thickness) {
  const std::string* text = block.find("OFFSET");
  if (text == nullptr) return 0.0;
  const std::string word = upper_without_blanks(*text);
  if (word == "SPOS") return -0.5 * thickness;
  if (word == "SNEG") return 0.5 * thickness;
  const std::optional<double> fraction = to_number(word);
  if (fraction) return -*fraction * thickness;
  return model.refuse(fmt::format("*SHELL SECTION: OFFSET={} is not understood", *text), block,
                      "write SPOS, SNEG or a number");
}

/// Reads the material x axis of the shell: the axis of *ORIENTATION that cyclically follows the one near the normal.
bool read_shell_direction(Model& model, int scope, const Block& block, SectionUse& use) {
  const std::string* name = block.find("ORIENTATION");
  if (name == nullptr) return true;
  const Orientation* orientation = find_orientation(model, scope, *name, model.where(block));
  if (orientation == nullptr) return false;
  if (use.has_direction) use.direction = projection_of(*orientation, *name).x;
  return true;
}

std::optional<ShellSection> read_composite(Model& model, int scope, const Block& block, SectionUse& use) {
  const std::optional<Layers> layers = read_layers(model, scope, block);
  if (!layers) return std::nullopt;
  double thickness = 0.0;
  for (const Ply& ply : layers->plies) thickness += ply.thickness;
  use.direction = layers->x;
  return laminate(layers->plies, -0.5 * thickness);
}

std::optional<ShellSection> read_sheet(Model& model, const Block& block, bool& has_direction) {
  const AbaqusMaterial* material = find_material(model, block);
  const std::optional<double> thickness = number_at(model, block, 0, 0, "thickness");
  if (material == nullptr || !thickness) return std::nullopt;
  if (!(*thickness > 0.0)) throw not_positive("*SHELL SECTION: thickness", *thickness, model.where(block));
  has_direction = material->kind != Kind::isotropic;
  if (!has_direction) return isotropic_shell(material->E, material->nu, material->density, *thickness, 5.0 / 6.0);
  Ply ply = ply_of(*material);
  ply.thickness = *thickness;
  check_plies({ply}, model.where(block));
  return laminate({ply}, -0.5 * *thickness);
}

/// Reads K11, K22, K12 of *TRANSVERSE SHEAR STIFFNESS after the section.
void read_shear(Model& model, const Block& block, ShellSection& section) {
  std::array<double, 3> k{};
  if (block.data.empty() || !read_numbers(model, block, block.data[0], k)) return;
  if (!(k[0] > 0.0 && k[1] > 0.0 && k[0] * k[1] > k[2] * k[2]))
    return model.fault(
        fmt::format("{}: K11 = {}, K22 = {}, K12 = {} are not positive definite", block.title, k[0], k[1], k[2]), block,
        "give K11, K22 > 0 and K12² < K11 K22");
  section.As << k[0], k[2], k[2], k[1];
}

void read_shell_section(Model& model, int scope, std::size_t index) {
  const std::vector<const Block*>& blocks = model.scopes[scope].blocks;
  const Block& block = *blocks[index];
  if (refuse_parameters(model, block, {"NODALTHICKNESS", "SHELLTHICKNESS", "STACKDIRECTION", "SYMMETRIC"})) return;
  SectionUse use;
  use.kind = ElementKind::shell;
  use.has_direction = block.find("COMPOSITE") != nullptr;
  std::optional<ShellSection> section =
      use.has_direction ? read_composite(model, scope, block, use) : read_sheet(model, block, use.has_direction);
  if (!section) return;
  if (index + 1 < blocks.size() && blocks[index + 1]->keyword == "TRANSVERSESHEARSTIFFNESS") {
    read_shear(model, *blocks[index + 1], *section);
    use.has_direction = use.has_direction || section->As(0, 0) != section->As(1, 1) || section->As(0, 1) != 0.0;
  }
  const std::optional<double> offset = shell_offset(model, block, section->thickness);
  if (!offset || !read_shell_direction(model, scope, block, use)) return;
  use.offset = *offset;
  use.property =
      add_row(model.deck.mesh.shell_properties, {*section, formats::MassMatrix::consistent, block.name_of("ELSET")});
  give_section(model, scope, block, use);
}

/// Whether the set of a section has elements of this kind.
bool holds(const Model& model, const std::vector<int>& elements, ElementKind kind) {
  return std::any_of(elements.begin(), elements.end(), [&](int row) { return model.elements[row].type->kind == kind; });
}

void read_truss(Model& model, int scope, const Block& block, const AbaqusMaterial& material) {
  const std::optional<double> area = number_at(model, block, 0, 0, "area of the trusses");
  if (!area) return;
  if (!(*area > 0.0)) throw not_positive("*SOLID SECTION: area of the trusses", *area, model.where(block));
  if (material.kind != Kind::isotropic)
    throw Error("trusses need an isotropic material", model.where(block), "use *ELASTIC, TYPE=ISOTROPIC");
  BeamProperty property;
  property.name = block.name_of("ELSET");
  property.data.section.name = property.name;
  property.data.section.area = *area;
  property.data.material = {material.name, material.E, material.nu, material.density, material.where};
  property.data.theory = formats::BeamTheory::euler_bernoulli;
  property.data.mass_matrix = formats::MassMatrix::lumped;
  SectionUse use;
  use.kind = ElementKind::truss;
  use.property = add_row(model.deck.mesh.beam_properties, std::move(property));
  give_section(model, scope, block, use);
}

void read_solid(Model& model, int scope, const Block& block, const AbaqusMaterial& material) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (const std::string* name = block.find("ORIENTATION"); name != nullptr) {
    const Orientation* orientation = find_orientation(model, scope, *name, model.where(block));
    if (orientation == nullptr) return;
    if (!orientation->is_rectangular && material.kind != Kind::isotropic)
      throw Error(fmt::format("orientation '{}' is not rectangular with DEFINITION=COORDINATES", *name),
                  orientation->where, "give rectangular axes for each set");
    axes = orientation->axes;
  } else if (material.kind != Kind::isotropic) {
    throw Error(
        fmt::format("*SOLID SECTION: material '{}' is not isotropic, but there is no ORIENTATION", material.name),
        model.where(block), "add ORIENTATION=...");
  }
  if (material.kind == Kind::lamina)
    throw Error(fmt::format("*SOLID SECTION: material '{}' is a LAMINA, which only shells can use", material.name),
                model.where(block), "use *ELASTIC, TYPE=ENGINEERING CONSTANTS");
  SectionUse use;
  use.kind = ElementKind::solid;
  use.property = add_row(model.deck.mesh.solid_properties,
                         {solid_of(material, axes), formats::MassMatrix::consistent, block.name_of("ELSET")});
  give_section(model, scope, block, use);
}

void read_solid_section(Model& model, int scope, const Block& block) {
  if (refuse_parameters(model, block, {"COMPOSITE", "STACKDIRECTION"})) return;
  const std::string where = model.where(block);
  const AbaqusMaterial* material = find_material(model, block);
  const auto elements = find_elements(model, scope, block.name_of("ELSET"), where);
  if (material == nullptr || !elements) return;
  if (holds(model, *elements, ElementKind::truss))
    read_truss(model, scope, block, *material);
  else
    read_solid(model, scope, block, *material);
}

void read_mass(Model& model, int scope, const Block& block) {
  const std::optional<double> mass = number_at(model, block, 0, 0, "mass");
  if (!mass) return;
  if (*mass < 0.0) throw Error(fmt::format("*MASS: {} < 0", *mass), model.where(block), "give a mass >= 0");
  SectionUse use;
  use.kind = ElementKind::mass;
  use.mass = *mass;
  give_section(model, scope, block, use);
}

/// Reads I11, I22, I33, I12, I13, I23. Products are entries of the tensor, I12 = −∫ x1 x2 dm. This is an assumption:
/// Abaqus' pages only name them "products of inertia".
void read_rotary_inertia(Model& model, int scope, const Block& block) {
  std::array<double, 6> v{};
  if (block.data.empty() || !read_numbers(model, block, block.data[0], v)) return;
  Eigen::Matrix3d inertia;
  inertia << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
  const Eigen::Vector3d principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvalues();
  if (!(principal.minCoeff() >= -1e-9 * principal.cwiseAbs().maxCoeff()))
    throw Error(fmt::format("*ROTARY INERTIA has the negative principal value {:.6g}", principal.minCoeff()),
                model.where(block), "check the six entries I11, I22, I33, I12, I13, I23");
  Eigen::Matrix3d axes = model.scopes[scope].placement.R;
  if (const std::string* name = block.find("ORIENTATION"); name != nullptr) {
    const Orientation* orientation = find_orientation(model, scope, *name, model.where(block));
    if (orientation == nullptr) return;
    if (!orientation->is_rectangular)
      throw Error(fmt::format("orientation '{}' is not rectangular", *name), orientation->where,
                  "give rectangular axes");
    axes = orientation->axes;
  }
  SectionUse use;
  use.kind = ElementKind::rotary_inertia;
  use.inertia = axes * inertia * axes.transpose();
  give_section(model, scope, block, use);
}

/// Reads SPRINGA: a line without meaning, then the stiffness. SPRING2: the two components, then the stiffness. Blank
/// lines do not count, so the first line of SPRINGA may be absent.
void read_spring(Model& model, int scope, const Block& block) {
  if (refuse_parameters(model, block, {"NONLINEAR", "COMPLEXSTIFFNESS", "DEPENDENCIES", "RTOL"})) return;
  const std::string where = model.where(block);
  const auto elements = find_elements(model, scope, block.name_of("ELSET"), where);
  if (!elements) return;
  SectionUse use;
  use.name = block.name_of("ELSET");
  use.kind = holds(model, *elements, ElementKind::two_node_spring) ? ElementKind::two_node_spring
             : holds(model, *elements, ElementKind::ground_spring) ? ElementKind::ground_spring
                                                                   : ElementKind::axial_spring;
  if (block.data.empty()) throw Error("*SPRING without stiffness", where, "give it in the last data line");
  const std::optional<double> stiffness = number_at(model, block, block.data.size() - 1, 0, "stiffness");
  if (!stiffness) return;
  if (*stiffness < 0.0) throw Error(fmt::format("*SPRING: stiffness {} < 0", *stiffness), where, "give a value >= 0");
  use.stiffness = *stiffness;
  if (use.kind == ElementKind::two_node_spring) {
    std::array<double, 2> dofs{};
    if (block.data.size() < 2 || !read_numbers(model, block, block.data[0], dofs)) return;
    for (std::size_t k = 0; k < 2; ++k) {
      if (dofs[k] < 1.0 || dofs[k] > 6.0 || dofs[k] != std::floor(dofs[k]))
        throw Error(fmt::format("*SPRING: degree of freedom {} does not exist", dofs[k]), where,
                    "write two numbers from 1 to 6");
      use.components[k] = static_cast<int>(dofs[k]) - 1;
    }
  }
  if (const std::string* name = block.find("ORIENTATION"); name != nullptr) {
    const Orientation* orientation = find_orientation(model, scope, *name, where);
    if (orientation == nullptr) return;
    if (!orientation->is_rectangular)
      throw Error(fmt::format("orientation '{}' is not rectangular", *name), orientation->where,
                  "give rectangular axes");
    use.axes = orientation->axes;
  }
  give_section(model, scope, block, use);
}

}  // namespace

std::optional<double> number_at(Model& model, const Block& block, std::size_t line, std::size_t field,
                                std::string_view meaning) {
  const std::vector<std::string_view> fields =
      line < block.data.size() ? split(block.data[line].text) : std::vector<std::string_view>();
  const std::optional<double> value = field < fields.size() ? to_number(fields[field]) : std::nullopt;
  if (!value)
    model.fault(fmt::format("{}: {} {}", block.title, meaning,
                            field < fields.size() ? fmt::format("'{}' is not a number", fields[field]) : "is missing"),
                line < block.data.size() ? model.where(block.data[line]) : model.where(block),
                "write a finite number in the data lines");
  return value;
}

void give_section(Model& model, int scope, const Block& block, const SectionUse& use) {
  const std::string where = model.where(block);
  const std::string set = block.name_of("ELSET");
  const auto elements = find_elements(model, scope, set, where);
  if (!elements) return;
  const int section = add_row(model.sections, use);
  model.sections.back().name = set;
  for (const int row : *elements) {
    RawElement& element = model.elements[row];
    if (element.type->kind != use.kind)
      model.fault(fmt::format("{}, ELSET={} does not fit {}", block.title, set, model.element_text(element)), where,
                  "name a set that holds only elements of this kind");
    else if (element.section >= 0 && element.section != section)
      model.fault(fmt::format("{} has two sections, of '{}' and of '{}'", model.element_text(element),
                              model.sections[element.section].name, set),
                  where, "give each element one section: the sets must not overlap");
    else
      element.section = section;
  }
}

void read_sections(Model& model, int scope) {
  const std::vector<const Block*>& blocks = model.scopes[scope].blocks;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Block& block = *blocks[i];
    try {
      if (block.keyword == "SHELLSECTION") read_shell_section(model, scope, i);
      if (block.keyword == "SOLIDSECTION") read_solid_section(model, scope, block);
      if (block.keyword == "BEAMSECTION" || block.keyword == "BEAMGENERALSECTION") read_beam_section(model, scope, i);
      if (block.keyword == "MASS") read_mass(model, scope, block);
      if (block.keyword == "ROTARYINERTIA") read_rotary_inertia(model, scope, block);
      if (block.keyword == "SPRING") read_spring(model, scope, block);
    } catch (const Error& error) {
      model.fault(error.message(), error.where().empty() ? model.where(block) : error.where(), error.remedy());
    }
  }
}

}  // namespace tisserand::reducer::abaqus
