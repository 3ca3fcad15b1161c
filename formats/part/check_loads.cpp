// SPDX-License-Identifier: GPL-3.0-or-later
// Checks supports and load cases.
#include <cmath>

#include "formats/part/check.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

/// Checks the place of a load or support. It must be an existing node, so it cannot be a centroid.
void check_loaded_place(const Part& part, const PartNames& names, const Place& place, const Subject& subject) {
  if (place.kind == PlaceKind::centroid) {
    subject.add("at", "a centroid is not a node of the part",
                "put a spider there and name it: spiders: {pad: {kind: averaging, on: ...}}");
    return;
  }
  const bool deck_boundary = part.boundary.empty() && !part.mesh.file.empty();
  if (place.kind == PlaceKind::name && deck_boundary) return;  // may name a deck's node, known with the mesh
  check_place(part, names, place, "at", subject);
}

void check_support(const Part& part, const PartNames& names, const Support& support, Faults& faults) {
  const Subject subject = subject_of("support", support, faults);
  if (support.components == 0)
    faults.add(support.where, "directions", subject.name + " holds nothing", "name directions: [x, y, z], or all");
  if (support.on.empty()) return check_loaded_place(part, names, support.at, subject);
  PartNames known = names;
  if (support.on.size() == 1 && support.on[0] == support.name)  // the name may mean a place
    known.groups.insert(known.groups.end(), names.places.begin(), names.places.end());
  check_group_names(part, known, support.on, "on", subject);
}

void check_finite(const Eigen::Vector3d& value, const Subject& subject) {
  if (!value.allFinite()) subject.faults.add(subject.where, "", subject.name + " must be finite", "");
}

void check_load_case(const Part& part, const PartNames& names, const PartLoadCase& load, const Subject& subject) {
  Faults& faults = subject.faults;
  subject.finite("gravity", load.gravity);
  if (load.forces.empty() && load.pressures.empty() && load.line_loads.empty() && load.gravity.isZero(0.0))
    faults.add(load.where, "", subject.name + " has no loads", "give forces, pressures, line_loads or gravity");
  for (const PlaceLoad& force : load.forces) {
    const Subject own{fmt::format("{}: force '{}'", subject.name, force.name), force.where, faults};
    check_finite(force.force, own);
    check_finite(force.moment, own);
    check_loaded_place(part, names, force.at, own);
  }
  for (const PressureLoad& pressure : load.pressures) {
    const Subject own{subject.name + ": pressure", pressure.where, faults};
    if (!std::isfinite(pressure.pressure))
      faults.add(own.where, "", fmt::format("{} on '{}' must be finite", own.name, pressure.on), "");
    check_group_names(part, names, {pressure.on}, "", own);
  }
  for (const LineLoad& line : load.line_loads) {
    const Subject own{subject.name + ": line load", line.where, faults};
    check_finite(line.force, {fmt::format("{} on '{}'", own.name, line.on), line.where, faults});
    PartNames known = names;
    for (const BeamLine& beam : part.beams) known.groups.push_back(beam.name);
    check_group_names(part, known, {line.on}, "", own);
  }
}

}  // namespace

void check_loads(const Part& part, PartNames names, Faults& faults) {
  for (const BoundaryNode& node : part.boundary) names.places.push_back(node.name);
  for (const Support& support : part.supports) check_support(part, names, support, faults);
  std::vector<std::string> cases;
  for (const PartLoadCase& load : part.load_cases)
    check_load_case(part, names, load, check_name("load case", load, cases, faults));
}

}  // namespace tisserand::formats
