// SPDX-License-Identifier: GPL-3.0-or-later
// Frequencies of beams at rest from mass and stiffness tangents against exact dispersion relations.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "tests/support/bodies/beam_states.hpp"
#include "tests/support/bodies/beam_statics.hpp"

namespace tisserand::mechanism::beam_frequencies_test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

struct Rod {
  double E = 200.0, nu = 0.25, rho = 3.0, L = 4.0;
  formats::Section section = test::rectangle(0.3, 0.5, 0.004, 0.8);
};

BeamMesh rod_mesh(const Rod& rod, int elements, int nodes_per_element) {
  formats::BeamBodySpec spec;
  spec.name = "rod";
  // An inclined axis: nothing is aligned with the world.
  spec.from = {0.3, -0.2, 0.1};
  spec.to = spec.from + rod.L * Vector3d(2, 3, 6) / 7.0;
  spec.elements = elements;
  spec.nodes_per_element = nodes_per_element;
  spec.section = rod.section;
  spec.material = test::material(rod.E, rod.nu, rod.rho);
  return mesh_beam(spec, 0);
}

/// Ascending ω² with two free components per node, in section axes (0 x, 1 y, 2 z; −1: none). They are the displacement
/// along `free_displacement` and the rotation about `free_rotation`. `pinned` holds the displacement at both ends.
Eigen::VectorXd eigenvalues(const BeamMesh& mesh, int free_displacement, int free_rotation, bool pinned) {
  Eigen::VectorXd r;
  Eigen::MatrixXd K, M;
  const std::vector<NodeMotion> nodes = test::reference_nodes(mesh);
  test::assemble(mesh, nodes, {.mass = 0, .damping = 0, .stiffness = 1}, r, K);
  test::assemble(mesh, nodes, {.mass = 1, .damping = 0, .stiffness = 0}, r, M);
  std::vector<Eigen::VectorXd> columns;
  const std::size_t n = mesh.position.size();
  for (std::size_t i = 0; i < n; ++i)
    for (const int rotation : {0, 1}) {
      const int axis = rotation ? free_rotation : free_displacement;
      if (axis < 0 || (!rotation && pinned && (i == 0 || i == n - 1))) continue;
      Eigen::VectorXd column = Eigen::VectorXd::Zero(K.rows());
      column.segment<3>(static_cast<Eigen::Index>(6 * i) + 3 * rotation) = mesh.section[i].col(axis);
      columns.push_back(column);
    }
  Eigen::MatrixXd V(K.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) V.col(k) = columns[k];
  const Eigen::MatrixXd Kr = V.transpose() * K * V, Mr = V.transpose() * M * V;
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(Kr, Mr, Eigen::EigenvaluesOnly).eigenvalues();
}

/// Lowest root ω² of Timoshenko's frequency equation for the simply supported beam, wave number q.
double timoshenko(double q, double EI, double GA, double rhoA, double rhoI) {
  const double a = rhoI * rhoA, b = rhoA * (EI * q * q + GA) + rhoI * GA * q * q, c = EI * GA * std::pow(q, 4);
  return 2.0 * c / (b + std::sqrt(b * b - 4.0 * a * c));
}

/// Lowest ω² of the chain of two-node elements (w = sin, θ = cos of q x are exact discrete modes). With c = cos(qh/2),
/// s = sin(qh/2), d = 2 s/h: K = S [d², −dc; −dc, c²] + EI [0, 0; 0, d²] with 1/S = 1/GA + h²/(12 EI).
/// M = [ρA (2 + cos qh)/3, ρA h s c/6; same, ρI + ρA h² s²/30] of the parabola w, θ between the nodes.
double discrete_timoshenko(double q, double h, double EI, double GA, double rhoA, double rhoI) {
  const double c = std::cos(q * h / 2), s = std::sin(q * h / 2), d = 2.0 * s / h;
  const double S = 1.0 / (1.0 / GA + h * h / (12.0 * EI)), mixed = rhoA * h * s * c / 6.0;
  Eigen::MatrixXd K(2, 2), M(2, 2);
  K << S * d * d, -S * d * c, -S * d * c, S * c * c + EI * d * d;
  M << rhoA * (2.0 + std::cos(q * h)) / 3.0, mixed, mixed, rhoI + rhoA * h * h * s * s / 30.0;
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(K, M).eigenvalues()[0];
}

struct Plane {
  int displacement, rotation;
  double EI, GA, rhoI;
};

std::array<Plane, 2> planes(const Rod& rod) {
  const double G = rod.E / (2.0 * (1.0 + rod.nu));
  return {Plane{1, 2, rod.E * rod.section.second_moment_z, G * rod.section.shear_area_y,
                rod.rho * rod.section.second_moment_z},
          Plane{2, 1, rod.E * rod.section.second_moment_y, G * rod.section.shear_area_z,
                rod.rho * rod.section.second_moment_y}};
}

TEST(BeamFrequencies, SimplySupportedTwoNodes) {
  const Rod rod;
  const int n = 12;
  const double rhoA = rod.rho * rod.section.area;
  for (const Plane& p : planes(rod)) {
    const Eigen::VectorXd computed = eigenvalues(rod_mesh(rod, n, 2), p.displacement, p.rotation, true);
    for (int mode = 1; mode <= 4; ++mode) {
      const double q = mode * pi / rod.L;
      EXPECT_NEAR(computed[mode - 1] / discrete_timoshenko(q, rod.L / n, p.EI, p.GA, rhoA, p.rhoI), 1.0, 1e-11) << mode;
    }
  }
}

// Slender: order 4, as with three nodes. Shear and rotary inertia have an error of order 2: (qh)² EI q²/GA, 1e-6 here.
TEST(BeamFrequencies, SlenderBeamsOfTwoNodesConvergeWithOrderFour) {
  Rod rod;
  rod.section = test::rectangle(3e-3, 5e-3, 4e-11, 0.8);
  const double rhoA = rod.rho * rod.section.area;
  for (const Plane& p : planes(rod))
    for (const int mode : {1, 2}) {
      const double exact = timoshenko(mode * pi / rod.L, p.EI, p.GA, rhoA, p.rhoI);
      const auto error = [&](int n) {
        return eigenvalues(rod_mesh(rod, n, 2), p.displacement, p.rotation, true)[mode - 1] / exact - 1.0;
      };
      EXPECT_NEAR(std::log2(error(4 * mode) / error(8 * mode)), 4.0, 0.2) << mode;
      EXPECT_LT(std::abs(error(8 * mode)), 1e-4) << mode;
    }
}

TEST(BeamFrequencies, SimplySupportedThreeNodes) {
  const Rod rod;
  const double rhoA = rod.rho * rod.section.area;
  for (const Plane& p : planes(rod))
    for (int mode = 1; mode <= 2; ++mode) {
      const double exact = timoshenko(mode * pi / rod.L, p.EI, p.GA, rhoA, p.rhoI);
      const double coarse = eigenvalues(rod_mesh(rod, 8, 3), p.displacement, p.rotation, true)[mode - 1] / exact - 1.0;
      const double fine = eigenvalues(rod_mesh(rod, 16, 3), p.displacement, p.rotation, true)[mode - 1] / exact - 1.0;
      EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.1);
      EXPECT_LT(std::abs(fine), 1e-4);
    }
}

// Free-free bar of two-node elements: ω² = (6 E/ρh²)(1 − cos kh)/(2 + cos kh) with consistent mass (axial), and
// ω² = (2 GJ/ρI_p h²)(1 − cos kh) with lumped rotary inertia (torsion), k = jπ/L.
TEST(BeamFrequencies, AxialAndTorsionalOfTheFreeBar) {
  const Rod rod;
  const int n = 10;
  const double h = rod.L / n, G = rod.E / (2.0 * (1.0 + rod.nu));
  const BeamMesh mesh = rod_mesh(rod, n, 2);
  const Eigen::VectorXd axial = eigenvalues(mesh, 0, -1, false), torsion = eigenvalues(mesh, -1, 0, false);
  const double scale = axial[n], torsion_scale = torsion[n];
  EXPECT_NEAR(axial[0] / scale, 0.0, 1e-13);  // free
  EXPECT_NEAR(torsion[0] / torsion_scale, 0.0, 1e-13);
  for (int j = 1; j <= n; ++j) {
    const double cosine = std::cos(j * pi / n);
    EXPECT_NEAR(axial[j] / scale, 6.0 * rod.E / (rod.rho * h * h) * (1.0 - cosine) / (2.0 + cosine) / scale, 1e-12);
    EXPECT_NEAR(torsion[j] / torsion_scale,
                2.0 * G * rod.section.torsion_constant / (rod.rho * rod.section.polar_moment * h * h) * (1.0 - cosine) /
                    torsion_scale,
                1e-12);
  }
}

// Euler-Bernoulli limit: slender clamped-free beam, (βL)⁴ EI/(ρA L⁴), β₁L = 1.8751040687, β₂L = 4.6940911330.
TEST(BeamFrequencies, SlenderCantilever) {
  Rod rod;
  rod.section = test::rectangle(0.01, 0.01, 1.4e-9, 5.0 / 6.0);
  const double EI = rod.E * rod.section.second_moment_z, rhoA = rod.rho * rod.section.area;
  const BeamMesh mesh = rod_mesh(rod, 16, 3);
  Eigen::VectorXd r;
  Eigen::MatrixXd K, M;
  const std::vector<NodeMotion> nodes = test::reference_nodes(mesh);
  test::assemble(mesh, nodes, {.mass = 0, .damping = 0, .stiffness = 1}, r, K);
  test::assemble(mesh, nodes, {.mass = 1, .damping = 0, .stiffness = 0}, r, M);
  const Eigen::Index n = K.rows() - 6;
  const Eigen::VectorXd omega2 = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(
                                     K.bottomRightCorner(n, n), M.bottomRightCorner(n, n), Eigen::EigenvaluesOnly)
                                     .eigenvalues();
  const double unit = EI / (rhoA * std::pow(rod.L, 4));
  // All modes come twice (square section); shear and rotary inertia change ω² by (βL)² (h/L)² = 1e-5 · 22.
  for (const auto& [index, beta] : {std::pair(0, 1.8751040687), std::pair(2, 4.6940911330)})
    for (const int copy : {0, 1}) EXPECT_NEAR(omega2[index + copy] / (unit * std::pow(beta, 4)), 1.0, 3e-4) << index;
}

}  // namespace
}  // namespace tisserand::mechanism::beam_frequencies_test
