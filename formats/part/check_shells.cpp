// SPDX-License-Identifier: GPL-3.0-or-later
// Checks a part's materials, plates, discs, cylinders, extrusions, shells and solids.
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "formats/part/check.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

/// Checks for positive constants and a positive definite plane stress stiffness: nu12² < E1/E2.
void check_orthotropic(const OrthotropicMaterial& m, Faults& faults) {
  const Subject subject = subject_of("material", m, faults);
  subject.positive("E1", m.E1);
  subject.positive("E2", m.E2);
  subject.positive("G12", m.G12);
  subject.positive("G13", m.G13);
  subject.positive("G23", m.G23);
  subject.positive("density", m.density);
  if (m.E1 > 0.0 && m.E2 > 0.0 && !(m.nu12 * m.nu12 < m.E1 / m.E2))
    subject.add("nu12",
                fmt::format("nu12 {:g} must be below sqrt(E1/E2) = {:g} in magnitude", m.nu12, std::sqrt(m.E1 / m.E2)),
                "nu12 is the contraction along 2 divided by the strain along 1, under tension along 1");
}

void check_layout(const ShellLayout& layout, const PartNames& names, const Subject& subject) {
  if (layout.plies.empty()) {
    subject.positive("thickness", layout.thickness);
    check_reference(subject, "material", "material", layout.material, names.layers);
  }
  for (std::size_t i = 0; i < layout.plies.size(); ++i) {
    const Ply& ply = layout.plies[i];
    const std::string prefix = fmt::format("laminate.{}.", i);
    subject.positive(prefix + "thickness", ply.thickness);
    check_reference(subject, prefix + "material", "material", ply.material, names.layers);
    if (!std::isfinite(ply.angle)) subject.add(prefix + "angle_deg", "angle_deg must be finite");
  }
  subject.finite("offset", layout.offset);
  if (layout.x && !(layout.x->norm() > 0.0 && layout.x->allFinite()))
    subject.add("x", "x must be a direction", "give the direction of the fibres at angle 0, x: [1, 0, 0]");
}

void check_direction(const Eigen::Vector3d& direction, const std::string& key, const Subject& subject) {
  if (!(direction.norm() > 0.0 && direction.allFinite()))
    subject.add(key, fmt::format("{} must be a direction, not of zero length", key));
}

void check_start(const std::optional<Eigen::Vector3d>& start, const Eigen::Vector3d& axis, const Subject& subject) {
  if (start && !(start->cross(axis).norm() > 1e-6 * start->norm() * axis.norm()))
    subject.add("start", "start is parallel to the axis", "give a direction across the axis");
}

void check_turn(double angle, const Subject& subject, const std::string& key) {
  if (!(std::abs(angle) > 0.0 && std::abs(angle) <= 2.0 * M_PI * (1.0 + 1e-12)))
    subject.add(key, fmt::format("angle_deg {:g} must be between -360 and 360, and not 0", angle * 180.0 / M_PI));
}

struct ShapeCheck {
  const Subject& subject;

  void operator()(const Plate& plate) const {
    const std::size_t count = plate.corners.size();
    if (count != 4)
      return subject.add("corners", fmt::format("{} corners", count),
                         "give four corners in order, or three for a parallelogram");
    double scale = 0.0;
    for (const Eigen::Vector3d& corner : plate.corners) {
      if (!corner.allFinite()) return;
      scale = std::max(scale, (corner - plate.corners[0]).norm());
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector3d ahead = plate.corners[(i + 1) % 4] - plate.corners[i];
      const Eigen::Vector3d back = plate.corners[(i + 3) % 4] - plate.corners[i];
      const Eigen::Vector3d diagonals =
          (plate.corners[2] - plate.corners[0]).cross(plate.corners[3] - plate.corners[1]);
      if (!(ahead.cross(back).dot(diagonals) > 1e-9 * scale * scale * diagonals.norm()))
        return subject.add("corners",
                           fmt::format("the inner angle at corner {} is not between 0 and 180 degrees", i + 1),
                           "give the corners in order around the plate, all different");
    }
  }
  void operator()(const Disc& disc) const {
    check_direction(disc.normal, "normal", subject);
    check_start(disc.start, disc.normal, subject);
    subject.positive("radius", disc.radius);
    if (!(disc.inner_radius >= 0.0 && disc.inner_radius < disc.radius))
      subject.add(
          "inner_radius",
          fmt::format("inner_radius {:g} must be at least 0 and below radius {:g}", disc.inner_radius, disc.radius),
          "");
  }
  void operator()(const Cylinder& cylinder) const {
    check_direction(cylinder.to - cylinder.from, "to", subject);
    check_start(cylinder.start, cylinder.to - cylinder.from, subject);
    subject.positive("radius", cylinder.radius);
    subject.positive("end_radius", cylinder.end_radius);
    check_turn(cylinder.angle, subject, "angle_deg");
    if (cylinder.angle < 0.0)
      subject.add("angle_deg", "angle_deg must be positive", "turn `start`, or exchange from and to");
  }
  void operator()(const Extrusion& extrusion) const {
    if (extrusion.section.size() < 2)
      subject.add("profile", fmt::format("{} points", extrusion.section.size()), "give two or more");
    for (std::size_t i = 1; i < extrusion.section.size(); ++i)
      if (extrusion.section[i] == extrusion.section[i - 1])
        subject.add("profile", fmt::format("points {} and {} are at the same place", i, i + 1), "remove one");
    if (const auto* along = std::get_if<Eigen::Vector3d>(&extrusion.path)) {
      check_direction(*along, "along", subject);
    } else {
      const ArcPath& arc = std::get<ArcPath>(extrusion.path);
      check_direction(arc.axis, "arc.axis", subject);
      check_turn(arc.angle, subject, "arc.angle_deg");
    }
  }
};

void check_division(const ShellPatch& patch, const Subject& subject) {
  constexpr double most = 1e7;
  if (patch.elements.empty()) return subject.positive("size", patch.size);
  if (patch.elements.size() != 2) return subject.add("elements", "two counts are needed", "elements: [10, 20]");
  for (const int count : patch.elements)
    if (count < 1) subject.add("elements", fmt::format("elements {} must be 1 or more", count));
  if (static_cast<double>(patch.elements[0]) * patch.elements[1] > most)
    subject.add("elements",
                fmt::format("{} x {} elements; the limit is {:g}", patch.elements[0], patch.elements[1], most),
                "give fewer");
  const auto* disc = std::get_if<Disc>(&patch.shape);
  const auto* cylinder = std::get_if<Cylinder>(&patch.shape);
  if (disc != nullptr && disc->inner_radius == 0.0 && patch.elements[0] % 4 != 0)
    subject.add("elements", fmt::format("{} elements around a full disc", patch.elements[0]), "give a multiple of 4");
  const bool round = disc != nullptr || (cylinder != nullptr && cylinder->angle > M_PI);
  if (round && patch.elements[0] < 3)
    subject.add("elements", fmt::format("{} elements around", patch.elements[0]), "give 3 or more");
}

/// Checks that a patch has its own layout or that the part has shells.
void check_has_layout(const Part& part, const ShellPatch& patch, const Subject& subject) {
  if (patch.layout || !part.shells.empty()) return;
  subject.add(
      "thickness", "neither thickness and material nor a laminate is given",
      fmt::format("give thickness and material here, or a shell: shells: {{skin: {{on: {}, ...}}}}", patch.name));
}

}  // namespace

std::vector<std::string> edge_groups(const ShellPatch& patch) {
  if (std::holds_alternative<Plate>(patch.shape))
    return {patch.name + "/edge1", patch.name + "/edge2", patch.name + "/edge3", patch.name + "/edge4"};
  if (const auto* disc = std::get_if<Disc>(&patch.shape))
    return disc->inner_radius > 0.0 ? std::vector<std::string>{patch.name + "/rim", patch.name + "/hole"}
                                    : std::vector<std::string>{patch.name + "/rim"};
  return {patch.name + "/start", patch.name + "/end"};
}

void check_shells(const Part& part, const PartNames& names, Faults& faults) {
  for (const OrthotropicMaterial& material : part.orthotropic) check_orthotropic(material, faults);
  for (const ShellPatch& patch : part.patches) {
    const Subject subject{fmt::format("'{}'", patch.name), patch.where, faults};
    std::visit(ShapeCheck{subject}, patch.shape);
    check_division(patch, subject);
    if (patch.layout) check_layout(*patch.layout, names, subject);
    check_has_layout(part, patch, subject);
  }
  std::vector<std::string> seen;
  for (const ShellGroup& shell : part.shells) {
    const Subject subject = check_name("shell", shell, seen, faults);
    check_group_names(part, names, shell.on, "on", subject);
    check_layout(shell.layout, names, subject);
  }
  std::vector<std::string> solids;
  for (const SolidGroup& solid : part.solids) {
    const Subject subject = check_name("solid", solid, solids, faults);
    check_group_names(part, names, solid.on, "on", subject);
    check_reference(subject, "material", "material", solid.material, names.materials);
  }
}

}  // namespace tisserand::formats
