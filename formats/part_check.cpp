// Findings of a part: names, references, signs, and geometry of lines.
#include "formats/part_check.hpp"

#include <algorithm>
#include <cmath>

#include "formats/line_check.hpp"
#include "formats/name_check.hpp"
#include "formats/section_reader.hpp"

namespace tisserand::formats {

namespace {

/// The names that references may use.
struct Names {
  std::vector<std::string> materials, sections, points;
};

const NamedPoint* find_point(const Part& part, const std::string& name) {
  const auto found = std::ranges::find(part.points, name, &NamedPoint::name);
  return found == part.points.end() ? nullptr : &*found;
}

Names check_definitions(const Part& part, Faults& faults) {
  Names names;
  for (const Material& material : part.materials) {
    check_name("material", material.name, material.where, names.materials, faults);
    check_material(material, fmt::format("material '{}'", material.name), "", faults);
  }
  for (const Section& section : part.sections) {
    check_name("section", section.name, section.where, names.sections, faults);
    check_section(section, fmt::format("section '{}'", section.name), "", faults);
  }
  for (const NamedPoint& point : part.points) {
    check_name("point", point.name, point.where, names.points, faults);
    if (!point.position.allFinite())
      faults.add(point.where, "", fmt::format("point '{}': position must be finite", point.name), "");
  }
  return names;
}

void check_beam(const Part& part, const BeamLine& beam, const Names& names, Faults& faults) {
  const std::string subject = fmt::format("beam '{}'", beam.name);
  check_reference(subject, "point", beam.from.name, names.points, beam.where, "from", faults);
  check_reference(subject, "point", beam.to.name, names.points, beam.where, "to", faults);
  check_reference(subject, "section", beam.section, names.sections, beam.where, "section", faults);
  check_reference(subject, "material", beam.material, names.materials, beam.where, "material", faults);
  if (beam.elements < 0)
    faults.add(beam.where, "elements", fmt::format("{}: elements {} must be 1 or more", subject, beam.elements), "");
  if (beam.elements == 0 && !(beam.size > 0.0 && std::isfinite(beam.size)))
    faults.add(beam.where, "size", fmt::format("{}: size {:g} must be positive", subject, beam.size), "");
  const auto section = std::ranges::find(part.sections, beam.section, &Section::name);
  if (beam.theory == BeamTheory::timoshenko && section != part.sections.end() && section->shear_area_y == 0.0 &&
      section->area > 0.0 && section->shear_area_z == 0.0)
    faults.add(beam.where, "section", fmt::format("{}: section '{}' has no shear areas", subject, section->name),
               "give shear_area_y and shear_area_z, or set theory: euler_bernoulli");
  const NamedPoint* from = find_point(part, beam.from.name);
  const NamedPoint* to = find_point(part, beam.to.name);
  if (from == nullptr || to == nullptr) return;
  check_line({subject, beam.where, from->position, to->position, beam.through, beam.orientation}, faults);
  if (beam.elements != 0 || !(beam.size > 0.0)) return;
  const double count = (to->position - from->position).norm() / beam.size;
  constexpr double most = 1e6;
  if (count > most)
    faults.add(beam.where, "size",
               fmt::format("{}: size {:g} makes {:.3g} elements; the limit is {:g}", subject, beam.size, count, most),
               "give a larger size");
}

void check_modes(const Part& part, Faults& faults) {
  const ModeSelection& modes = part.modes;
  if (modes.count < 0)
    faults.add(modes.where, "modes", fmt::format("modes {} must not be negative", modes.count),
               "modes: 0 gives Guyan reduction");
  if (modes.cutoff && !(*modes.cutoff > 0.0 && std::isfinite(*modes.cutoff)))
    faults.add(modes.where, "cutoff", fmt::format("cutoff {:g} must be positive", *modes.cutoff), "");
}

void check_boundary(const Part& part, const Names& names, Faults& faults) {
  if (part.boundary.empty())
    faults.add(part.file, "boundary", "the part has no boundary node",
               "list the points at which it is joined or loaded, boundary: [base, tip]");
  std::vector<std::string> seen;
  for (const BoundaryNode& node : part.boundary) {
    check_name("boundary node", node.name, node.where, seen, faults);
    check_reference(fmt::format("boundary node '{}'", node.name), "point", node.at.name, names.points, node.where, "",
                    faults);
    if (!node.translations && !node.rotations)
      faults.add(node.where, "", fmt::format("boundary node '{}': keeps neither translations nor rotations", node.name),
                 "");
  }
}

}  // namespace

Faults find_faults(const Part& part) {
  Faults faults;
  if (part.name.empty()) faults.add(part.file, "part", "the part has no name", "part: <name>");
  const Names names = check_definitions(part, faults);
  std::vector<std::string> beams, masses;
  if (part.beams.empty()) faults.add(part.file, "beams", "the part has no beams", "");
  for (const BeamLine& beam : part.beams) {
    check_name("beam", beam.name, beam.where, beams, faults);
    check_beam(part, beam, names, faults);
  }
  for (const PointMass& mass : part.point_masses) {
    const std::string subject = fmt::format("point mass '{}'", mass.name);
    check_name("point mass", mass.name, mass.where, masses, faults);
    check_reference(subject, "point", mass.at.name, names.points, mass.where, "at", faults);
    check_mass({subject, mass.where, mass.mass, mass.inertia}, MassSign::zero_allowed, faults);
  }
  check_boundary(part, names, faults);
  check_modes(part, faults);
  return faults;
}

void check(const Part& part) { find_faults(part).raise(); }

}  // namespace tisserand::formats
