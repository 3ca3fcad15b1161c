// SPDX-License-Identifier: GPL-3.0-or-later
// Sections of shells from plies against closed forms.
#include "reducer/properties/laminate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "common/error.hpp"

namespace tisserand::reducer::laminate_test {
namespace {

Ply isotropic_ply(double thickness, double angle) {
  return {2e11, 2e11, 0.3, 2e11 / 2.6, 2e11 / 2.6, 2e11 / 2.6, 8000.0, thickness, angle};
}

TEST(Laminate, IsotropicPliesMakeTheIsotropicSheet) {
  const ShellSection expected = isotropic_shell(2e11, 0.3, 8000.0, 0.06, 5.0 / 6.0);
  const ShellSection s =
      laminate({isotropic_ply(0.01, 0.3), isotropic_ply(0.03, -1.1), isotropic_ply(0.02, 0.7)}, -0.03);
  EXPECT_LT((s.A - expected.A).cwiseAbs().maxCoeff(), 1e-13 * expected.A(0, 0));
  EXPECT_LT(s.B.cwiseAbs().maxCoeff(), 1e-13 * expected.A(0, 0) * 0.06);
  EXPECT_LT((s.D - expected.D).cwiseAbs().maxCoeff(), 1e-13 * expected.D(0, 0));
  EXPECT_LT((s.As - expected.As).cwiseAbs().maxCoeff(), 1e-12 * expected.As(0, 0));  // 5/6, whatever the plies
  EXPECT_NEAR(s.mass, 480.0, 1e-9);
  EXPECT_NEAR(s.first_moment, 0.0, 1e-12);
  EXPECT_NEAR(s.rotary_inertia, 8000.0 * 0.06 * 0.06 * 0.06 / 12.0, 1e-12);
}

/// [0/90] of equal plies: A = (Q0 + Q90) t, B11 = (Q22 - Q11) t²/2 = -B22, D = (Q0 + Q90) t³/3.
TEST(Laminate, CrossPlyOfTwoHasTheKnownCoupling) {
  const double t = 0.004, E1 = 140e9, E2 = 10e9, nu = 0.3;
  const Ply ply{E1, E2, nu, 5e9, 5e9, 3e9, 1600.0, t, 0.0};
  Ply across = ply;
  across.angle = 0.5 * std::numbers::pi;
  const ShellSection s = laminate({ply, across}, -t);
  const double f = 1.0 - nu * nu * E2 / E1, Q11 = E1 / f, Q22 = E2 / f;
  EXPECT_NEAR(s.A(0, 0), (Q11 + Q22) * t, 1e-12 * Q11 * t);
  EXPECT_NEAR(s.B(0, 0), 0.5 * (Q22 - Q11) * t * t, 1e-12 * Q11 * t * t);
  EXPECT_NEAR(s.B(1, 1), 0.5 * (Q11 - Q22) * t * t, 1e-12 * Q11 * t * t);
  EXPECT_NEAR(s.B(2, 2), 0.0, 1e-12 * Q11 * t * t);
  EXPECT_NEAR(s.D(0, 0), (Q11 + Q22) * t * t * t / 3.0, 1e-12 * Q11 * t * t * t);
  EXPECT_NEAR(s.D(2, 2), 5e9 * 8.0 * t * t * t / 12.0, 1e-12 * Q11 * t * t * t);
}

/// Two thin stiff faces around a soft core: nearly all shear is in the core at constant stress, and
/// As → G (c + f)²/c with the core's thickness c and that of a face f (sandwich theory), to the order of f/c and
/// E_c/E_f.
TEST(Laminate, SandwichHasTheShearStiffnessOfItsCore) {
  const double f = 1e-4, c = 2e-2, G = 30e6;
  const Ply face{7e10, 7e10, 0.3, 2.7e10, 2.7e10, 2.7e10, 2700.0, f, 0.0};
  const Ply core{1e5, 1e5, 0.0, 1e5, G, 2.0 * G, 50.0, c, 0.0};
  const ShellSection s = laminate({face, core, face}, -0.5 * c - f);
  EXPECT_NEAR(s.As(0, 0) / (G * (c + f) * (c + f) / c), 1.0, 2e-3);
  EXPECT_NEAR(s.As(1, 1) / (2.0 * G * (c + f) * (c + f) / c), 1.0, 2e-3);
}

/// Turning the whole laminate turns its shear stiffness: it has no preferred axes.
TEST(Laminate, ShearStiffnessTurnsByARightAngle) {
  const Ply ply{140e9, 10e9, 0.3, 5e9, 5e9, 3e9, 1600.0, 0.01, 0.4};
  Ply second = ply;
  second.angle = -0.2;
  const ShellSection s = laminate({ply, second, ply}, -0.015);
  Ply turned = ply, turned_second = second;
  turned.angle += 0.5 * std::numbers::pi;
  turned_second.angle += 0.5 * std::numbers::pi;
  const ShellSection r = laminate({turned, turned_second, turned}, -0.015);
  EXPECT_NEAR(r.As(0, 0), s.As(1, 1), 1e-10 * s.As(0, 0));
  EXPECT_NEAR(r.As(1, 1), s.As(0, 0), 1e-10 * s.As(0, 0));
  EXPECT_NEAR(r.As(0, 1), -s.As(0, 1), 1e-10 * s.As(0, 0));
}

/// A section about another reference surface: parallel axes.
TEST(Laminate, ReferenceSurfaceMovesByParallelAxes) {
  const Ply ply{140e9, 10e9, 0.3, 5e9, 5e9, 3e9, 1600.0, 0.01, 0.4};
  Ply second = ply;
  second.angle = -0.9;
  second.density = 3000.0;
  const double d = 0.07;
  const ShellSection s = laminate({ply, second}, -0.01), m = laminate({ply, second}, -0.01 + d);
  EXPECT_LT((m.B - s.B - d * s.A).norm(), 1e-12 * d * s.A.norm());
  EXPECT_LT((m.D - s.D - 2.0 * d * s.B - d * d * s.A).norm(), 1e-12 * m.D.norm());
  EXPECT_LT((m.As - s.As).norm(), 1e-9 * s.As.norm());
  EXPECT_NEAR(m.first_moment, s.first_moment + d * s.mass, 1e-12 * m.first_moment);
  EXPECT_NEAR(m.rotary_inertia, s.rotary_inertia + 2.0 * d * s.first_moment + d * d * s.mass, 1e-12 * m.rotary_inertia);
}

TEST(Laminate, BadPliesAreNamed) {
  const auto message = [](auto change) -> std::string {
    std::vector<Ply> plies(2, isotropic_ply(0.01, 0.0));
    change(plies[1]);
    try {
      check_plies(plies, "deck.bdf:7");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message([](Ply&) {}), "");
  EXPECT_THAT(message([](Ply& p) { p.thickness = 0.0; }), ::testing::HasSubstr("deck.bdf:7: ply 2: thickness is 0"));
  EXPECT_THAT(message([](Ply& p) { p.E2 = -1.0; }), ::testing::HasSubstr("ply 2: E2 is -1"));
  EXPECT_THAT(message([](Ply& p) { p.G13 = std::numeric_limits<double>::infinity(); }),
              ::testing::HasSubstr("ply 2: G13 is inf"));
  EXPECT_THAT(message([](Ply& p) { p.nu12 = 1.0; }), ::testing::HasSubstr("ply 2: nu12 is 1"));
  EXPECT_THAT(message([](Ply& p) { p.density = std::nan(""); }), ::testing::HasSubstr("ply 2: density is nan"));
  EXPECT_THROW(check_plies({}, "x"), Error);
}

}  // namespace
}  // namespace tisserand::reducer::laminate_test
