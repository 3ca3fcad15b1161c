// SPDX-License-Identifier: GPL-3.0-or-later
// Springs and bushings between two nodes: energies by hand, rigid motions, and the measure that tells when they fail.
#include "reducer/elements/spring.hpp"

#include <random>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "common/math/rotation.hpp"
#include "reducer/elements/beam/beam.hpp"
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer::spring_test {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Vector12 = Eigen::Matrix<double, 12, 1>;

const Eigen::Vector3d span(1.0, 2.0, -0.5);

/// Rotation by theta about `center` of nodes at 0 and `span`.
Vector12 turned(const Eigen::Vector3d& theta, const Eigen::Vector3d& center) {
  Vector12 q;
  q << theta.cross(-center), theta, theta.cross(span - center), theta;
  return q;
}

Matrix6 coupled_stiffness() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Matrix6 A = Matrix6::NullaryExpr([&] { return uniform(random); });
  return A * A.transpose() + Matrix6::Identity();
}

TEST(Spring, ScalarSpringSeesOneComponentOfEachNodeInItsAxes) {
  const Eigen::Matrix3d R = exp_so3<double>(Eigen::Vector3d(0.3, -0.8, 1.1));
  const Matrix12 K = scalar_spring(5.0, {1, R}, {3, Eigen::Matrix3d::Identity()});
  Vector12 q = Vector12::LinSpaced(0.1, 1.2);
  const double elongation = q[9] - R.col(1).dot(q.head<3>());
  EXPECT_NEAR(q.dot(K * q), 5.0 * elongation * elongation, 1e-14);
}

TEST(Spring, AxialSpringLetsThePartFloat) {
  const auto K = axial_spring(7.0, span);
  ASSERT_TRUE(K);
  EXPECT_LT((*K * turned({0.3, -0.2, 0.9}, {4.0, 1.0, 2.0})).norm(), 1e-14);
  EXPECT_LT(rigid_motion_defect(*K, span), 1e-15);
  Vector12 pulled = Vector12::Zero();
  pulled.segment<3>(6) = 0.1 * span.normalized();
  EXPECT_NEAR(pulled.dot(*K * pulled), 7.0 * 0.01, 1e-15);
  EXPECT_FALSE(axial_spring(7.0, Eigen::Vector3d::Zero()));
}

/// Two arms to one point: six zero modes, and the energy is that of the relative motion at that point in axes B.
TEST(Spring, BushingActsAtItsPlace) {
  const Eigen::Vector3d place(0.2, -0.4, 3.0);
  const Eigen::Matrix3d R_PB = exp_so3<double>(Eigen::Vector3d(-0.5, 0.6, 0.2));
  const Matrix6 K_B = coupled_stiffness();
  const Matrix12 K = bushing(K_B, {place, place - span, R_PB});
  EXPECT_LT(rigid_motion_defect(K, span), 1e-15);
  EXPECT_LT((K * turned({0.3, -0.2, 0.9}, {4.0, 1.0, 2.0})).norm(), 1e-13 * K.norm());
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues();
  EXPECT_LT(eigenvalues.head<6>().cwiseAbs().maxCoeff(), 1e-14 * eigenvalues.maxCoeff());
  EXPECT_GT(eigenvalues[6], 1e-4 * eigenvalues.maxCoeff());

  const Eigen::Vector3d theta(0.1, 0.2, -0.3), shift(0.4, 0.5, 0.6);  // of the second node
  Vector12 q = Vector12::Zero();
  q.segment<3>(6) = shift;
  q.tail<3>() = theta;
  Eigen::Matrix<double, 6, 1> d;
  d << R_PB.transpose() * (shift + theta.cross(place - span)), R_PB.transpose() * theta;
  EXPECT_NEAR(q.dot(K * q), d.dot(K_B * d), 1e-13 * d.dot(K_B * d));
}

/// A translational spring across a distance resists turning: with k across d, turning by 1 rad about the middle strains
/// it by d, so the scaled defect is exactly 1. Along the line between the nodes, or at coincident nodes, it is 0.
TEST(Spring, DefectReportsGroundedSprings) {
  const Eigen::Vector3d along_x(2.5, 0.0, 0.0);
  EXPECT_NEAR(rigid_motion_defect(
                  scalar_spring(3.0, {1, Eigen::Matrix3d::Identity()}, {1, Eigen::Matrix3d::Identity()}), along_x),
              1.0, 1e-15);
  EXPECT_EQ(rigid_motion_defect(scalar_spring(3.0, {0, Eigen::Matrix3d::Identity()}, {0, Eigen::Matrix3d::Identity()}),
                                along_x),
            0.0);
  EXPECT_EQ(rigid_motion_defect(scalar_spring(3.0, {1, Eigen::Matrix3d::Identity()}, {1, Eigen::Matrix3d::Identity()}),
                                Eigen::Vector3d::Zero()),
            0.0);
  EXPECT_GT(rigid_motion_defect(bushing(coupled_stiffness(), {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                                              Eigen::Matrix3d::Identity()}),
                                along_x),
            0.1);
  EXPECT_EQ(rigid_motion_defect(Matrix12::Zero(), along_x), 0.0);
}

TEST(Spring, ElementMatricesAreTheStiffnessAndNoMass) {
  Spring spring;
  spring.stiffness = bushing(coupled_stiffness(), {});
  ElementMatrices out;
  element_matrices(Mesh{}, spring, out);
  EXPECT_EQ(out.S, Eigen::MatrixXd(spring.stiffness));
  EXPECT_EQ(out.M, Eigen::MatrixXd(Matrix12::Zero()));
}

}  // namespace
}  // namespace tisserand::reducer::spring_test
