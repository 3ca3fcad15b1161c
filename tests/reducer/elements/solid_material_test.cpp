// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic matrices of solids: strains of simple tests, material axes, and constants that cannot be.
#include <limits>

#include "reducer/properties/solid_material.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/LU>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "reducer/properties/solid_anisotropic.hpp"

namespace tisserand::reducer::solid_material_test {
namespace {

/// Constants of a carbon laminate of the usual kind, in GPa.
OrthotropicConstants carbon() { return {140.0, 10.0, 9.0, 0.3, 0.32, 0.4, 5.0, 3.5, 4.5}; }

TEST(SolidMaterial, IsotropicUnderOneStressStretchesByOneOverE) {
  const Matrix6 compliance = isotropic_solid(210.0, 0.3, 1.0).C.inverse();
  EXPECT_NEAR(compliance(0, 0), 1.0 / 210.0, 1e-16);
  EXPECT_NEAR(compliance(1, 0), -0.3 / 210.0, 1e-16);
  EXPECT_NEAR(compliance(5, 5), 2.6 / 210.0, 1e-16);
}

TEST(SolidMaterial, OrthotropicComplianceHasTheEngineeringConstants) {
  const OrthotropicConstants c = carbon();
  const Matrix6 compliance = orthotropic_elasticity(c, "test").inverse();
  Matrix6 expected = Matrix6::Zero();
  expected.diagonal() << 1.0 / c.E1, 1.0 / c.E2, 1.0 / c.E3, 1.0 / c.G12, 1.0 / c.G23, 1.0 / c.G31;
  expected(0, 1) = expected(1, 0) = -c.nu12 / c.E1;
  expected(0, 2) = expected(2, 0) = -c.nu13 / c.E1;
  expected(1, 2) = expected(2, 1) = -c.nu23 / c.E2;
  EXPECT_LT((compliance - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(SolidMaterial, IsotropicDoesNotFeelItsAxes) {
  const Matrix6 C = isotropic_solid(210.0, 0.3, 1.0).C;
  const Eigen::Matrix3d R = exp_so3<double>(Eigen::Vector3d(0.4, 1.3, -0.7));
  EXPECT_LT((rotated_elasticity(C, R) - C).cwiseAbs().maxCoeff(), 1e-13 * C.cwiseAbs().maxCoeff());
}

/// Turned by 90° about z, direction 1 of the material is y of the part: rows change places, nothing else.
TEST(SolidMaterial, QuarterTurnPermutesTheConstants) {
  const Matrix6 C = orthotropic_elasticity(carbon(), "test");
  Eigen::Matrix3d R_PM;
  R_PM << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const Matrix6 turned = rotated_elasticity(C, R_PM);
  EXPECT_NEAR(turned(1, 1), C(0, 0), 1e-12);
  EXPECT_NEAR(turned(0, 0), C(1, 1), 1e-12);
  EXPECT_NEAR(turned(1, 2), C(0, 2), 1e-12);
  EXPECT_NEAR(turned(3, 3), C(3, 3), 1e-12);
  EXPECT_NEAR(turned(4, 4), C(5, 5), 1e-12);  // yz of the part is 13 of the material
  EXPECT_NEAR(turned(5, 5), C(4, 4), 1e-12);
}

/// Young's modulus at an angle θ in the 1-2 plane: 1/E = c⁴/E1 + s⁴/E2 + c²s²(1/G12 − 2 nu12/E1), classical lamina
/// theory.
TEST(SolidMaterial, ModulusAtAnAngleFollowsTheLaminaFormula) {
  const OrthotropicConstants k = carbon();
  const double angle = 0.6, c = std::cos(angle), s = std::sin(angle);
  const Eigen::Matrix3d R_PM = exp_so3<double>(Eigen::Vector3d(0.0, 0.0, angle));
  const Matrix6 compliance = rotated_elasticity(orthotropic_elasticity(k, "test"), R_PM).inverse();
  const double expected =
      std::pow(c, 4) / k.E1 + std::pow(s, 4) / k.E2 + c * c * s * s * (1.0 / k.G12 - 2.0 * k.nu12 / k.E1);
  EXPECT_NEAR(compliance(0, 0), expected, 1e-15);
}

TEST(SolidMaterial, ImpossibleConstantsAreErrorsWithTheirPlace) {
  OrthotropicConstants bad = carbon();
  bad.nu23 = 1.2;  // nu23² > E2/E3
  try {
    orthotropic_elasticity(bad, "deck.bdf:12");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("deck.bdf:12"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("1.2"));
  }
  bad = carbon();
  bad.G23 = 0.0;
  EXPECT_THROW(orthotropic_elasticity(bad, "x"), Error);
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  EXPECT_THROW(anisotropic_solid(-Matrix6::Identity(), one, 1.0, "x"), Error);
  Matrix6 skewed = 10.0 * Matrix6::Identity();
  skewed(0, 1) = 1.0;
  EXPECT_THROW(anisotropic_solid(skewed, one, 1.0, "x"), Error);
  EXPECT_THROW(anisotropic_solid(Matrix6::Constant(std::numeric_limits<double>::quiet_NaN()), one, 1.0, "x"), Error);
}

}  // namespace
}  // namespace tisserand::reducer::solid_material_test
