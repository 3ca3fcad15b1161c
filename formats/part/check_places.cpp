// SPDX-License-Identifier: GPL-3.0-or-later
// Checks a part's mesh file, groups, places, masses, springs and spiders.
#include <cmath>

#include <Eigen/Eigenvalues>

#include "formats/part/check.hpp"
#include "formats/yaml/line_check.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

bool is_positive(double value) { return value > 0.0 && std::isfinite(value); }

/// Whether the text names entities: "face 3", "edge 12", "volume 1", "all".
bool names_entities(const std::string& text) {
  return text == "all" || text.starts_with("face ") || text.starts_with("edge ") || text.starts_with("volume ");
}

void check_mesh_file(const MeshFile& mesh, Faults& faults) {
  const Subject subject{"mesh", mesh.where, faults};
  if (mesh.size != 0.0) subject.positive("size", mesh.size);
  if (mesh.smallest != 0.0) subject.positive("smallest", mesh.smallest);
  if (mesh.curvature < 0 || mesh.curvature > 1000)
    subject.add("curvature", fmt::format("curvature {} must be between 0 and 1000 elements per turn", mesh.curvature));
  if (mesh.order < 0 || mesh.order > 2) subject.add("order", fmt::format("order {} must be 1 or 2", mesh.order));
  subject.positive("scale", mesh.scale);
  for (const MeshFile::LocalSize& local : mesh.sizes)
    if (!is_positive(local.size))
      subject.add("sizes", fmt::format("size {:g} of '{}' must be positive", local.size, local.group));
}

void check_group(const Part& part, const PartNames& names, const GroupDefinition& group, Faults& faults) {
  const Subject subject = subject_of("group", group, faults);
  if (group.numbers.empty() && group.groups.empty() && !group.box && !group.cylinder && !group.near)
    subject.add("", "selects nothing", "give faces, edges, volumes, nodes, groups, box, cylinder or near");
  check_group_names(part, names, group.groups, "groups", subject);
  subject.not_negative("tolerance", group.tolerance);
  if (!group.cylinder) return;
  const Subject bore{subject.name, subject.where, faults, "cylinder."};
  bore.positive("radius", group.cylinder->radius);
  if (!((group.cylinder->to - group.cylinder->from).norm() > 0.0))
    bore.add("to", "the axis of the cylinder has zero length", "give two different points");
}

void check_stiffness(const SpringLine& spring, const Subject& subject) {
  const auto& K = spring.stiffness;
  const auto fail = [&](const std::string& what, const std::string& remedy) { subject.add("stiffness", what, remedy); };
  if (!subject.finite("stiffness", K)) return;
  const double largest = K.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) return fail("stiffness is zero", "give a positive stiffness, or remove the spring");
  if ((K - K.transpose()).cwiseAbs().maxCoeff() > 1e-9 * largest) return fail("stiffness is not symmetric", "");
  // Scaled to unit diagonal, since translations and rotations have different units.
  Eigen::Matrix<double, 6, 1> d = K.diagonal();
  if ((d.array() < 0.0).any()) return fail("a stiffness is negative", "");
  for (int i = 0; i < 6; ++i) d[i] = d[i] > 0.0 ? 1.0 / std::sqrt(d[i]) : 0.0;
  const Eigen::MatrixXd scaled = d.asDiagonal() * K * d.asDiagonal();
  for (int i = 0; i < 6; ++i)
    if (d[i] == 0.0 && K.row(i).cwiseAbs().maxCoeff() > 0.0) return fail("stiffness is not positive semidefinite", "");
  const double lowest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues()[0];
  if (lowest < -1e-9) fail("stiffness is not positive semidefinite", "check the coupling terms");
}

void check_spider(const Part& part, const PartNames& names, const SpiderLine& spider, Faults& faults) {
  const Subject subject = subject_of("spider", spider, faults);
  if (spider.on.empty() && spider.nodes.empty())
    subject.add("on", "is attached to nothing", "name a group: on: left_hole");
  check_group_names(part, names, spider.on, "on", subject);
  const bool own_centroid = spider.at.kind == PlaceKind::centroid && spider.at.name.empty();
  if (!own_centroid) check_place(part, names, spider.at, "at", subject);
  if (!spider.nodes.empty() && part.mesh.file.empty())
    subject.add("on", "node numbers are given, but there is no mesh file", "name a group");
}

}  // namespace

void check_place(const Part& part, const PartNames& names, const Place& place, const std::string& key,
                 const Subject& subject) {
  if (place.kind == PlaceKind::name) {
    check_reference(subject, key, "point", place.name, names.places);
    return;
  }
  if (!place.position.allFinite()) subject.add(key, "position must be finite");
  if (place.kind == PlaceKind::centroid)
    check_group_names(part, names, {place.name}, key, subject);
  else if (place.kind != PlaceKind::position && part.mesh.file.empty())
    subject.add(key, fmt::format("'{}' needs a mesh file", place.kind == PlaceKind::node ? "node" : "near"),
                "name a point, or give mesh: {file: ...}");
  if (place.tolerance && !(*place.tolerance >= 0.0 && std::isfinite(*place.tolerance)))
    subject.add(key, fmt::format("tolerance {:g} must not be negative", *place.tolerance));
}

void check_group_names(const Part& part, const PartNames& names, const std::vector<std::string>& on,
                       const std::string& key, const Subject& subject) {
  if (!part.mesh.file.empty()) return;
  for (const std::string& name : on)
    if (!names_entities(name)) check_reference(subject, key, "group", name, names.groups);
}

void check_mesh_and_groups(const Part& part, const PartNames& names, Faults& faults) {
  if (!part.mesh.file.empty()) check_mesh_file(part.mesh, faults);
  for (const GroupDefinition& group : part.groups) check_group(part, names, group, faults);
  for (const NamedPoint& point : part.points)
    if (point.place) check_place(part, names, *point.place, "", subject_of("point", point, faults));
}

void check_attachments(const Part& part, const PartNames& names, Faults& faults) {
  std::vector<std::string> masses, springs;
  for (const PointMass& mass : part.point_masses) {
    const Subject subject = check_name("point mass", mass, masses, faults);
    check_place(part, names, mass.at, "at", subject);
    check_mass(mass.mass, mass.inertia, MassSign::zero_allowed, subject);
    subject.finite("offset", mass.offset);
  }
  for (const SpringLine& spring : part.springs) {
    const Subject subject = check_name("spring", spring, springs, faults);
    check_place(part, names, spring.from, "from", subject);
    check_place(part, names, spring.to, "to", subject);
    check_stiffness(spring, subject);
  }
  for (const SpiderLine& spider : part.spiders) check_spider(part, names, spider, faults);
}

}  // namespace tisserand::formats
