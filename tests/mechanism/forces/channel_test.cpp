// SPDX-License-Identifier: GPL-3.0-or-later
// Channels and inputs in expressions: exact derivatives in whole models, control loops with known answers, histories.
#include "mechanism/model/channel.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "tests/support/scenes/model_tangent.hpp"
#include "tests/support/scenes/wheels.hpp"

namespace tisserand::mechanism::channel_test {
namespace {

using Eigen::Vector3d;
using formats::ChannelKind;
using formats::JointKind;
using ::testing::HasSubstr;

formats::TimeExpression expression(const std::string& text) { return {text, {}, "scene.yaml:9:9"}; }

formats::ChannelSpec of_coordinate(const std::string& name, ChannelKind kind, const std::string& coordinate) {
  formats::ChannelSpec channel;
  channel.name = name;
  channel.kind = kind;
  channel.coordinate = {coordinate, ""};
  return channel;
}

formats::ChannelSpec of_marker(const std::string& name, ChannelKind kind, const std::string& node, int axis) {
  formats::ChannelSpec channel;
  channel.name = name;
  channel.kind = kind;
  channel.a.node = node;
  channel.axis = Eigen::Vector3d::Unit(axis);
  return channel;
}

formats::SpringSpec along(const std::string& coordinate) {
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.coordinate = formats::CoordinateRef{coordinate, ""};
  return spring;
}

/// Two bodies, all kinds of channels, in loads of both kinds and axes and in forces of springs.
formats::Scene controlled() {
  formats::Scene scene = test_support::empty_scene(0.01, 1.0);
  scene.bodies.push_back(test_support::rigid_body("arm", 1.0, {0.5, 0.2, 0.3}, {0.3, 0.4, 0.5}));
  scene.bodies.push_back(test_support::rigid_body("free", 2.0, {-0.3, 0.2, 0.1}, {0.5, 0.4, 0.3}));
  std::get<formats::RigidBodySpec>(scene.bodies[1]).start.pose.position = {1, 1, 1};
  scene.joints.push_back(
      test_support::joint("hinge", JointKind::revolute, "ground", "arm", Vector3d::Zero(), Vector3d(1, 2, 3)));
  scene.channels = {
      of_coordinate("angle", ChannelKind::coordinate, "hinge"), of_coordinate("speed", ChannelKind::rate, "hinge"),
      of_marker("height", ChannelKind::position, "free", 2), of_marker("sideways", ChannelKind::velocity, "arm", 1)};
  scene.channels[2].a.position = Vector3d(0.3, -0.2, 0.4);
  scene.channels[3].a.position = Vector3d(-0.1, 0.2, 0.5);
  formats::ChannelSpec gap;
  gap.name = "gap";
  gap.kind = ChannelKind::distance;
  gap.a.node = "arm";
  gap.b.node = "free";
  gap.b.position = Vector3d(0.1, 0.1, -0.2);
  scene.channels.push_back(gap);
  scene.loads = {test_support::constant_load("f", formats::LoadKind::force, "free", {1, 2, 3}),
                 test_support::constant_load("m", formats::LoadKind::moment, "arm", {0, 1, 0})};
  scene.loads[0].axes = formats::LoadAxes::body;
  scene.loads[0].at.position = Vector3d(0.2, 0.1, 0.3);
  scene.loads[0].components[1] = expression("3*sin(height)*speed + gap^2");
  scene.loads[0].components[2] = expression("sideways*sideways - 2*height");
  scene.loads[1].components[0] = expression("-5*angle*gap + t");
  formats::SpringSpec motor = along("hinge");
  motor.force = expression("exp(-angle)*height + 0.5*sideways - speed");
  formats::SpringSpec rope;
  rope.name = "rope";
  rope.a.node = "ground";
  rope.b.node = "free";
  rope.a.position = Vector3d(3, 0, 0);
  rope.stiffness = 2.0;
  rope.force = expression("-gap*speed");
  scene.springs = {motor, rope};
  return scene;
}

// Central differences with 1e-6 of both: 1e-8 relative to the largest entry.
TEST(Channels, IterationMatrixIsTheDerivativeOfTheResidual) {
  test_support::Simulation run(controlled(), {});
  const int n = run.model().sizes.boundary;
  for (unsigned seed = 0; seed < 4; ++seed) {
    test_support::randomise(run, seed, 0.3, 1.0);
    using test_support::Argument;
    const Eigen::MatrixXd K = test_support::iteration_matrix(run, {0, 0, 1}).topLeftCorner(n, n);
    EXPECT_LT(test_support::relative_difference(K, residual_difference(run, Argument::position, 1e-6)), 2e-8);
    const Eigen::MatrixXd C = test_support::damping_matrix(run);
    EXPECT_LT(test_support::relative_difference(C, residual_difference(run, Argument::velocity, 1e-6)), 2e-8);
    EXPECT_GT(C.norm(), 1.0);
  }
}

// A controller that says what a spring and damper do takes the same steps, with the same number of iterations.
TEST(Channels, AControllerIsASpringAndDamper) {
  const auto swing = [](bool controller) {
    formats::Scene scene = test_support::pendulum_scene(0.01, 1.0);
    formats::SpringSpec spring = along("hinge");
    spring.free = 0.3;
    if (controller) {
      scene.channels = {of_coordinate("angle", ChannelKind::coordinate, "hinge"),
                        of_coordinate("speed", ChannelKind::rate, "hinge")};
      spring.force = expression("-20*(angle - 0.3) - 1.5*speed");
    } else {
      spring.stiffness = 20.0;
      spring.damping = 1.5;
    }
    scene.springs = {spring};
    test_support::Simulation run(scene, {});
    run.start();
    run.run(1.0);
    return std::pair(run.state().hinges()[0], run.iterations);
  };
  const auto by_controller = swing(true), by_spring = swing(false);
  EXPECT_NEAR(by_controller.first, by_spring.first, 1e-9);
  EXPECT_LE(std::abs(by_controller.second - by_spring.second), 5);
}

// Newton's law of gravity towards the origin by three load components of position channels: a circular orbit comes
// back.
TEST(Channels, LoadsOfPositionsMakeAnOrbit) {
  const auto error = [](int steps) {
    formats::Scene scene = test_support::empty_scene(2.0 * M_PI / steps, 2.0 * M_PI);
    scene.integrator.rho = 1.0;
    scene.bodies.push_back(test_support::rigid_body("moon", 2.0, Vector3d::Zero(), {1, 1, 1}));
    std::get<formats::RigidBodySpec>(scene.bodies[0]).start.pose.position = {1, 0, 0};
    std::get<formats::RigidBodySpec>(scene.bodies[0]).start.velocity = {0, 1, 0};
    scene.channels = {of_marker("x", ChannelKind::position, "moon", 0),
                      of_marker("y", ChannelKind::position, "moon", 1)};
    scene.loads = {test_support::constant_load("pull", formats::LoadKind::force, "moon", Vector3d::Zero())};
    scene.loads[0].components[0] = expression("-2*x/(x*x + y*y)^1.5");
    scene.loads[0].components[1] = expression("-2*y/(x*x + y*y)^1.5");
    test_support::Simulation run(scene, {});
    run.start();
    run.run(2.0 * M_PI);
    EXPECT_NEAR(run.state().work(), 0.0, 20.0 / steps / steps);
    return (run.position("moon") - Vector3d(1, 0, 0)).norm();
  };
  const double coarse = error(200), fine = error(400);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.3);
}

constexpr formats::TyreQuantity tyre_quantities[] = {
    formats::TyreQuantity::load,        formats::TyreQuantity::force_x,       formats::TyreQuantity::force_y,
    formats::TyreQuantity::moment_x,    formats::TyreQuantity::moment_y,      formats::TyreQuantity::moment_z,
    formats::TyreQuantity::slip,        formats::TyreQuantity::slip_angle,    formats::TyreQuantity::camber,
    formats::TyreQuantity::penetration, formats::TyreQuantity::rolling_radius};

/// A car of one body that is pushed along x by `factor` times a quantity of its first tyre.
formats::Scene pushed_by_tyre(formats::TyreQuantity quantity, double factor) {
  formats::Scene scene = test_support::block_car(-0.02);
  formats::ChannelSpec channel;
  channel.name = "q";
  channel.kind = ChannelKind::tyre;
  channel.tyre = scene.tyres[0].name;
  channel.quantity = quantity;
  scene.channels = {channel};
  scene.loads = {test_support::constant_load("push", formats::LoadKind::force, "car", Vector3d::Zero())};
  scene.loads[0].components[0] = expression(fmt::format("{}*q", factor));
  return scene;
}

// Each quantity enters by its exact derivatives: the factor makes it more than the forces of the tyres, whose second
// derivatives limit differences to 1e-4 as in the tests of tyres.
TEST(Channels, OfTyresEnterTheIterationMatrix) {
  for (const formats::TyreQuantity quantity : tyre_quantities) {
    const double factor = quantity <= formats::TyreQuantity::moment_z ? 1e2 : 1e7;
    test_support::Simulation run(pushed_by_tyre(quantity, factor), {});
    run.start();
    test_support::randomise(run, 3, 0.005, 1.0);
    const int n = run.model().sizes.boundary;
    const Eigen::MatrixXd with_mass = test_support::iteration_matrix(run, {1, 0, 0});
    const Eigen::MatrixXd K = (test_support::iteration_matrix(run, {1, 0, 1}) - with_mass).topLeftCorner(n, n);
    const Eigen::MatrixXd C = test_support::damping_matrix(run);
    using test_support::Argument;
    EXPECT_LT((K - residual_difference(run, Argument::position, 1e-7)).cwiseAbs().maxCoeff(),
              1e-4 * K.cwiseAbs().maxCoeff())
        << static_cast<int>(quantity);
    EXPECT_LT((C - residual_difference(run, Argument::velocity, 1e-6)).cwiseAbs().maxCoeff(),
              1e-4 * C.cwiseAbs().maxCoeff())
        << static_cast<int>(quantity);
    EXPECT_GT(K.row(0).cwiseAbs().maxCoeff(), 3e5) << static_cast<int>(quantity);  // of the tyres alone: 2e5
  }
}

TEST(Channels, OfTyresAreWhatResultsShow) {
  for (const formats::TyreQuantity quantity : tyre_quantities) {
    test_support::Simulation run(pushed_by_tyre(quantity, 0.0), {});
    run.start();
    test_support::randomise(run, 5, 0.005, 1.0);
    evaluate(run.model(), run.state(), run.workspace.now);
    const TyreTerms& tyre = run.workspace.now.tyres[0];
    ASSERT_GT(tyre.penetration, 0.0);
    const double shown[] = {tyre.force.z(),  tyre.force.x(),   tyre.force.y(),     tyre.moment.x(),
                            tyre.moment.y(), tyre.moment.z(),  tyre.slip,          tyre.slip_angle,
                            tyre.camber,     tyre.penetration, tyre.rolling_radius};
    EXPECT_NEAR(run.workspace.now.channels[0], shown[static_cast<int>(quantity)],
                1e-12 * (1.0 + std::abs(shown[static_cast<int>(quantity)])));
  }
}

formats::InputSpec input(const std::string& name, formats::Interpolation interpolation) {
  return {name, {{0.1, 0.3, 0.4}, {0.0, 10.0, 4.0}}, interpolation, ""};
}

/// A mass of 2 that is pushed along x.
formats::Scene pushed(const std::string& force) {
  formats::Scene scene = test_support::empty_scene(0.03, 0.6);
  scene.bodies.push_back(test_support::rigid_body("mass", 2.0, Vector3d::Zero(), {0.1, 0.1, 0.1}));
  scene.inputs = {input("drive", formats::Interpolation::linear)};
  scene.loads = {test_support::constant_load("push", formats::LoadKind::force, "mass", Vector3d::Zero())};
  scene.loads[0].components[0] = expression(force);
  return scene;
}

// Linear between points and constant outside; steps end on the points, so that the momentum is the exact integral of
// the linear pieces: 0 + ½·10·0.2 + 7·0.1 + 4·0.2 = 2.5, times 3, over the mass (trapezoidal rule: exact; the start of
// each slope is of second order in the integrator).
TEST(Inputs, DriveALoad) {
  test_support::Simulation run(pushed("3*drive"), {});
  run.start();
  run.run(0.6);
  EXPECT_EQ(run.model().breakpoints, (std::vector<double>{0.1, 0.3, 0.4}));
  EXPECT_NEAR(run.velocity("mass").x(), 3.0 * 2.5 / 2.0, 2e-2);
  EXPECT_TRUE(run.model().channel_uses.empty());
}

TEST(Inputs, MayBeCubicAndMixWithChannels) {
  formats::Scene scene = pushed("drive - 2*v");
  scene.inputs[0].interpolation = formats::Interpolation::cubic;
  scene.channels = {of_marker("v", ChannelKind::velocity, "mass", 0)};
  test_support::Simulation run(scene, {});
  // Inside, the slope is continuous; before the first and after the last instant it is zero.
  EXPECT_EQ(run.model().breakpoints,
            (std::vector<double>{scene.inputs[0].table.time.front(), scene.inputs[0].table.time.back()}));
  TimeFunction& f = run.workspace.now.load_functions[0][0];
  f.set_channels(Eigen::VectorXd::Constant(1, 0.5));
  EXPECT_DOUBLE_EQ(f(0.0), -1.0);
  EXPECT_DOUBLE_EQ(f(0.3), 9.0);
  EXPECT_DOUBLE_EQ(f(2.0), 3.0);
  EXPECT_NEAR(f.derivative(0, 0.3), -2.0, 1e-9);
}

// A motion may follow an input; here a ramp: value 5 t.
TEST(Inputs, DriveAMotion) {
  formats::Scene scene = test_support::pendulum_scene(0.01, 0.5);
  scene.gravity.setZero();
  scene.inputs = {{"ramp", {{-1.0, 1.0}, {-5.0, 5.0}}, formats::Interpolation::cubic, ""}};
  scene.motions = {{"drive", {"hinge", ""}, expression("ramp"), ""}};
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.angular_velocity = {0, 0, 5};
  test_support::Simulation run(scene, {});
  run.start();
  run.run(0.5);
  EXPECT_NEAR(run.state().hinges()[0], 2.5, 1e-9);
}

TEST(Channels, WhatIsWrongIsNamed) {
  const auto error_of = [](const formats::Scene& scene) -> std::string {
    try {
      test_support::Simulation run(scene, {});
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  formats::Scene scene = controlled();
  scene.loads[0].components[1] = expression("3*heigth");
  EXPECT_THAT(error_of(scene), HasSubstr("expression '3*heigth'"));
  EXPECT_THAT(error_of(scene), HasSubstr("write a formula in t and angle, speed, height, sideways, gap"));
  scene = controlled();
  scene.motions = {{"drive", {"hinge", ""}, expression("2*speed"), "scene.yaml:3:3"}};
  EXPECT_THAT(error_of(scene), HasSubstr("motion 'drive' uses channel 'speed'"));
  scene = controlled();
  scene.channels[0].coordinate.name = "hinge/z";
  EXPECT_THAT(error_of(scene), HasSubstr("there is no joint coordinate 'hinge/z'"));
  scene = controlled();
  scene.channels[4].b = scene.channels[4].a;
  EXPECT_THAT(error_of(scene), HasSubstr("channel 'gap' connects 'arm' and 'arm'"));
  scene = controlled();
  scene.channels[0].name = "sin";
  EXPECT_NE(error_of(scene), "");
}

}  // namespace
}  // namespace tisserand::mechanism::channel_test
