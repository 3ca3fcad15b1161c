// Shapes of elements and plausibility of numbers.
#include "reducer/elements/checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/sections/substance.hpp"
#include "formats/yaml/line_check.hpp"
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer {
namespace {

constexpr std::size_t most_told = 10;

std::string element_name(const Mesh& mesh, const BeamElement& beam) {
  return fmt::format("beam {} of '{}'", beam.id, mesh.beam_properties[beam.property].name);
}
std::string element_name(const Mesh& mesh, const ShellElement& shell) {
  return fmt::format("shell {} of '{}'", shell.id, mesh.shell_properties[shell.property].name);
}
std::string element_name(const Mesh& mesh, const SolidElement& solid) {
  return fmt::format("solid {} of '{}'", solid.id, mesh.solid_properties[solid.property].name);
}

/// The first texts of a kind and how many there were.
struct Findings {
  std::vector<std::string> told;
  std::size_t count = 0;

  void add(const std::string& element, const std::vector<std::string>& texts) {
    for (const std::string& text : texts)
      if (count++ < most_told) told.push_back(element + ": " + text);
  }
};

struct ShapeReport {
  Findings errors, warnings;
};

template <class Element>
void check_all(const Mesh& mesh, const std::vector<Element>& elements, ShapeReport& report) {
  ShapeFindings findings;
  for (const Element& element : elements) {
    check_shape(mesh, element, findings);
    if (findings.errors.empty() && findings.warnings.empty()) continue;
    report.errors.add(element_name(mesh, element), findings.errors);
    report.warnings.add(element_name(mesh, element), findings.warnings);
    findings = {};
  }
}

/// Appends the places of elements with errors, counted from `first`.
template <class Element>
void find_faulty(const Mesh& mesh, const std::vector<Element>& elements, int first, std::vector<int>& faulty) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    ShapeFindings findings;
    check_shape(mesh, elements[i], findings);
    if (!findings.errors.empty()) faulty.push_back(first + static_cast<int>(i));
  }
}

/// Walls thicker than a fifth of their own extent, by property: no shells, or numbers in other units. A thickness
/// beyond the edges of a fine mesh alone harms nothing.
void warn_thick_shells(const Mesh& mesh, std::vector<std::string>& warnings) {
  std::vector<Eigen::AlignedBox3d> box(mesh.shell_properties.size());
  for (const ShellElement& shell : mesh.shells)
    for (int i = 0; i < shell.corners(); ++i) box[shell.property].extend(mesh.position.col(shell.nodes[i]));
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
  for (const BeamElement& beam : mesh.beams)
    box.extend(mesh.position.col(beam.first)), box.extend(mesh.position.col(beam.second));
  for (const ShellElement& shell : mesh.shells)
    for (int i = 0; i < shell.corners(); ++i) box.extend(mesh.position.col(shell.nodes[i]));
  for (const SolidElement& solid : mesh.solids)
    for (int i = 0; i < node_count(solid.shape); ++i) box.extend(mesh.position.col(solid.nodes[i]));
  return box;
}

/// Spiders whose own node lies beside the part by more than a fifth of its size and more than what they grab extends:
/// an arm that is meant to be long looks the same as a position in other units.
void warn_far_spiders(const Mesh& mesh, const Units& units, std::vector<std::string>& warnings) {
  const Eigen::AlignedBox3d part = box_of_elements(mesh);
  if (part.isEmpty()) return;
  const double size = part.diagonal().norm();
  double farthest = 0.0;
  std::vector<std::string> names;
  for (const Spider& spider : mesh.spiders) {
    Eigen::AlignedBox3d legs;
    for (const int node : spider.nodes) legs.extend(mesh.position.col(node));
    const double beside = part.exteriorDistance(Eigen::Vector3d(mesh.position.col(spider.reference)));
    if (!(beside > 0.2 * size && beside > legs.diagonal().norm())) continue;
    names.insert(beside > farthest ? names.begin() : names.end(), spider.name);
    farthest = std::max(farthest, beside);
  }
  if (names.empty()) return;
  const std::string unit = units.named() ? " " + units.length.label : "";
  constexpr std::size_t told = 5;
  std::string others;
  if (names.size() > 1)
    others = fmt::format(
        " (and {}{} also lie{} far beside it)",
        join(std::vector<std::string>(names.begin() + 1, names.begin() + std::min(names.size(), told)), ", "),
        names.size() > told ? fmt::format(" and {} more", names.size() - told) : "", names.size() == 2 ? "s" : "");
  warnings.push_back(
      fmt::format("the node of spider '{}' lies {:.3g}{} beside the part, which is {:.3g}{} large{}: check its "
                  "position and the unit of its coordinates",
                  names[0], farthest, unit, size, unit, others));
}

/// Those of the elements that no material with a name accounts for.
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

std::vector<int> faulty_elements(const Mesh& mesh) {
  const int beams = static_cast<int>(mesh.beams.size()), shells = static_cast<int>(mesh.shells.size());
  std::vector<int> faulty;
  find_faulty(mesh, mesh.beams, 0, faulty);
  find_faulty(mesh, mesh.shells, beams, faulty);
  find_faulty(mesh, mesh.solids, beams + shells, faulty);
  return faulty;
}

std::vector<std::string> check_shapes(const Mesh& mesh, const std::string& where) {
  ShapeReport report;
  check_all(mesh, mesh.beams, report);
  check_all(mesh, mesh.shells, report);
  check_all(mesh, mesh.solids, report);
  if (report.errors.count > 0)
    throw Error(
        fmt::format("{} fault{} of element shapes: {}{}", report.errors.count, report.errors.count == 1 ? "" : "s",
                    join(report.errors.told, "; "), report.errors.count > report.errors.told.size() ? "; ..." : ""),
        where, "repair these elements in the mesh or the program that made it");
  if (report.warnings.count > report.warnings.told.size())
    report.warnings.told.push_back(fmt::format("... and {} more element shapes of this kind",
                                               report.warnings.count - report.warnings.told.size()));
  return report.warnings.told;
}

std::vector<std::string> plausibility_warnings(const Mesh& mesh, const Units& units,
                                               const std::vector<formats::Material>& materials) {
  std::vector<std::string> warnings;
  warn_thick_shells(mesh, warnings);
  warn_far_spiders(mesh, units, warnings);
  for (const NodalMass& mass : mesh.masses)
    if (std::string doubt = formats::inertia_doubt(fmt::format("point mass '{}'", mass.name), mass.inertia);
        !doubt.empty())
      warnings.push_back(std::move(doubt));
  for (const formats::Material& m : materials)
    if (m.poisson_ratio < 0.0)
      warnings.push_back(fmt::format("material '{}': a Poisson's ratio of {:.4g} is unusual; common are 0 to 0.5",
                                     m.name, m.poisson_ratio));
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

std::optional<std::string> mass_doubt(double mass, const Units& units) {
  if (!units.named() || mass * units.mass.factor < 1e6) return std::nullopt;
  return fmt::format(
      "the part has a mass of {:.3g} {}: is {} the unit of its nodes, and does the density belong to it?", mass,
      units.mass.label, units.length.label);
}

}  // namespace tisserand::reducer
