// SPDX-License-Identifier: GPL-3.0-or-later
// method: radau: orders of positions, velocities and multipliers, its error estimate and steps, stiff parts, and what
// all methods share: jumps, rows between steps, rows left out, checkpoints, no allocation.
#include "mechanism/radau/radau.hpp"
#include "mechanism/equations/round_off.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <fstream>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "formats/results/results.hpp"
#include "mechanism/simulate.hpp"
#include "mechanism/step/redundancy.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/scenes/rotor.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/schemes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::radau_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;
using test_support::order;
using test_support::Pendulum;
using test_support::Simulation;

formats::Scene with_radau(formats::Scene scene) {
  scene.integrator.method = formats::Method::radau;
  scene.integrator.tolerance = 1e-12;
  scene.integrator.constraint_tolerance = 1e-13;
  scene.integrator.max_iterations = 40;
  return scene;
}

formats::Scene controlled(formats::Scene scene, double tolerance) {
  scene = with_radau(std::move(scene));
  scene.integrator.error_control.active = true;
  scene.integrator.error_control.tolerance = tolerance;
  return scene;
}

/// Rods of a metre and a kilogram on spherical joints, level at the start; the last one has a spin of its own.
formats::Scene chain(int links, double step, double end) {
  formats::Scene scene = test_support::empty_scene(step, end);
  scene.gravity = {0, 0, -9.81};
  std::string before = "ground";
  for (int i = 0; i < links; ++i) {
    formats::RigidBodySpec rod =
        test_support::rigid_body("rod" + std::to_string(i), 1.0, {0.5, 0, 0}, {0.01, 1.0 / 12.0, 1.0 / 12.0});
    rod.start.pose.position = {1.0 * i, 0, 0};
    if (i + 1 == links) rod.start.angular_velocity = {0, 1.0, 2.0};
    scene.bodies.push_back(rod);
    scene.joints.push_back(test_support::joint("joint" + std::to_string(i), JointKind::spherical, before, rod.name,
                                               {1.0 * i, 0, 0}, Vector3d::UnitZ()));
    before = rod.name;
  }
  return scene;
}

/// A rigid crank that gravity turns, a rigid rod, its end on a line.
formats::Scene slider_crank(double step, double end) {
  formats::Scene scene = test_support::empty_scene(step, end);
  scene.gravity = {0, -9.81, 0};
  const Vector3d z = Vector3d::UnitZ();
  scene.bodies.push_back(test_support::rigid_body("crank", 1.0, {0.15, 0, 0}, {0.01, 0.02, 0.02}));
  formats::RigidBodySpec rod = test_support::rigid_body("rod", 0.5, {0.35, 0, 0}, {0.01, 0.03, 0.03});
  rod.start.pose.position = {0.3, 0, 0};
  scene.bodies.push_back(rod);
  scene.joints = {
      test_support::joint("main", JointKind::revolute, "ground", "crank", Vector3d::Zero(), z),
      test_support::joint("pin", JointKind::revolute, "crank", "rod", {0.3, 0, 0}, z),
      test_support::joint("slide", JointKind::point_on_line, "ground", "rod", {1.0, 0, 0}, Vector3d::UnitX())};
  return scene;
}

/// Largest differences of positions, velocities and multipliers at the ends of coarse steps from a run with a quarter
/// of the step.
std::array<double, 3> errors(const formats::Scene& scene, double h) {
  const auto scene_with = [&](double step) {
    formats::Scene one = with_radau(scene);
    one.integrator.step = step;
    return one;
  };
  Simulation coarse(scene_with(h), {}), fine(scene_with(h / 4.0), {});
  coarse.start();
  fine.start();
  std::array<double, 3> worst{};
  for (int i = 1; i * h < scene.integrator.end * (1.0 + 1e-9); ++i) {
    coarse.run(i * h);
    fine.run(i * h);
    worst[0] = std::max(worst[0], (coarse.state().x() - fine.state().x()).cwiseAbs().maxCoeff());
    worst[1] = std::max(worst[1], (coarse.state().v() - fine.state().v()).cwiseAbs().maxCoeff());
    worst[2] = std::max(worst[2], (coarse.state().lambda() - fine.state().lambda()).cwiseAbs().maxCoeff());
  }
  return worst;
}

void expect_orders(const formats::Scene& scene, double h) {
  const auto coarse = errors(scene, h), fine = errors(scene, h / 2.0);
  EXPECT_GT(order(coarse[0], fine[0]), 4.6) << coarse[0] << " " << fine[0];
  EXPECT_GT(order(coarse[1], fine[1]), 4.6) << coarse[1] << " " << fine[1];
  EXPECT_GT(order(coarse[2], fine[2]), 2.7) << coarse[2] << " " << fine[2];
  EXPECT_LT(order(coarse[0], fine[0]), 6.2) << coarse[0] << " " << fine[0];
  EXPECT_LT(order(coarse[1], fine[1]), 6.2) << coarse[1] << " " << fine[1];
}

// [HW96] IV.8: A⁻¹ T = T Λ; the embedded formula is of order 3, so that constants, t and t² leave no error.
TEST(RadauCoefficients, PartTheMatrixAndEstimateWithOrderThree) {
  const radau::Coefficients& m = radau::coefficients();
  Eigen::Matrix3d Lambda = Eigen::Matrix3d::Zero();
  Lambda(0, 0) = m.gamma;
  Lambda.bottomRightCorner<2, 2>() << m.pair.real(), -m.pair.imag(), m.pair.imag(), m.pair.real();
  EXPECT_LT((m.inverse * m.T - m.T * Lambda).cwiseAbs().maxCoeff(), 1e-14);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR((k == 0 ? 1.0 / m.gamma : 0.0) + m.e.dot(m.c.array().pow(k + 1).matrix()), 0.0, 1e-14) << k;
  EXPECT_GT(std::abs(m.e.dot(m.c.array().pow(4).matrix())), 1e-3);
  // Collocation: order 5 of the quadrature, its last row.
  for (int k = 0; k < 5; ++k)
    EXPECT_NEAR(m.A.row(2).dot(m.c.array().pow(k).matrix().transpose()), 1.0 / (k + 1.0), 1e-15);
}

TEST(RadauOrders, OfTheHeavyTop) { expect_orders(test_support::heavy_top_scene(1e-3, 0.032), 2e-3); }
TEST(RadauOrders, OfARigidChain) { expect_orders(chain(4, 1e-2, 0.48), 0.02); }
TEST(RadauOrders, OfASliderCrank) { expect_orders(slider_crank(1e-2, 0.48), 0.02); }

// After one period the pendulum is at rest again.
TEST(Radau, PendulumHasTheExactPeriod) {
  const auto delay = [](int steps) {
    Simulation run(with_radau(test_support::pendulum_scene(Pendulum::period() / steps, Pendulum::period())), {});
    run.start();
    run.run(Pendulum::period());
    const double acceleration = Pendulum::mass * Pendulum::gravity * Pendulum::arm / Pendulum::inertia_about_hinge();
    return std::abs(run.Omega("pendulum").z()) / acceleration / Pendulum::period();
  };
  const double coarse = delay(60), fine = delay(120);
  EXPECT_NEAR(order(coarse, fine), 5.0, 0.5) << coarse << " " << fine;
  EXPECT_LT(fine, 1e-6);
}

// The error at the end falls with the tolerance and stays near it.
// Multipliers that move no body converge too, whatever the body has turned since its matrices were made.
TEST(Radau, ARotorLoadsItsBearingAcrossItsPlane) {
  for (const double step : {1e-3, 4e-3, 1e-2, 2e-2}) {
    formats::Scene scene = test_support::Rotor::scene(step, 0.6);
    scene.integrator.method = formats::Method::radau;
    EXPECT_LT(test_support::Rotor::error(scene, 0.0), 1e-3) << step;
  }
}

TEST(RadauControl, ErrorsFollowTheTolerance) {
  Simulation reference(with_radau(chain(4, 1e-3, 1.0)), {});
  reference.start();
  reference.run(1.0);
  double previous = 0.0;
  long steps = 0;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    Simulation run(controlled(chain(4, 1e-3, 1.0), tolerance), {});
    run.start();
    run.run(1.0);
    const double error = (run.state().x() - reference.state().x()).cwiseAbs().maxCoeff() / run.model().length;
    EXPECT_LT(error, 10.0 * tolerance) << tolerance;
    if (previous > 0.0) {
      EXPECT_LT(error, 0.1 * previous);
    }
    EXPECT_LT(run.steps, 400);
    EXPECT_GT(run.steps, steps);
    previous = error;
    steps = run.steps;
  }
}

// A constant force is integrated exactly; with a jump at t = 0.55 only if the step ends there. v = 0.55 + 0.45 · 3, x =
// 0.55²/2 + 0.55 · 0.45 + 3 · 0.45²/2; work of the same.
TEST(Radau, AJumpOfALoadIsPassed) {
  formats::Scene scene = test_support::empty_scene(0.1, 1.0);
  scene.bodies.push_back(test_support::rigid_body("body", 1.0, {0, 0, 0}, {1, 1, 1}));
  scene.loads.push_back(test_support::constant_load("push", formats::LoadKind::force, "body", {0, 0, 0}));
  scene.loads.back().components[0] = formats::TimeExpression{"t < 0.55 ? 1 : 3", {0.55}, ""};
  for (const bool control : {false, true}) {
    Simulation run(control ? controlled(scene, 1e-6) : with_radau(scene), {});
    run.start();
    run.run(1.0);
    const double v = 0.55 + 0.45 * 3;
    EXPECT_NEAR(run.velocity("body").x(), v, 1e-11);
    EXPECT_NEAR(run.position("body").x(), 0.55 * 0.55 / 2 + 0.55 * 0.45 + 3 * 0.45 * 0.45 / 2, 1e-11);
    EXPECT_NEAR(run.state().work(), 0.5 * v * v, 1e-11);
  }
}

/// A damped flexible pendulum on a hinge, with a load that grows.
struct Flexible {
  SuperelementFiles files;
  formats::Scene scene = test_support::empty_scene(2e-3, 1.0);

  Flexible() {
    test_support::add_file("beam", test_support::test_superelement("beam"), files);
    scene.gravity = {0, 0, -9.81};
    formats::SuperelementBodySpec body = test_support::superelement_body("beam", "beam");
    body.damping.stiffness = 1e-3;
    scene.bodies.push_back(body);
    scene.joints.push_back(
        test_support::joint("hinge", JointKind::revolute, "ground", "beam/base", {-0.2, 0, 0.1}, {0, 1, 0}));
    scene.loads.push_back(test_support::constant_load("push", formats::LoadKind::force, "beam/tip", {0, 0, 0}));
    scene.loads[0].components[1] = formats::TimeTable{{0.0, 1.0}, {0.0, 20.0}};
  }
};

// Internal coordinates are condensed with complex frequencies: the same motion as generalised alpha in the limit, and
// more than order 2 with a step that resolves the bending alone.
TEST(RadauFlexible, ConvergesToTheMotionOfGeneralisedAlpha) {
  const auto tip = [](double h, formats::Method method) {
    Flexible flexible;
    flexible.scene.integrator.step = h;
    if (method == formats::Method::radau) flexible.scene = with_radau(flexible.scene);
    Simulation run(flexible.scene, flexible.files);
    run.start();
    run.run(0.2);
    return run.position("beam/tip");
  };
  const Vector3d fine = tip(2.5e-4, formats::Method::radau);
  const double coarse_error = (tip(4e-3, formats::Method::radau) - fine).norm();
  const double error = (tip(2e-3, formats::Method::radau) - fine).norm();
  EXPECT_GT(order(coarse_error, error), 2.5) << coarse_error << " " << error;
  const Vector3d a = tip(1e-3, formats::Method::generalised_alpha), b = tip(5e-4, formats::Method::generalised_alpha);
  EXPECT_LT(((4.0 * b - a) / 3.0 - fine).norm(), 0.1 * (b - fine).norm());
}

struct Feature {
  const char* name;
  double step, end;
  const char* scene;
};

const Feature features[] = {
    {"gears", 1e-3, 0.5, R"(
gravity: [0, 0, -9.81]
bodies:
  pinion: {type: rigid, mass: 1, center_of_mass: [0.05, 0, 0], inertia: [0.01, 0.01, 0.02]}
  wheel: {type: rigid, mass: 2, inertia: [0.02, 0.02, 0.04], pose: {position: [0.5, 0, 0]}}
  bar: {type: rigid, mass: 3, inertia: [0.1, 0.1, 0.1], pose: {position: [1, 0, 0]}}
  nut: {type: rigid, mass: 0.5, inertia: [0.01, 0.01, 0.01], pose: {position: [1.5, 0, 0]}}
joints:
  first: {type: revolute, a: ground, b: pinion, position: [0, 0, 0], axis: [0, 1, 0]}
  second: {type: revolute, a: ground, b: wheel, position: [0.5, 0, 0], axis: [0, 1, 0]}
  slide: {type: prismatic, a: ground, b: bar, position: [1, 0, 0], axis: [0, 0, 1]}
  thread: {type: screw, a: ground, b: nut, position: [1.5, 0, 0], axis: [0, 0, 1], pitch: 0.05}
  pair: {type: gear, between: [first, second], ratio: -2.5}
  rack: {type: rack_and_pinion, between: [second, slide], radius: 0.1}
springs:
  hold: {coordinate: slide, stiffness: 400, damping: 3}
  nut_spring: {coordinate: thread/z, stiffness: 500, free: 0.01}
)"},
    {"stops", 1e-4, 0.25, R"(
gravity: [0, 0, -9.81]
bodies:
  block: {type: rigid, mass: 2, inertia: [0.1, 0.1, 0.1], velocity: [1, 0, 0]}
joints:
  slide: {type: prismatic, a: ground, b: block, position: [0, 0, 0], axis: [1, 0, 0], friction: {coefficient: 0.1, velocity: 0.05}}
springs:
  ends: {coordinate: slide, stiffness: 20, upper: 0.1, lower: -0.1, stop_stiffness: 2e4, stop_damping: 20}
)"},
    {"driven", 1e-3, 0.4, R"(
gravity: [0, 0, -9.81]
virtual_bodies: keep
bodies:
  carrier: {type: virtual}
  rod: {type: beam, from: [0, 0, 0], to: [0.5, 0, 0], elements: 3, section: {shape: circle, radius: 0.005}, material: {E: 7e10, nu: 0.3, density: 2700}}
joints:
  turn: {type: revolute, a: ground, b: carrier, position: [0, 0, 0], axis: [0, 1, 0]}
  swing: {type: revolute, a: carrier, b: rod/start, position: [0, 0, 0], axis: [0, 0, 1]}
motions:
  turn: {coordinate: turn, value: {table: [[0, 0], [0.2, 0.5], [0.4, 0.5], [0.6, 0]]}}
bushings:
  mount: {a: ground, b: rod/end, stiffness: [50, 50, 50, 0, 0, 0], damping: [1, 1, 1, 0, 0, 0]}
)"},
};

// Gears, racks and screws, stops and friction, drives by tables, kept virtual bodies, beams and bushings: what
// generalised alpha with half a step leaves is a third of its change from the whole step (order 2), up to the vibration
// of an undamped beam, and that is how far from it the fifth order is.
TEST(RadauFeatures, MoveAsWithGeneralisedAlpha) {
  for (const Feature& feature : features) {
    const test_support::TemporaryFolder folder;
    const std::string path = (folder.path() / "a.scene.yaml").string();
    std::ofstream(path) << "scene: " << feature.name << feature.scene << "integrator: {step: " << feature.step
                        << ", end: " << feature.end << "}\n";
    const auto places = [&](formats::Method method, double step) {
      formats::Scene scene = formats::read_scene(path, {});
      scene.integrator.method = method;
      scene.integrator.step = step;
      Simulation run(scene, {});
      run.start();
      Eigen::Matrix3Xd all(3, 0);
      for (int i = 1; i <= 10; ++i) {
        run.run(feature.end * i / 10);
        const Eigen::Matrix3Xd now = run.state().x();
        all.conservativeResize(3, all.cols() + now.cols());
        all.rightCols(now.cols()) = now;
      }
      return all;
    };
    const Eigen::Matrix3Xd coarse = places(formats::Method::generalised_alpha, feature.step);
    const Eigen::Matrix3Xd fine = places(formats::Method::generalised_alpha, feature.step / 2);
    const Eigen::Matrix3Xd radau = places(formats::Method::radau, feature.step / 2);
    const double change = (coarse - fine).cwiseAbs().maxCoeff();
    EXPECT_GT(change, 1e-8) << feature.name;
    EXPECT_LT((fine - radau).cwiseAbs().maxCoeff(), 0.6 * change) << feature.name;
  }
}

TEST(Radau, ARunContinuedFromACopyOfTheStateIsBitEqual) {
  Flexible flexible;
  Simulation first(with_radau(flexible.scene), flexible.files), second(with_radau(flexible.scene), flexible.files);
  first.start();
  first.run(0.1);
  first.stepper.forget(first.workspace);
  second.state().block() = first.state().block();
  for (int i = 1; i <= 30; ++i) {
    const double end = 0.1 + 2e-3 * i;
    for (Simulation* run : {&first, &second})
      ASSERT_EQ(run->stepper.advance({end, end}, run->state(), run->workspace).outcome, StepOutcome::accepted);
    ASSERT_EQ(first.state().block(), second.state().block()) << "step " << i;
  }
}

TEST(Radau, ARejectedStepLeavesTheStateBitEqual) {
  Flexible flexible;
  Simulation run(with_radau(flexible.scene), flexible.files);
  run.start();
  run.run(0.02);
  const std::vector<double> before = run.state().block();
  run.scene.integrator.max_iterations = 1;
  run.scene.integrator.tolerance = 1e-30;
  for (const double step : {2e-3, 1e-3, 0.7}) {
    const double end = run.state().time() + step;
    EXPECT_NE(run.stepper.advance({end, end}, run.state(), run.workspace).outcome, StepOutcome::accepted);
    EXPECT_EQ(run.state().block(), before) << step;
  }
}

TEST(Radau, AStepAllocatesNothing) {
  for (const formats::LinearSolver solver : {formats::LinearSolver::klu, formats::LinearSolver::dense}) {
    Flexible flexible;
    flexible.scene.integrator.linear_solver = solver;
    flexible.scene.bodies.push_back(test_support::rigid_body("block", 2.0, {0, 0, 0}, {0.3, 0.4, 0.5}));
    Simulation run(with_radau(flexible.scene), flexible.files);
    run.start();
    run.run(0.02);
    std::size_t allocations = 0;
    for (int i = 0; i < 20; ++i) {
      const double end = run.state().time() + (i % 3 == 0 ? 2e-3 : 1e-3);
      const std::size_t before = test_support::allocation_count();
      const StepReport report = run.stepper.advance({end, end}, run.state(), run.workspace);
      allocations += test_support::allocation_count() - before;
      ASSERT_EQ(report.outcome, StepOutcome::accepted);
    }
    EXPECT_EQ(allocations, 0u);
  }
}

// A parallelogram of hinges: rows that repeat others are left out, and follow.
TEST(Radau, LeavesOutRowsThatRepeatOthers) {
  formats::Scene scene = test_support::empty_scene(0.01, 0.5);
  scene.gravity = {0, 0, -9.81};
  const Vector3d y = Vector3d::UnitY();
  const auto link = [&scene](const std::string& name, const Vector3d& at, const Vector3d& center) {
    formats::RigidBodySpec body = test_support::rigid_body(name, 1.0, center, {0.1, 0.1, 0.1});
    body.start.pose.position = at;
    scene.bodies.push_back(body);
  };
  link("left", {0, 0, 0}, {0.2, 0, -0.4});
  link("right", {1, 0, 0}, {0.2, 0, -0.4});
  link("floor", {0.4, 0, -0.8}, {0.5, 0, 0});
  scene.joints = {test_support::joint("a", JointKind::revolute, "ground", "left", {0, 0, 0}, y),
                  test_support::joint("b", JointKind::revolute, "ground", "right", {1, 0, 0}, y),
                  test_support::joint("c", JointKind::revolute, "left", "floor", {0.4, 0, -0.8}, y),
                  test_support::joint("d", JointKind::revolute, "right", "floor", {1.4, 0, -0.8}, y)};
  Simulation run(controlled(scene, 1e-7), {});
  run.start();
  run.run(0.5);
  EXPECT_LT(run.state().active().minCoeff(), 0.5);
  EXPECT_LT(largest_violation(run.model(), run.workspace.now, Rows::left_out).value, 1e-10);
  EXPECT_NEAR(run.energy().total(), run.state().initial_energy(), 1e-5 * run.energy().kinetic);
}

// Rows at requested times lie between steps that are longer: the cubic and quartic polynomials of a step.
TEST(RadauRows, LieBetweenTheSteps) {
  const test_support::TemporaryFolder folder;
  formats::Scene scene = controlled(chain(3, 1e-3, 1.0), 1e-6);
  scene.output.interval = 0.01;
  RunControl control;
  const RunReport report = simulate(scene, (folder.path() / "chain.results.h5").string(), control);
  EXPECT_EQ(report.outcome, RunOutcome::completed);
  EXPECT_EQ(report.rows, 101);
  EXPECT_LT(report.steps, 80);
  const formats::ResultsReader reader((folder.path() / "chain.results.h5").string());
  EXPECT_EQ(reader.rows(), 101u);
  EXPECT_LT(report.largest_balance, 1e-4 * report.energy_reference);
  EXPECT_LT(report.largest_constraint, 1e-9);
}

}  // namespace
}  // namespace tisserand::mechanism::radau_test
