// SPDX-License-Identifier: GPL-3.0-or-later
// Elements of the mesh, one function for each kind.
#include "reducer/decks/abaqus/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "reducer/decks/abaqus/surfaces.hpp"
#include "reducer/elements/beam/beam.hpp"
#include "reducer/elements/spring.hpp"

namespace tisserand::reducer::abaqus {
namespace {

/// Number for messages, 0 for ids beyond int.
int short_id(long id) { return id <= std::numeric_limits<int>::max() ? static_cast<int>(id) : 0; }

const Eigen::Vector3d& position(const Model& model, int node) { return model.positions[node]; }

/// Material x axis without *ORIENTATION: projection of the global x axis, or of z if x is within 0.1° of the normal
/// (Abaqus, "Conventions").
Eigen::Vector3d default_direction(const Model& model, const ShellElement& shell) {
  const Eigen::Vector3d normal = normal_of(model.deck.mesh, shell);
  const double cosine = std::abs(normal.x()) / std::max(normal.norm(), std::numeric_limits<double>::min());
  return cosine > std::cos(0.1 * M_PI / 180.0) ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
}

/// Nodes of a shell; four nodes with two equal neighbours are a triangle.
std::array<int, 4> shell_nodes(const int* nodes, int count) {
  std::array<int, 4> result{nodes[0], nodes[1], nodes[2], count == 4 ? nodes[3] : -1};
  if (count == 3) return result;
  for (std::size_t k = 0; k < 4; ++k)
    if (nodes[k] == nodes[(k + 1) % 4]) return {nodes[(k + 1) % 4], nodes[(k + 2) % 4], nodes[(k + 3) % 4], -1};
  return result;
}

int add_shell(Model& model, const RawElement& element, const SectionUse& use) {
  ShellElement shell;
  shell.nodes = shell_nodes(model.nodes_of(element), element.count);
  shell.property = use.property;
  shell.offset = use.offset;
  shell.id = short_id(element.id);
  if (use.has_direction) shell.material_x = use.direction.isZero(0.0) ? default_direction(model, shell) : use.direction;
  return add_row(model.deck.mesh.shells, shell);
}

/// Row of the beam property; one section may be used by B31 and B33.
int beam_property(Model& model, const RawElement& element, SectionUse& use) {
  if (element.type->kind == ElementKind::truss || element.type->theory == formats::BeamTheory::timoshenko)
    return use.property;
  if (use.slender_property < 0) {
    BeamProperty slender = model.deck.mesh.beam_properties[use.property];
    slender.data.theory = formats::BeamTheory::euler_bernoulli;
    use.slender_property = add_row(model.deck.mesh.beam_properties, std::move(slender));
  }
  return use.slender_property;
}

int add_beam(Model& model, const RawElement& element, SectionUse& use) {
  const int* nodes = model.nodes_of(element);
  BeamElement beam;
  beam.first = nodes[0];
  beam.second = nodes[1];
  beam.property = beam_property(model, element, use);
  beam.id = short_id(element.id);
  const Eigen::Vector3d axis = position(model, nodes[1]) - position(model, nodes[0]);
  Eigen::Vector3d n1 = use.direction;
  if (element.count == 3) n1 = position(model, nodes[2]) - position(model, nodes[0]);
  if (element.type->kind == ElementKind::truss)
    n1 = std::abs(axis.x()) < 0.9 * axis.norm() ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const std::optional<Eigen::Matrix3d> axes = axis.norm() > 0.0 && n1.norm() > 0.0 ? beam_axes(axis, n1) : std::nullopt;
  if (!axes) {
    model.fault(
        fmt::format("{}: {}", model.element_text(element),
                    axis.norm() > 0.0 ? fmt::format("n1 = ({}, {}, {}) is parallel to the beam", n1.x(), n1.y(), n1.z())
                                      : std::string("its nodes coincide")),
        element,
        axis.norm() > 0.0 ? "give another n1 in the second data line of the section"
                          : "delete the element or correct its nodes");
    return -1;
  }
  beam.R_PE = *axes;
  return add_row(model.deck.mesh.beams, beam);
}

int add_solid(Model& model, const RawElement& element, const SectionUse& use) {
  const int* nodes = model.nodes_of(element);
  SolidElement solid;
  solid.shape = element.type->shape;
  solid.property = use.property;
  solid.id = short_id(element.id);
  std::size_t k = 0;
  for (const int place : gmsh_order(solid.shape)) solid.nodes[k++] = nodes[place];
  return add_row(model.deck.mesh.solids, solid);
}

Eigen::Matrix3d component_axes(const Model& model, const SectionUse& use, int node) {
  if (use.axes) return *use.axes;
  const auto found = model.node_axes.find(node);
  return found == model.node_axes.end() ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : found->second;
}

int add_spring(Model& model, const RawElement& element, const SectionUse& use) {
  const int* nodes = model.nodes_of(element);
  const Eigen::Vector3d reach = position(model, nodes[1]) - position(model, nodes[0]);
  Spring spring;
  spring.first = nodes[0];
  spring.second = nodes[1];
  spring.name = use.name;
  if (element.type->kind == ElementKind::axial_spring) {
    const auto stiffness = reducer::axial_spring(use.stiffness, reach);
    if (!stiffness)
      model.fault(fmt::format("{}: its nodes coincide", model.element_text(element)), element,
                  "use SPRING2, for which you give the direction");
    spring.stiffness = stiffness.value_or(Eigen::Matrix<double, 12, 12>::Zero());
  } else {
    if (!use.axes)
      for (const int node : {nodes[0], nodes[1]})
        if (!has_directions(model, node, model.where(element))) return -1;
    spring.stiffness = scalar_spring(use.stiffness, {use.components[0], component_axes(model, use, nodes[0])},
                                     {use.components[1], component_axes(model, use, nodes[1])});
    const double defect = rigid_motion_defect(spring.stiffness, reach);
    if (use.stiffness > 0.0 && defect > 1e-9)
      model.fault(fmt::format("{} resists rigid-body motion of the part, like a support (its nodes are {:.6g} "
                              "apart, degrees of freedom {} and {})",
                              model.element_text(element), reach.norm(), use.components[0] + 1, use.components[1] + 1),
                  element, "place both nodes at the same point, or use SPRINGA");
  }
  return add_row(model.deck.mesh.springs, spring);
}

void add_point(Model& model, const RawElement& element, const SectionUse& use) {
  NodalMass mass;
  mass.node = model.nodes_of(element)[0];
  mass.mass = use.mass;
  mass.inertia = use.inertia;
  mass.name = use.name;
  model.deck.mesh.masses.push_back(mass);
}

/// Adds the element and returns its row in the vector of its kind, -1 for masses and faulty elements.
int add_element(Model& model, const RawElement& element, SectionUse& use) {
  switch (element.type->kind) {
    case ElementKind::shell:
      return add_shell(model, element, use);
    case ElementKind::beam:
    case ElementKind::truss:
      return add_beam(model, element, use);
    case ElementKind::solid:
      return add_solid(model, element, use);
    case ElementKind::axial_spring:
    case ElementKind::two_node_spring:
      return add_spring(model, element, use);
    case ElementKind::mass:
    case ElementKind::rotary_inertia:
      add_point(model, element, use);
      return -1;
    case ElementKind::ground_spring:
      model.fault(fmt::format("{} connects the part to the ground", model.element_text(element)), element,
                  "a superelement has no supports: define the support in the scene");
      return -1;
  }
  return -1;
}

void count_elements(const Model& model, std::array<std::size_t, 3>& count) {
  for (const RawElement& element : model.elements) {
    const ElementKind kind = element.type->kind;
    count[kind == ElementKind::shell ? 0 : kind == ElementKind::solid ? 1 : 2] += 1;
  }
}

/// Sets ids of the assembly, and those of instances that only one instance has.
void fill_ids(Model& model) {
  std::map<long, int>& ids = model.deck.node_of_id;
  std::vector<std::pair<long, int>> sorted;
  sorted.reserve(model.positions.size());
  for (int node = 0; node < std::ssize(model.positions); ++node) sorted.emplace_back(model.node_ids[node], node);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size();) {
    std::size_t end = i;
    while (end < sorted.size() && sorted[end].first == sorted[i].first) ++end;
    const auto of_assembly =
        std::find_if(sorted.begin() + static_cast<std::ptrdiff_t>(i), sorted.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](const auto& entry) { return model.node_scopes[entry.second] == 0; });
    if (of_assembly != sorted.begin() + static_cast<std::ptrdiff_t>(end))
      ids.emplace_hint(ids.end(), *of_assembly);
    else if (end == i + 1)
      ids.emplace_hint(ids.end(), sorted[i]);
    i = end;
  }
}

bool lacks_section(const RawElement& element) {
  return element.section < 0 && element.type->kind != ElementKind::ground_spring;
}

void add_missing_section(Model& model, const std::string& set, int count, const RawElement& first) {
  const std::string element = model.element_text(first);
  const std::string text =
      count == 1    ? fmt::format("{} has no section", element)
      : set.empty() ? fmt::format("{} elements in no set have no section, the first is {}", count, element)
                    : fmt::format("set '{}': {} elements have no section, the first is {}", set, count, element);
  model.fault(text, first,
              "name the set in *SHELL SECTION, *SOLID SECTION, *BEAM SECTION, *MASS, *ROTARY INERTIA or *SPRING");
}

/// Adds one fault per set; an element in several sets counts with the first by name.
void find_missing_sections(Model& model) {
  std::vector<bool> reported(model.elements.size(), false);
  const auto tell = [&](const std::string& set, const auto& rows) {
    int count = 0, first = -1;
    for (const int row : rows) {
      if (reported[row] || !lacks_section(model.elements[row])) continue;
      reported[row] = true;
      first = count++ == 0 ? row : std::min(first, row);
    }
    if (count > 0) add_missing_section(model, set, count, model.elements[first]);
  };
  for (const Scope& scope : model.scopes)
    for (const auto& [name, rows] : scope.element_sets) tell(name, rows);
  std::vector<int> all(model.elements.size());
  std::iota(all.begin(), all.end(), 0);
  tell("", all);
}

}  // namespace

void fill_nodes(Model& model) {
  Mesh& mesh = model.deck.mesh;
  mesh.position.resize(3, static_cast<Eigen::Index>(model.positions.size()));
  mesh.node_label.reserve(model.positions.size());
  for (int node = 0; node < std::ssize(model.positions); ++node) {
    mesh.position.col(node) = model.positions[node];
    mesh.node_label.push_back(model.node_text(node));
  }
  fill_ids(model);
}

void fill_elements(Model& model) {
  std::array<std::size_t, 3> count{};
  count_elements(model, count);
  model.deck.mesh.shells.reserve(count[0]);
  model.deck.mesh.solids.reserve(count[1]);
  model.deck.mesh.beams.reserve(count[2]);
  for (RawElement& element : model.elements) {
    if (element.section >= 0) {
      element.row = add_element(model, element, model.sections[element.section]);
    } else if (element.type->kind == ElementKind::ground_spring) {
      SectionUse none;
      element.row = add_element(model, element, none);
    }
  }
  find_missing_sections(model);
}

}  // namespace tisserand::reducer::abaqus
