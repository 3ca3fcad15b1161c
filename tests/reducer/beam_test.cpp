// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of the beam element: symmetry, zero-energy modes, patch test, mass, invariance, limits.
#include "reducer/elements/beam/beam.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "common/math/rotation.hpp"

namespace tisserand::reducer::beam_test {
namespace {

using Eigen::Vector3d;
using formats::BeamTheory;
using formats::MassMatrix;

BeamElementData example(BeamTheory theory, MassMatrix mass_matrix, RotaryInertia rotary) {
  BeamElementData beam;
  beam.section = {"s", 2e-3, 3e-7, 8e-7, 6e-7, 11e-7, 1.6e-3, 1.5e-3, ""};
  beam.material = {"m", 2.1e11, 0.3, 7850.0, ""};
  beam.length = 0.4;
  beam.theory = theory;
  beam.mass_matrix = mass_matrix;
  beam.rotary_inertia = rotary;
  return beam;
}

/// Unit translations and rotations about node 1 + `offset`.
Eigen::Matrix<double, 12, 6> rigid(const Vector3d& first, const Vector3d& second) {
  Eigen::Matrix<double, 12, 6> R = Eigen::Matrix<double, 12, 6>::Zero();
  R.block<6, 6>(0, 0).setIdentity();
  R.block<6, 6>(6, 0).setIdentity();
  R.block<3, 3>(0, 3) = -skew<double>(first);
  R.block<3, 3>(6, 3) = -skew<double>(second);
  return R;
}

struct Variant {
  BeamTheory theory;
  MassMatrix mass_matrix;
  RotaryInertia rotary;
};

class BeamLaws : public ::testing::TestWithParam<Variant> {
 protected:
  BeamElementData beam = example(GetParam().theory, GetParam().mass_matrix, GetParam().rotary);
  Eigen::Matrix3d R_PE = exp_so3<double>(Vector3d(0.3, -1.1, 0.7));
  Vector3d first{0.2, -0.5, 0.9};
  Vector3d second = first + R_PE.col(0) * beam.length;
};

TEST_P(BeamLaws, StiffnessIsSymmetricWithSixZeroEnergyModes) {
  const Matrix12 K = to_part_axes(beam_stiffness(beam), R_PE);
  EXPECT_EQ((K - K.transpose()).cwiseAbs().maxCoeff(), 0.0);
  // Round-off of twelve products of entries of the size of the largest.
  EXPECT_LT((K * rigid(first, second)).cwiseAbs().maxCoeff(), 1e-14 * K.cwiseAbs().maxCoeff());
  Matrix12 scale = Matrix12::Identity();  // rotations of unit edge displacement: eigenvalues of one unit
  for (int i : {3, 4, 5, 9, 10, 11}) scale(i, i) = 1.0 / beam.length;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scale * K * scale);
  EXPECT_LT(std::abs(solver.eigenvalues()[5]), 1e-13 * solver.eigenvalues()[11]);
  EXPECT_GT(solver.eigenvalues()[6], 1e-6 * solver.eigenvalues()[11]);
}

TEST_P(BeamLaws, MassIsThatOfTheBody) {
  const Matrix12 M = to_part_axes(beam_mass(beam), R_PE);
  EXPECT_EQ((M - M.transpose()).cwiseAbs().maxCoeff(), 0.0);
  const Vector3d middle = 0.5 * (first + second);
  const Eigen::Matrix<double, 6, 6> rigid_mass =
      rigid(first - middle, second - middle).transpose() * M * rigid(first - middle, second - middle);
  const double rho = beam.material.density, L = beam.length, m = rho * beam.section.area * L;
  const bool rotary = beam.rotary_inertia == RotaryInertia::with;
  // Consistent: the slender body, m L²/12; lumped: half of the mass at either end, m L²/4.
  const double lengthwise = beam.mass_matrix == MassMatrix::consistent ? m * L * L / 12.0 : m * L * L / 4.0;
  const Vector3d inertia(rho * beam.section.polar_moment * L,
                         lengthwise + (rotary ? rho * beam.section.second_moment_y * L : 0.0),
                         lengthwise + (rotary ? rho * beam.section.second_moment_z * L : 0.0));
  Eigen::Matrix<double, 6, 6> expected = Eigen::Matrix<double, 6, 6>::Zero();
  expected.topLeftCorner<3, 3>().diagonal().setConstant(m);
  expected.bottomRightCorner<3, 3>() = R_PE * inertia.asDiagonal() * R_PE.transpose();
  EXPECT_LT((rigid_mass - expected).cwiseAbs().maxCoeff(), 1e-13 * m);
}

TEST_P(BeamLaws, MassIsPositiveExceptWhatIsLeftOut) {
  const Eigen::VectorXd value = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(beam_mass(beam)).eigenvalues();
  const bool massless = beam.mass_matrix == MassMatrix::lumped && beam.rotary_inertia == RotaryInertia::without;
  EXPECT_EQ((value.array() > 1e-14 * value.maxCoeff()).count(), massless ? 8 : 12);  // four bending rotations less
}

TEST_P(BeamLaws, EnergiesDoNotDependOnTheAxes) {
  const Eigen::VectorXd S = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(beam_stiffness(beam)).eigenvalues();
  const Eigen::VectorXd turned =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(to_part_axes(beam_stiffness(beam), R_PE)).eigenvalues();
  EXPECT_LT((S - turned).cwiseAbs().maxCoeff(), 1e-13 * S.maxCoeff());
  const Eigen::VectorXd M = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(beam_mass(beam)).eigenvalues();
  const Eigen::VectorXd mass =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(to_part_axes(beam_mass(beam), R_PE)).eigenvalues();
  EXPECT_LT((M - mass).cwiseAbs().maxCoeff(), 1e-13 * M.maxCoeff());
}

TEST_P(BeamLaws, RotaryInertiaOffKeepsTheTorsionalOne) {
  beam.rotary_inertia = RotaryInertia::with;
  const Matrix12 with = beam_mass(beam);
  beam.rotary_inertia = RotaryInertia::without;
  const Matrix12 without = beam_mass(beam);
  EXPECT_EQ(with(3, 3), without(3, 3));
  EXPECT_GT(with(4, 4), without(4, 4));
  EXPECT_GT(with(5, 5), without(5, 5));
}

INSTANTIATE_TEST_SUITE_P(
    All, BeamLaws,
    ::testing::Values(Variant{BeamTheory::timoshenko, MassMatrix::consistent, RotaryInertia::with},
                      Variant{BeamTheory::timoshenko, MassMatrix::consistent, RotaryInertia::without},
                      Variant{BeamTheory::timoshenko, MassMatrix::lumped, RotaryInertia::with},
                      Variant{BeamTheory::euler_bernoulli, MassMatrix::consistent, RotaryInertia::with},
                      Variant{BeamTheory::euler_bernoulli, MassMatrix::lumped, RotaryInertia::without}));

/// Patch test: node 1 held, one load at node 2, one element: the exact solution of the Timoshenko cantilever
/// (axial F L/EA, twist T L/GJ, deflection P L³/3EI + P L/GA_s, slope P L²/2EI; moment: M L²/2EI, M L/EI).
TEST(BeamPatch, OneElementIsExactForEndLoads) {
  const BeamElementData beam = example(BeamTheory::timoshenko, MassMatrix::consistent, RotaryInertia::with);
  const double E = 2.1e11, G = E / 2.6, L = 0.4;
  const formats::Section& s = beam.section;
  const double EIy = E * s.second_moment_y, EIz = E * s.second_moment_z;
  Eigen::Matrix<double, 6, 6> expected = Eigen::Matrix<double, 6, 6>::Zero();  // flexibility at node 2
  expected(0, 0) = L / (E * s.area);
  expected(3, 3) = L / (G * s.torsion_constant);
  expected(1, 1) = L * L * L / (3.0 * EIz) + L / (G * s.shear_area_y);
  expected(5, 5) = L / EIz;
  expected(1, 5) = expected(5, 1) = L * L / (2.0 * EIz);
  expected(2, 2) = L * L * L / (3.0 * EIy) + L / (G * s.shear_area_z);
  expected(4, 4) = L / EIy;
  expected(2, 4) = expected(4, 2) = -L * L / (2.0 * EIy);  // w' = −θy
  const Eigen::Matrix<double, 6, 6> flexibility = beam_stiffness(beam).bottomRightCorner<6, 6>().inverse();
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      EXPECT_NEAR(flexibility(i, j), expected(i, j), 1e-12 * std::sqrt(expected(i, i) * expected(j, j))) << i << j;
}

/// ρAL/420 [156 22L 54 −13L; . 4L² 13L −3L²; ...], in every textbook (e.g. [Prz68] 11.4).
TEST(BeamMass, EulerBernoulliWithoutRotaryInertiaIsTheTextbookMatrix) {
  const BeamElementData beam = example(BeamTheory::euler_bernoulli, MassMatrix::consistent, RotaryInertia::without);
  const Matrix12 M = beam_mass(beam);
  const double L = beam.length, unit = beam.material.density * beam.section.area * L / 420.0;
  EXPECT_NEAR(M(1, 1), 156.0 * unit, 1e-13 * unit * 156.0);
  EXPECT_NEAR(M(1, 5), 22.0 * L * unit, 1e-13 * unit * 22.0);
  EXPECT_NEAR(M(1, 7), 54.0 * unit, 1e-13 * unit * 54.0);
  EXPECT_NEAR(M(1, 11), -13.0 * L * unit, 1e-13 * unit * 13.0);
  EXPECT_NEAR(M(5, 5), 4.0 * L * L * unit, 1e-13 * unit);
  EXPECT_NEAR(M(5, 11), -3.0 * L * L * unit, 1e-13 * unit);
  EXPECT_NEAR(M(2, 4), -22.0 * L * unit, 1e-13 * unit * 22.0);
}

TEST(BeamTheories, EulerBernoulliIsTheLimitOfStiffShear) {
  BeamElementData stiff = example(BeamTheory::timoshenko, MassMatrix::consistent, RotaryInertia::with);
  const BeamElementData bernoulli = example(BeamTheory::euler_bernoulli, MassMatrix::consistent, RotaryInertia::with);
  stiff.section.shear_area_y = stiff.section.shear_area_z = 1e9;  // Φ of order 1e-12
  EXPECT_LT((beam_stiffness(stiff) - beam_stiffness(bernoulli)).cwiseAbs().maxCoeff(),
            1e-11 * beam_stiffness(bernoulli).cwiseAbs().maxCoeff());
  EXPECT_LT((beam_mass(stiff) - beam_mass(bernoulli)).cwiseAbs().maxCoeff(), 1e-11 * beam_mass(bernoulli).maxCoeff());
}

TEST(BeamAxes, YIsThePartOfTheOrientationNormalToTheAxis) {
  const auto axes = beam_axes(Vector3d(2, 0, 0), Vector3d(5, 0, 3));
  ASSERT_TRUE(axes);
  EXPECT_LT((axes->col(1) - Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_LT((axes->col(2) + Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_FALSE(beam_axes(Vector3d(1, 1, 0), Vector3d(-2, -2, 0)));
}

}  // namespace
}  // namespace tisserand::reducer::beam_test
