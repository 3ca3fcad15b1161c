// SPDX-License-Identifier: GPL-3.0-or-later
// Springs and point masses of the mesh from CELAS1, CELAS2, CBUSH and CONM2 of a Nastran deck.
#include <bit>
#include <optional>

#include <fmt/format.h>

#include "reducer/decks/nastran/model.hpp"
#include "reducer/elements/beam/beam.hpp"
#include "reducer/elements/spring.hpp"

namespace tisserand::reducer {
namespace {

/// One end of a CELAS: a node (−1: ground) and one component in the axes of its CD.
struct ElasticEnd {
  int node = -1;
  int component = 0;
};

ElasticEnd read_end(NastranModel& model, CardFields& f, int index) {
  ElasticEnd end;
  if (f.id_or_none(index, "G") == 0) return end;
  end.node = model.node(f, index, "G");
  const Components components = f.components(index + 1, "C", 0);
  if (f.ok() && std::popcount(components) != 1)
    f.fault(fmt::format("C '{}' must be one component", f.text(index + 1)), "give a digit from 1 to 6");
  end.component = components == 0 ? 0 : std::countr_zero(components);
  return end;
}

double largest_distance(const Mesh& mesh) {
  if (mesh.nodes() == 0) return 0.0;
  return (mesh.position.rowwise().maxCoeff() - mesh.position.rowwise().minCoeff()).norm();
}

void add_elastic(NastranModel& model, CardFields& f, double stiffness, long pid, double size) {
  const ElasticEnd first = read_end(model, f, 2), second = read_end(model, f, 4);
  if (!f.ok() || stiffness == 0.0) return;
  if (first.node < 0 && second.node < 0) return f.fault("both ends are blank", "name two grid points");
  if (first.node < 0 || second.node < 0) {
    const ElasticEnd& end = first.node < 0 ? second : first;
    model.held.push_back({end.node, static_cast<Components>(1u << end.component), model.row(f)});
    return;
  }
  Spring spring;
  spring.first = first.node;
  spring.second = second.node;
  spring.stiffness = scalar_spring(stiffness, {first.component, model.displacement_axes(first.node)},
                                   {second.component, model.displacement_axes(second.node)});
  spring.name = f.label();
  const Eigen::Vector3d between = model.position(second.node) - model.position(first.node);
  const bool apart = between.norm() > 1e-6 * size;
  if (rigid_motion_defect(spring.stiffness, apart ? between : Eigen::Vector3d::Zero()) > 1e-9)
    return f.fault("this spring resists rigid-body motion of the part, like a support",
                   "use CBUSH, or grid points that coincide or lie on a line along the spring");
  const int row = add_row(model.deck.mesh.springs, spring);
  if (pid > 0) model.of_property[pid].springs.push_back(row);
}

/// Axes of the bushing in part axes (columns); without CID and v only K1 and K4 have a meaning.
std::optional<Eigen::Matrix3d> bush_axes(NastranModel& model, CardFields& f, const Spring& spring,
                                         const BushProperty& bush) {
  const Eigen::Vector3d a = model.position(spring.first), axis = model.position(spring.second) - a;
  if (!f.blank(7)) {
    const int row = model.frame(f, 7, "CID");
    if (row < 0) return std::nullopt;
    return frame_axes_at(model.frames.frames[row], a);
  }
  if (!(axis.norm() > 0.0)) return f.refuse("the grid points coincide and CID is blank", "give CID");
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  if (parse_integer(f.text(4)).value_or(0) > 0 && f.blank(5) && f.blank(6)) {
    const int node = model.node(f, 4, "GO");
    if (node >= 0) v = model.position(node) - a;
  } else {
    v = model.displacement_axes(spring.first) * f.vector(4, "X");
  }
  if (!f.ok()) return std::nullopt;
  std::optional<Eigen::Matrix3d> axes = v.norm() > 0.0 ? beam_axes(axis, v) : std::nullopt;
  if (axes) return axes;
  const auto& k = bush.stiffness;
  if (k(1) != 0.0 || k(2) != 0.0 || k(4) != 0.0 || k(5) != 0.0 || v.norm() > 0.0)
    return f.refuse("the orientation is missing or parallel to the axis", "give X1, X2, X3, GO or CID");
  Eigen::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  return beam_axes(axis, Eigen::Vector3d::Unit(least));
}

/// Point of action of the bushing: S (blank: 0.5) of the way from GA to GB, or S1, S2, S3 in coordinate system OCID.
Eigen::Vector3d bush_point(NastranModel& model, CardFields& f, const Spring& spring) {
  const Eigen::Vector3d a = model.position(spring.first), b = model.position(spring.second);
  if (f.integer(9, "OCID", -1) < 0) return a + f.real(8, "S", 0.5) * (b - a);
  const int row = model.frame(f, 9, "OCID");
  if (row < 0) return a;
  return frame_point(model.frames.frames[row], f.vector(10, "S"));
}

void add_bush(NastranModel& model, CardFields& f) {
  const int id = model.element_id(f);
  const long pid = f.blank(1) ? id : f.id(1, "PID");
  Spring spring;
  spring.first = model.node(f, 2, "GA");
  if (f.ok() && f.id_or_none(3, "GB") == 0) {
    model.held.push_back({spring.first, all_components, model.row(f)});
    return;
  }
  spring.second = model.node(f, 3, "GB");
  const BushProperty* bush = bush_property(model, f, pid);
  if (bush == nullptr || !f.ok()) return;
  const std::optional<Eigen::Matrix3d> axes = bush_axes(model, f, spring, *bush);
  const Eigen::Vector3d point = bush_point(model, f, spring);
  if (!axes || !f.ok()) return;
  const BushingPlace place{point - model.position(spring.first), point - model.position(spring.second), *axes};
  spring.stiffness = bushing(bush->stiffness.asDiagonal(), place);
  spring.name = f.label();
  model.of_property[pid].springs.push_back(add_row(model.deck.mesh.springs, spring));
}

/// Adds a mass: I11, I21, I22, I31, I32, I33 about its centre; products enter the matrix with a minus sign.
void add_mass(NastranModel& model, CardFields& f) {
  model.element_id(f);
  NodalMass mass;
  mass.node = model.node(f, 1, "G");
  const bool absolute = f.integer(2, "CID", 0) == -1;
  const int row = absolute ? 0 : model.frame(f, 2, "CID");
  mass.mass = f.real(3, "M", 0.0) * model.mass_scale;
  const Eigen::Vector3d x = f.vector(4, "X");
  std::array<double, 6> I{};
  for (int i = 0; i < 6; ++i) I[i] = f.real(8 + i, "I", 0.0) * model.mass_scale;
  if (!f.ok()) return;
  const Eigen::Vector3d node = model.position(mass.node);
  const Eigen::Matrix3d axes = frame_axes_at(model.frames.frames[row], node);
  mass.offset = absolute ? Eigen::Vector3d(x - node) : Eigen::Vector3d(axes * x);
  Eigen::Matrix3d J;
  J << I[0], -I[1], -I[3], -I[1], I[2], -I[4], -I[3], -I[4], I[5];
  mass.inertia = axes * J * axes.transpose();
  if (mass.mass < 0.0) return f.fault(fmt::format("M {:g} is negative", mass.mass), "give a mass >= 0");
  if (!(I[0] >= 0.0 && I[2] >= 0.0 && I[5] >= 0.0 && I[1] * I[1] <= I[0] * I[2] * (1 + 1e-9) &&
        I[3] * I[3] <= I[0] * I[5] * (1 + 1e-9) && I[4] * I[4] <= I[2] * I[5] * (1 + 1e-9)))
    return f.fault("no body can have these moments of inertia",
                   "give I11, I22, I33 >= 0, I21² <= I11 I22, I31² <= I11 I33 and I32² <= I22 I33");
  mass.name = f.label();
  if (mass.mass > 0.0 || !mass.inertia.isZero(0.0)) model.deck.mesh.masses.push_back(mass);
}

}  // namespace

void add_springs(NastranModel& model) {
  const double size = largest_distance(model.deck.mesh);
  model.for_each("CELAS1", [&](CardFields& f) {
    const int id = model.element_id(f);
    const long pid = f.blank(1) ? id : f.id(1, "PID");
    const auto property = model.properties.elastic.find(pid);
    if (!f.ok()) return;
    if (property == model.properties.elastic.end())
      return f.fault(fmt::format("PID names property {}, which is missing", pid), "add a PELAS");
    add_elastic(model, f, property->second.stiffness, pid, size);
  });
  model.for_each("CELAS2", [&](CardFields& f) {
    model.element_id(f);
    add_elastic(model, f, f.real(1, "K"), 0, size);
  });
  model.for_each("CBUSH", [&](CardFields& f) { add_bush(model, f); });
}

void add_masses(NastranModel& model) {
  model.for_each("CONM2", [&](CardFields& f) { add_mass(model, f); });
}

}  // namespace tisserand::reducer
