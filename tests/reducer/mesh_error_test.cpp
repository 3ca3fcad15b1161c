// SPDX-License-Identifier: GPL-3.0-or-later
// Estimated discretisation error of the lowest frequencies: zero for exact solutions, else of the size of the error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "reducer/elements/element_matrices.hpp"
#include "reducer/elements/mesh_error.hpp"
#include "reducer/mesh_error/patches.hpp"
#include "reducer/mesh_error/smooth_stress.hpp"
#include "reducer/mesh_error/surround.hpp"
#include "reducer/properties/laminate.hpp"
#include "reducer/report/certificate.hpp"
#include "tests/reducer/mesh_errors.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/support/meshes/shell_grids.hpp"
#include "tests/support/meshes/solid_mesh.hpp"

namespace tisserand::testing::mesh_error_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using reducer::Mesh;
using reducer::SolidShape;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr SolidShape all_shapes[] = {SolidShape::tetrahedron4, SolidShape::tetrahedron10, SolidShape::hexahedron8,
                                     SolidShape::hexahedron20, SolidShape::prism6,        SolidShape::prism15};

reducer::SolidProperty steel(formats::MassMatrix mass) {
  return {reducer::isotropic_solid(2.1e11, 0.3, 7850.0), mass, "block"};
}

/// Sums over the elements: energy_error without and with the layers at the edges of shells, and uᵀ S u of the
/// displacements of the nodes, 6 rows each.
struct Energies {
  double error = 0.0, with_layers = 0.0, energy = 0.0;
};

Energies energies(const Mesh& mesh, const MatrixXd& motion) {
  const reducer::SmoothStress smooth(mesh, motion);
  const VectorXd none = VectorXd::Zero(1);
  Energies sum;
  reducer::ElementMatrices matrices;
  for (int e = 0; e < static_cast<int>(mesh.solids.size()); ++e) {
    const MatrixXd u = motion_of(mesh.solids[e], motion);
    element_matrices(mesh, mesh.solids[e], matrices);
    sum.error += energy_error(mesh, mesh.solids[e], {u, none}, smooth.of_solid(e))[0];
    sum.energy += (u.transpose() * matrices.S * u)(0, 0);
  }
  for (int e = 0; e < static_cast<int>(mesh.shells.size()); ++e) {
    const MatrixXd u = motion_of(mesh.shells[e], motion);
    element_matrices(mesh, mesh.shells[e], matrices);
    const MatrixXd stress = smooth.of_shell(e);
    sum.error += energy_error(mesh, mesh.shells[e], {u, none}, stress, {})[0];
    sum.with_layers += energy_error(mesh, mesh.shells[e], {u, none}, stress, smooth.around(e))[0];
    sum.energy += (u.transpose() * matrices.S * u)(0, 0);
  }
  return sum;
}

MatrixXd linear_field(const Mesh& mesh) {
  Eigen::Matrix3d H;
  H << 3, 1, -2, 0.5, -1, 4, 2, -3, 1.5;
  MatrixXd motion = MatrixXd::Zero(6 * mesh.nodes(), 1);
  for (int n = 0; n < mesh.nodes(); ++n) motion.block<3, 1>(6 * n, 0) = H * mesh.position.col(n);
  return motion;
}

/// Linear displacements have constant stress and are in the space of every element: no error on any mesh (patch test).
TEST(MeshError, ConstantStressHasNone) {
  for (const SolidShape shape : all_shapes) {
    const Mesh mesh = solid_block({shape, {3, 2, 2}, Vector3d(3, 2, 2), 0.2}, steel(formats::MassMatrix::consistent));
    const Energies found = energies(mesh, linear_field(mesh));
    EXPECT_LT(std::abs(found.error), 1e-12 * found.energy) << reducer::solid_name(shape);
  }
}

/// u_x = x²: of the strain 2x, trilinear bricks of size 1 miss 2(x − m), m in their middle. Per area, the error is
/// Σ ∫ 4(x − m)² = n/3 and the energy Σ (2m)² = Σ (2k + 1)² = n(4n² − 1)/3. Linear patches recover 2x except from
/// samples a fifth of the way to the corners, where bricks have their middles' stress. Slopes at the ends are
/// 1/(1 + 0.2²) of it.
TEST(MeshError, LinearStressIsRecovered) {
  const int n = 6;
  Mesh mesh =
      solid_block({SolidShape::hexahedron8, {n, 3, 3}, Vector3d(n, 3, 3), 0.0}, steel(formats::MassMatrix::consistent));
  mesh.solid_properties[0].material = reducer::isotropic_solid(1.0, 0.0, 1.0);  // nothing across
  MatrixXd motion = MatrixXd::Zero(6 * mesh.nodes(), 1);
  for (int k = 0; k < mesh.nodes(); ++k) motion(6 * k, 0) = std::pow(mesh.position(0, k), 2);
  const Energies found = energies(mesh, motion);
  EXPECT_NEAR(found.error / found.energy, 1.0 / (4.0 * n * n - 1.0), 0.04 / (4.0 * n * n - 1.0));
}

/// A flat sheet with constant curvature and twist has no error, whatever the directions of its elements' axes and
/// normals.
TEST(MeshError, ConstantCurvatureOfASheetHasNone) {
  for (const reducer::Facets facets : {reducer::Facets::quadrilaterals, reducer::Facets::triangles}) {
    Mesh mesh = shell_grid(
        {4, 3, facets, false}, [](double a, double b) { return Vector3d(2 * a, b + 0.3 * a, 0.0); },
        reducer::isotropic_shell(1e6, 0.3, 1.0, 0.05, 5.0 / 6.0));
    for (std::size_t e = 0; e < mesh.shells.size(); e += 2) std::swap(mesh.shells[e].nodes[0], mesh.shells[e].nodes[2]);
    MatrixXd motion = MatrixXd::Zero(6 * mesh.nodes(), 1);
    for (int k = 0; k < mesh.nodes(); ++k) {  // w = x²/2 + x y/3 − y²/5, θ = (w,y, −w,x)
      const double x = mesh.position(0, k), y = mesh.position(1, k);
      motion(6 * k + 2, 0) = 0.5 * x * x + x * y / 3.0 - 0.2 * y * y;
      motion(6 * k + 3, 0) = x / 3.0 - 0.4 * y;
      motion(6 * k + 4, 0) = -(x + y / 3.0);
    }
    const Energies found = energies(mesh, motion);
    EXPECT_LT(std::abs(found.error), 1e-10 * found.energy) << static_cast<int>(facets);
  }
}

/// w = x y: M_ns = 2 D_s at all edges, D_s = D (1 − ν)/2; with M_ns (1 − e^(−y/δ)) and the shear −M_ns e^(−y/δ)/δ in
/// equilibrium with it a free edge is softer by ∫ M_ns² e^(−2y/δ) (1/D_s + 1/(A_s δ²)) dy = M_ns² δ/D_s for δ² =
/// D_s/A_s.
TEST(MeshError, FreeEdgesOfATwistedSheetAreSofterByTheLayer) {
  const double t = 0.05, D_s = 1e6 * t * t * t / 12.0 / (1.0 - 0.09) * 0.35, A_s = 5.0 / 6.0 * 1e6 / 2.6 * t;
  const Mesh mesh = shell_grid(
      {4, 3, reducer::Facets::quadrilaterals, false}, [](double a, double b) { return Vector3d(2 * a, b, 0.0); },
      reducer::isotropic_shell(1e6, 0.3, 1.0, t, 5.0 / 6.0));
  MatrixXd motion = MatrixXd::Zero(6 * mesh.nodes(), 1);
  for (int k = 0; k < mesh.nodes(); ++k) {
    const double x = mesh.position(0, k), y = mesh.position(1, k);
    motion.block<3, 1>(6 * k + 2, 0) = Vector3d(x * y, x, -y);
  }
  const double edge = 4.0 * D_s * std::sqrt(D_s / A_s), perimeter = 6.0;
  EXPECT_NEAR(energies(mesh, motion).with_layers, perimeter * edge, 1e-9 * edge);
}

/// Patches end at a fold, at a web and where the property changes; not where a normal is turned round.
TEST(MeshError, PatchesEndWhereStressesJump) {
  const auto sheet = [](double angle) {
    return shell_grid(
        {2, 1, reducer::Facets::quadrilaterals, false},
        [angle](double a, double b) {
          const double beyond = std::max(a - 0.5, 0.0);
          return Vector3d(std::min(a, 0.5) + beyond * std::cos(angle), b, beyond * std::sin(angle));
        },
        reducer::isotropic_shell(1e6, 0.3, 1.0, 0.05, 5.0 / 6.0));
  };
  EXPECT_EQ(reducer::stress_patches(sheet(0.4)).patch.size(), 6u);
  EXPECT_EQ(reducer::stress_patches(sheet(0.6)).patch.size(), 8u);  // 34 degrees
  Mesh mesh = sheet(0.0);
  mesh.shell_properties.push_back(mesh.shell_properties[0]);
  mesh.shells[1].property = 1;
  EXPECT_EQ(reducer::stress_patches(mesh).patch.size(), 8u);
  mesh = sheet(0.0);
  std::swap(mesh.shells[1].nodes[1], mesh.shells[1].nodes[3]);
  EXPECT_EQ(reducer::stress_patches(mesh).patch.size(), 6u);
}

/// Inertia between the ends of Euler-Bernoulli beams makes pinned frequencies (βh)⁴/1440 too high ([Prz68]; the Hermite
/// element, frequencies_test.cpp); free ends have another constant near the ends only.
TEST(MeshError, OfBeamsIsThatOfTheHermiteElement) {
  formats::Part part = plain_beam(Vector3d::Zero(), Vector3d(1.7, 0, 0), 16, 30);
  set_theory(part, formats::BeamTheory::euler_bernoulli);
  formats::Part fine = plain_beam(Vector3d::Zero(), Vector3d(1.7, 0, 0), 128, 30);
  set_theory(fine, formats::BeamTheory::euler_bernoulli);
  const reducer::Reduction coarse = reduce(part), exact = reduce(fine);
  ASSERT_EQ(coarse.model.mesh_error.error.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    const double error = coarse.model.mesh_error.frequency[k] / exact.model.mesh_error.frequency[k] - 1.0;
    EXPECT_GT(coarse.model.mesh_error.error[k] / error, 0.3) << k;
    EXPECT_LT(coarse.model.mesh_error.error[k] / error, 3.0) << k;
  }
}

/// Requirement: a known estimate is within a factor of two of the error, and over 40 % are known on meshes that are
/// coarse on purpose. References are other meshes and elements (docs/VERIFICATION.md has the figures).
TEST(MeshError, IsWithinAFactorOfTwoOrUnknown) {
  std::string part;
  reducer::MeshModes reference;
  int known = 0, all = 0;
  for (const reducer::MeshErrorCase& one : reducer::mesh_error_cases()) {
    if (one.part != part) reference = reducer::free_shapes(one.reference(), 16);
    part = one.part;
    for (const reducer::ComparedError& mode : compared_errors(reducer::free_shapes(one.mesh(), 6), reference)) {
      ++all;
      if (mode.doubt != reducer::MeshDoubt::none) continue;
      ++known;
      if (!mode.compared()) continue;
      EXPECT_GT(mode.estimate / mode.error, 0.5) << one.part << ", " << one.element << ", " << one.size;
      EXPECT_LT(mode.estimate / mode.error, 2.0) << one.part << ", " << one.element << ", " << one.size;
    }
  }
  EXPECT_GT(known, 0.4 * all) << "the cases are coarse on purpose";
}

int known_of(const Mesh& mesh) {
  const auto& doubt = reducer::free_shapes(mesh, 6).estimate.doubts.doubt;
  return static_cast<int>(std::count(doubt.begin(), doubt.end(), reducer::MeshDoubt::none));
}

/// Ordinary meshes have known estimates for all five modes.
TEST(MeshError, IsKnownOnOrdinaryMeshes) {
  int least = 5;
  for (const reducer::MeshErrorCase& one : reducer::mesh_error_cases()) {
    const bool quads = one.element == "4-node shells", bricks = one.element == "hexahedron8";
    const bool fine = (quads && one.part == "plate" && one.size == "16 x 16") ||
                      (quads && one.part == "cylinder" && one.size == "32 x 32") ||
                      (quads && one.part == "disc" && (one.size == "8 across" || one.size == "16 across")) ||
                      (quads && one.part == "square tube" && one.size == "8 across") ||
                      (bricks && (one.size == "16 x 4 x 2" || one.size == "32 x 4 x 4" || one.size == "12 x 9 x 3"));
    if (fine) {
      EXPECT_EQ(known_of(one.mesh()), 5) << one.part << ", " << one.element << ", " << one.size;
    }
    if (fine) least = std::min(least, known_of(one.mesh()));
  }
  EXPECT_EQ(least, 5);
}

/// Trial torsion_bricks: torsion of 16 x 2 x 1 bricks errs by 8.1 % (the table), where the estimate once was 0.4 %.
TEST(MeshError, TorsionOfAFewBricksAcrossIsUnknown) {
  Mesh mesh = solid_block({SolidShape::hexahedron8, {16, 2, 1}, Vector3d(0.2, 0.02, 0.01), 0.0},
                          steel(formats::MassMatrix::consistent));
  for (const Vector3d& place : {Vector3d(0, 0, 0), Vector3d(0.2, 0, 0), Vector3d(0, 0.02, 0)})
    mesh.boundary.push_back({"b" + std::to_string(mesh.boundary.size()), node_at(mesh, place), true, false});
  const reducer::Reduction bar = reducer::reduction_for_mesh_errors(mesh);
  const reducer::MeshCertificate& c = bar.model.mesh_error;
  ASSERT_EQ(c.error.size(), 5u);
  EXPECT_TRUE(std::isnan(c.error[3]));
  EXPECT_THAT(c.unknown[3], HasSubstr("free faces"));
  EXPECT_TRUE(c.unknown[0].empty());
  EXPECT_THAT(bar.model.warnings, ::testing::Contains(AllOf(HasSubstr("unknown"), HasSubstr("may exceed 5 %"))));
  const std::string text = reducer::certificate_text(bar.superelement, bar.file, bar.model);
  EXPECT_THAT(text, AllOf(HasSubstr(", unknown, "), HasSubstr("unknown for mode 4: smoothed stresses")));
  EXPECT_THAT(reducer::certificate_json(bar.superelement, bar.file, bar.model), HasSubstr("null"));
}

/// Slopes of a cylinder's facets are ± half of the turn per facet. Free edges of a disc bow by a twelfth of length
/// times turn.
TEST(MeshError, CurvedSurfacesAndEdgesAreSeenFromTheNodes) {
  constexpr int around = 24;
  const double turn = 2.0 * std::numbers::pi / around;
  const auto section = reducer::isotropic_shell(1e6, 0.3, 1.0, 0.05, 5.0 / 6.0);
  const Mesh cylinder = shell_grid(
      {around, 4, reducer::Facets::quadrilaterals, true},
      [](double a, double b) {
        return Vector3d(b, std::cos(2 * std::numbers::pi * a), std::sin(2 * std::numbers::pi * a));
      },
      section);
  for (const reducer::ShellSurround& one : reducer::surroundings(cylinder, reducer::stress_patches(cylinder))) {
    EXPECT_NEAR(one.slope.colwise().norm().mean(), std::tan(0.5 * turn), 1e-12);
    for (const double bow : one.bow) EXPECT_NEAR(bow, 0.0, 1e-15) << "ends of a cylinder are straight in its surface";
  }
  const Mesh disc = shell_grid(
      {around, 3, reducer::Facets::quadrilaterals, true},
      [](double a, double b) {
        return Vector3d((1 + b) * std::cos(2 * std::numbers::pi * a), (1 + b) * std::sin(2 * std::numbers::pi * a),
                        0.0);
      },
      section);
  std::vector<double> bows;
  for (const reducer::ShellSurround& one : reducer::surroundings(disc, reducer::stress_patches(disc)))
    for (const double bow : one.bow)
      if (bow != 0.0) bows.push_back(bow);
  ASSERT_EQ(bows.size(), 2u * around);
  const auto [least, most] = std::minmax_element(bows.begin(), bows.end());
  EXPECT_NEAR(*most, 2.0 * 2.0 * std::sin(0.5 * turn) * turn / 12.0, 1e-12) << "outside material is missing";
  EXPECT_NEAR(*least, -2.0 * std::sin(0.5 * turn) * turn / 12.0, 1e-12) << "at the hole there is too much";
}

/// One first-order tetrahedron across a plate makes bending several times too stiff. A warning names the remedy.
TEST(MeshError, OneTetrahedronThroughAPlateIsReportedWithItsRemedy) {
  const reducer::Reduction plate = reducer::reduction_for_mesh_errors(reducer::plate_of_single_tetrahedra(12));
  std::vector<std::string> reported;
  for (const std::string& warning : plate.model.warnings)
    if (warning.find("too coarse") != std::string::npos) reported.push_back(warning);
  ASSERT_EQ(reported.size(), 1u);
  EXPECT_THAT(reported[0], AllOf(HasSubstr("'block'"), HasSubstr("`size`"), HasSubstr("`order: 2`")));
}

/// A warning reports an accuracy that the mesh does not reach.
TEST(MeshError, BeyondTheAccuracyAskedForIsReported) {
  formats::Part part = plain_beam(Vector3d::Zero(), Vector3d(1.7, 0, 0), 8, 0);
  const auto warned = [&](double error) {
    part.modes.accuracy = formats::Accuracy{error, 1000.0};
    const reducer::Reduction reduction = reduce(part);
    return std::any_of(reduction.model.warnings.begin(), reduction.model.warnings.end(),
                       [](const std::string& w) { return w.find("requested: ") != std::string::npos; });
  };
  EXPECT_FALSE(warned(0.05));
  EXPECT_TRUE(warned(1e-5));
}

}  // namespace
}  // namespace tisserand::testing::mesh_error_test
