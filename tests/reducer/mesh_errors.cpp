// Meshes of a plate, a cylindrical panel, a block and a beam.
#include "tests/reducer/mesh_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "reducer/properties/laminate.hpp"
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

/// 1 x 0.7, 0.002 thick.
Mesh plate_case(Facets facets, int n, const Grading& at) {
  return held_at(shell_grid(
                     {n, n, facets, false}, [&](double a, double b) { return Vector3d(at(a), 0.7 * at(b), 0.0); },
                     isotropic_shell(E, nu, density, 0.002, 5.0 / 6.0)),
                 {Vector3d::Zero(), Vector3d(1.0, 0.0, 0.0), Vector3d(0.0, 0.7, 0.0)});
}

/// A third of a cylinder of radius 0.5 and length 1, 0.002 thick.
Mesh panel_case(Facets facets, int n, const Grading& grading) {
  const auto at = [&](double a, double b) {
    const double angle = 2.0 * std::numbers::pi / 3.0 * grading(a);
    return Vector3d(0.5 * std::cos(angle), 0.5 * std::sin(angle), grading(b));
  };
  return held_at(shell_grid({n, n, facets, false}, at, isotropic_shell(E, nu, density, 0.002, 5.0 / 6.0)),
                 {at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)});
}

Mesh block_of(SolidShape shape, const Vector3d& size, const std::array<int, 3>& cells) {
  return held_at(solid_block({shape, cells, size, 0.0},
                             {isotropic_solid(E, nu, density), formats::MassMatrix::consistent, "block"}),
                 {Vector3d::Zero(), Vector3d(size.x(), 0.0, 0.0), Vector3d(0.0, size.y(), 0.0)});
}

Mesh block_case(SolidShape shape, int n) { return block_of(shape, {1.0, 0.75, 0.25}, {4 * n, 3 * n, n}); }

MeshErrorCase shell_case(const std::string& part, Facets facets, int coarse,
                         Mesh (*mesh)(Facets, int, const Grading&)) {
  return {part, facets == Facets::quadrilaterals ? "4-node shells" : "3-node shells", fmt::format("{0} x {0}", coarse),
          [=] { return mesh(facets, coarse, even); },
          [=] { return mesh(Facets::quadrilaterals, graded_cells, graded); }};
}

MeshErrorCase solid_case(SolidShape shape, int n) {
  return {"block", solid_name(shape), fmt::format("{} x {} x {}", 4 * n, 3 * n, n),
          [=] { return block_case(shape, n); }, [] { return block_case(SolidShape::hexahedron20, 3); }};
}

}  // namespace

std::vector<MeshErrorCase> mesh_error_cases() {
  return {shell_case("plate", Facets::quadrilaterals, 16, plate_case),
          shell_case("plate", Facets::triangles, 16, plate_case),
          shell_case("curved shell", Facets::quadrilaterals, 24, panel_case),
          shell_case("curved shell", Facets::triangles, 24, panel_case),
          solid_case(SolidShape::tetrahedron4, 3),
          solid_case(SolidShape::hexahedron8, 2),
          solid_case(SolidShape::prism6, 3),
          solid_case(SolidShape::tetrahedron10, 1),
          solid_case(SolidShape::hexahedron20, 1),
          solid_case(SolidShape::prism15, 1)};
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

std::vector<ComparedError> compared_errors(const MeshCertificate& coarse, const std::vector<double>& exact) {
  const auto corrected = [&](std::size_t k) { return coarse.frequency[k] / (1.0 + coarse.error[k]); };
  std::vector<std::size_t> order(coarse.error.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return corrected(a) < corrected(b); });
  std::vector<ComparedError> result;
  for (std::size_t k = 0; k < order.size(); ++k)
    result.push_back({coarse.frequency[order[k]] / exact[k] - 1.0, coarse.error[order[k]]});
  return result;
}

Mesh plate_of_single_tetrahedra(int cells) {
  return block_of(SolidShape::tetrahedron4, {1.0, 1.0, 0.01}, {cells, cells, 1});
}

}  // namespace tisserand::reducer
