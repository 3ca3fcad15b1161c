// SPDX-License-Identifier: GPL-3.0-or-later
// Mass matrix of a point mass beside its node against the kinetic energy of a rigid body.
#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer::nodal_mass_test {
namespace {

/// 2 T = m |v + ω × c|² + ω·J_c ω for any velocity of the node.
TEST(NodalMass, HasTheKineticEnergyOfARigidBody) {
  NodalMass mass;
  mass.mass = 3.0;
  mass.inertia << 2.0, 0.1, -0.2, 0.1, 1.5, 0.3, -0.2, 0.3, 1.0;
  mass.offset = {0.4, -0.6, 0.9};
  const Eigen::Matrix<double, 6, 6> M = nodal_mass_matrix(mass);
  EXPECT_EQ(M, M.transpose());
  const Eigen::Vector3d v(0.3, -0.7, 0.2), omega(1.1, 0.4, -0.9);
  Eigen::Matrix<double, 6, 1> velocity;
  velocity << v, omega;
  const double twice = mass.mass * (v + omega.cross(mass.offset)).squaredNorm() + omega.dot(mass.inertia * omega);
  EXPECT_NEAR(velocity.dot(M * velocity), twice, 1e-14 * twice);
}

}  // namespace
}  // namespace tisserand::reducer::nodal_mass_test
