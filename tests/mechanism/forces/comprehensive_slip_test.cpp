// SPDX-License-Identifier: GPL-3.0-or-later
// The law of comprehensive slip: exact values, the friction circle, no jump.
#include "mechanism/tyres/comprehensive_slip.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace tisserand::mechanism::comprehensive_slip_test {
namespace {

/// Fz = 3000 N, C_α = 60000 N/rad, patch of 0.2 m.
PatchSlip<double> slipping(double along, double across, double camber = 0.0) {
  return {along, across, std::sin(camber), 3000.0, 0.2, 0.3, 1.0};
}

// Pure side slip: F_y = μ F_z (3 s − 3 s² + s³), M_z = C_α S_α l (1 − s)³/6 with s = C_α S_α/(3 μ F_z): the brush
// model; for S_α = 0.05 that is 2111.111 N and M_z/l = 148.1481 N.
TEST(ComprehensiveSlip, PureSideSlipIsTheBrushModel) {
  const ComprehensiveSlip law{80e3, 60e3, 3e3, 1.0, 1.0};
  const PatchForce<double> example = patch_force(law, slipping(0.0, 0.05));
  EXPECT_NEAR(example.y, -2111.111, 5e-4);
  EXPECT_NEAR(example.moment / 0.2, 148.1481, 5e-5);
  for (double S = -0.149; S < 0.15; S += 0.01) {
    const double s = 60e3 * std::abs(S) / 9000.0, sign = S < 0.0 ? -1.0 : 1.0;
    const PatchForce<double> force = patch_force(law, slipping(0.0, S));
    EXPECT_NEAR(force.y, -sign * 3000.0 * (3 * s - 3 * s * s + s * s * s), 1e-9);
    EXPECT_NEAR(force.moment, 60e3 * S * 0.2 * std::pow(1 - s, 3) / 6.0, 1e-9);
    EXPECT_EQ(force.x, 0.0);
    EXPECT_NEAR(force.adhesion, 1.0 - s, 1e-14);
  }
}

// Where all slides, friction is μ F_z against the slip, with μ linear in the slip up to 1 and constant beyond.
TEST(ComprehensiveSlip, SlidingIsCoulombFrictionAgainstTheSlip) {
  const ComprehensiveSlip law{80e3, 60e3, 3e3, 1.0, 0.75};
  for (const double S : {0.3, 0.8, 1.0, 2.0, 50.0})
    for (const double angle : {0.0, 0.4, 1.5, 3.0, -2.0}) {
      const PatchForce<double> force = patch_force(law, slipping(S * std::cos(angle), S * std::sin(angle)));
      const double mu = 1.0 - 0.25 * std::min(S, 1.0);
      EXPECT_NEAR(force.x, -mu * 3000.0 * std::cos(angle), 1e-9);
      EXPECT_NEAR(force.y, -mu * 3000.0 * std::sin(angle), 1e-9);
      EXPECT_EQ(force.moment, 0.0);
      EXPECT_EQ(force.adhesion, 0.0);
    }
}

TEST(ComprehensiveSlip, StaysInTheFrictionCircleAndOpposesTheSlip) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> slip(-0.3, 0.3), camber(-0.4, 0.4), stiffness(2e4, 2e5);
  for (int i = 0; i < 2000; ++i) {
    const ComprehensiveSlip law{stiffness(random), stiffness(random), 3e3, 1.0, 0.75};
    const bool upright = i % 2 == 0;
    const PatchSlip<double> s = slipping(slip(random), slip(random), upright ? 0.0 : camber(random));
    const PatchForce<double> force = patch_force(law, s);
    EXPECT_LE(std::hypot(force.x, force.y), 3000.0 * (1 + 1e-12));
    EXPECT_LE(force.x * s.along, 0.0);
    EXPECT_TRUE(!upright || force.y * s.across <= 0.0);
  }
}

// Forces have slopes of at most a few times C_s or C_α (their slope at zero slip; 3 from q, camber and friction), so
// that a step of 2e-6 of slip through zero, the beginning of sliding or a slip of one changes them by less than 2 N.
TEST(ComprehensiveSlip, HasNoJumpAnywhere) {
  const ComprehensiveSlip law{80e3, 60e3, 3e3, 1.0, 0.75};
  for (const double other : {0.0, 0.02, -0.1, 0.9})
    for (const double camber : {0.0, 0.1, -0.2})
      for (const bool lateral : {false, true}) {
        PatchForce<double> last;
        double before = -9.0;
        for (double S = -1.2; S < 1.2; S += std::abs(S) < 0.3 || std::abs(std::abs(S) - 1.0) < 1e-3 ? 2e-6 : 1e-3) {
          const PatchForce<double> now =
              patch_force(law, lateral ? slipping(other, S, camber) : slipping(S, other, camber));
          ASSERT_TRUE(std::isfinite(now.x) && std::isfinite(now.y) && std::isfinite(now.moment));
          if (S - before < 3e-6) {
            ASSERT_LT(std::abs(now.x - last.x) + std::abs(now.y - last.y) + std::abs(now.moment - last.moment), 2.0)
                << S;
          }
          last = now;
          before = S;
        }
      }
}

}  // namespace
}  // namespace tisserand::mechanism::comprehensive_slip_test
