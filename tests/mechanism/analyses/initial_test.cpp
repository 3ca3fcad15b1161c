// SPDX-License-Identifier: GPL-3.0-or-later
// Start of an analysis: counts, projection, and every fault of the input that is found here.
#include "mechanism/analyses/start.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::initial_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;
using test_support::Simulation;

/// Message of the error that start() throws.
std::string start_error(const formats::Scene& scene) {
  try {
    Simulation run(scene, {});
    run.start();
  } catch (const Error& error) {
    EXPECT_FALSE(error.remedy().empty());
    EXPECT_THAT(error.where(), ::testing::HasSubstr("test.yaml"));
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

/// A square of bars of length 1 in the x-y plane, hinged about z at (0,0), (0,1), (1,1), (1,0); `last`: kind of its
/// last joint.
formats::Scene four_bar(JointKind last) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.gravity = {0, -9.81, 0};
  const auto bar = [&scene](const std::string& name, const Vector3d& from, double angle) {
    formats::RigidBodySpec body = test_support::rigid_body(name, 1.0, {0.5, 0, 0}, {1e-3, 1.0 / 12, 1.0 / 12});
    body.start.pose.position = from;
    body.start.pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
    scene.bodies.push_back(body);
  };
  bar("left", {0, 0, 0}, std::numbers::pi / 2);
  bar("top", {0, 1, 0}, 0.0);
  bar("right", {1, 1, 0}, -std::numbers::pi / 2);
  const Vector3d z = Vector3d::UnitZ();
  scene.joints = {test_support::joint("one", JointKind::revolute, "ground", "left", {0, 0, 0}, z),
                  test_support::joint("two", JointKind::revolute, "left", "top", {0, 1, 0}, z),
                  test_support::joint("three", JointKind::revolute, "top", "right", {1, 1, 0}, z),
                  test_support::joint("four", last, "right", "ground", {1, 0, 0}, z)};
  return scene;
}

TEST(Mobility, IsCounted) {
  struct Case {
    JointKind kind;
    int constraints, freedom;
  };
  for (const Case& c :
       {Case{JointKind::revolute, 5, 1}, Case{JointKind::spherical, 3, 3}, Case{JointKind::fixed, 6, 0}}) {
    formats::Scene scene = test_support::pendulum_scene(1e-3, 1.0);
    scene.joints[0].kind = c.kind;
    Simulation run(scene, {});
    run.start();
    EXPECT_EQ(run.started.mobility.constraints, c.constraints);
    EXPECT_EQ(run.started.mobility.rank, c.constraints);
    EXPECT_EQ(run.started.mobility.degrees_of_freedom, c.freedom);
    EXPECT_EQ(run.started.mobility.rigid_mobility, c.freedom);
  }
}

// Three bars with 18 coordinates move with one degree of freedom: 20 equations of four hinges have rank 17; with a ball
// in place of the last hinge two of three superfluous equations go (and the translation along z stays).
TEST(Mobility, OfAFourBarLinkage) {
  Simulation run(four_bar(JointKind::revolute), {});
  const Mobility mobility = count_mobility(run.model(), run.state(), run.workspace.now);
  EXPECT_EQ(mobility.constraints, 20);
  EXPECT_EQ(mobility.rank, 17);
  EXPECT_EQ(mobility.degrees_of_freedom, 1);
  EXPECT_EQ(mobility.redundant.size(), 3u);
  Simulation ball(four_bar(JointKind::spherical), {});
  EXPECT_EQ(count_mobility(ball.model(), ball.state(), ball.workspace.now).redundant.size(), 1u);
}

TEST(RedundantConstraints, AreMadeInactiveAndNamed) {
  Simulation run(four_bar(JointKind::revolute), {});
  run.start();
  ASSERT_EQ(run.started.mobility.redundant.size(), 3u);
  for (const int row : run.started.mobility.redundant) {
    EXPECT_EQ(run.state().active()[row], 0.0);
    EXPECT_EQ(run.state().lambda()[row], 0.0);
    EXPECT_THAT(constraint_name(run.model(), row),
                ::testing::ContainsRegex("(one|two|three|four), (translation z|z axis of B normal to)"));
  }
}

TEST(MarkerGap, IsAnErrorThatNamesJointAndEquation) {
  formats::Scene scene = test_support::pendulum_scene(1e-3, 1.0);
  scene.joints[0].b.position = Vector3d(0, 1e-3, 0);
  scene.joints[0].position = Vector3d::Zero();
  const std::string text = start_error(scene);
  EXPECT_THAT(text, ::testing::HasSubstr("hinge"));
  EXPECT_THAT(text, ::testing::HasSubstr("translation y"));
}

TEST(MarkerTilt, IsAnErrorThatNamesJointAndEquation) {
  formats::Scene scene = test_support::pendulum_scene(1e-3, 1.0);
  scene.joints[0].axis.reset();
  scene.joints[0].a.orientation = Eigen::Quaterniond::Identity();
  scene.joints[0].b.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.01, Vector3d::UnitX()));
  const std::string text = start_error(scene);
  EXPECT_THAT(text, ::testing::HasSubstr("hinge, z axis of B normal to y axis of A"));
}

TEST(OppositeMarkers, AreAnErrorAlthoughTheyMeetTheEquations) {
  formats::Scene scene = test_support::pendulum_scene(1e-3, 1.0);
  scene.joints[0].axis.reset();
  scene.joints[0].a.orientation = Eigen::Quaterniond::Identity();
  scene.joints[0].b.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitX()));
  EXPECT_THAT(start_error(scene), ::testing::HasSubstr("point in opposite directions"));
  scene.joints[0].kind = formats::JointKind::fixed;
  scene.joints[0].b.orientation =
      Eigen::Quaterniond(Eigen::AngleAxisd(2.0 * std::numbers::pi / 3.0, Vector3d::Ones().normalized()));
  EXPECT_THAT(start_error(scene), ::testing::HasSubstr("rotated relative to each other"));
}

TEST(InconsistentVelocity, IsAnErrorThatNamesJointAndEquation) {
  formats::Scene scene = test_support::pendulum_scene(1e-3, 1.0);
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.velocity = {0, 0, 0.5};
  const std::string text = start_error(scene);
  EXPECT_THAT(text, ::testing::HasSubstr("velocit"));
  EXPECT_THAT(text, ::testing::HasSubstr("hinge, translation z"));
}

TEST(MasslessDirection, IsAnErrorThatNamesIt) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.push_back(test_support::rigid_body("needle", 1.0, {0, 0, 0}, {1.0, 0.0, 1.0}));
  EXPECT_THAT(start_error(scene), ::testing::HasSubstr("needle, rotation about its y axis"));
}

// A small gap and a small wrong velocity along the line between two bodies are taken away in the mass norm: both move,
// in proportion to the inverse masses (3 to 1).
TEST(Projection, ClosesSmallGapsInTheMassNorm) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.initial_tolerance = 1e-2;
  for (const std::string name : {"light", "heavy"}) {
    const bool heavy = name == "heavy";
    formats::RigidBodySpec body = test_support::rigid_body(name, heavy ? 3.0 : 1.0, {0, 0, 0}, {1, 1, 1});
    if (heavy) body.start.pose.position = {1.004, 0, 0};
    body.start.velocity = {heavy ? 1.004 : 1.0, 0, 0};
    scene.bodies.push_back(body);
  }
  formats::JointSpec ball = test_support::joint("ball", JointKind::spherical, "light", "heavy", {0, 0, 0}, {0, 0, 1});
  ball.a.position = Vector3d(0.5, 0, 0);
  ball.b.position = Vector3d(-0.5, 0, 0);
  scene.joints.push_back(ball);
  Simulation run(scene, {});
  run.start();
  EXPECT_NEAR(run.started.projection.position, 4e-3 / 1.004, 1e-12);  // of the extent of the scene
  EXPECT_NEAR(run.position("light").x(), 0.003, 1e-12);
  EXPECT_NEAR(run.position("heavy").x(), 1.003, 1e-12);
  EXPECT_NEAR(run.velocity("light").x(), 1.003, 1e-12);
  EXPECT_NEAR(run.velocity("heavy").x(), 1.003, 1e-12);
}

// v̇ and λ of the pendulum at rest in the horizontal: angular acceleration −m g d/J_0 ... at (−d, 0) it falls, so that
// it turns with +m g d/J_0 about z; the hinge carries m (g − d · acceleration) upwards.
TEST(Accelerations, OfAPendulumAtRest) {
  using test_support::Pendulum;
  Simulation run(test_support::pendulum_scene(1e-3, 1.0), {});
  run.start();
  const double turning = Pendulum::mass * Pendulum::gravity * Pendulum::arm / Pendulum::inertia_about_hinge();
  EXPECT_NEAR(run.state().vdot()[5], turning, 1e-12 * turning);
  EXPECT_NEAR(run.state().vdot()[1], -Pendulum::arm * turning, 1e-12 * turning);
  const double support = Pendulum::mass * (Pendulum::gravity - Pendulum::arm * turning);
  EXPECT_NEAR(-run.state().lambda()[1], support, 1e-12 * support);
}

}  // namespace
}  // namespace tisserand::mechanism::initial_test
