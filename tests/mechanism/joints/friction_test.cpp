// SPDX-License-Identifier: GPL-3.0-or-later
// Friction in joints: the law, exact derivatives in whole models, and motions with known answers.
#include "mechanism/joints/friction.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/scenes/joint_kinds.hpp"
#include "tests/support/scenes/model_tangent.hpp"

namespace tisserand::mechanism::friction_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;

constexpr double g = 9.81;

// Quadratic up to the static coefficient, flat there, down to the kinetic one, flat after that.
TEST(FrictionLaw, IsSmoothAndReachesItsCoefficients) {
  Friction f;
  f.kinetic = 0.2;
  f.stiction = 0.35;
  f.velocity = 0.01;
  const auto mu = [&](double s) { return friction_law(f, s).ratio * s; };
  EXPECT_DOUBLE_EQ(mu(0.005), 0.75 * 0.35);
  EXPECT_DOUBLE_EQ(mu(0.01), 0.35);
  EXPECT_DOUBLE_EQ(mu(0.02), 0.5 * (0.35 + 0.2));
  EXPECT_DOUBLE_EQ(mu(0.03), 0.2);
  EXPECT_DOUBLE_EQ(mu(7.0), 0.2);
  const double h = 1e-7;
  for (const double s : {0.004, 0.013, 0.029, 0.5})
    EXPECT_NEAR(friction_law(f, s).slope * s,
                s * (friction_law(f, s + h).ratio - friction_law(f, s - h).ratio) / (2 * h), 1e-5);
  for (const double s : {0.01, 0.03}) EXPECT_NEAR(mu(s + h), mu(s - h), 1e-7);
}

formats::JointSpec rubbing(JointKind kind, const Vector3d& axis, double coefficient, double velocity) {
  formats::JointSpec joint = test_support::joint("joint", kind, "ground", "body", Vector3d::Zero(), axis);
  joint.friction =
      formats::FrictionSpec{coefficient, {}, velocity, formats::joint_kind(kind).friction.radius ? 0.1 : 0.0, {}};
  return joint;
}

class RubbingJoint : public ::testing::TestWithParam<JointKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, RubbingJoint, ::testing::ValuesIn(test_support::every_joint_with_friction()),
                         test_support::joint_test_name);

// Between two bodies with offset and turned markers, speeds on all branches of the law. Central differences with 1e-6:
// kinks aside, 1e-8 relative to the largest entry.
TEST_P(RubbingJoint, IterationMatrixIsTheDerivativeOfTheResidual) {
  formats::Scene scene = test_support::empty_scene(0.01, 1.0);
  scene.bodies.push_back(test_support::rigid_body("other", 1.0, {0.1, 0.2, 0.3}, {0.3, 0.4, 0.5}));
  scene.bodies.push_back(test_support::rigid_body("body", 2.0, {-0.3, 0.2, 0.1}, {0.5, 0.4, 0.3}));
  formats::JointSpec joint = rubbing(GetParam(), {1, 2, 3}, 0.3, 0.0);
  joint.a.node = "other";
  joint.position = Vector3d(0.4, -0.2, 0.1);
  joint.friction->static_coefficient = 0.5;
  joint.pitch = 0.7;
  if (formats::joint_kind(GetParam()).friction.arm) joint.friction->arm = 0.6;
  for (const double velocity : {0.02, 0.1, 3.0}) {
    joint.friction->velocity = velocity;
    scene.joints = {joint};
    test_support::Simulation run(scene, {});
    const int n = run.model().sizes.boundary, m = run.model().sizes.constraints;
    for (unsigned seed = 0; seed < 3; ++seed) {
      test_support::randomise(run, seed, 0.3, 1.0);
      using test_support::Argument;
      const Eigen::MatrixXd K = test_support::iteration_matrix(run, {0, 0, 1});
      EXPECT_LT(
          test_support::relative_difference(K.topLeftCorner(n, n), residual_difference(run, Argument::position, 1e-6)),
          5e-8);
      EXPECT_LT(test_support::relative_difference(K.topRightCorner(n, m),
                                                  residual_difference(run, Argument::multiplier, 1e-6)),
                5e-8);
      EXPECT_GT((K.topRightCorner(n, m) - K.bottomLeftCorner(m, n).transpose()).norm(), 1e-3);
      const Eigen::MatrixXd C = test_support::damping_matrix(run);
      EXPECT_LT(test_support::relative_difference(C, residual_difference(run, Argument::velocity, 1e-6)), 5e-8);
    }
  }
}

/// A block on a guide along x, which falls at the given slope.
formats::Scene incline(double slope, double coefficient, double velocity, double step, double end) {
  formats::Scene scene = test_support::empty_scene(step, end);
  scene.gravity = g * Vector3d(slope, 0, -1) / std::sqrt(1.0 + slope * slope);
  scene.bodies.push_back(test_support::rigid_body("body", 2.0, Vector3d::Zero(), {0.1, 0.1, 0.1}));
  scene.joints.push_back(rubbing(JointKind::prismatic, Vector3d::UnitX(), coefficient, velocity));
  return scene;
}

// Slope 0.5 above μ = 0.3: a = g (sin α − μ cos α). While the speed is below 3 velocity friction differs: the speed
// errs by no more than that. At rest there is no friction: the first step begins with g sin α, half a step of μ g cos α
// too fast (6.6e-5 here).
TEST(Friction, BlockSlidesDownASteepIncline) {
  test_support::Simulation run(incline(0.5, 0.3, 1e-4, 5e-5, 1.0), {});
  run.start();
  run.run(1.0);
  const double a = g * (0.5 - 0.3) / std::sqrt(1.25);
  EXPECT_NEAR(run.velocity("body").x(), a, 3e-4);
  EXPECT_NEAR(run.position("body").x(), 0.5 * a, 3e-4);
}

// Slope 0.2 below μ = 0.3: F = ⅔ μ N; creeps with (1 − √(1 − ⅔)) velocity.
TEST(Friction, BlockCreepsOnAFlatIncline) {
  formats::Scene scene = incline(0.2, 0.3, 1e-3, 1e-3, 0.5);
  scene.integrator.rho = 0.5;
  test_support::Simulation run(scene, {});
  run.start();
  run.run(0.5);
  EXPECT_NEAR(run.velocity("body").x(), 1e-3 * (1.0 - std::sqrt(1.0 / 3.0)), 1e-9);
  EXPECT_LT(run.position("body").x(), 0.5e-3);
}

// With a static coefficient of 0.4 the same holds on a slope of 0.35 from rest; moving at 0.1 it goes on, faster.
TEST(Friction, StictionHoldsWhatSlidesOnceMoving) {
  for (const double v0 : {0.0, 0.1}) {
    formats::Scene scene = incline(0.35, 0.3, 1e-3, 1e-3, 0.5);
    scene.joints[0].friction->static_coefficient = 0.4;
    std::get<formats::RigidBodySpec>(scene.bodies[0]).start.velocity = {v0, 0, 0};
    scene.integrator.rho = 0.5;
    test_support::Simulation run(scene, {});
    run.start();
    run.run(0.5);
    if (v0 == 0.0)
      EXPECT_LT(run.velocity("body").x(), 1e-3);
    else
      EXPECT_NEAR(run.velocity("body").x(), v0 + 0.5 * g * 0.05 / std::sqrt(1.0 + 0.35 * 0.35), 1e-9);
  }
}

// A wheel on a shaft with a torsion spring, weight across the shaft: N = m g, M = μ r m g constant, so each half swing
// loses 2M/k of amplitude and the half period stays π √(J/k).
TEST(Friction, AmplitudeFallsLinearlyPerHalfSwing) {
  const double J = 0.5, k = 8.0, M = 0.2 * 0.1 * 2.0 * g, half = M_PI * std::sqrt(J / k);
  const auto error = [&](int steps) {
    formats::Scene scene = test_support::empty_scene(half / steps, 2.0 * half);
    scene.gravity = {-g, 0, 0};
    scene.bodies.push_back(test_support::rigid_body("body", 2.0, Vector3d::Zero(), {0.3, 0.3, J}));
    scene.joints.push_back(rubbing(JointKind::revolute, Vector3d::UnitZ(), 0.2, 1e-5));
    formats::SpringSpec spring;
    spring.name = "spring";
    spring.coordinate = formats::CoordinateRef{"joint", ""};
    spring.stiffness = k;
    spring.free = 1.0;
    scene.springs.push_back(spring);
    test_support::Simulation run(scene, {});
    run.start();
    run.run(half);
    const double first = run.state().hinges()[0] - 1.0;  // −1 at the start, deflection
    run.run(2.0 * half);
    const double second = run.state().hinges()[0] - 1.0;
    return std::max(std::abs(first - (1.0 - 2.0 * M / k)), std::abs(second + (1.0 - 4.0 * M / k)));
  };
  const double coarse = error(100), fine = error(400);
  EXPECT_LT(coarse, 3e-3);
  EXPECT_LT(fine, coarse / 3.0);
}

/// A body that turns on an overhung shaft along z: centre of mass d beyond the bearing, weight along −x.
// N = m g + 2 m g d/arm from force and moment; ω falls with μ r N/J.
TEST(Friction, OverhungBearingTakesTheMomentToo) {
  const double d = 0.15, arm = 0.3, J = 0.5, coefficient = 0.2;
  formats::Scene scene = test_support::empty_scene(1e-3, 0.3);
  scene.gravity = {-g, 0, 0};
  scene.bodies.push_back(test_support::rigid_body("body", 2.0, {0, 0, d}, {0.3, 0.3, J}));
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.angular_velocity = {0, 0, 5};
  scene.joints.push_back(rubbing(JointKind::revolute, Vector3d::UnitZ(), coefficient, 1e-4));
  scene.joints[0].friction->arm = arm;
  test_support::Simulation run(scene, {});
  run.start();
  run.run(0.3);
  const double N = 2.0 * g * (1.0 + 2.0 * d / arm);
  EXPECT_NEAR(run.Omega("body").z(), 5.0 - coefficient * 0.1 * N / J * 0.3, 1e-9);
}

// A ball about its centre: |ω| falls with μ r m g/J along its direction.
TEST(Friction, BallStopsAlongItsSpin) {
  formats::Scene scene = test_support::empty_scene(1e-3, 0.2);
  scene.gravity = {0, -g, 0};
  scene.bodies.push_back(test_support::rigid_body("body", 2.0, Vector3d::Zero(), {0.4, 0.4, 0.4}));
  const Vector3d omega(1, 2, -2);
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.angular_velocity = omega;
  scene.joints.push_back(rubbing(JointKind::spherical, Vector3d::UnitZ(), 0.3, 1e-4));
  test_support::Simulation run(scene, {});
  run.start();
  run.run(0.2);
  const double left = 3.0 - 0.3 * 0.1 * 2.0 * g / 0.4 * 0.2;
  EXPECT_LT((run.rotation("body") * run.Omega("body") - left / 3.0 * omega).norm(), 1e-9);
}

// Screwing slip on a cylinder: with J = m r² both parts slow down together, |s| by μ g.
TEST(Friction, SlipOnACylinderIsOneVector) {
  formats::Scene scene = test_support::empty_scene(1e-3, 0.3);
  scene.gravity = {-g, 0, 0};
  scene.bodies.push_back(test_support::rigid_body("body", 2.0, Vector3d::Zero(), {0.1, 0.1, 2.0 * 0.01}));
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.angular_velocity = {0, 0, 8};
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.velocity = {0, 0, 0.6};
  scene.joints.push_back(rubbing(JointKind::cylindrical, Vector3d::UnitZ(), 0.2, 1e-4));
  test_support::Simulation run(scene, {});
  run.start();
  run.run(0.3);
  const double factor = 1.0 - 0.2 * g * 0.3 / 1.0;  // |s| = √(0.8² + 0.6²) at the start
  EXPECT_NEAR(run.velocity("body").z(), 0.6 * factor, 1e-9);
  EXPECT_NEAR(run.Omega("body").z(), 8.0 * factor, 1e-8);
}

// A disc with J = m r² that slides and spins on a table: all three parts of the slip slow down together, |s| by μ g.
TEST(Friction, SlipOnATableIsOneVector) {
  formats::Scene scene = test_support::empty_scene(1e-3, 0.3);
  scene.gravity = {0, 0, -g};
  scene.bodies.push_back(test_support::rigid_body("body", 2.0, Vector3d::Zero(), {0.1, 0.1, 2.0 * 0.01}));
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.angular_velocity = {0, 0, 8};
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.velocity = {0.36, -0.48, 0};
  scene.joints.push_back(rubbing(JointKind::planar, Vector3d::UnitZ(), 0.2, 1e-4));
  test_support::Simulation run(scene, {});
  run.start();
  run.run(0.3);
  const double factor = 1.0 - 0.2 * g * 0.3 / 1.0;  // |s| = √(0.36² + 0.48² + 0.8²) at the start
  EXPECT_LT((run.velocity("body") - factor * Vector3d(0.36, -0.48, 0)).norm(), 1e-9);
  EXPECT_NEAR(run.Omega("body").z(), 8.0 * factor, 1e-8);
}

// A point slides on a plane, or along a line that lies level: its speed falls by μ g t.
TEST(Friction, PointSlows) {
  for (const bool on_plane : {true, false}) {
    formats::Scene scene = test_support::empty_scene(1e-3, 0.3);
    scene.gravity = {0, 0, -g};
    scene.bodies.push_back(test_support::rigid_body("body", 2.0, Vector3d::Zero(), {0.1, 0.2, 0.3}));
    const Vector3d direction = Vector3d(3, -4, 0) / 5.0;
    std::get<formats::RigidBodySpec>(scene.bodies[0]).start.velocity = direction;
    scene.joints.push_back(on_plane ? rubbing(JointKind::point_on_plane, Vector3d::UnitZ(), 0.2, 1e-4)
                                    : rubbing(JointKind::point_on_line, direction, 0.2, 1e-4));
    test_support::Simulation run(scene, {});
    run.start();
    run.run(0.3);
    EXPECT_LT((run.velocity("body") - (1.0 - 0.2 * g * 0.3) * direction).norm(), 1e-9);
  }
}

// A nut of pitch 2π k runs down a screw. The thread carries N along z; friction acts along the helix (r, k)/l:
// m k φ̈ = m g − N − μ N k/l and J φ̈ = k N − μ N r²/l.
TEST(Friction, NutRunsDownItsScrew) {
  const double m = 2.0, J = 0.05, k = 0.08, r = 0.1, mu = 0.2, l = std::hypot(r, k);
  formats::Scene scene = test_support::empty_scene(1e-3, 0.3);
  scene.gravity = {0, 0, g};
  scene.bodies.push_back(test_support::rigid_body("body", m, Vector3d::Zero(), {0.1, 0.1, J}));
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.angular_velocity = {0, 0, 1};
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.velocity = {0, 0, k};
  scene.joints.push_back(rubbing(JointKind::screw, Vector3d::UnitZ(), mu, 1e-4));
  scene.joints[0].pitch = 2.0 * M_PI * k;
  test_support::Simulation run(scene, {});
  run.start();
  run.run(0.3);
  const double lever = k - mu * r * r / l;  // of N about the axis
  const double N = m * g / (1.0 + mu * k / l + m * k * lever / J);
  EXPECT_NEAR(run.Omega("body").z(), 1.0 + N * lever / J * 0.3, 1e-8);
}

// A cross or a ball race that turns about a pin under a steady force m g: the angular velocity falls with μ r m g/J.
TEST(Friction, JointsOfShaftsSlowDown) {
  for (const JointKind kind : {JointKind::universal, JointKind::constant_velocity}) {
    formats::Scene scene = test_support::empty_scene(1e-3, 0.2);
    scene.gravity = {-g, 0, 0};
    scene.bodies.push_back(test_support::rigid_body("body", 2.0, Vector3d::Zero(), {0.4, 0.4, 0.4}));
    std::get<formats::RigidBodySpec>(scene.bodies[0]).start.angular_velocity = {3, 0, 0};
    scene.joints.push_back(rubbing(kind, Vector3d::UnitZ(), 0.3, 1e-4));
    scene.joints[0].x_axis = Vector3d::UnitX();
    test_support::Simulation run(scene, {});
    run.start();
    run.run(0.2);
    EXPECT_LT((run.Omega("body") - (3.0 - 0.3 * 0.1 * 2.0 * g / 0.4 * 0.2) * Vector3d::UnitX()).norm(), 1e-9);
  }
}

// A pendulum in a dry bearing, reactions changing all the time: the balance of energy is of second order in the step.
TEST(Friction, EnergyOfAPendulumIsBalanced) {
  const auto balance = [](double step) {
    formats::Scene scene = test_support::pendulum_scene(step, 0.6);
    scene.integrator.rho = 1.0;
    scene.joints[0].friction = formats::FrictionSpec{0.3, {}, 0.01, 0.05, {}};
    std::get<formats::RigidBodySpec>(scene.bodies[0]).start.angular_velocity = {0, 0, 2};
    test_support::Simulation run(scene, {});
    run.start();
    run.run(0.6);
    EXPECT_GT(run.state().dissipated(), 0.1);
    return run.energy().total() - run.state().initial_energy() + run.state().dissipated();
  };
  const double coarse = balance(0.002), fine = balance(0.001);
  EXPECT_LT(std::abs(fine), 1e-4);
  EXPECT_NEAR(coarse / fine, 4.0, 1.0);
}

}  // namespace
}  // namespace tisserand::mechanism::friction_test
