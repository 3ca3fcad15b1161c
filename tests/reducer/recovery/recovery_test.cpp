// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes and stresses of recovery files: rigid motions, states of constant stress and of bending, beams, modes and
// statics of the full model.
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "reducer/properties/laminate.hpp"
#include "reducer/properties/solid_material.hpp"
#include "reducer/sources/build_mesh.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/recovery/recovered.hpp"
#include "tests/support/meshes/shell_grids.hpp"
#include "tests/support/meshes/small_model.hpp"
#include "tests/support/meshes/solid_mesh.hpp"

namespace tisserand::testing::recovery_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::RecoveryField;
using reducer::Mesh;
using Motion = Eigen::Matrix<double, 6, 1>;

constexpr double E = 2.1e11, nu = 0.3;

/// Small rigid motion: translation t and rotation w about the origin.
Motion rigid(const Vector3d& X) {
  const Vector3d t(0.3, -0.2, 0.5), w(0.1, 0.4, -0.2);
  Motion motion;
  motion << t + w.cross(X), w;
  return motion;
}

/// A square plate of n x n elements turned in space, its two edges across a = const at the boundary.
Mesh plate(reducer::Facets facets, int n, const Eigen::Matrix3d& R) {
  const reducer::GridShape grid{n, n, facets, false};
  Mesh mesh = reducer::shell_grid(
      grid, [&](double a, double b) -> Vector3d { return R * Vector3d(a + 0.1 * a * (1 - a) * b, b, 0.0); },
      reducer::isotropic_shell(E, nu, 7800.0, 0.02, 5.0 / 6.0));
  std::vector<int> edges;
  for (int j = 0; j <= n; ++j)
    edges.insert(edges.end(), {reducer::grid_node(grid, 0, j), reducer::grid_node(grid, n, j)});
  set_boundary(mesh, edges, true);
  return mesh;
}

Mesh block(reducer::SolidShape shape, double poisson, double distortion) {
  Mesh mesh = reducer::solid_block({shape, {2, 2, 2}, {2.0, 1.0, 0.8}, distortion},
                                   {reducer::isotropic_solid(E, poisson, 7800.0), {}, "body"});
  std::vector<int> ends;
  for (int n = 0; n < mesh.nodes(); ++n)
    if (std::abs(mesh.position(0, n)) < 1e-12 || std::abs(mesh.position(0, n) - 2.0) < 1e-12) ends.push_back(n);
  set_boundary(mesh, ends, false);
  return mesh;
}

Mesh frame() { return reducer::build_mesh(space_frame(0)); }

const Eigen::Matrix3d skew_axes =
    (Eigen::AngleAxisd(0.7, Vector3d::UnitZ()) * Eigen::AngleAxisd(-0.4, Vector3d::UnitY())).toRotationMatrix();

// The largest stress of a unit of a coordinate is what round-off is measured with; 1e-9 is that of the condensation.
TEST(Recovery, RigidMotionsMoveAllNodesRigidlyWithoutStress) {
  Mesh shells = plate(reducer::Facets::quadrilaterals, 4, skew_axes);
  reducer::Spider spider;
  spider.kind = reducer::SpiderKind::averaging;
  spider.reference = shells.nodes();
  spider.nodes = {6, 7, 8, 11, 12, 13};
  spider.weight.assign(6, 1.0);
  spider.name = "hub";
  shells.position.conservativeResize(3, shells.nodes() + 1);
  shells.position.rightCols<1>() = Vector3d(0.5, 0.4, 0.3);
  shells.node_label.push_back("hub");
  shells.spiders.push_back(spider);
  shells.boundary.push_back({"hub", spider.reference, true, true});
  for (const Mesh& mesh : {frame(), shells, block(reducer::SolidShape::tetrahedron10, nu, 0.2)}) {
    const Recovered r = recovered(mesh, 3);
    const VectorXd y = boundary_motion(r, rigid);
    const VectorXd u = r.of(RecoveryField::translation) * y, theta = r.of(RecoveryField::rotation) * y;
    for (int n = 0; n < mesh.nodes(); ++n) {
      const Motion expected = rigid(mesh.position.col(n));
      EXPECT_LT((u.segment<3>(3 * n) - expected.head<3>()).norm(), 1e-9);
      const Vector3d turn =
          r.tables.rotates[static_cast<std::size_t>(n)] != 0 ? Vector3d(expected.tail<3>()) : Vector3d::Zero();
      EXPECT_LT((theta.segment<3>(3 * n) - turn).norm(), 1e-9);
    }
    for (const RecoveryField field :
         {RecoveryField::beam_force, RecoveryField::shell_stress, RecoveryField::solid_stress}) {
      const MatrixXd& stress = r.of(field);
      if (stress.rows() == 0) continue;
      EXPECT_LT((stress * y).cwiseAbs().maxCoeff(), 1e-9 * stress.cwiseAbs().maxCoeff());
      // As files have it: each value rounded by 6e-8, some ten of them summed.
      const VectorXd rounded = stress.cast<float>().cast<double>() * y;
      EXPECT_LT(rounded.cwiseAbs().maxCoeff(), 1e-6 * stress.cwiseAbs().maxCoeff());
    }
  }
}

// Statics of the boundary are exact: displacements inside equal those of the unreduced model.
TEST(Recovery, DisplacementsInsideAreThoseOfTheFullModel) {
  for (const Mesh& mesh : {frame(), plate(reducer::Facets::triangles, 4, skew_axes)}) {
    const Recovered r = recovered(mesh, 0);
    reducer::SmallModel model(mesh);
    const auto motion = [](const Vector3d& X) {
      Motion m;
      m << std::sin(3.0 * X.x()), X.y() * X.z(), std::cos(X.x() - X.y()), 0.2 * X.x(), -0.1, X.z();
      return Motion(1e-3 * m);
    };
    for (const reducer::MeshBoundary& b : mesh.boundary)
      for (int c = 0; c < 6; ++c) model.prescribe(b.node, c, motion(mesh.position.col(b.node))[c]);
    const VectorXd full = reducer::solve_small(model), y = boundary_motion(r, motion);
    const VectorXd u = r.of(RecoveryField::translation) * y, theta = r.of(RecoveryField::rotation) * y;
    for (int n = 0; n < mesh.nodes(); ++n) {
      EXPECT_LT((u.segment<3>(3 * n) - full.segment<3>(6 * n)).norm(), 1e-9 * full.cwiseAbs().maxCoeff());
      EXPECT_LT((theta.segment<3>(3 * n) - full.segment<3>(6 * n + 3)).norm(), 1e-9 * full.cwiseAbs().maxCoeff());
    }
  }
}

// MAC against modes_small() of the held model, frequencies there to 1e-9, vectors to its square root.
TEST(Recovery, InternalShapesAreTheModesOfTheHeldModel) {
  const Mesh mesh = plate(reducer::Facets::quadrilaterals, 5, skew_axes);
  const Recovered r = recovered(mesh, 4);
  reducer::SmallModel model(mesh);
  for (const reducer::MeshBoundary& b : mesh.boundary) model.hold(b.node, reducer::all_components);
  const reducer::SmallModes modes = reducer::modes_small(model, 4, 0.0);
  const Index first = r.tables.coordinates() - 4;
  for (Index k = 0; k < 4; ++k) {
    VectorXd expected(3 * mesh.nodes());
    for (int n = 0; n < mesh.nodes(); ++n) expected.segment<3>(3 * n) = modes.shape.col(k).segment<3>(6 * n);
    const VectorXd shape = r.of(RecoveryField::translation).col(first + k);
    const double product = shape.dot(expected);
    EXPECT_NEAR(product * product / (shape.squaredNorm() * expected.squaredNorm()), 1.0, 1e-8) << k;
    EXPECT_NEAR(shape.norm() / expected.norm(), 1.0, 1e-4) << k;  // both have unit modal mass
  }
}

// σ = E ε with free sides; the elements pass the patch test, distorted or not.
TEST(Recovery, SolidsInTensionHaveTheStressOfTheBar) {
  for (const reducer::SolidShape shape : reducer::all_solid_shapes) {
    const Recovered r = recovered(block(shape, nu, reducer::is_quadratic(shape) ? 0.0 : 0.2), 0);
    const VectorXd y = boundary_motion(r, [](const Vector3d& X) {
      Motion m = Motion::Zero();
      m.head<3>() = 1e-3 * Vector3d(X.x(), -nu * X.y(), -nu * X.z());
      return m;
    });
    const VectorXd stress = r.of(RecoveryField::solid_stress) * y;
    ASSERT_GT(r.tables.stress_points(), 0);
    for (Index p = 0; p < r.tables.stress_points(); ++p) {
      Eigen::Matrix<double, 6, 1> expected = Eigen::Matrix<double, 6, 1>::Zero();
      expected[0] = 1e-3 * E;
      EXPECT_LT((stress.segment<6>(6 * p) - expected).norm(), 1e-9 * E * 1e-3) << reducer::solid_name(shape);
    }
  }
}

// Pure bending u = κ(xz, 0, −x²/2) with ν = 0: σxx = E κ z at every node, also on the surface. Quadratic elements and
// the brick with incompatible displacements contain it.
TEST(Recovery, SolidsInBendingHaveTheStressOfTheSurface) {
  const double kappa = 1e-3;
  for (const reducer::SolidShape shape : {reducer::SolidShape::hexahedron8, reducer::SolidShape::hexahedron20,
                                          reducer::SolidShape::tetrahedron10, reducer::SolidShape::prism15}) {
    const Recovered r = recovered(block(shape, 0.0, 0.0), 0);
    const VectorXd y = boundary_motion(r, [&](const Vector3d& X) {
      Motion m = Motion::Zero();
      m.head<3>() = kappa * Vector3d(X.x() * X.z(), 0.0, -0.5 * X.x() * X.x());
      return m;
    });
    const VectorXd stress = r.of(RecoveryField::solid_stress) * y;
    for (Index p = 0; p < r.tables.stress_points(); ++p) {
      const double z = r.tables.position(2, r.tables.stress_node[static_cast<std::size_t>(p)]);
      EXPECT_NEAR(stress[6 * p], E * kappa * z, 1e-8 * E * kappa) << reducer::solid_name(shape);
    }
  }
}

/// xx, yy, xy of the shell turned to the axes of the plate, in which x is the direction of the load.
Eigen::Matrix2d in_plate_axes(const Recovered& r, Index shell, const Eigen::Matrix3d& R, const Vector3d& components) {
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  tensor.topLeftCorner<2, 2>() << components[0], components[2], components[2], components[1];
  const Eigen::Matrix3d turn = R.transpose() * r.tables.shell_axes[static_cast<std::size_t>(shell)];
  return (turn * tensor * turn.transpose()).topLeftCorner<2, 2>();
}

// Tension ε and bending κ with anticlastic curvature: membrane E ε, bending ± E κ t/2 on the faces, nothing else.
TEST(Recovery, ShellsInTensionAndBendingHaveTheStressesOfBothFaces) {
  const double strain = 1e-4, kappa = 3e-2, t = 0.02;
  for (const reducer::Facets facets : {reducer::Facets::quadrilaterals, reducer::Facets::triangles}) {
    const Recovered r = recovered(plate(facets, 4, skew_axes), 0);
    const VectorXd y = boundary_motion(r, [&](const Vector3d& place) {
      const Vector3d X = skew_axes.transpose() * place;
      const Vector3d slope(-kappa * X.x(), nu * kappa * X.y(), 0.0);  // of w = -κ (x² − ν y²)/2
      const Vector3d u(strain * X.x(), -nu * strain * X.y(), -0.5 * kappa * (X.x() * X.x() - nu * X.y() * X.y()));
      Motion m;
      m << skew_axes * u, skew_axes * Vector3d(slope.y(), -slope.x(), 0.0);
      return m;
    });
    const VectorXd stress = r.of(RecoveryField::shell_stress) * y;
    for (Index s = 0; s < r.tables.shells(); ++s) {
      const Eigen::Matrix2d membrane = in_plate_axes(r, s, skew_axes, stress.segment<3>(6 * s));
      const Eigen::Matrix2d bending = in_plate_axes(r, s, skew_axes, stress.segment<3>(6 * s + 3));
      Eigen::Matrix2d unit = Eigen::Matrix2d::Zero();
      unit(0, 0) = 1.0;
      EXPECT_LT((membrane - E * strain * unit).norm(), 1e-7 * E * strain);
      EXPECT_LT((bending - 0.5 * E * kappa * t * unit).norm(), 1e-7 * E * kappa * t);
    }
  }
}

// A cantilever with the tip force P: N = P_x, V = P, M from the lever arm, in element axes, exact at every section.
TEST(Recovery, BeamsHaveTheForcesOfStatics) {
  const Vector3d from(0.1, 0.2, -0.3), to(1.1, 0.9, 0.4), P(300.0, -200.0, 500.0);
  const Recovered r = recovered(reducer::build_mesh(plain_beam(from, to, 5, 0)), 2);
  const Index n = r.tables.coordinates();
  VectorXd y = VectorXd::Zero(n), f = VectorXd::Zero(6);
  f.head<3>() = P;
  const MatrixXd S = r.superelement.stiffness.block(6, 6, 6, 6);
  ASSERT_EQ(r.superelement.dof_node[6], 1);
  y.segment<6>(6) = S.ldlt().solve(f);
  const VectorXd forces = r.of(RecoveryField::beam_force) * y;
  for (Index e = 0; e < r.tables.beams(); ++e)
    for (Index end = 0; end < 2; ++end) {
      const Eigen::Matrix3d& R = r.tables.beam_axes[static_cast<std::size_t>(e)];
      const int node = r.tables.elements.node[static_cast<std::size_t>(2 * e + end)];
      const Vector3d moment = (to - r.tables.position.col(node)).cross(P);
      EXPECT_LT((forces.segment<3>(12 * e + 6 * end) - R.transpose() * P).norm(), 1e-6 * P.norm());
      EXPECT_LT((forces.segment<3>(12 * e + 6 * end + 3) - R.transpose() * moment).norm(), 1e-6 * P.norm());
    }
}

/// Coordinates under forces on the translations of boundary nodes at x = `end`, all others held: statics of the
/// superelement alone.
VectorXd loaded_end(const Recovered& r, double end, const std::function<Vector3d(const Vector3d&)>& force) {
  std::vector<Index> free;
  std::vector<double> load;
  for (Index k = 0; k < r.tables.coordinates(); ++k) {
    const int node = r.tables.dof_node[static_cast<std::size_t>(k)];
    const int component = r.tables.dof_component[static_cast<std::size_t>(k)];
    if (node < 0) continue;
    const Vector3d X = r.tables.position.col(r.tables.boundary_node[static_cast<std::size_t>(node)]);
    if (std::abs(X.x() - end) > 1e-9) continue;
    free.push_back(k);
    load.push_back(component < 3 ? force(X)[component] : 0.0);
  }
  const MatrixXd S = r.superelement.stiffness(free, free);
  const VectorXd solution = S.ldlt().solve(Eigen::Map<const VectorXd>(load.data(), static_cast<Index>(load.size())));
  VectorXd y = VectorXd::Zero(r.tables.coordinates());
  y(free) = solution;
  return y;
}

// Saint-Venant's flexure with ν = 0, away from the ends: σxx = P (L − x) z/I, τxz = P/(2I) (h²/4 − z²), 1.5 P/A in the
// middle. Two quadratic bricks over the height have a linear shear stress each, whose fit to the parabola errs by a
// third of 1.5 P/A at most; bending is exact up to what the ends disturb.
TEST(Recovery, SolidCantileverHasTheStressOfTheBeam) {
  const double L = 4.0, h = 0.4, P = 1e4, I = h * h * h * h / 12.0;
  Mesh mesh = reducer::solid_block({reducer::SolidShape::hexahedron20, {16, 2, 2}, {L, h, h}, 0.0},
                                   {reducer::isotropic_solid(E, 0.0, 7800.0), {}, "body"});
  std::vector<int> ends;
  for (int n = 0; n < mesh.nodes(); ++n)
    if (mesh.position(0, n) < 1e-9 || mesh.position(0, n) > L - 1e-9) ends.push_back(n);
  set_boundary(mesh, ends, false);
  const Recovered r = recovered(mesh, 0);
  const double nodes = static_cast<double>(ends.size()) / 2.0;
  const VectorXd y = loaded_end(r, L, [&](const Vector3d&) { return Vector3d(0.0, 0.0, P / nodes); });
  const VectorXd stress = r.of(RecoveryField::solid_stress) * y;
  int seen = 0;
  for (Index p = 0; p < r.tables.stress_points(); ++p) {
    const Vector3d X = r.tables.position.col(r.tables.stress_node[static_cast<std::size_t>(p)]);
    if (std::abs(X.x() - 0.5 * L) > 1e-9) continue;
    const double z = X.z() - 0.5 * h, bending = -P * 0.5 * L * z / I;
    EXPECT_NEAR(stress[6 * p], bending, 1e-6 * P * 0.5 * L * 0.5 * h / I);
    EXPECT_NEAR(stress[6 * p + 5], 0.5 * P / I * (0.25 * h * h - z * z), 0.5 * P / (h * h));
    ++seen;
  }
  EXPECT_GT(seen, 8);
}

// A strip with ν = 0: M = P (L − x) per width b at the middle of each element, σ = ± 6 M/(b t²) on the faces, no
// membrane stress.
TEST(Recovery, ShellCantileverHasTheStressOfTheBeam) {
  const double L = 1.0, b = 0.2, t = 0.01, P = 10.0;
  for (const reducer::Facets facets : {reducer::Facets::quadrilaterals, reducer::Facets::triangles}) {
    const reducer::GridShape grid{20, 4, facets, false};
    Mesh mesh = reducer::shell_grid(
        grid,
        [&](double x, double z) -> Vector3d {
          return {L * x, b * z, 0.0};
        },
        reducer::isotropic_shell(E, 0.0, 7800.0, t, 5.0 / 6.0));
    std::vector<int> ends;
    for (int j = 0; j <= 4; ++j)
      ends.insert(ends.end(), {reducer::grid_node(grid, 0, j), reducer::grid_node(grid, 20, j)});
    set_boundary(mesh, ends, true);
    const Recovered r = recovered(mesh, 0);
    const VectorXd y = loaded_end(r, L, [&](const Vector3d& X) {
      const bool corner = X.y() < 1e-9 || X.y() > b - 1e-9;
      return Vector3d(0.0, 0.0, corner ? P / 8.0 : P / 4.0);
    });
    const VectorXd stress = r.of(RecoveryField::shell_stress) * y;
    const double largest = 6.0 * P * L / (b * t * t);
    double worst = 0.0;
    for (Index s = 0; s < r.tables.shells(); ++s) {
      Vector3d middle = Vector3d::Zero();
      const reducer::ShellElement& shell = mesh.shells[static_cast<std::size_t>(s)];
      for (int k = 0; k < shell.corners(); ++k) middle += mesh.position.col(shell.nodes[k]) / shell.corners();
      Eigen::Matrix2d bending = in_plate_axes(r, s, Eigen::Matrix3d::Identity(), stress.segment<3>(6 * s + 3));
      bending(0, 0) += 6.0 * P * (L - middle.x()) / (b * t * t);  // u_z > 0 shortens the upper face
      worst = std::max(worst, bending.norm() / largest);
      EXPECT_LT(stress.segment<3>(6 * s).norm(), 1e-6 * largest);
    }
    EXPECT_LT(worst, facets == reducer::Facets::quadrilaterals ? 1e-6 : 1e-2);
  }
}

/// Static answer of the part to the inertia loads with its boundary held: modes and what they leave out.
MatrixXd answer(const Recovered& r, RecoveryField field) {
  const formats::RecoveryLoads& loads = *r.tables.loads;
  MatrixXd y = MatrixXd::Zero(r.tables.coordinates(), formats::inertia_loads);
  for (Index k = 0; k < y.rows(); ++k)
    if (loads.stiffness[k] > 0.0) y.row(k) = loads.share.row(k) / loads.stiffness[k];
  return r.of(field) * y + r.loads[static_cast<std::size_t>(field)];
}

// K_II⁻¹ g does not depend on how many modes hold a part of it; with many modes little is left.
TEST(Recovery, ModesAndAnswersToLoadsTogetherDoNotDependOnTheModes) {
  for (const Mesh& mesh : {plate(reducer::Facets::quadrilaterals, 4, skew_axes), frame(),
                           block(reducer::SolidShape::hexahedron8, nu, 0.1)}) {
    const Recovered none = recovered(mesh, 0), some = recovered(mesh, 6);
    EXPECT_EQ(none.tables.loads->reference_point, some.tables.loads->reference_point);
    EXPECT_GT(some.tables.loads->left_out, some.tables.loads->stiffness.maxCoeff() * (1.0 - 1e-9));
    for (const RecoveryField field : formats::recovery_fields) {
      const MatrixXd whole = none.loads[static_cast<std::size_t>(field)], together = answer(some, field);
      for (Index load = 0; load < whole.cols(); ++load)
        EXPECT_LE((whole - together).col(load).norm(), 1e-7 * whole.norm()) << static_cast<int>(field) << ' ' << load;
    }
  }
}

// The divergence theorem: ∮ x·n dA/3 is the volume if all triangles look outwards, and no face is missing.
TEST(Recovery, SurfaceOfSolidsIsClosedAndLooksOutwards) {
  for (const reducer::SolidShape shape : reducer::all_solid_shapes) {
    const Recovered r = recovered(block(shape, nu, 0.0), 0);
    double volume = 0.0;
    Vector3d area = Vector3d::Zero();
    for (Index k = 0; k < r.tables.triangle.cols(); ++k) {
      const Vector3d a = r.tables.position.col(r.tables.triangle(0, k)),
                     b = r.tables.position.col(r.tables.triangle(1, k)),
                     c = r.tables.position.col(r.tables.triangle(2, k));
      volume += a.dot(b.cross(c)) / 6.0;
      area += 0.5 * (b - a).cross(c - a);
    }
    EXPECT_NEAR(volume, 1.6, 1e-12) << reducer::solid_name(shape);
    EXPECT_LT(area.norm(), 1e-12) << reducer::solid_name(shape);
  }
}

}  // namespace
}  // namespace tisserand::testing::recovery_test
