// SPDX-License-Identifier: GPL-3.0-or-later
// Beams under large rotations: a helix, reversed elements, rigid motions accumulated, relative rotations near
// π.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/bodies/beam_states.hpp"
#include "tests/support/bodies/beam_statics.hpp"

namespace tisserand::mechanism::beam_invariance_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double helix_length = 10.0, helix_stiffness = 100.0;

/// Tip of a cantilever along x with GJ = EI_y = EI_z = EI under a dead moment m at its end. The moment is m everywhere,
/// so that the section turns about the fixed axis m at the rate |m|/EI: Λ(s) = exp(s m~/EI), a helix; exact for any EA,
/// GA.
test::Cantilever helix(const Vector3d& turns, int elements, int nodes_per_element) {
  formats::BeamBodySpec spec;
  spec.name = "helix";
  spec.to = {helix_length, 0, 0};
  spec.elements = elements;
  spec.nodes_per_element = nodes_per_element;
  spec.section = test::rectangle(1.0, 1.0, helix_stiffness, 1.0);
  spec.section.area = spec.section.shear_area_y = spec.section.shear_area_z = 1e3;
  spec.section.second_moment_y = spec.section.second_moment_z = 0.5 * helix_stiffness;
  spec.material = test::material(2.0, 0.0, 1.0);  // G = 1: GJ = EI
  const Vector3d moment = 2.0 * pi * turns * helix_stiffness / helix_length;
  return test::bend_cantilever(test::without_twist_elongation(mesh_beam(spec, 0)), {.moment = moment}, 40, 1e-10);
}

// Two nodes: the rotations are exact, and each element is the chord of an arc of length h, A(ψ) g = e₁ in its middle
// section: x_N = h Σ exp((i + 1/2) h m~/EI) A(ψ)⁻¹ e₁ with A = 1 − ψ~²/24, exactly.
TEST(BeamInvariance, HelixOfTwoNodesIsItsExactPolygon) {
  const Vector3d turns(0.3, 0.2, 0.8);  // 0.877 turns: at one full turn the tip's compliance is singular
  const int n = 16;
  const test::Cantilever result = helix(turns, n, 2);
  ASSERT_TRUE(result.converged);
  const Matrix3d psi = skew<double>(2.0 * pi * turns / n);
  const Vector3d chord = (Matrix3d::Identity() - psi * psi / 24.0).inverse() * Vector3d::UnitX();
  Vector3d tip = Vector3d::Zero();
  for (int i = 0; i < n; ++i) tip += helix_length / n * (exp_so3<double>(2.0 * pi * turns * (i + 0.5) / n) * chord);
  EXPECT_LT((result.nodes.back().x - tip).norm(), 1e-10);
  EXPECT_LT((result.nodes.back().R - exp_so3<double>(2.0 * pi * turns)).norm(), 1e-10);
}

TEST(BeamInvariance, HelixConvergesWithOrderFour) {
  const Vector3d turns(0.3, 0.2, 0.8);  // 0.877 turns: at one full turn the tip's compliance is singular
  // ∫ exp(s m~/EI) e₁ ds over the length: along the axis a, plus the turning part.
  const double angle = 2.0 * pi * turns.norm();
  const Vector3d a = turns.normalized(), along = a * a.x(), across = Vector3d::UnitX() - along;
  const Vector3d tip =
      helix_length * (along + std::sin(angle) / angle * across + (1.0 - std::cos(angle)) / angle * a.cross(across));
  for (const int nodes_per_element : {2, 3}) {
    double previous = 0.0;
    for (const int n : {6, 12}) {
      const test::Cantilever result = helix(turns, n, nodes_per_element);
      ASSERT_TRUE(result.converged);
      EXPECT_LT((result.nodes.back().R - exp_so3<double>(2.0 * pi * turns)).norm(), 1e-10);
      const double error = (result.nodes.back().x - tip).norm();
      if (previous > 0.0) {
        EXPECT_NEAR(std::log2(previous / error), 4.0, 0.3) << n;
      }
      previous = error;
    }
    EXPECT_LT(previous, 1e-4 * helix_length);
  }
}

template <class T>
struct BeamReversal : ::testing::Test {};
using Sizes = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(BeamReversal, Sizes);

// Numbering the nodes from the other end, with section triads turned by π about y, is the same beam: Γ, κ keep their
// size at mirrored points, so energy, forces and tangents are the same per node.
TYPED_TEST(BeamReversal, EnergyForcesAndTangentsAreThoseOfTheReversedElement) {
  constexpr int N = TypeParam::value;
  const BeamElement<N> element = test::general_element<N>();
  BeamElement<N> reversed = element;
  const Matrix3d flip = Vector3d(-1, 1, -1).asDiagonal();
  for (int i = 0; i < N; ++i) {
    reversed.nodes[i] = element.nodes[N - 1 - i];
    reversed.section[i] = element.section[N - 1 - i] * flip;
    reversed.inertia[i] = element.inertia[N - 1 - i];
  }
  // Λ' = Λ flip and d/ds' = −d/ds: Γ₀' = −flip Γ₀, κ₀' = −flip κ₀.
  for (int k = 0; k < N - 1; ++k) {
    reversed.initial_gamma[k] = -(flip * element.initial_gamma[N - 2 - k]);
    reversed.initial_kappa[k] = -(flip * element.initial_kappa[N - 2 - k]);
  }
  std::mt19937 generator(5);
  const Vector3d gravity(1, 2, 3);
  for (const double size : {0.0, 0.3, 1.0}) {
    const std::vector<NodeMotion> nodes = test::random_state<N>(generator, size);
    Eigen::Matrix<double, 6 * N, 1> r, s;
    Eigen::Matrix<double, 6 * N, 6 * N> A, B;
    const TangentCoefficients c{.mass = 1.0, .damping = 2.0, .stiffness = 3.0};
    residual_and_tangent(element, nodes, gravity, c, r, A);
    residual_and_tangent(reversed, nodes, gravity, c, s, B);
    EXPECT_NEAR(energy(element, nodes, gravity).strain, energy(reversed, nodes, gravity).strain, 1e-13);
    for (int i = 0; i < N; ++i) {
      EXPECT_LT((r.template segment<6>(6 * i) - s.template segment<6>(6 * (N - 1 - i))).norm(), 1e-13 * (1 + r.norm()));
      for (int j = 0; j < N; ++j)
        EXPECT_LT(
            (A.template block<6, 6>(6 * i, 6 * j) - B.template block<6, 6>(6 * (N - 1 - i), 6 * (N - 1 - j))).norm(),
            1e-12 * (1 + A.norm()));
    }
  }
}

// Ten thousand rigid increments, about a hundred turns: the strain energy drifts with the rounding of R and x alone.
TYPED_TEST(BeamReversal, StrainSurvivesTenThousandRigidIncrements) {
  constexpr int N = TypeParam::value;
  const BeamElement<N> element = test::general_element<N>();
  std::mt19937 generator(9);
  std::vector<NodeMotion> nodes = test::random_state<N>(generator, 0.3);
  const double before = energy(element, nodes, Vector3d::Zero()).strain;
  for (int step = 0; step < 10000; ++step) {
    const Matrix3d Q = exp_so3<double>(Vector3d(0.03, 0.05, -0.02) + test::random_vector(generator, 0.02));
    for (NodeMotion& node : nodes) {
      node.x = Q * node.x;
      node.R = Eigen::Quaterniond(Q * node.R).normalized().toRotationMatrix();
    }
  }
  EXPECT_NEAR(energy(element, nodes, Vector3d::Zero()).strain, before, 1e4 * 1e-15 * (1.0 + before));
}

// Momentum of a deformed element: resultant force and moment of the inertia forces are the rates of linear and angular
// momentum (central differences in time of the motion, error h² = 1e-8 of size one).
TYPED_TEST(BeamReversal, InertiaForcesAreTheRatesOfMomentum) {
  constexpr int N = TypeParam::value;
  const BeamElement<N> element = test::general_element<N>();
  std::mt19937 generator(13);
  const std::vector<NodeMotion> nodes = test::random_state<N>(generator, 0.4);
  const auto momentum = [&](double t) {
    Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
    std::array<Vector3d, N> v;
    for (int j = 0; j < N; ++j) v[j] = nodes[j].xd + t * nodes[j].xdd;
    for (int i = 0; i < N; ++i) {
      const NodeMotion& n = nodes[i];
      const Vector3d x = n.x + t * n.xd + 0.5 * t * t * n.xdd;
      for (int j = 0; j < N; ++j) {
        const Vector3d p = element.mass * beam::Shares<N>::mass[i][j] * v[j];
        sum.head<3>() += p;
        sum.tail<3>() += x.cross(p);
      }
      const Matrix3d R = n.R * exp_so3<double>(t * n.Omega + 0.5 * t * t * n.Omegad);
      sum.tail<3>() += R * (element.inertia[i] * (n.Omega + t * n.Omegad));
    }
    if constexpr (N == 2) {  // ∫ ẋ dm and ∫ x × ẋ dm of the parabola beside the chord
      using beam::Parabola;
      std::array<Vector3d, 2> x;
      Vector3d d = Vector3d::Zero(), rate = Vector3d::Zero();
      for (int i = 0; i < 2; ++i) {
        const NodeMotion& n = nodes[i];
        x[i] = n.x + t * n.xd + 0.5 * t * t * n.xdd;
        const Matrix3d R = n.R * exp_so3<double>(t * n.Omega + 0.5 * t * t * n.Omegad);
        const Vector3d arm = Parabola::sign[i] * element.length * element.section[i].col(0);
        d += R * arm;
        rate += R * (n.Omega + t * n.Omegad).cross(arm);
      }
      // b = d - 0.6 (d.c) c/L^2 and its rate
      const Vector3d c = x[1] - x[0], c_rate = v[1] - v[0];
      const double k = 0.6 / (element.length * element.length);
      rate -= k * ((rate.dot(c) + d.dot(c_rate)) * c + d.dot(c) * c_rate);
      d -= k * d.dot(c) * c;
      sum.head<3>() += element.mass / 6.0 * rate;
      sum.tail<3>() +=
          element.mass * ((x[0] + x[1]).cross(rate) / 12.0 + d.cross(v[0] + v[1]) / 12.0 + d.cross(rate) / 30.0);
    }
    return sum;
  };
  Eigen::Matrix<double, 6 * N, 1> r, internal;
  std::vector<NodeMotion> at_rest = nodes;
  for (NodeMotion& n : at_rest) n.xd = n.Omega = n.xdd = n.Omegad = Vector3d::Zero();
  residual(element, nodes, Vector3d::Zero(), r);
  residual(element, at_rest, Vector3d::Zero(), internal);
  r -= internal;
  Eigen::Matrix<double, 6, 1> rate = Eigen::Matrix<double, 6, 1>::Zero();
  for (int i = 0; i < N; ++i) {
    rate.head<3>() += r.template segment<3>(6 * i);
    rate.tail<3>() += nodes[i].x.cross(r.template segment<3>(6 * i)) + nodes[i].R * r.template segment<3>(6 * i + 3);
  }
  const double h = 1e-4;
  EXPECT_LT(((momentum(h) - momentum(-h)) / (2 * h) - rate).cwiseAbs().maxCoeff(), 1e-7);
}

}  // namespace
}  // namespace tisserand::mechanism::beam_invariance_test
