// SPDX-License-Identifier: GPL-3.0-or-later
// Checks a part: names, references, signs, and geometry of lines.
#include "formats/part/check.hpp"

#include <algorithm>
#include <bit>
#include <optional>

#include "formats/sections/reader.hpp"
#include "formats/yaml/line_check.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

/// Position of a place. Empty for nodes of a mesh file, spiders and unknown names.
std::optional<Eigen::Vector3d> position_of(const Part& part, const Place& place) {
  if (place.kind == PlaceKind::position) return place.position;
  if (place.kind != PlaceKind::name) return std::nullopt;
  const auto found = std::ranges::find(part.points, place.name, &NamedPoint::name);
  if (found == part.points.end() || found->place) return std::nullopt;
  return found->position;
}

PartNames check_definitions(const Part& part, Faults& faults) {
  PartNames names;
  for (const Material& material : part.materials) {
    check_material(material, check_name("material", material, names.layers, faults));
    names.materials.push_back(material.name);
  }
  for (const OrthotropicMaterial& material : part.orthotropic) check_name("material", material, names.layers, faults);
  for (const Section& section : part.sections)
    check_section(section, check_name("section", section, names.sections, faults));
  for (const NamedPoint& point : part.points) {
    const Subject subject = check_name("point", point, names.places, faults);
    if (!point.position.allFinite()) subject.add("", "position must be finite");
  }
  for (const SpiderLine& spider : part.spiders) check_name("spider", spider, names.places, faults);
  for (const GroupDefinition& group : part.groups) check_name("group", group, names.groups, faults);
  for (const ShellPatch& patch : part.patches) {
    check_name("group", patch, names.groups, faults);
    for (const std::string& edge : edge_groups(patch)) names.groups.push_back(edge);
  }
  return names;
}

void check_section_of_beam(const Part& part, const BeamLine& beam, const Subject& subject) {
  const auto section = std::ranges::find(part.sections, beam.section, &Section::name);
  if (beam.theory == BeamTheory::timoshenko && section != part.sections.end() && section->shear_area_y == 0.0 &&
      section->area > 0.0 && section->shear_area_z == 0.0 && section->second_moment_y + section->second_moment_z > 0.0)
    subject.add("section", fmt::format("section '{}' has no shear areas", section->name),
                section->by_stiffness ? "give GAy and GAz, or set theory: euler_bernoulli"
                                      : "give shear_area_y and shear_area_z, or set theory: euler_bernoulli");
  const bool by_stiffness = section != part.sections.end() && section->by_stiffness;
  if (by_stiffness && !beam.material.empty())
    subject.add("material", "'material' cannot be combined with a section by stiffness",
                "remove it: the section needs none");
  if (!by_stiffness && beam.material.empty())
    subject.faults.add(beam.where, "", subject.name + " has no 'material'", "add it, or give the section by stiffness");
  const auto second = std::ranges::find(part.sections, beam.to_section, &Section::name);
  if (section != part.sections.end() && second != part.sections.end() && second->by_stiffness != section->by_stiffness)
    subject.add("to_section",
                fmt::format("only one of sections '{}' and '{}' is given by stiffness", section->name, second->name),
                "give both sections by stiffness, or neither");
  subject.finite("angle_deg", beam.angle);
  if (!beam.from_offset.allFinite() || !beam.to_offset.allFinite()) subject.add("offset", "offsets must be finite");
}

/// Checks length, arc and division of a line between two places of known position.
void check_line_of_beam(const Part& part, const BeamLine& beam, const Subject& subject) {
  if (beam.elements < 0) subject.add("elements", fmt::format("elements {} must be 1 or more", beam.elements));
  if (beam.elements == 0) subject.positive("size", beam.size);
  constexpr double most = 1e6;
  if (beam.elements > most)
    subject.add("elements", fmt::format("{} elements; the limit is {:g}", beam.elements, most), "give fewer");
  const auto from = position_of(part, beam.from), to = position_of(part, beam.to);
  if (!from || !to) return;
  check_line({*from, *to, beam.through, beam.orientation}, subject);
  if (beam.elements != 0 || !(beam.size > 0.0)) return;
  const double count = (*to - *from).norm() / beam.size;
  if (count > most)
    subject.add("size", fmt::format("size {:g} makes {:.3g} elements; the limit is {:g}", beam.size, count, most),
                "give a larger size");
}

void check_beam(const Part& part, const BeamLine& beam, const PartNames& names, const Subject& subject) {
  check_reference(subject, "section", "section", beam.section, names.sections);
  if (!beam.to_section.empty()) check_reference(subject, "to_section", "section", beam.to_section, names.sections);
  if (!beam.material.empty()) check_reference(subject, "material", "material", beam.material, names.materials);
  check_section_of_beam(part, beam, subject);
  if (!beam.on.empty()) return check_group_names(part, names, beam.on, "on", subject);
  check_place(part, names, beam.from, "from", subject);
  check_place(part, names, beam.to, "to", subject);
  check_line_of_beam(part, beam, subject);
}

void check_modes(const Part& part, Faults& faults) {
  const ModeSelection& modes = part.modes;
  const Subject subject{"", modes.where, faults};
  if (modes.count < 0)
    subject.add("modes", fmt::format("modes {} must not be negative", modes.count),
                "write modes: 0 for Guyan reduction");
  if (part.double_curvature < 0 || part.double_curvature > 100)
    subject.add("double_curvature", fmt::format("double_curvature {} must be 0 to 100 shapes", part.double_curvature),
                "20 shapes are enough for plates");
  subject.positive("cutoff", modes.cutoff);
  if (modes.moments && *modes.moments < 0)
    subject.add("moments", fmt::format("moments {} must not be negative", *modes.moments));
  if (modes.method != ReductionMethod::craig_bampton && (modes.accuracy || modes.moments))
    subject.add(modes.accuracy ? "accuracy" : "moments",
                fmt::format("'{}' needs modes with the boundary held", modes.accuracy ? "accuracy" : "moments"),
                "remove it, or write method: craig_bampton");
  const bool free_modes = modes.method != ReductionMethod::craig_bampton;
  if (modes.mechanism == Mechanisms::allow && (free_modes || part.modal_body))
    subject.add("mechanism",
                free_modes ? "mechanism: allow needs modes with the boundary held"
                           : "mechanism: allow cannot be combined with `modal_body`, whose modes need stiffness",
                free_modes ? "write method: craig_bampton" : "remove `modal_body`, or `mechanism`");
  if (!modes.accuracy) return;
  if (modes.moments.value_or(0) > 0)
    subject.add("moments", "'accuracy' chooses the number of moment vectors itself",
                "remove `moments`, or write moments: 0 for internal modes only");
  if (!(modes.accuracy->error > 0.0 && modes.accuracy->error < 1.0))
    subject.add("error", fmt::format("error {:g} must be between 0 and 1", modes.accuracy->error),
                "for example 0.001, which is 0.1 % of each frequency");
  subject.positive("up_to", modes.accuracy->up_to);
}

void check_modal_body(const Part& part, PartNames names, Faults& faults) {
  if (!part.modal_body) return;
  const ModalBodyRequest& body = *part.modal_body;
  const Subject subject{"modal_body", body.where, faults};
  if (body.modes < 1)
    subject.add("modes", fmt::format("modes {} must be 1 or more", body.modes),
                "for a body without modes, use the superelement, or a rigid body of the scene");
  subject.not_negative("damping", body.damping);
  int held = 0;
  for (const BoundaryNode& node : part.boundary) names.places.push_back(node.name);
  for (const ModalBodyRequest::Held& place : body.held) {
    held += std::popcount(place.components);
    if (!part.boundary.empty() || part.mesh.file.empty())
      check_reference(subject, "reference", "place", place.place, names.places);
  }
  if (!body.held.empty() && held != 6)
    subject.add("reference", fmt::format("{} components are held", held),
                "hold six components: fewer do not fix the frame, more stiffen the body");
}

void check_boundary(const Part& part, const PartNames& names, Faults& faults) {
  const bool solved = !part.supports.empty() || !part.load_cases.empty();
  if (part.boundary.empty() && part.mesh.file.empty() && !solved)
    faults.add(part.file, "boundary", "the part has no boundary node",
               "list the points at which it is joined or loaded: boundary: [base, tip]");
  std::vector<std::string> seen;
  for (const BoundaryNode& node : part.boundary) {
    const Subject subject = check_name("boundary node", node, seen, faults);
    check_place(part, names, node.at, "", subject);
    if (!node.translations && !node.rotations) subject.add("", "keeps neither translations nor rotations");
  }
}

}  // namespace

Faults find_faults(const Part& part) {
  Faults faults;
  if (part.name.empty()) faults.add(part.file, "part", "the part has no name", "part: <name>");
  const PartNames names = check_definitions(part, faults);
  if (part.beams.empty() && part.patches.empty() && part.mesh.file.empty())
    faults.add(part.file, "beams", "the part has no elements",
               "give beams, plates, discs, cylinders, extrusions, or a mesh file (mesh: {file: ...})");
  std::vector<std::string> beams;
  for (const BeamLine& beam : part.beams) check_beam(part, beam, names, check_name("beam", beam, beams, faults));
  check_mesh_and_groups(part, names, faults);
  check_shells(part, names, faults);
  check_attachments(part, names, faults);
  check_boundary(part, names, faults);
  check_modes(part, faults);
  check_modal_body(part, names, faults);
  check_loads(part, names, faults);
  return faults;
}

void check(const Part& part) { find_faults(part).raise(); }

}  // namespace tisserand::formats
