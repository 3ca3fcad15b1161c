// SPDX-License-Identifier: GPL-3.0-or-later
// Static beams with large rotations against published and analytic solutions; orders of convergence.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/bodies/beam_states.hpp"
#include "tests/support/bodies/beam_statics.hpp"
#include "tests/support/reference_table.hpp"

namespace tisserand::mechanism::beam_statics_test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using test::bend_cantilever;
using test::Cantilever;
using test_support::reference_rows;

formats::BeamBodySpec straight(double length, int elements, int nodes_per_element) {
  formats::BeamBodySpec spec;
  spec.name = "beam";
  spec.to = {length, 0, 0};
  spec.elements = elements;
  spec.nodes_per_element = nodes_per_element;
  return spec;
}

formats::BeamBodySpec arc(double radius, double angle, int elements, int nodes_per_element) {
  formats::BeamBodySpec spec = straight(1.0, elements, nodes_per_element);
  spec.through = radius * Vector3d(std::sin(angle / 2), std::cos(angle / 2) - 1.0, 0);
  spec.to = radius * Vector3d(std::sin(angle), std::cos(angle) - 1.0, 0);
  return spec;
}

/// The 45-degree bend, reference row 0 or 1 (see references/README.md).
Vector3d bend_45(const std::vector<double>& row, int elements, int nodes_per_element, int load_steps) {
  formats::BeamBodySpec spec = arc(100.0, pi / 4, elements, nodes_per_element);
  spec.section = test::rectangle(1.0, 1.0, row[0] / 5e6, 5.0 / 6.0);
  spec.material = test::material(1e7, 0.0, 1.0);
  const BeamMesh mesh = test::without_twist_elongation(mesh_beam(spec, 0));
  const Cantilever result = bend_cantilever(mesh, {.force = {0, 0, 600}}, load_steps, 1e-9);
  EXPECT_TRUE(result.converged) << elements << " elements";
  return result.nodes.back().x - mesh.position.back();
}

TEST(BeamStatics, Bend45OfBatheAndBolourchi) {
  for (const std::vector<double>& row : reference_rows("beam_bend_45.csv")) {
    const Vector3d expected(row[1], row[2], row[3]);
    const double size = expected.norm();
    // Two nodes: order 4 of bending and 2 of what the twist adds, of opposite signs with few elements; three nodes: order 4.
    // Without the corrections eight elements of two nodes err by 2.2e-3.
    const double e8 = (bend_45(row, 8, 2, 24) - expected).norm(), e16 = (bend_45(row, 16, 2, 24) - expected).norm();
    EXPECT_LT((bend_45(row, 4, 2, 24) - expected).norm(), 1e-3 * size);
    EXPECT_LT(e8, 2e-4 * size);
    EXPECT_GT(std::log2(e8 / e16), 1.9) << e8 / size << ' ' << e16 / size;
    const double c4 = (bend_45(row, 4, 3, 8) - expected).norm(), c8 = (bend_45(row, 8, 3, 8) - expected).norm();
    EXPECT_LT(c4, 1e-3 * size);
    EXPECT_LT(c8, 2e-5 * size);
    EXPECT_NEAR(std::log2(c4 / c8), 4.0, 0.2);
    EXPECT_LT((bend_45(row, 16, 3, 8) - expected).norm(), 1e-6 * size);  // seven digits of the reference
  }
}

TEST(BeamStatics, SolutionDoesNotDependOnTheLoadPath) {
  const std::vector<double> row = reference_rows("beam_bend_45.csv")[0];
  for (const int n : {2, 3}) EXPECT_LT((bend_45(row, 8, n, 24) - bend_45(row, 8, n, 40)).norm(), 1e-9) << n << " nodes";
}

Cantilever roll_up(int elements, int nodes_per_element, double turns) {
  formats::BeamBodySpec spec = straight(10.0, elements, nodes_per_element);
  spec.section = test::rectangle(1.0, 1.0, 100.0, 1.0);
  spec.section.area = spec.section.shear_area_y = spec.section.shear_area_z = 1e6;
  spec.section.second_moment_y = spec.section.second_moment_z = 100.0;
  spec.material = test::material(1.0, 0.0, 1.0);
  return bend_cantilever(mesh_beam(spec, 0), {.moment = {0, 0, turns * 2.0 * pi * 100.0 / 10.0}}, 100, 1e-10);
}

// A pure end moment M = 2π EI/L: every element is in the same state of constant curvature, and each is its neighbour
// turned by 2π/N. The full circle therefore closes to rounding with any number of elements.
TEST(BeamStatics, RollUpToAFullCircle) {
  for (const int nodes_per_element : {2, 3})
    for (const int elements : {5, 8, 16}) {
      const Cantilever result = roll_up(elements, nodes_per_element, 1.0);
      ASSERT_TRUE(result.converged);
      EXPECT_LT(result.nodes.back().x.norm(), 1e-12 * 10.0);
      EXPECT_LT((result.nodes.back().R - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    }
}

// Half a circle shows the error: the nodes of elements of two nodes are corners of a regular polygon whose side is the
// chord h/(1 + a²/24) of the angle a = π/N; the tip is at (side)/sin(π/2N) exactly, instead of 2L/π: order 4. Three
// nodes: order 4.
TEST(BeamStatics, RollUpToHalfACircle) {
  const double exact = 20.0 / pi;
  for (const int n : {4, 8, 16}) {
    const Cantilever result = roll_up(n, 2, 0.5);
    ASSERT_TRUE(result.converged);
    const double side = 10.0 / n / (1.0 + pi * pi / (24.0 * n * n));
    EXPECT_LT((result.nodes.back().x - Vector3d(0, side / std::sin(pi / (2 * n)), 0)).norm(), 1e-12 * 10.0) << n;
  }
  double previous = 0.0;
  for (const int n : {4, 8, 16}) {
    const Cantilever result = roll_up(n, 3, 0.5);
    ASSERT_TRUE(result.converged);
    const double error = (result.nodes.back().x - Vector3d(0, exact, 0)).norm();
    if (previous > 0.0) {
      EXPECT_NEAR(std::log2(previous / error), 4.0, 0.1);
    }
    previous = error;
  }
  EXPECT_LT(previous, 1e-6 * 10.0);
}

formats::BeamBodySpec princeton(int elements, int nodes_per_element) {
  formats::BeamBodySpec spec = straight(0.508, elements, nodes_per_element);
  const double E = 70e9, G = E / 2.6;
  spec.section.name = "princeton";
  spec.section.area = 2.84191e6 / E;
  spec.section.shear_area_y = 6.40131e5 / G;
  spec.section.shear_area_z = 9.03881e5 / G;
  spec.section.torsion_constant = 3.10338 / G;
  spec.section.second_moment_y = 36.2794 / E;
  spec.section.second_moment_z = 2.42873 / E;
  spec.material = test::material(E, 0.3, 2700.0);
  return spec;
}

// 0.1 % of the tip displacement of each row (and of the largest twist). The displacements need 8 elements of two nodes,
// 4 of three; the twist of a section fifteen times stiffer one way than the other, of order 2 with two nodes, needs 22.
TEST(BeamStatics, PrincetonBeam) {
  for (const auto& [elements, nodes_per_element] : {std::pair(8, 2), std::pair(22, 2), std::pair(4, 3)}) {
    const BeamMesh mesh = mesh_beam(princeton(elements, nodes_per_element), 0);
    for (const std::vector<double>& row : reference_rows("princeton_beam.csv")) {
      if (std::fmod(row[1], 15.0) != 0.0) continue;
      const double theta = row[1] * pi / 180.0;
      const Cantilever result =
          bend_cantilever(mesh, {.force = row[0] * Vector3d(0, std::sin(theta), std::cos(theta))}, 4, 1e-10);
      ASSERT_TRUE(result.converged);
      const Vector3d u = result.nodes.back().x - mesh.position.back(), expected(row[2], row[3], row[4]);
      const Eigen::Matrix3d& R = result.nodes.back().R;
      EXPECT_LT((u - expected).norm(), 1e-3 * expected.norm()) << row[0] << " N, " << row[1] << " degrees";
      if (elements == 8) continue;
      EXPECT_NEAR(std::atan2(-R(1, 2), R(2, 2)) * 180.0 / pi, row[5], 3.5e-3)
          << row[0] << " N, " << row[1] << " degrees";
    }
  }
}

/// Tip displacement and rotation (6) of the linear cantilever at rest under a tip wrench.
Eigen::Matrix<double, 6, 1> linear_tip(const BeamMesh& mesh, const Eigen::Matrix<double, 6, 1>& wrench) {
  Eigen::VectorXd r, f = Eigen::VectorXd::Zero(6 * (static_cast<Eigen::Index>(mesh.position.size()) - 1));
  Eigen::MatrixXd K;
  test::assemble(mesh, test::reference_nodes(mesh), {.mass = 0, .damping = 0, .stiffness = 1}, r, K);
  EXPECT_LT((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-12 * K.cwiseAbs().maxCoeff());
  f.tail<6>() = wrench;
  return K.bottomRightCorner(f.size(), f.size()).partialPivLu().solve(f).tail<6>();
}

// Exact nodes for forces and moments at the tip, whatever slenderness and number of elements: tip deflection
// P L³/(3EI) + P L/(GA). Two nodes by the residual bending flexibility (without it P L³/(3EI) lacks the share 1/(4N²)),
// three by their cubic deflection and superconvergent nodes.
TEST(BeamStatics, LinearCantileverWithoutLockingAtAnySlenderness) {
  for (const double height : {0.5, 0.05, 5e-4}) {  // length 5: slenderness 10 to 1e4; locking: errors of size one
    for (const int n : {1, 4, 16})
      for (const int nodes_per_element : {2, 3}) {
        formats::BeamBodySpec spec = straight(5.0, n, nodes_per_element);
        spec.section = test::rectangle(height, 2 * height, std::pow(height, 4), 5.0 / 6.0);
        spec.material = test::material(2e11, 0.25, 1.0);
        const BeamMesh mesh = mesh_beam(spec, 0);
        const double E = 2e11, G = 0.8e11, L = 5.0, A = 2 * height * height, GA = G * A * 5.0 / 6.0;
        const double Iy = spec.section.second_moment_y, Iz = spec.section.second_moment_z;
        // Rounding: the condition number of K grows with n² GA L²/EI.
        const double tolerance = 1e-12 + 2.2e-16 * n * n * GA * L * L / (E * Iz);
        const auto expect = [&](int load, int response, double expected) {
          Eigen::Matrix<double, 6, 1> wrench = Eigen::Matrix<double, 6, 1>::Zero();
          wrench[load] = 1.0;
          const double value = linear_tip(mesh, wrench)[response];
          EXPECT_NEAR(value / expected, 1.0, tolerance) << load << response << " N=" << n << " h=" << height;
        };
        expect(0, 0, L / (E * A));
        expect(1, 1, L * L * L / (3 * E * Iz) + L / GA);
        expect(2, 2, L * L * L / (3 * E * Iy) + L / GA);
        expect(3, 3, L / (G * std::pow(height, 4)));
        expect(4, 4, L / (E * Iy));
        expect(5, 5, L / (E * Iz));
        expect(5, 1, L * L / (2 * E * Iz));
        expect(4, 2, -L * L / (2 * E * Iy));
      }
  }
}

// Section forces of one element at its middle are those of the load: the shear force is P, though the shear strain of
// two nodes holds bending too, and the bending moment P L/2.
TEST(BeamStatics, SectionForcesOfOneElementAreThoseOfTheLoad) {
  formats::BeamBodySpec spec = straight(5.0, 1, 2);
  spec.section = test::rectangle(0.05, 0.1, 1e-6, 5.0 / 6.0);
  spec.material = test::material(2e11, 0.25, 1.0);
  const BeamMesh mesh = mesh_beam(spec, 0);
  const Vector3d P(0, 1e-3, 2e-3);  // deflections of 1e-8 L
  const Cantilever result = bend_cantilever(mesh, {.force = P}, 1, 1e-14);
  const BeamSectionForces middle = section_forces(mesh.elements2[0], result.nodes)[0];
  EXPECT_NEAR(middle.force.y() / P.y(), 1.0, 1e-7);
  EXPECT_NEAR(middle.force.z() / P.z(), 1.0, 1e-7);
  EXPECT_NEAR(middle.moment.z() / (P.y() * 2.5), 1.0, 1e-7);
  EXPECT_NEAR(middle.moment.y() / (-P.z() * 2.5), 1.0, 1e-7);
}

// Weight along the beam: q L⁴/(8EI) + q L²/(2GA) at the tip, exact nodes with any number of elements of two nodes,
// since the weight of the parabola between them turns the nodes by q h²/12.
TEST(BeamStatics, CantileverUnderItsWeightIsExactWithOneElement) {
  for (const int n : {1, 3}) {
    formats::BeamBodySpec spec = straight(5.0, n, 2);
    spec.section = test::rectangle(0.3, 0.5, 4e-3, 5.0 / 6.0);
    spec.material = test::material(2e11, 0.25, 8000.0);
    const BeamMesh mesh = mesh_beam(spec, 0);
    const std::vector<NodeMotion> nodes = test::reference_nodes(mesh);
    Eigen::VectorXd r, f = Eigen::VectorXd::Zero(6 * (n + 1));
    Eigen::MatrixXd K;
    test::assemble(mesh, nodes, {.mass = 0, .damping = 0, .stiffness = 1}, r, K);
    for (const BeamElement2& element : mesh.elements2) {
      Eigen::Matrix<double, 12, 1> weight;
      residual(element, nodes, Vector3d(0, -9.81, 0), weight);
      f.segment<12>(6 * element.nodes[0]) -= weight;
    }
    const double tip = K.bottomRightCorner(6 * n, 6 * n).partialPivLu().solve(f.tail(6 * n))[6 * n - 5];
    const double L = 5.0, q = -8000.0 * spec.section.area * 9.81, EI = 2e11 * spec.section.second_moment_z;
    const double GA = 0.8e11 * spec.section.shear_area_y;
    EXPECT_NEAR(tip / (q * std::pow(L, 4) / (8 * EI) + q * L * L / (2 * GA)), 1.0, 1e-10) << n;
  }
}

// Quarter circle, clamped, radial tip force in its plane (Castigliano): u = (π P R/4) (R²/EI + 1/EA + 1/GA). With
// membrane locking the error would grow with slenderness; here it is that of the interpolation, order 4.
TEST(BeamStatics, ThinArcWithoutMembraneLocking) {
  for (const int nodes_per_element : {2, 3}) {
    const int n = 4;
    double error_thick = 0.0;
    for (const double height : {0.1, 1e-3, 1e-4}) {  // radius 1: slenderness 10 to 1e4
      const auto error = [&](int elements) {
        formats::BeamBodySpec spec = arc(1.0, pi / 2, elements, nodes_per_element);
        spec.section = test::rectangle(height, height, 0.14 * std::pow(height, 4), 5.0 / 6.0);
        spec.material = test::material(1e9, 0.0, 1.0);
        const double EA = 1e9 * height * height, EI = EA * height * height / 12.0, GA = EA * 5.0 / 12.0;
        Eigen::Matrix<double, 6, 1> wrench = Eigen::Matrix<double, 6, 1>::Zero();
        wrench[0] = 1.0;  // at the tip (1, −1, 0) the tangent is −y, the radius along x
        return linear_tip(mesh_beam(spec, 0), wrench)[0] / (pi / 4.0 * (1.0 / EI + 1.0 / EA + 1.0 / GA)) - 1.0;
      };
      const double coarse = error(n), fine = error(2 * n);
      EXPECT_LT(std::abs(coarse), 5e-3) << height;
      if (height > 5e-4) {  // thinner: the error of the fine mesh sinks into rounding (condition number 1e9 n²)
        // two nodes: shear deformation, a hundredth of the bending in the thick arc, keeps order 2
        EXPECT_NEAR(std::log2(coarse / fine), 4.0, nodes_per_element == 2 && height == 0.1 ? 0.5 : 0.1) << height;
      }
      if (error_thick == 0.0) error_thick = std::abs(coarse);
      EXPECT_LT(std::abs(coarse), 1.1 * error_thick) << height;
    }
  }
}

// Axially compressed cantilever: the tangent loses definiteness at Haringx's load for Simo-Reissner rods, the smallest
// root of P (1 + P/GA) = π² EI/(4L²) for EA → ∞ (axial shortening is made negligible here).
TEST(BeamStatics, TangentFindsTheBucklingLoad) {
  formats::BeamBodySpec spec = straight(2.0, 16, 3);
  spec.section = test::rectangle(1.0, 1.0, 1.0, 1.0);
  spec.section.area = 1e7;
  spec.section.shear_area_y = spec.section.shear_area_z = 40.0;
  spec.section.second_moment_y = 8.0;
  spec.section.second_moment_z = 1.0;
  spec.material = test::material(1.0, 0.0, 1.0);
  const double GA = 20.0, euler = pi * pi / 16.0;
  const double critical = 0.5 * GA * (std::sqrt(1.0 + 4.0 * euler / GA) - 1.0);
  const BeamMesh mesh = mesh_beam(spec, 0);
  const auto determinant_sign = [&](double load) {
    const Cantilever result = bend_cantilever(mesh, {.force = {-load, 0, 0}}, 1, 1e-12);
    Eigen::VectorXd r;
    Eigen::MatrixXd K;
    test::assemble(mesh, result.nodes, {.mass = 0, .damping = 0, .stiffness = 1}, r, K);
    const Eigen::Index n = K.rows() - 6;
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(K.bottomRightCorner(n, n));
    double sign = lu.permutationP().determinant();
    for (Eigen::Index i = 0; i < n; ++i) sign *= lu.matrixLU()(i, i) > 0.0 ? 1.0 : -1.0;
    return sign;
  };
  EXPECT_GT(determinant_sign(critical * (1.0 - 1e-5)), 0.0);
  EXPECT_LT(determinant_sign(critical * (1.0 + 1e-5)), 0.0);
}

}  // namespace
}  // namespace tisserand::mechanism::beam_statics_test
