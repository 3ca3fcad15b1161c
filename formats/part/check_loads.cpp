// Findings of supports and load cases.
#include <cmath>

#include "formats/part/check.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {

namespace {

/// Place of a load or support: it must be a node that is there, so no centroid.
void check_loaded_place(const Part& part, const PartNames& names, const Place& place, const std::string& subject,
                        const std::string& where, Faults& faults) {
  if (place.kind == PlaceKind::centroid) {
    faults.add(where, "at", subject + ": a centroid has no node of the part",
               "put a spider there and name it: spiders: {pad: {kind: averaging, on: ...}}");
    return;
  }
  const bool deck_boundary = part.boundary.empty() && !part.mesh.file.empty();
  if (place.kind == PlaceKind::name && deck_boundary) return;  // its nodes may be meant: known with the mesh
  check_place(part, names, place, subject, where, "at", faults);
}

void check_support(const Part& part, const PartNames& names, const Support& support, Faults& faults) {
  const std::string subject = fmt::format("support '{}'", support.name);
  if (support.components == 0)
    faults.add(support.where, "directions", subject + " holds nothing", "name directions: [x, y, z], or all");
  if (support.on.empty()) return check_loaded_place(part, names, support.at, subject, support.where, faults);
  PartNames known = names;
  if (support.on.size() == 1 && support.on[0] == support.name)  // a place may have been meant
    known.groups.insert(known.groups.end(), names.places.begin(), names.places.end());
  check_group_names(part, known, support.on, subject, support.where, "on", faults);
}

void check_load_case(const Part& part, const PartNames& names, const PartLoadCase& load, Faults& faults) {
  const auto check_finite = [&](const Eigen::Vector3d& value, const std::string& subject, const std::string& where) {
    if (!value.allFinite()) faults.add(where, "", subject + " must be finite", "");
  };
  const std::string subject = fmt::format("load case '{}'", load.name);
  check_finite(load.gravity, subject + ": gravity", load.where);
  if (load.forces.empty() && load.pressures.empty() && load.line_loads.empty() && load.gravity.isZero(0.0))
    faults.add(load.where, "", subject + " has no loads", "give forces, pressures, line_loads or gravity");
  for (const PlaceLoad& force : load.forces) {
    const std::string own = fmt::format("{}: force '{}'", subject, force.name);
    check_finite(force.force, own, force.where);
    check_finite(force.moment, own, force.where);
    check_loaded_place(part, names, force.at, own, force.where, faults);
  }
  for (const PressureLoad& pressure : load.pressures) {
    if (!std::isfinite(pressure.pressure))
      faults.add(pressure.where, "", fmt::format("{}: pressure on '{}' must be finite", subject, pressure.on), "");
    check_group_names(part, names, {pressure.on}, subject + ": pressure", pressure.where, "", faults);
  }
  for (const LineLoad& line : load.line_loads) {
    const std::string own = subject + ": line load";
    check_finite(line.force, fmt::format("{} on '{}'", own, line.on), line.where);
    PartNames known = names;
    for (const BeamLine& beam : part.beams) known.groups.push_back(beam.name);
    check_group_names(part, known, {line.on}, own, line.where, "", faults);
  }
}

}  // namespace

void check_loads(const Part& part, PartNames names, Faults& faults) {
  for (const BoundaryNode& node : part.boundary) names.places.push_back(node.name);
  for (const Support& support : part.supports) check_support(part, names, support, faults);
  std::vector<std::string> cases;
  for (const PartLoadCase& load : part.load_cases) {
    check_name("load case", load.name, load.where, cases, faults);
    check_load_case(part, names, load, faults);
  }
}

}  // namespace tisserand::formats
