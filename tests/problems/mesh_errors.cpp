// Meshes of a plate, a cylindrical panel, a block and a beam.
#include "tests/problems/mesh_errors.hpp"

#include <cmath>
#include <numbers>

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

/// 1 x 0.7, 0.002 thick: the layer of shear at free edges, as wide as the sheet is thick, is below the error.
Mesh plate_case(Facets facets, int n) {
  return held_at(shell_grid(
                     {n, n, facets, false}, [](double a, double b) { return Vector3d(a, 0.7 * b, 0.0); },
                     isotropic_shell(E, nu, density, 0.002, 5.0 / 6.0)),
                 {Vector3d::Zero(), Vector3d(1.0, 0.0, 0.0), Vector3d(0.0, 0.7, 0.0)});
}

/// A third of a cylinder of radius 0.5 and length 1, 0.002 thick.
Mesh panel_case(Facets facets, int n) {
  const auto at = [](double a, double b) {
    const double angle = 2.0 * std::numbers::pi / 3.0 * a;
    return Vector3d(0.5 * std::cos(angle), 0.5 * std::sin(angle), b);
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

MeshErrorCase shell_case(const std::string& part, Facets facets, int coarse, Mesh (*mesh)(Facets, int)) {
  const bool quads = facets == Facets::quadrilaterals;
  return {part, quads ? "4-node shells" : "3-node shells", fmt::format("{0} x {0}", coarse),
          [=](int n) { return mesh(facets, coarse * n); }, [=] { return mesh(Facets::quadrilaterals, 8 * coarse); }};
}

MeshErrorCase solid_case(SolidShape shape, int n) {
  return {"block", solid_name(shape), fmt::format("{} x {} x {}", 4 * n, 3 * n, n),
          [=](int finer) { return block_case(shape, finer * n); },
          [] { return block_case(SolidShape::hexahedron20, 3); }};
}

}  // namespace

std::vector<MeshErrorCase> mesh_error_cases() {
  return {shell_case("plate", Facets::quadrilaterals, 8, plate_case),
          shell_case("plate", Facets::triangles, 8, plate_case),
          shell_case("curved shell", Facets::quadrilaterals, 12, panel_case),
          shell_case("curved shell", Facets::triangles, 12, panel_case),
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

Mesh plate_of_single_tetrahedra(int cells) {
  return block_of(SolidShape::tetrahedron4, {1.0, 1.0, 0.01}, {cells, cells, 1});
}

}  // namespace tisserand::reducer
