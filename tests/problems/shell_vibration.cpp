// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry and supports of the published frequencies of plates and shells.
#include "tests/problems/shell_vibration.hpp"

#include <cmath>
#include <numbers>

#include "reducer/properties/laminate.hpp"
#include "tests/support/meshes/shell_grids.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using std::numbers::pi;

constexpr Components x = 1, y = 2, z = 4, rx = 8, ry = 16, rz = 32;

ShellSection nafems(double thickness) { return isotropic_shell(200e9, 0.3, 8000.0, thickness, 5.0 / 6.0); }

/// 10 x 10 in the x-y plane.
SmallModel plate(const ShellMesh& mesh, double thickness) {
  return SmallModel(shell_grid(
      {mesh.n, mesh.n, mesh.facets, false}, [](double a, double b) { return Vector3d(10.0 * a, 10.0 * b, 0.0); },
      nafems(thickness)));
}

void hold_everywhere(SmallModel& model, Components components) {
  hold_where(model, components, [](const Vector3d&) { return true; });
}

bool at_edge(double p) { return std::abs(p) < 1e-9 || std::abs(p - 10.0) < 1e-9; }

/// No deflection, no rotation in the plane of the edge.
void support_simply(SmallModel& model) {
  hold_where(model, z | rx, [](const Vector3d& p) { return at_edge(p.x()); });
  hold_where(model, z | ry, [](const Vector3d& p) { return at_edge(p.y()); });
}

SmallModel cylinder(const ShellMesh& mesh, CylinderEnds ends) {
  SmallModel model(shell_grid(
      {4 * mesh.n, 2 * mesh.n, mesh.facets, true},
      [](double a, double b) { return Vector3d(0.1 * std::cos(2 * pi * a), 0.1 * std::sin(2 * pi * a), 0.4 * b); },
      isotropic_shell(200e9, 0.3, 7800.0, 0.01, 5.0 / 6.0)));
  hold_where(model, ends == CylinderEnds::clamped ? all_components : translations_only,
             [](const Vector3d& p) { return std::abs(p.z() - 0.2) > 0.2 - 1e-9; });
  return model;
}

}  // namespace

VectorXd free_square_plate(const ShellMesh& mesh) { return modes_small(plate(mesh, 0.05), 14, 100.0).hertz(); }

VectorXd clamped_rhombic_plate(const ShellMesh& mesh) {
  const int n = mesh.n;
  const GridShape grid{n, n, mesh.facets, false};
  const double c = std::sqrt(0.5);
  SmallModel model(shell_grid(
      grid, [&](double a, double b) { return Vector3d(10.0 * (a + c * b), 10.0 * c * b, 0.0); }, nafems(0.05)));
  hold_everywhere(model, x | y | rz);
  for (int i = 0; i <= n; ++i)
    for (const int node : {grid_node(grid, i, 0), grid_node(grid, i, n), grid_node(grid, 0, i), grid_node(grid, n, i)})
      model.hold(node, all_components);
  return modes_small(model, 6, 0.0).hertz();
}

VectorXd thick_plate_bending(const ShellMesh& mesh) {
  SmallModel model = plate(mesh, 1.0);
  support_simply(model);
  hold_everywhere(model, x | y | rz);
  return modes_small(model, 4, 0.0).hertz();
}

VectorXd thick_plate_in_its_plane(const ShellMesh& mesh) {
  SmallModel model = plate(mesh, 1.0);
  hold_everywhere(model, z | rx | ry);
  return modes_small(model, 6, 1e5).hertz();
}

VectorXd square_plate_parameters(const ShellMesh& mesh, SquareEdges edges) {
  SmallModel model = plate(mesh, 0.01);
  hold_everywhere(model, x | y | rz);
  if (edges == SquareEdges::simply_supported) support_simply(model);
  if (edges == SquareEdges::clamped)
    hold_where(model, all_components, [](const Vector3d& p) { return at_edge(p.x()) || at_edge(p.y()); });
  const int rigid = edges == SquareEdges::free ? 3 : 0, elastic = 6;
  const ShellSection section = nafems(0.01);
  const double unit = 100.0 * std::sqrt(section.mass / section.D(0, 0));
  const VectorXd omega2 = modes_small(model, rigid + elastic, rigid > 0 ? 1.0 : 0.0).omega2;
  return unit * omega2.tail(elastic).cwiseSqrt();
}

double square_plate_ratio(const ShellMesh& mesh) {
  SmallModel model = plate(mesh, 0.01);
  support_simply(model);
  hold_everywhere(model, x | y | rz);
  const ShellSection section = nafems(0.01);
  return modes_small(model, 1, 0.0).omega2[0] / (4.0 * std::pow(pi / 10.0, 4) * section.D(0, 0) / section.mass);
}

VectorXd clamped_cylinder(const ShellMesh& mesh) {
  return modes_small(cylinder(mesh, CylinderEnds::clamped), 2, 0.0).hertz();
}

double cylinder_torsion(const ShellMesh& mesh, CylinderEnds ends) {
  const SmallModel model = cylinder(mesh, ends);
  const SmallModes modes = modes_small(model, 24, 0.0);
  VectorXd turn = VectorXd::Zero(6 * model.mesh.nodes());
  for (int i = 0; i < model.mesh.nodes(); ++i) {
    turn[6 * i] = -model.mesh.position(1, i);
    turn[6 * i + 1] = model.mesh.position(0, i);
    turn[6 * i + 5] = 1.0;
  }
  Eigen::Index mode = 0;
  (modes.shape.transpose() * (assemble_small(model.mesh).M * turn)).cwiseAbs().maxCoeff(&mode);
  return modes.hertz()[mode];
}

}  // namespace tisserand::reducer
