// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry, supports and loads of the published statics of plates and shells; data as in their sources ([MH85],
// NAFEMS), in consistent units.
#include "tests/problems/shell_statics.hpp"

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

bool equal(double a, double b) { return std::abs(a - b) < 1e-6; }

ShellSection sheet(double E, double nu, double thickness) { return isotropic_shell(E, nu, 0.0, thickness, 5.0 / 6.0); }

/// A quarter of a cylinder's piece along y, angle from z; diaphragm at y = 0, symmetry at y = length and x = 0.
SmallModel quarter_cylinder(const GridShape& grid, double radius, double length, double angle,
                            const ShellSection& section) {
  SmallModel model(shell_grid(
      grid,
      [&](double a, double b) {
        return Vector3d(radius * std::sin(angle * a), length * b, radius * std::cos(angle * a));
      },
      section));
  hold_where(model, x | z | ry, [](const Vector3d& p) { return equal(p.y(), 0.0); });
  hold_where(model, y | rx | rz, [&](const Vector3d& p) { return equal(p.y(), length); });
  hold_where(model, x | ry | rz, [](const Vector3d& p) { return equal(p.x(), 0.0); });
  return model;
}

/// Spreads `total` evenly over the nodes first..last of the edge a = 1 (column na), or of b = 1 (row nb).
enum class GridEdge { last_column, last_row };
struct EdgeNodes {
  GridEdge edge;
  int first;
  int last;
};
void load_edge(SmallModel& model, const GridShape& grid, const EdgeNodes& nodes, int component, double total) {
  for (int k = nodes.first; k <= nodes.last; ++k) {
    const int node = nodes.edge == GridEdge::last_column ? grid_node(grid, grid.na, k) : grid_node(grid, k, grid.nb);
    const double share = k == nodes.first || k == nodes.last ? 0.5 : 1.0;
    model.load[6 * node + component] += share * total / (nodes.last - nodes.first);
  }
}

/// Mean displacement of the edge a = 1 under a unit load on it, the edge a = 0 clamped.
double tip_displacement(const GridShape& grid, const Surface& surface, const ShellSection& section, int component) {
  SmallModel model(shell_grid(grid, surface, section));
  for (int j = 0; j <= grid.nb; ++j) model.hold(grid_node(grid, 0, j), all_components);
  load_edge(model, grid, {GridEdge::last_column, 0, grid.nb}, component, 1.0);
  return model.load.dot(solve_small(model));
}

}  // namespace

double scordelis_lo_roof(const ShellMesh& mesh) {
  const GridShape grid{mesh.n, mesh.n, mesh.facets, false};
  SmallModel model = quarter_cylinder(grid, 25.0, 25.0, 40.0 * pi / 180.0, sheet(4.32e8, 0.0, 0.25));
  load_area(model, Vector3d(0.0, 0.0, -90.0));
  return -solve_small(model)[6 * grid_node(grid, mesh.n, mesh.n) + 2];
}

double pinched_cylinder(const ShellMesh& mesh) {
  const GridShape grid{mesh.n, mesh.n, mesh.facets, false};
  SmallModel model = quarter_cylinder(grid, 300.0, 300.0, 0.5 * pi, sheet(3e6, 0.3, 3.0));
  hold_where(model, z | rx | ry, [](const Vector3d& p) { return equal(p.z(), 0.0); });
  const int loaded = grid_node(grid, 0, mesh.n);
  model.load[6 * loaded + 2] = -0.25;
  return -solve_small(model)[6 * loaded + 2];
}

double pinched_hemisphere(const ShellMesh& mesh, double thickness) {
  const double R = 10.0;
  const GridShape grid{mesh.n, mesh.n, mesh.facets, false};
  SmallModel model(shell_grid(
      grid,
      [&](double a, double b) {
        const double p = 0.5 * pi * a, q = 0.4 * pi * b;
        return Vector3d(R * std::cos(p) * std::cos(q), R * std::sin(p) * std::cos(q), R * std::sin(q));
      },
      sheet(6.825e7, 0.3, thickness)));
  hold_where(model, y | rx | rz, [](const Vector3d& p) { return equal(p.y(), 0.0); });
  hold_where(model, x | ry | rz, [](const Vector3d& p) { return equal(p.x(), 0.0); });
  model.hold(0, z);
  model.load[0] = 1.0;
  model.load[6 * grid_node(grid, mesh.n, 0) + 1] = -1.0;
  return solve_small(model)[0];
}

double ring_opening(Facets facets, double radius_over_thickness) {
  const double t = 1.0 / radius_over_thickness, width = 0.2;
  const GridShape grid{72, 2, facets, false};
  SmallModel model(shell_grid(
      grid, [&](double a, double b) { return Vector3d(std::sin(2 * pi * a), width * b, std::cos(2 * pi * a)); },
      sheet(1.0, 0.0, t)));
  hold_where(model, all_components, [](const Vector3d& p) { return equal(p.x(), 0.0) && p.z() < 0.0; });
  const double EI = width * t * t * t / 12.0;
  for (int j = 0; j <= 2; ++j) {
    const double share = (j == 1 ? 0.5 : 0.25) * EI;
    model.load[6 * grid_node(grid, 0, j)] = share;
    model.load[6 * grid_node(grid, 72, j)] = -share;
  }
  const VectorXd u = solve_small(model);
  return u[6 * grid_node(grid, 0, 1)] - u[6 * grid_node(grid, 72, 1)];
}

double cooks_membrane(const ShellMesh& mesh) {
  const GridShape grid{mesh.n, mesh.n, mesh.facets, false};
  SmallModel model(shell_grid(
      grid, [](double a, double b) { return Vector3d(48 * a, 44 * a + b * (44 - 28 * a), 0.0); },
      sheet(1.0, 1.0 / 3.0, 1.0)));
  hold_where(model, x | y | rz, [](const Vector3d& p) { return equal(p.x(), 0.0); });
  hold_where(model, z | rx | ry, [](const Vector3d&) { return true; });
  load_edge(model, grid, {GridEdge::last_column, 0, mesh.n}, 1, 1.0);
  return solve_small(model)[6 * grid_node(grid, mesh.n, mesh.n / 2) + 1];
}

double straight_beam(const ShellMesh& mesh, Distortion distortion, TipLoad load) {
  const auto shift = [&](int column, double b) {  // of the columns of the 6 x 1 mesh
    if (column <= 0 || column >= 6 || distortion == Distortion::none) return 0.0;
    if (distortion == Distortion::parallelograms) return 0.1 * (2.0 * b - 1.0);
    return (column % 2 == 1 ? 0.1 : -0.1) * (1.0 - 2.0 * b);
  };
  const Surface surface = [&](double a, double b) {
    const int column = std::min(5, static_cast<int>(6.0 * a + 1e-9));
    const double part = 6.0 * a - column;
    return Vector3d(6.0 * a + (1.0 - part) * shift(column, b) + part * shift(column + 1, b), 0.2 * b, 0.0);
  };
  return tip_displacement({6 * mesh.n, mesh.n, mesh.facets, false}, surface, sheet(1e7, 0.3, 0.1),
                          static_cast<int>(load));
}

/// From angle 0 (clamped) to 90°; in plane: along the radius, y at the tip.
double curved_beam(const ShellMesh& mesh, TipLoad load) {
  const Surface surface = [](double a, double b) {
    const double r = 4.12 + 0.2 * b;
    return Vector3d(r * std::cos(0.5 * pi * a), r * std::sin(0.5 * pi * a), 0.0);
  };
  return tip_displacement({6 * mesh.n, mesh.n, mesh.facets, false}, surface, sheet(1e7, 0.25, 0.1),
                          static_cast<int>(load));
}

/// The tip lies in the x-z plane.
double twisted_beam(const ShellMesh& mesh, double thickness, TipLoad load) {
  const Surface surface = [](double a, double b) {
    const double width = 1.1 * (b - 0.5), angle = 0.5 * pi * a;
    return Vector3d(12.0 * a, width * std::cos(angle), width * std::sin(angle));
  };
  return tip_displacement({12 * mesh.n, 2 * mesh.n, mesh.facets, false}, surface, sheet(29e6, 0.22, thickness),
                          load == TipLoad::in_plane ? 2 : 1);
}

double plate_deflection(const ShellMesh& mesh, const RectangularPlate& plate) {
  const double half = 0.5 * plate.length;
  const bool clamped = plate.edges == PlateEdges::clamped;
  SmallModel model(shell_grid(
      {mesh.n, mesh.n, mesh.facets, false}, [&](double a, double b) { return Vector3d(a, half * b, 0.0); },
      sheet(1.7472e7, 0.3, 1e-4)));
  hold_where(model, x | y | rz, [](const Vector3d&) { return true; });
  hold_where(model, ry, [](const Vector3d& p) { return equal(p.x(), 0.0); });
  hold_where(model, rx, [](const Vector3d& p) { return equal(p.y(), 0.0); });
  hold_where(model, clamped ? all_components : z | rx, [](const Vector3d& p) { return equal(p.x(), 1.0); });
  hold_where(model, clamped ? all_components : z | ry, [&](const Vector3d& p) { return equal(p.y(), half); });
  if (plate.load == PlateLoad::force)
    model.load[2] = 1e-4;
  else
    load_area(model, Vector3d(0.0, 0.0, 1e-4));
  return solve_small(model)[2];
}

/// The length along the profile (-1,-1) (-1,0) (1,0) (1,1) in y, z is 4. Translations are held at x = 0; the forces of
/// ±0.6 MN are spread over the ends of the flanges. The edge is free, so its stress is E times its strain, here the
/// central difference over two elements.
double z_section_stress(const ShellMesh& mesh) {
  const double L = 10.0, E = 210e9;
  const GridShape grid{4 * mesh.n, 8 * mesh.n, mesh.facets, false};
  SmallModel model(shell_grid(
      grid,
      [&](double a, double b) {
        const double s = 4.0 * a;
        if (s < 1.0) return Vector3d(L * b, -1.0, s - 1.0);
        return s < 3.0 ? Vector3d(L * b, s - 2.0, 0.0) : Vector3d(L * b, 1.0, s - 3.0);
      },
      sheet(E, 0.3, 0.1)));
  hold_where(model, translations_only, [](const Vector3d& p) { return equal(p.x(), 0.0); });
  load_edge(model, grid, {GridEdge::last_row, 3 * mesh.n, 4 * mesh.n}, 2, 0.6e6);
  load_edge(model, grid, {GridEdge::last_row, 0, mesh.n}, 2, -0.6e6);
  const VectorXd u = solve_small(model);
  const auto ux = [&](int j) { return u[6 * grid_node(grid, grid.na, j)]; };
  const int place = 2 * mesh.n;
  return E * (ux(place + 1) - ux(place - 1)) / (2.0 * L / grid.nb);
}

/// The sections turn about the x axis without changing their shape at both ends and warp freely, as in the exact
/// solution (Morris; NAFEMS P12): circumferential C x/R, axial -C φ, radial 0, T = 4π D (1-ν) C/R. The turn of the far
/// end is prescribed; the displacement found is scaled to the torque that does the same work.
SlitCylinder slit_cylinder(const ShellMesh& mesh) {
  const double R = 300.0, L = 900.0, turn = 1e-3, T = 1000.0;
  const GridShape grid{16 * mesh.n, 4 * mesh.n, mesh.facets, false};
  const auto angle = [](double a) { return 2.0 * pi * (a - 0.5); };
  SmallModel model(shell_grid(
      grid, [&](double a, double b) { return Vector3d(L * b, R * std::cos(angle(a)), R * std::sin(angle(a))); },
      sheet(3e6, 0.3, 3.0)));
  for (int i = 0; i <= grid.na; ++i) {
    model.hold(grid_node(grid, i, 0), y | z | rx);
    const int node = grid_node(grid, i, grid.nb);
    model.prescribe(node, 1, -turn * model.mesh.position(2, node));
    model.prescribe(node, 2, turn * model.mesh.position(1, node));
    model.prescribe(node, 3, turn);
  }
  model.hold(grid_node(grid, grid.na / 2, 0), x);
  const VectorXd u = solve_small(model);
  const double torque = u.dot(assemble_small(model.mesh).S * u) / turn;
  const int middle = grid.nb / 2;
  const double jump = u[6 * grid_node(grid, 0, middle)] - u[6 * grid_node(grid, grid.na, middle)];
  return {0.5 * jump * T / torque, turn * R * T / torque};
}

}  // namespace tisserand::reducer
