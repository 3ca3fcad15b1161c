// SPDX-License-Identifier: GPL-3.0-or-later
// Applied forces and moments: virtual power of the applied wrench, stiffness against central differences, work of a
// run.
#include "mechanism/forces/load.hpp"

#include <random>

#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "tests/support/bodies/superelement_cases.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::load_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using formats::LoadAxes;
using formats::LoadKind;
using test_support::random_vector;

struct Case {
  LoadKind kind;
  LoadAxes axes;
};

class EveryLoad : public ::testing::TestWithParam<Case> {
 protected:
  Load load(std::mt19937& random) const {
    Load load;
    load.kind = GetParam().kind;
    load.axes = GetParam().axes;
    load.at = {0, random_vector(random, 1.0), exp_so3<double>(random_vector(random, 2.0))};
    return load;
  }
  static NodeMotion motion(std::mt19937& random) {
    NodeMotion node;
    node.x = random_vector(random, 2.0);
    node.R = exp_so3<double>(random_vector(random, 3.0));
    node.xd = random_vector(random, 1.0);
    node.Omega = random_vector(random, 1.0);
    return node;
  }
};

INSTANTIATE_TEST_SUITE_P(Loads, EveryLoad,
                         ::testing::Values(Case{LoadKind::force, LoadAxes::world},
                                           Case{LoadKind::force, LoadAxes::body},
                                           Case{LoadKind::moment, LoadAxes::world},
                                           Case{LoadKind::moment, LoadAxes::body}),
                         [](const ::testing::TestParamInfo<Case>& given) {
                           return std::string(given.param.kind == LoadKind::force ? "Force" : "Moment") +
                                  (given.param.axes == LoadAxes::world ? "World" : "Body");
                         });

// The power on any velocity is F · (velocity of the point of application) or M · ω, in world axes.
TEST_P(EveryLoad, PowerIsThatOfTheAppliedWrench) {
  std::mt19937 random(1);
  for (int i = 0; i < 5; ++i) {
    const Load l = load(random);
    const NodeMotion node = motion(random);
    const Vector3d value = random_vector(random, 1.0);
    const Vector3d applied = l.axes == LoadAxes::world ? value : Vector3d(marker_rotation(l.at, node) * value);
    const double expected =
        l.kind == LoadKind::force ? applied.dot(marker_velocity(l.at, node)) : applied.dot(node.R * node.Omega);
    const Vector6d force = load_force(l, node, value);
    EXPECT_NEAR(force.head<3>().dot(node.xd) + force.tail<3>().dot(node.Omega), expected, 1e-14);
  }
}

// Central differences with 1e-5 of functions of size one: 1e-10.
TEST_P(EveryLoad, StiffnessIsTheDerivativeOfTheForce) {
  std::mt19937 random(2);
  const double d = 1e-5;
  for (int i = 0; i < 5; ++i) {
    const Load l = load(random);
    const NodeMotion node = motion(random);
    const Vector3d value = random_vector(random, 1.0);
    const Matrix6d K = load_stiffness(l, node, value);
    EXPECT_TRUE(K.leftCols<3>().isZero(0.0));
    for (int j = 0; j < 3; ++j) {
      const auto turned = [&](double angle) {
        NodeMotion moved = node;
        moved.R = (node.R * exp_so3<double>(Vector3d(angle * Vector3d::Unit(j)))).eval();
        return load_force(l, moved, value);
      };
      EXPECT_LT((K.col(3 + j) - (turned(d) - turned(-d)) / (2 * d)).cwiseAbs().maxCoeff(), 1e-9);
    }
  }
}

formats::Scene loaded_body(double step) {
  formats::Scene scene = test_support::empty_scene(step, 1.0);
  formats::RigidBodySpec body = test_support::rigid_body("body", 2.0, {0.3, 0.1, -0.2}, {0.3, 0.4, 0.5});
  body.start.angular_velocity = {0.5, 1.0, -2.0};
  scene.bodies.push_back(body);
  return scene;
}

// A dead force at a point of a body does the work F · displacement of that point. Work is summed by the trapezoidal
// rule: second order, quartered when the step is halved, so the extrapolated value must be that of the extrapolated
// displacement.
TEST(Work, OfADeadForceIsForceTimesDisplacement) {
  const Vector3d force(1.0, -2.0, 3.0), place(0.4, 0.5, 0.6);
  const auto difference = [&](double step) {
    formats::Scene scene = loaded_body(step);
    scene.loads.push_back(test_support::constant_load("f", LoadKind::force, "body", force));
    scene.loads.back().at.position = place;
    test_support::Simulation run(scene, {});
    run.start();
    run.run(1.0);
    const Marker at = run.model().loads[0].at;
    NodeMotion node;
    node.x = run.position("body");
    node.R = run.rotation("body").toRotationMatrix();
    return run.state().work() - force.dot(marker_position(at, node) - place);
  };
  const double coarse = difference(0.02), fine = difference(0.01);
  EXPECT_LT(std::abs(fine), 1e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.2);
}

// Work of a following moment equals the gain of kinetic energy; both have errors of second order.
TEST(Work, OfAFollowingMomentIsTheKineticEnergyGained) {
  const auto balance = [](double step) {
    formats::Scene scene = loaded_body(step);
    scene.loads.push_back(test_support::constant_load("m", LoadKind::moment, "body", {1, 2, -1}));
    scene.loads.back().axes = LoadAxes::body;
    test_support::Simulation run(scene, {});
    run.start();
    run.run(1.0);
    EXPECT_GT(std::abs(run.state().work()), 1.0);
    return run.energy().total() - run.state().initial_energy() - run.state().work();
  };
  const double coarse = balance(0.02), fine = balance(0.01);
  EXPECT_LT(std::abs(fine), 2e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.6);
}

// A moment that follows a body turning about its principal axis: Ω = M t/J, exactly represented by the integrator.
TEST(Load, FollowingMomentSpinsABodyUp) {
  formats::Scene scene = test_support::empty_scene(0.01, 1.0);
  scene.bodies.push_back(test_support::rigid_body("body", 2.0, Vector3d::Zero(), {0.3, 0.4, 0.5}));
  scene.loads.push_back(test_support::constant_load("m", LoadKind::moment, "body", {0, 0, 2}));
  scene.loads.back().axes = LoadAxes::body;
  test_support::Simulation run(scene, {});
  run.start();
  run.run(1.0);
  EXPECT_LT((run.Omega("body") - Vector3d(0, 0, 4)).norm(), 1e-9);
}

}  // namespace
}  // namespace tisserand::mechanism::load_test
