// SPDX-License-Identifier: GPL-3.0-or-later
// Plausibility checks. Limits lie far beyond usual designs, because a mistake of units is mostly a factor of 1000.
#include "reducer/elements/plausibility.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "common/text.hpp"
#include "formats/sections/substance.hpp"
#include "formats/yaml/line_check.hpp"
#include "reducer/elements/checks.hpp"

namespace tisserand::reducer {
namespace {

// The first three limits have no published source. No example and no variation of one by 30 % comes near them.
constexpr double most_offset = 20.0;       // thicknesses
constexpr double most_point_mass = 100.0;  // masses of all elements
constexpr double most_outside = 1.0;       // extents of the nodes
constexpr double most_mass = 1e6;          // [kg]: a bracket in millimetres taken for metres weighs 1e9 times too much

/// Warns, by property, of walls thicker than a fifth of their own extent: these are no shells, or numbers in other
/// units. Thicknesses larger than the edges of a fine mesh are harmless.
void warn_thick_shells(const Mesh& mesh, std::vector<std::string>& warnings) {
  std::vector<Eigen::AlignedBox3d> box(mesh.shell_properties.size());
  for (const ShellElement& shell : mesh.shells)
    for (const int n : nodes_of(shell)) box[shell.property].extend(mesh.position.col(n));
  for (std::size_t p = 0; p < box.size(); ++p) {
    const double thickness = mesh.shell_properties[p].section.thickness;
    if (box[p].isEmpty() || thickness <= 0.2 * box[p].diagonal().norm()) continue;
    warnings.push_back(
        fmt::format("the shells of '{}' are {:.4g} thick and extend over {:.4g}: check the thickness, or use solids",
                    mesh.shell_properties[p].name, thickness, box[p].diagonal().norm()));
  }
}

Eigen::AlignedBox3d box_of_elements(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  const auto add = [&](const auto& element) {
    for (const int n : nodes_of(element)) box.extend(mesh.position.col(n));
  };
  std::ranges::for_each(mesh.beams, add);
  std::ranges::for_each(mesh.shells, add);
  std::ranges::for_each(mesh.solids, add);
  return box;
}

/// Spiders with the same fault, the farthest first.
struct FarSpiders {
  double farthest = 0.0;
  std::vector<std::string> names;

  void add(const std::string& name, double distance) {
    names.insert(distance > farthest ? names.begin() : names.end(), name);
    farthest = std::max(farthest, distance);
  }
  std::string others() const {
    if (names.size() < 2) return "";
    constexpr std::size_t reported = 5;
    return fmt::format(
        " (and {}{} also lie{} far away)",
        join(std::vector<std::string>(names.begin() + 1, names.begin() + std::min(names.size(), reported)), ", "),
        names.size() > reported ? fmt::format(" and {} more", names.size() - reported) : "",
        names.size() == 2 ? "s" : "");
  }
};

/// Warns of spiders whose own node is far away, which may be a long arm or a position in other units. Away from the
/// part: by more than a fifth of its size and the extent of the held nodes. Away from three or more held nodes: by a
/// fifth of the part and twice their extent.
void warn_far_spiders(const Mesh& mesh, const Units& units, std::vector<std::string>& warnings) {
  const Eigen::AlignedBox3d part = box_of_elements(mesh);
  if (part.isEmpty()) return;
  const double size = part.diagonal().norm();
  FarSpiders beside_part, off_legs;
  for (const Spider& spider : mesh.spiders) {
    Eigen::AlignedBox3d legs;
    for (const int node : spider.nodes) legs.extend(mesh.position.col(node));
    const Eigen::Vector3d reference = mesh.position.col(spider.reference);
    const double extent = legs.diagonal().norm(), beside = part.exteriorDistance(reference),
                 off = legs.exteriorDistance(reference);
    if (beside > 0.2 * size && beside > extent)
      beside_part.add(spider.name, beside);
    else if (spider.nodes.size() > 2 && off > 0.2 * size && off > 2.0 * extent)
      off_legs.add(spider.name, off);
  }
  const std::string unit = after_number(unit_label(units, 1, 0, 0));
  constexpr const char* check = "check its position and the unit of its coordinates";
  if (!beside_part.names.empty())
    warnings.push_back(
        fmt::format("the node of spider '{}' lies {:.3g}{} away from the part, which is {:.3g}{} large{}: {}",
                    beside_part.names[0], beside_part.farthest, unit, size, unit, beside_part.others(), check));
  if (!off_legs.names.empty())
    warnings.push_back(fmt::format(
        "the node of spider '{}' lies {:.3g}{} away from the nodes that it holds; the part is {:.3g}{} large{}: {}",
        off_legs.names[0], off_legs.farthest, unit, size, unit, off_legs.others(), check));
}

/// Warns, once per property, of offsets of more than `most_offset` thicknesses: the elements are far from their nodes.
void warn_far_offsets(const Mesh& mesh, const Units& units, std::vector<std::string>& warnings) {
  const std::string unit = after_number(unit_label(units, 1, 0, 0));
  const auto tell = [&](const char* kind, const std::string& name, double offset, double thickness) {
    if (offset > most_offset * thickness && thickness > 0.0)
      warnings.push_back(fmt::format(
          "{} of '{}' lie {:.4g}{} away from their nodes, {:.3g} times their thickness: check the offset and its unit",
          kind, name, offset, unit, offset / thickness));
  };
  std::vector<double> of_shells(mesh.shell_properties.size(), 0.0), of_beams(mesh.beam_properties.size(), 0.0);
  for (const ShellElement& shell : mesh.shells)
    of_shells[shell.property] = std::max(of_shells[shell.property], std::abs(shell.offset));
  for (const BeamElement& beam : mesh.beams)
    of_beams[beam.property] = std::max({of_beams[beam.property], beam.first_offset.norm(), beam.second_offset.norm()});
  for (std::size_t p = 0; p < of_shells.size(); ++p)
    tell("the shells", mesh.shell_properties[p].name, of_shells[p], mesh.shell_properties[p].section.thickness);
  for (std::size_t p = 0; p < of_beams.size(); ++p) {
    const formats::Section& s = mesh.beam_properties[p].data.section;
    // thickness of a rectangle with the same larger radius of gyration
    tell("the beams", mesh.beam_properties[p].name, of_beams[p],
         s.area > 0.0 ? std::sqrt(12.0 * std::max(s.second_moment_y, s.second_moment_z) / s.area) : 0.0);
  }
}

/// Materials that have names, and those of elements that no named material explains.
std::vector<formats::Substance> substances(const Mesh& mesh, const std::vector<formats::Material>& materials) {
  std::vector<formats::Substance> all;
  for (const formats::Material& m : materials)
    all.push_back({fmt::format("material '{}'", m.name), m.youngs_modulus, m.density});
  const auto named = all.size();
  const auto add = [&](const formats::Substance& s) {
    for (std::size_t k = 0; k < named; ++k)
      if (std::abs(all[k].density - s.density) <= 1e-9 * s.density) return;
    all.push_back(s);
  };
  for (const BeamProperty& p : mesh.beam_properties)
    add({fmt::format("'{}'", p.name), p.data.material.youngs_modulus, p.data.material.density});
  for (const ShellProperty& p : mesh.shell_properties)
    if (p.section.thickness > 0.0)
      add({fmt::format("'{}'", p.name), p.section.A.topLeftCorner<2, 2>().diagonal().maxCoeff() / p.section.thickness,
           p.section.mass / p.section.thickness});
  for (const SolidProperty& p : mesh.solid_properties)
    add({fmt::format("'{}'", p.name), p.material.C.topLeftCorner<3, 3>().diagonal().maxCoeff(), p.material.density});
  return all;
}

}  // namespace

std::vector<std::string> plausibility_warnings(const Mesh& mesh, const Units& units,
                                               const std::vector<formats::Material>& materials) {
  std::vector<std::string> warnings;
  warn_thick_shells(mesh, warnings);
  warn_far_spiders(mesh, units, warnings);
  warn_far_offsets(mesh, units, warnings);
  for (const NodalMass& mass : mesh.masses)
    if (std::string doubt = formats::inertia_doubt(fmt::format("point mass '{}'", mass.name), mass.inertia);
        !doubt.empty())
      warnings.push_back(std::move(doubt));
  for (const formats::Material& m : materials)
    if (m.poisson_ratio < 0.0)
      warnings.push_back(
          fmt::format("material '{}': a Poisson's ratio of {:.4g} is unusual; common values are 0 to 0.5", m.name,
                      m.poisson_ratio));
  for (const std::string& doubt : stiff_spring_doubts(mesh)) warnings.push_back(doubt);
  if (!units.named()) return warnings;
  for (const formats::Substance& s : substances(mesh, materials)) {
    std::string text = formats::substance_doubt(s, units, "the part");
    if (!text.empty() && std::ranges::find(warnings, text) == warnings.end()) warnings.push_back(std::move(text));
  }
  const double size = 2.0 * characteristic_length(mesh) * units.length.factor;
  if (size > 200.0 || size < 1e-5)
    warnings.push_back(fmt::format("the part is about {:.3g} {} large, that is {:.3g} m: is {} the unit of its nodes?",
                                   2.0 * characteristic_length(mesh), units.length.label, size, units.length.label));
  return warnings;
}

std::vector<std::string> mass_warnings(const Mesh& mesh, const formats::RigidProperties& rigid, const Units& units) {
  std::vector<std::string> warnings;
  const std::string unit = after_number(unit_label(units, 0, 1, 0)), length = after_number(unit_label(units, 1, 0, 0));
  double of_elements = rigid.mass;
  for (const NodalMass& mass : mesh.masses) of_elements -= mass.mass;
  for (const NodalMass& mass : mesh.masses)
    if (of_elements > 1e-9 * rigid.mass && mass.mass > most_point_mass * of_elements)
      warnings.push_back(
          fmt::format("point mass '{}' of {:.4g}{} is {:.3g} times the mass of all elements, {:.4g}{}: check this mass "
                      "and the densities",
                      mass.name, mass.mass, unit, mass.mass / of_elements, of_elements, unit));
  Eigen::AlignedBox3d box;
  for (int node = 0; node < mesh.nodes(); ++node) box.extend(Eigen::Vector3d(mesh.position.col(node)));
  const double size = box.diagonal().norm(), outside = box.exteriorDistance(rigid.center_of_mass);
  if (outside > most_outside * size)
    warnings.push_back(
        fmt::format("the centre of mass of the part lies {:.4g}{} away from its nodes, which extend over {:.4g}{}: "
                    "check the offsets of point masses",
                    outside, length, size, length));
  if (units.named() && rigid.mass * units.mass.factor >= most_mass)
    warnings.push_back(
        fmt::format("the part has a mass of {:.3g}{}: is {} the unit of its nodes, and does the density fit this unit?",
                    rigid.mass, unit, units.length.label));
  return warnings;
}

}  // namespace tisserand::reducer
