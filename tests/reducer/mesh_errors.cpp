// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of a plate, a cylindrical panel, a block and a beam.
#include "tests/reducer/mesh_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "reducer/modes/full_model.hpp"
#include "reducer/properties/laminate.hpp"
#include "reducer/system/system.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/support/meshes/shell_grids.hpp"
#include "tests/support/meshes/solid_mesh.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Vector3d;

constexpr double E = 2.1e11, nu = 0.3, density = 7850.0;

Mesh held_at(Mesh mesh, const std::vector<Vector3d>& places) {
  for (const Vector3d& place : places)
    mesh.boundary.push_back({fmt::format("b{}", mesh.boundary.size()), node_at(mesh, place), true, false});
  return mesh;
}

using Grading = std::function<double(double)>;

double even(double a) { return a; }

constexpr int graded_cells = 80;

/// The unit interval in `graded_cells` cells, the outer ones a fraction of 0.002: where twisting moments of a sheet as
/// thick as that become shear along free edges.
double graded(double a) {
  constexpr std::array edge{0.0, 0.0003, 0.0008, 0.0015, 0.0025, 0.004, 0.0065, 0.0105, 0.017, 0.028};
  const int i = static_cast<int>(std::lround(a * graded_cells)), ends = static_cast<int>(edge.size()) - 1;
  if (i <= ends) return edge[i];
  if (i >= graded_cells - ends) return 1.0 - edge[graded_cells - i];
  return edge.back() + (1.0 - 2.0 * edge.back()) * (i - ends) / (graded_cells - 2 * ends);
}

Mesh shells(const GridShape& grid, const Surface& surface, double thickness) {
  return shell_grid(grid, surface, isotropic_shell(E, nu, density, thickness, 5.0 / 6.0));
}

/// 1 x 0.7, 0.002 thick.
Mesh plate_case(Facets facets, int n, const Grading& at) {
  return shells({n, n, facets, false}, [&](double a, double b) { return Vector3d(at(a), 0.7 * at(b), 0.0); }, 0.002);
}

/// A third of a cylinder of radius 0.5 and length 1, 0.002 thick.
Mesh panel_case(Facets facets, int n, const Grading& grading) {
  const auto at = [&](double a, double b) {
    const double angle = 2.0 * std::numbers::pi / 3.0 * grading(a);
    return Vector3d(0.5 * std::cos(angle), 0.5 * std::sin(angle), grading(b));
  };
  return shells({n, n, facets, false}, at, 0.002);
}

/// Radius 0.1, length 0.6, 0.0005 thick: n around, m along.
Mesh cylinder_case(Facets facets, int n, int m) {
  const auto at = [](double a, double b) {
    const double angle = 2.0 * std::numbers::pi * a;
    return Vector3d(0.6 * b, 0.1 * std::cos(angle), 0.1 * std::sin(angle));
  };
  return shells({n, m, facets, true}, at, 0.0005);
}

/// A ring from radius 0.05 to 0.3, 0.004 thick: 3 n around, n from edge to edge.
Mesh disc_case(Facets facets, int n) {
  const auto at = [](double a, double b) {
    const double angle = 2.0 * std::numbers::pi * a, r = 0.05 + 0.25 * b;
    return Vector3d(r * std::cos(angle), r * std::sin(angle), 0.0);
  };
  return shells({3 * n, n, facets, true}, at, 0.004);
}

/// Square, 0.1 x 0.1 x 0.6, 0.002 thick: n on each side, m along.
Mesh tube_case(Facets facets, int n, int m) {
  const auto at = [](double a, double b) {
    static constexpr std::array<std::array<double, 2>, 5> corner{{{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}, {0, 0}}};
    const int side = std::min(3, static_cast<int>(4.0 * a));
    const double share = 4.0 * a - side;
    return Vector3d(0.6 * b, (1.0 - share) * corner[side][0] + share * corner[side + 1][0],
                    (1.0 - share) * corner[side][1] + share * corner[side + 1][1]);
  };
  return shells({4 * n, m, facets, true}, at, 0.002);
}

Mesh block_of(SolidShape shape, const Vector3d& size, const std::array<int, 3>& cells) {
  return held_at(solid_block({shape, cells, size, 0.0},
                             {isotropic_solid(E, nu, density), formats::MassMatrix::consistent, "block"}),
                 {Vector3d::Zero(), Vector3d(size.x(), 0.0, 0.0), Vector3d(0.0, size.y(), 0.0)});
}

using Cells = std::array<int, 3>;

Mesh solid(SolidShape shape, const Vector3d& size, const Cells& cells) {
  return solid_block({shape, cells, size, 0.0},
                     {isotropic_solid(E, nu, density), formats::MassMatrix::consistent, "block"});
}

const char* facet_name(Facets facets) { return facets == Facets::quadrilaterals ? "4-node shells" : "3-node shells"; }

class Cases {
 public:
  std::vector<MeshErrorCase> list;

  /// Meshes of first-order solids have the cells given, of second order half as many along.
  void add_solids(const std::string& part, const Vector3d& size, const Cells& fine, const std::vector<Cells>& meshes) {
    for (const SolidShape shape : {SolidShape::hexahedron8, SolidShape::prism6, SolidShape::tetrahedron4,
                                   SolidShape::hexahedron20, SolidShape::prism15, SolidShape::tetrahedron10})
      for (Cells cells : meshes) {
        if (is_quadratic(shape)) cells[0] = std::max(1, cells[0] / 2);
        list.push_back({part, solid_name(shape), fmt::format("{} x {} x {}", cells[0], cells[1], cells[2]),
                        [=] { return solid(shape, size, cells); },
                        [=] { return solid(SolidShape::hexahedron20, size, fine); }});
      }
  }

  void add_shells(const std::string& part, const std::vector<int>& meshes, const std::string& size,
                  const std::function<Mesh(Facets, int)>& mesh, const std::function<Mesh()>& reference) {
    for (const Facets facets : {Facets::quadrilaterals, Facets::triangles})
      for (const int n : meshes)
        list.push_back({part, facet_name(facets), fmt::format(fmt::runtime(size), n), [=] { return mesh(facets, n); },
                        reference});
  }
};

/// A shape of the coarse mesh and those of the reference at the nodes that both have (2 % of the size apart at most).
Eigen::MatrixXd assurance(const MeshModes& coarse, const MeshModes& reference) {
  const Eigen::Matrix3Xd& fine = reference.mesh.position;
  const double size = (fine.rowwise().maxCoeff() - fine.rowwise().minCoeff()).norm();
  std::vector<int> rows, fine_rows;
  for (int n = 0; n < coarse.mesh.nodes(); ++n) {
    Eigen::Index at = 0;
    const double apart = (fine.colwise() - coarse.mesh.position.col(n)).colwise().squaredNorm().minCoeff(&at);
    if (std::sqrt(apart) > 0.02 * size) continue;
    for (int k = 0; k < 3; ++k) {
      rows.push_back(3 * n + k);
      fine_rows.push_back(3 * static_cast<int>(at) + k);
    }
  }
  const Eigen::MatrixXd a = coarse.translation(rows, Eigen::all).colwise().normalized();
  const Eigen::MatrixXd b = reference.translation(fine_rows, Eigen::all).colwise().normalized();
  return (a.transpose() * b).cwiseAbs2();
}

}  // namespace

std::vector<MeshErrorCase> mesh_error_cases() {
  constexpr auto quads = Facets::quadrilaterals;
  Cases cases;
  cases.add_solids("bar 200 x 20 x 10", {0.2, 0.02, 0.01}, {32, 4, 4},
                   {{16, 1, 1}, {16, 2, 1}, {16, 4, 2}, {32, 4, 4}});
  cases.add_solids("strip 400 x 100 x 10", {0.4, 0.1, 0.01}, {32, 8, 2}, {{16, 4, 1}, {32, 8, 1}, {32, 8, 2}});
  cases.add_solids("block", {1.0, 0.75, 0.25}, {12, 9, 3}, {{4, 3, 1}, {8, 6, 2}, {12, 9, 3}});
  cases.add_shells(
      "plate", {4, 8, 16}, "{0} x {0}", [](Facets f, int n) { return plate_case(f, n, even); },
      [] { return plate_case(quads, graded_cells, graded); });
  cases.add_shells(
      "curved shell", {6, 12, 24}, "{0} x {0}", [](Facets f, int n) { return panel_case(f, n, even); },
      [] { return panel_case(quads, graded_cells, graded); });
  cases.add_shells(
      "cylinder", {8, 16, 32}, "{0} x {0}", [](Facets f, int n) { return cylinder_case(f, n, n); },
      [] { return cylinder_case(quads, 96, 48); });
  cases.add_shells("disc", {2, 4, 8, 16}, "{0} across", disc_case, [] { return disc_case(quads, 40); });
  cases.add_shells(
      "square tube", {1, 2, 4, 8}, "{0} across", [](Facets f, int n) { return tube_case(f, n, 6 * n); },
      [] { return tube_case(quads, 32, 120); });
  return cases.list;
}

MeshModes free_shapes(const Mesh& mesh, int modes) {
  testing::start_solvers();
  constexpr int estimated = 5;
  const System system = build_system(mesh, "mesh");
  const formats::ModeSelection asked;
  const double first =
      full_free_modes(system, {.scale = 1e4 / (system.length * system.length), .count = 1}, asked, Count::never)->value[0];
  const FreeModes found = *full_free_modes(system, {.scale = first, .count = modes}, asked, Count::never);
  MeshModes shapes{mesh, found.value.cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi), {}, {}};
  const Eigen::MatrixXd x = expand(system.T, found.vector);
  shapes.translation.resize(3 * mesh.nodes(), x.cols());
  for (int n = 0; n < mesh.nodes(); ++n)
    shapes.translation.middleRows<3>(3 * n) = x.middleRows<3>(system.coordinates.of(n, 0));
  shapes.estimate = mesh_errors(mesh, system, {false, found.value, found.vector}, estimated);
  return shapes;
}

std::vector<ComparedError> compared_errors(const MeshModes& coarse, const MeshModes& reference) {
  constexpr double equal = 2e-3;  // frequencies of one group, whose shapes may be turned in it
  const Eigen::MatrixXd alike = assurance(coarse, reference);
  std::vector<ComparedError> result;
  for (Eigen::Index k = 0; k < coarse.estimate.relative.size(); ++k) {
    const Eigen::ArrayXd& f = reference.frequency.array();
    double most = -1.0;
    Eigen::Index mode = 0;
    for (Eigen::Index j = 0; j < alike.cols(); ++j) {
      const double share = ((f / f[j] - 1.0).abs() < equal).select(alike.row(k).transpose().array(), 0.0).sum();
      if (share > most) most = share, mode = j;
    }
    result.push_back({coarse.frequency[k] / reference.frequency[mode] - 1.0, coarse.estimate.relative[k],
                      coarse.estimate.doubts.doubt[static_cast<std::size_t>(k)]});
  }
  return result;
}

Reduction reduction_for_mesh_errors(const Mesh& mesh) {
  testing::start_solvers();
  formats::Part part;
  part.name = "part";
  part.file = "part.yaml";
  part.units = Units::si();
  part.modes.count = 30;
  return reduce_mesh(mesh, part, [](const std::string&) {});
}

Mesh plate_of_single_tetrahedra(int cells) {
  return block_of(SolidShape::tetrahedron4, {1.0, 1.0, 0.01}, {cells, cells, 1});
}

}  // namespace tisserand::reducer
