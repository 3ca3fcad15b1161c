// Findings of a part's mesh file, groups, places, masses, springs and spiders.
#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "formats/part/check.hpp"
#include "formats/yaml/line_check.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {

namespace {

bool is_positive(double value) { return value > 0.0 && std::isfinite(value); }

/// "face 3", "edge 12", "volume 1", "all".
bool names_entities(const std::string& text) {
  return text == "all" || text.starts_with("face ") || text.starts_with("edge ") || text.starts_with("volume ");
}

void check_mesh_file(const MeshFile& mesh, Faults& faults) {
  const auto fail = [&](const char* key, const std::string& what) { faults.add(mesh.where, key, "mesh: " + what, ""); };
  if (mesh.size != 0.0 && !is_positive(mesh.size)) fail("size", fmt::format("size {:g} must be positive", mesh.size));
  if (mesh.smallest != 0.0 && !is_positive(mesh.smallest))
    fail("smallest", fmt::format("smallest {:g} must be positive", mesh.smallest));
  if (mesh.curvature < 0 || mesh.curvature > 1000)
    fail("curvature", fmt::format("curvature {} must be between 0 and 1000 elements per turn", mesh.curvature));
  if (mesh.order < 0 || mesh.order > 2) fail("order", fmt::format("order {} must be 1 or 2", mesh.order));
  if (!is_positive(mesh.scale)) fail("scale", fmt::format("scale {:g} must be positive", mesh.scale));
  for (const MeshFile::LocalSize& local : mesh.sizes)
    if (!is_positive(local.size))
      fail("sizes", fmt::format("size {:g} of '{}' must be positive", local.size, local.group));
}

void check_group(const Part& part, const PartNames& names, const GroupDefinition& group, Faults& faults) {
  const std::string subject = fmt::format("group '{}'", group.name);
  const auto fail = [&](const char* key, const std::string& what, const std::string& remedy) {
    faults.add(group.where, key, subject + ": " + what, remedy);
  };
  if (group.numbers.empty() && group.groups.empty() && !group.box && !group.cylinder && !group.near)
    fail("", "selects nothing", "give faces, edges, volumes, nodes, groups, box, cylinder or near");
  check_group_names(part, names, group.groups, subject, group.where, "groups", faults);
  if (group.tolerance && !(*group.tolerance >= 0.0 && std::isfinite(*group.tolerance)))
    fail("tolerance", fmt::format("tolerance {:g} must not be negative", *group.tolerance), "");
  if (group.cylinder && !is_positive(group.cylinder->radius))
    fail("cylinder.radius", fmt::format("radius {:g} must be positive", group.cylinder->radius), "");
  if (group.cylinder && !((group.cylinder->to - group.cylinder->from).norm() > 0.0))
    fail("cylinder.to", "the axis of the cylinder has zero length", "give two different points");
}

void check_stiffness(const SpringLine& spring, const std::string& subject, Faults& faults) {
  const auto& K = spring.stiffness;
  const auto fail = [&](const std::string& what, const std::string& remedy) {
    faults.add(spring.where, "stiffness", subject + ": " + what, remedy);
  };
  if (!K.allFinite()) return fail("stiffness must be finite", "");
  const double largest = K.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) return fail("stiffness is zero", "give a positive stiffness, or remove the spring");
  if ((K - K.transpose()).cwiseAbs().maxCoeff() > 1e-9 * largest) return fail("stiffness is not symmetric", "");
  // Scaled to unit diagonal, since translations and rotations differ in units.
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
  const std::string subject = fmt::format("spider '{}'", spider.name);
  if (spider.on.empty() && spider.nodes.empty())
    faults.add(spider.where, "on", subject + ": is on nothing", "name a group: on: left_hole");
  check_group_names(part, names, spider.on, subject, spider.where, "on", faults);
  const bool own_centroid = spider.at.kind == PlaceKind::centroid && spider.at.name.empty();
  if (!own_centroid) check_place(part, names, spider.at, subject, spider.where, "at", faults);
  if (!spider.nodes.empty() && part.mesh.file.empty())
    faults.add(spider.where, "on", subject + ": numbers of nodes without a mesh file", "name a group");
}

}  // namespace

void check_place(const Part& part, const PartNames& names, const Place& place, const std::string& subject,
                 const std::string& where, const std::string& key, Faults& faults) {
  if (place.kind == PlaceKind::name) {
    check_reference(subject, "point", place.name, names.places, where, key, faults);
    return;
  }
  if (!place.position.allFinite()) faults.add(where, key, subject + ": position must be finite", "");
  if (place.kind == PlaceKind::centroid)
    check_group_names(part, names, {place.name}, subject, where, key, faults);
  else if (place.kind != PlaceKind::position && part.mesh.file.empty())
    faults.add(where, key,
               fmt::format("{}: '{}' without a mesh file", subject, place.kind == PlaceKind::node ? "node" : "near"),
               "name a point, or give mesh: {file: ...}");
  if (place.tolerance && !(*place.tolerance >= 0.0 && std::isfinite(*place.tolerance)))
    faults.add(where, key, fmt::format("{}: tolerance {:g} must not be negative", subject, *place.tolerance), "");
}

void check_group_names(const Part& part, const PartNames& names, const std::vector<std::string>& on,
                       const std::string& subject, const std::string& where, const std::string& key, Faults& faults) {
  if (!part.mesh.file.empty()) return;
  for (const std::string& name : on)
    if (!names_entities(name)) check_reference(subject, "group", name, names.groups, where, key, faults);
}

void check_mesh_and_groups(const Part& part, const PartNames& names, Faults& faults) {
  if (!part.mesh.file.empty()) check_mesh_file(part.mesh, faults);
  for (const GroupDefinition& group : part.groups) check_group(part, names, group, faults);
  for (const NamedPoint& point : part.points)
    if (point.place)
      check_place(part, names, *point.place, fmt::format("point '{}'", point.name), point.where, "", faults);
}

void check_attachments(const Part& part, const PartNames& names, Faults& faults) {
  std::vector<std::string> masses, springs;
  for (const PointMass& mass : part.point_masses) {
    const std::string subject = fmt::format("point mass '{}'", mass.name);
    check_name("point mass", mass.name, mass.where, masses, faults);
    check_place(part, names, mass.at, subject, mass.where, "at", faults);
    check_mass({subject, mass.where, mass.mass, mass.inertia}, MassSign::zero_allowed, faults);
    if (!mass.offset.allFinite()) faults.add(mass.where, "offset", subject + ": offset must be finite", "");
  }
  for (const SpringLine& spring : part.springs) {
    const std::string subject = fmt::format("spring '{}'", spring.name);
    check_name("spring", spring.name, spring.where, springs, faults);
    check_place(part, names, spring.from, subject, spring.where, "from", faults);
    check_place(part, names, spring.to, subject, spring.where, "to", faults);
    check_stiffness(spring, subject, faults);
  }
  for (const SpiderLine& spider : part.spiders) check_spider(part, names, spider, faults);
}

}  // namespace tisserand::formats
