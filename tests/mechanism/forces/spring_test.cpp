// SPDX-License-Identifier: GPL-3.0-or-later
// Springs with stops, and prescribed motions: laws against their derivatives and against known functions; jumps in
// time.
#include "mechanism/forces/spring.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mechanism/forces/motion_function.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::spring_test {
namespace {

Spring stopped_spring() {
  Spring s;
  s.stiffness = 30.0;
  s.damping = 2.0;
  s.free = 0.1;
  s.lower = -0.3;
  s.upper = 0.4;
  s.stop_stiffness = 500.0;
  s.stop_damping = 0.7;
  return s;
}

// Inside, in both stops, and leaving a stop faster than it follows (1 + d g' < 0). Q is quadratic at most: central
// differences are exact but for round-off.
TEST(SpringForce, DerivativesAreThoseOfTheForce) {
  const Spring s = stopped_spring();
  const double h = 1e-4;
  for (const auto& [q, qd] : {std::pair{0.0, 0.5}, {0.6, 0.9}, {-0.5, -0.8}, {0.6, -3.0}}) {
    const SpringForce f = spring_force(s, q, qd, 1.5);
    EXPECT_NEAR(f.dQ_dq, (spring_force(s, q + h, qd, 1.5).Q - spring_force(s, q - h, qd, 1.5).Q) / (2 * h), 1e-8);
    EXPECT_NEAR(f.dQ_dqd, (spring_force(s, q, qd + h, 1.5).Q - spring_force(s, q, qd - h, 1.5).Q) / (2 * h), 1e-8);
    // Power of the force without the applied one = −(rate of the energy) − dissipated.
    const double rate = (spring_force(s, q + h, qd, 0).energy - spring_force(s, q - h, qd, 0).energy) / (2 * h) * qd;
    EXPECT_NEAR((f.Q - 1.5) * qd, -rate - f.dissipated, 1e-8);
    EXPECT_GE(f.dissipated, 0.0);
  }
  // A stop never pulls.
  EXPECT_DOUBLE_EQ(spring_force(s, 0.6, -3.0, 0).Q, -30.0 * 0.5 + 2.0 * 3.0);
}

// sin 3t with a spacing of 0.01: the differences of order six err by 3^7 d^6/140 and 3^8 d^6/560, round-off 1e-16/d^2.
TEST(MotionFunction, DifferentiatesExpressions) {
  MotionFunction f(formats::TimeExpression{"sin(3*t)", {}, ""}, 0.01);
  const MotionFunction::Value v = f(0.7);
  EXPECT_DOUBLE_EQ(v.value, std::sin(2.1));
  EXPECT_NEAR(v.rate, 3 * std::cos(2.1), 2e-11);
  EXPECT_NEAR(v.acceleration, -9 * std::sin(2.1), 2e-11);
}

// A formula whose pieces miss each other by 1e-8 at 0.7, which belongs to the second one. Each side is its own
// polynomial, also at the breakpoint and where round-off of t lies beyond it: 1e-8/d^2 = 1e-2 of acceleration
// otherwise.
TEST(MotionFunction, EndsOfPiecesAreTheirOwn) {
  const double at = 0.7, d = 1e-3;
  MotionFunction f(formats::TimeExpression{"t < 0.7 ? 3*t : 3*t + 1e-8", {}, ""}, d);
  for (const double t : {std::nextafter(at, 0.0), at, at + 1e-13}) {
    const MotionFunction::Value before = f(t, at - 1e-12), after = f(t, at + 1e-12);
    EXPECT_NEAR(before.value, 3 * t, 1e-14);
    EXPECT_NEAR(after.value, 3 * t + 1e-8, 1e-14);
    for (const auto& v : {before, after}) {
      EXPECT_NEAR(v.rate, 3.0, 1e-11);
      EXPECT_NEAR(v.acceleration, 0.0, 1e-7);  // 4e-16 * 100/d^2
    }
  }
}

// A force along a guide that is switched on at 0.5: v = F (t - 0.5)/m to round-off, as the start after the jump is
// exact.
TEST(SpringForce, JumpsAreMetAtTheirInstant) {
  formats::Scene scene = test_support::empty_scene(0.01, 1.0);
  scene.bodies.push_back(test_support::rigid_body("mass", 2.0, Eigen::Vector3d::Zero(), {0.1, 0.1, 0.1}));
  scene.joints.push_back(test_support::joint("guide", formats::JointKind::prismatic, "ground", "mass",
                                             Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()));
  formats::SpringSpec push;
  push.name = "push";
  push.coordinate = formats::CoordinateRef{"guide", ""};
  push.force = formats::TimeExpression{"t < 0.5 ? 0 : 10", {0.5}, ""};
  scene.springs.push_back(push);
  test_support::Simulation run(scene, {});
  run.start();
  run.run(1.0);
  EXPECT_NEAR(run.state().v().head<3>().norm(), 10.0 * 0.5 / 2.0, 1e-11);
  EXPECT_NEAR(run.state().work(), 0.5 * 2.0 * 2.5 * 2.5, 1e-9);
}

}  // namespace
}  // namespace tisserand::mechanism::spring_test
