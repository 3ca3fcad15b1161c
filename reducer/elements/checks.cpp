// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of the shapes of elements.
#include "reducer/elements/checks.hpp"

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer {
namespace {

constexpr std::size_t most_listed = 10;

std::string element_name(const Mesh& mesh, const BeamElement& beam) {
  return fmt::format("beam {} of '{}'", beam.id, mesh.beam_properties[beam.property].name);
}
std::string element_name(const Mesh& mesh, const ShellElement& shell) {
  return fmt::format("shell {} of '{}'", shell.id, mesh.shell_properties[shell.property].name);
}
std::string element_name(const Mesh& mesh, const SolidElement& solid) {
  return fmt::format("solid {} of '{}'", solid.id, mesh.solid_properties[solid.property].name);
}

/// First texts of a kind and the number of all.
struct Findings {
  std::vector<std::string> reported;
  std::size_t count = 0;

  void add(const std::string& element, const std::vector<std::string>& texts) {
    for (const std::string& text : texts)
      if (count++ < most_listed) reported.push_back(element + ": " + text);
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

/// Appends the indices of elements with errors, counted from `first`.
template <class Element>
void find_faulty(const Mesh& mesh, const std::vector<Element>& elements, int first, std::vector<int>& faulty) {
  for (int i = 0; i < std::ssize(elements); ++i) {
    ShapeFindings findings;
    check_shape(mesh, elements[i], findings);
    if (!findings.errors.empty()) faulty.push_back(first + i);
  }
}

}  // namespace

std::vector<int> faulty_elements(const Mesh& mesh) {
  const int beams = count_of(mesh.beams), shells = count_of(mesh.shells);
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
    throw Error(fmt::format("{} fault{} of element shapes: {}{}", report.errors.count,
                            report.errors.count == 1 ? "" : "s", join(report.errors.reported, "; "),
                            report.errors.count > report.errors.reported.size() ? "; ..." : ""),
                where, "repair these elements in the mesh, or in the program that made it");
  if (report.warnings.count > report.warnings.reported.size())
    report.warnings.reported.push_back(fmt::format("... and {} more element shapes of this kind",
                                                   report.warnings.count - report.warnings.reported.size()));
  return report.warnings.reported;
}

}  // namespace tisserand::reducer
