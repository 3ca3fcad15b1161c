// SPDX-License-Identifier: GPL-3.0-or-later
// Columns, strips, plates and panels with their companions, loaded and buckling in the reduced coordinates.
#include "tests/reducer/second_order/reduced_buckling.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "reducer/properties/laminate.hpp"
#include "tests/reducer/second_order/reduced_part.hpp"
#include "tests/support/meshes/buckling.hpp"
#include "tests/support/meshes/shell_grids.hpp"
#include "tests/support/meshes/solid_mesh.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::buckling_factors;
using testing::free_directions;
using testing::Preload;
using testing::reduce_with_companion;
using testing::ReducedPart;

constexpr double pi = std::numbers::pi;
constexpr double near_edge = 1e-9;

/// Lowest factor of a force along x or y at the second boundary node, which `row` names, with the rows `held` fixed.
double first_factor(const ReducedPart& part, const std::vector<int>& held, Index row, double force) {
  VectorXd load = VectorXd::Zero(part.element.size());
  load[row] = force;
  const MatrixXd Z = free_directions(part.element.size(), held);
  return buckling_factors(part, {load, Z}, Z, 1)[0];
}

const std::vector<int> base_rows{0, 1, 2, 3, 4, 5};
constexpr Index tip_x = 6, tip_y = 7;

/// Point of a square of side 1 about the origin, s from 0 to 1 around it.
Eigen::Vector2d square_point(double s) {
  const double p = 4.0 * s, q = p - std::floor(p);
  const int side = static_cast<int>(std::floor(p)) % 4;
  const std::array<Eigen::Vector2d, 4> points{{{q - 0.5, -0.5}, {0.5, q - 0.5}, {0.5 - q, 0.5}, {-0.5, 0.5 - q}}};
  return points[static_cast<std::size_t>(side)];
}

// --- plates ------------------------------------------------------------------------------------------------------

constexpr double thickness = 0.01, panel_radius = 20.0;
constexpr double plate_E = 12.0 * (1.0 - 0.09) / (thickness * thickness * thickness);  // D = 1

ShellSection plate_section() { return isotropic_shell(plate_E, 0.3, 1.0, thickness, 5.0 / 6.0); }

Mesh plate_mesh(const ShellMesh& mesh) {
  const GridShape grid{mesh.n, mesh.n, mesh.facets, false};
  return shell_grid(
      grid, [](double a, double b) { return Vector3d(a, b, 0.0); }, plate_section());
}

/// Mesh of the panel: x is axial, the arc along y goes from −b/2 to b/2.
Mesh panel_mesh(int cells) {
  const GridShape grid{cells, cells, Facets::quadrilaterals, false};
  return shell_grid(
      grid,
      [](double a, double b) {
        const double angle = (b - 0.5) / panel_radius;
        return Vector3d(a, panel_radius * std::sin(angle), panel_radius * (std::cos(angle) - 1.0));
      },
      plate_section());
}

/// Place of a node in an n x n grid.
struct EdgePlace {
  int i = 0, j = 0, n = 0;
  bool along_y() const { return i == 0 || i == n; }  ///< on an edge of constant x
  bool along_x() const { return j == 0 || j == n; }
  bool on_edge() const { return along_x() || along_y(); }
  double share() const { return (along_x() && along_y() ? 0.5 : 1.0) / n; }
};
EdgePlace place_of(int node, int n) { return {node % (n + 1), node / (n + 1), n}; }

/// Force on a node of the edges, resultant 1 per edge.
Vector3d edge_force(PlatePreload preload, const EdgePlace& at) {
  Vector3d force = Vector3d::Zero();
  const auto sign = [&](int k) { return k == at.n ? 1.0 : k == 0 ? -1.0 : 0.0; };
  if (preload == PlatePreload::compression && at.along_y()) force.x() = -sign(at.i) * at.share();
  if (preload == PlatePreload::shear) {
    if (at.along_y()) force.y() += sign(at.i) * at.share();
    if (at.along_x()) force.x() += sign(at.j) * at.share();
  }
  return force;
}

/// Translations of the nodes of the edges, in the order of their numbers.
void keep_edges(Mesh& mesh, int n) {
  for (int node = 0; node < mesh.nodes(); ++node)
    if (place_of(node, n).on_edge()) mesh.boundary.push_back({"n" + std::to_string(node), node, true, false});
}

/// Load of the edges on the rows of the boundary.
VectorXd edge_load(const Mesh& mesh, int n, PlatePreload preload, Index size) {
  VectorXd load = VectorXd::Zero(size);
  for (std::size_t b = 0; b < mesh.boundary.size(); ++b)
    load.segment<3>(static_cast<Index>(3 * b)) = edge_force(preload, place_of(mesh.boundary[b].node, n));
  return load;
}

/// Three rows that hold the rigid motions in the plane, at the corners (0, 0) and (1, 0).
std::vector<int> plane_rows(int n) { return {0, 1, 3 * n + 1}; }

// --- panels ------------------------------------------------------------------------------------------------------

/// Directions in which a node of the edges of the panel may move while it buckles, in axes x, circumference, radius.
std::array<bool, 3> panel_freedom(const EdgePlace& at) {
  if (!at.on_edge()) return {true, true, true};
  return {!at.along_x(), !at.along_y(), false};
}

/// Axes x, circumference and radius at a node.
Eigen::Matrix3d panel_axes(const EdgePlace& at) {
  const double angle = (static_cast<double>(at.j) / at.n - 0.5) / panel_radius;
  Eigen::Matrix3d axes;
  axes << 1, 0, 0, 0, std::cos(angle), std::sin(angle), 0, -std::sin(angle), std::cos(angle);
  return axes;
}

/// Directions of buckling for nodes whose translations stand at `row` of `size` coordinates; all others are free.
MatrixXd panel_directions(const std::map<int, Index>& row_of_node, int n, Index size) {
  MatrixXd axes = MatrixXd::Identity(size, size);
  std::vector<int> held;
  for (const auto& [node, row] : row_of_node) {
    const EdgePlace at = place_of(node, n);
    axes.block<3, 3>(row, row) = panel_axes(at);
    const std::array<bool, 3> free = panel_freedom(at);
    for (int k = 0; k < 3; ++k)
      if (!free[static_cast<std::size_t>(k)]) held.push_back(static_cast<int>(row) + k);
  }
  return axes * free_directions(size, held);
}

/// Rows that hold the six rigid motions: translations at (0, 0), y and z at (1, 0), z at (0, 1). The last one holds the
/// turn about the axis, since the panel is shallow.
template <class Row>
std::vector<int> panel_support(int n, const Row& row) {
  const int a = 0, b = n, c = n * (n + 1);
  return {row(a), row(a) + 1, row(a) + 2, row(b) + 1, row(b) + 2, row(c) + 2};
}

}  // namespace

Mesh slender_beam(const SlenderBeam& beam, int elements) {
  Mesh mesh;
  BeamElementData data;
  data.material = {"m", 1.0, -0.5, beam.density, ""};  // E = G = 1
  data.section.area = beam.EA;
  data.section.second_moment_y = beam.EI_y;
  data.section.second_moment_z = beam.EI_z;
  data.section.torsion_constant = beam.GJ;
  data.theory = formats::BeamTheory::euler_bernoulli;
  data.added_mass.first = data.added_mass.second = 1.0 - beam.density * beam.EA;
  data.added_mass.inertia = beam.torsional;
  mesh.beam_properties = {{data, "beam"}};
  for (int i = 0; i <= elements; ++i) testing::add_node(mesh, Vector3d(10.0 * i / elements, 0.0, 0.0));
  for (int i = 0; i < elements; ++i) testing::add_beam(mesh, i, i + 1, Vector3d::UnitY());
  mesh.boundary = {{"base", 0, true, true}, {"tip", elements, true, true}};
  return mesh;
}

std::vector<int> held_rows(ColumnEnds ends) {
  switch (ends) {
    case ColumnEnds::pinned:
      return {0, 1, 2, 3, 7, 8};
    case ColumnEnds::clamped_free:
      return base_rows;
    case ColumnEnds::clamped_pinned:
      return {0, 1, 2, 3, 4, 5, 7, 8};
    case ColumnEnds::clamped:
      break;
  }
  return {0, 1, 2, 3, 4, 5, 7, 8, 9, 10, 11};
}

double euler_factor(ColumnEnds ends) {
  return ends == ColumnEnds::pinned           ? 1.0
         : ends == ColumnEnds::clamped_free   ? 0.25
         : ends == ColumnEnds::clamped_pinned ? 2.045748
                                              : 4.0;
}

double reduced_column(ColumnEnds ends, int modes) {
  const auto part = reduce_with_companion(slender_beam({}, 40), modes);
  const double euler = euler_factor(ends) * pi * pi;  // EI/L² = 1
  return first_factor(part, held_rows(ends), tip_x, -1.0) / euler;
}

Mesh slender_strip(double EI_z) { return slender_beam({.EI_z = EI_z, .density = 1e-3 / EI_z, .torsional = 0.01}, 40); }

double reduced_strip(int modes, double EI_z) {
  const auto part = reduce_with_companion(slender_strip(EI_z), modes);
  return first_factor(part, base_rows, tip_y, 1.0) / (4.0126 * std::sqrt(100.0 * 80.0) / 100.0);
}

double reduced_box_column(int modes) {
  const double a = 0.1, t = 0.005, E = 1e9, L = 2.0;
  const GridShape grid{8, 20, Facets::quadrilaterals, true};
  const auto box = [&](double s, double x) {
    const Eigen::Vector2d p = a * square_point(s);
    return Vector3d(L * x, p.x(), p.y());
  };
  Mesh mesh = shell_grid(grid, box, isotropic_shell(E, 0.0, 1.0, t, 5.0 / 6.0));
  for (const auto& [name, x] : {std::pair{"base", 0.0}, {"tip", L}})
    testing::add_rigid_end(mesh, name,
                           nodes_where(mesh, [&](const Vector3d& X) { return std::abs(X.x() - x) < near_edge; }),
                           Vector3d(x, 0.0, 0.0));
  const double EI = E * 2.0 / 3.0 * a * a * a * t * (1.0 + t * t / (a * a)), GA = 0.5 * E * 2.0 * a * t;
  const double euler = 0.25 * pi * pi * EI / (L * L);
  return first_factor(reduce_with_companion(mesh, modes), base_rows, tip_x, -1.0) / (euler / (1.0 + euler / GA));
}

SolidColumn reduced_solid_column(SolidShape shape, int cells, int modes) {
  const double b = 0.1, E = 12.0 / std::pow(b, 4), euler = 0.25 * pi * pi, GA = 5.0 / 6.0 * 0.5 * E * b * b;
  SolidProperty property;
  property.material = isotropic_solid(E, 0.0, 1.0);
  Mesh mesh = solid_block({shape, {cells, 1, 1}, Vector3d(1.0, b, b), 0.0}, property);
  for (const auto& [name, x] : {std::pair{"base", 0.0}, {"tip", 1.0}})
    testing::add_rigid_end(mesh, name,
                           nodes_where(mesh, [&](const Vector3d& X) { return std::abs(X.x() - x) < near_edge; }),
                           Vector3d(x, 0.5 * b, 0.5 * b));
  return {first_factor(reduce_with_companion(mesh, modes), base_rows, tip_x, -1.0) / euler, 1.0 / (1.0 + euler / GA),
          0.5 * GA * (std::sqrt(1.0 + 4.0 * euler / GA) - 1.0) / euler};
}

double exact_plate(PlatePreload preload) { return preload == PlatePreload::compression ? 4.0 : 9.325; }

double full_plate(PlatePreload preload, const ShellMesh& mesh) {
  SmallModel model(plate_mesh(mesh));
  for (int node = 0; node < model.mesh.nodes(); ++node) {
    const EdgePlace at = place_of(node, mesh.n);
    if (!at.on_edge()) continue;
    model.hold(node, 0b000100);
    model.load.segment<3>(6 * node) = edge_force(preload, at);
  }
  model.hold(0, 0b000011);
  model.hold(mesh.n, 0b000010);
  return buckling_small(model, 1)[0] / (pi * pi);
}

double reduced_plate(PlatePreload preload, const ShellMesh& mesh, int modes) {
  Mesh plate = plate_mesh(mesh);
  keep_edges(plate, mesh.n);
  const auto part = reduce_with_companion(plate, modes);
  std::vector<int> held = plane_rows(mesh.n);
  for (std::size_t b = 0; b < plate.boundary.size(); ++b) held.push_back(static_cast<int>(3 * b + 2));
  const MatrixXd Z = free_directions(part.element.size(), held);
  return buckling_factors(part, {edge_load(plate, mesh.n, preload, part.element.size()), Z}, Z, 1)[0] / (pi * pi);
}

double exact_panel() { return 4.0 + plate_E * thickness / (4.0 * std::pow(pi, 4) * panel_radius * panel_radius); }

double full_panel(int cells) {
  SmallModel model(panel_mesh(cells));
  const auto n = static_cast<Index>(6 * model.mesh.nodes());
  std::map<int, Index> rows;
  for (int node = 0; node < model.mesh.nodes(); ++node) {
    rows[node] = 6 * node;
    model.load.segment<3>(6 * node) = edge_force(PlatePreload::compression, place_of(node, cells));
  }
  for (const int row : panel_support(cells, [](int node) { return 6 * node; }))
    model.hold(row / 6, static_cast<Components>(1 << row % 6));
  const VectorXd w = solve_small(model);
  const MatrixXd S = assemble_small(model.mesh).S, K_G = geometric_small(model.mesh, w);
  return buckling_factors(S, K_G, panel_directions(rows, cells, n), 1)[0] / (pi * pi);
}

double reduced_panel(int cells, int modes) {
  Mesh mesh = panel_mesh(cells);
  keep_edges(mesh, cells);
  const auto part = reduce_with_companion(mesh, modes);
  std::map<int, Index> rows;
  for (std::size_t b = 0; b < mesh.boundary.size(); ++b) rows[mesh.boundary[b].node] = static_cast<Index>(3 * b);
  const Index size = part.element.size();
  const MatrixXd preloaded =
      free_directions(size, panel_support(cells, [&](int node) { return static_cast<int>(rows.at(node)); }));
  const VectorXd load = edge_load(mesh, cells, PlatePreload::compression, size);
  return buckling_factors(part, {load, preloaded}, panel_directions(rows, cells, size), 1)[0] / (pi * pi);
}

}  // namespace tisserand::reducer
