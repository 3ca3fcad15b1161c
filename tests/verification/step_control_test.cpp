// SPDX-License-Identifier: GPL-3.0-or-later
// Generalised alpha and HHT with error control: errors that follow the tolerance, orders for random sequences of steps,
// instants that are met, rejected steps.
#include "mechanism/step/step_control.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/schemes.hpp"

namespace tisserand::mechanism::step_control_test {
namespace {

using Eigen::Vector3d;
using formats::Formulation;
using formats::Method;
using test_support::order;
using test_support::Pendulum;
using test_support::Scheme;
using test_support::Simulation;

class Controlled : public ::testing::TestWithParam<Scheme> {
 protected:
  formats::Scene with_scheme(formats::Scene scene) const {
    return test_support::with_scheme(GetParam(), std::move(scene));
  }
};

INSTANTIATE_TEST_SUITE_P(Schemes, Controlled, test_support::all_schemes(), test_support::scheme_name);

formats::Scene controlled(formats::Scene scene, double tolerance) {
  scene.integrator.error_control.active = true;
  scene.integrator.error_control.tolerance = tolerance;
  scene.integrator.step = 1e-3;
  return scene;
}

/// Error of the angle after one period relative to the amplitude, and the steps it took.
struct Outcome {
  double error = 0.0;
  long steps = 0;
  long rejected = 0;
};

Outcome swing(const formats::Scene& scene) {
  Simulation run(scene, {});
  run.start();
  run.run(Pendulum::period());
  const double acceleration = Pendulum::mass * Pendulum::gravity * Pendulum::arm / Pendulum::inertia_about_hinge();
  return {std::abs(run.Omega("pendulum").z()) / acceleration / Pendulum::period(), run.steps, run.rejected};
}

// A tolerance 16 times smaller makes the error 16 times smaller with 4 times the steps: errors per unit of time are
// controlled and the method has order 2.
TEST_P(Controlled, ErrorOfThePendulumFollowsTheTolerance) {
  const auto run = [this](double tolerance) {
    return swing(controlled(with_scheme(test_support::pendulum_scene(1e-3, Pendulum::period())), tolerance));
  };
  const Outcome coarse = run(1.6e-3), fine = run(1e-4);
  EXPECT_NEAR(coarse.error / fine.error, 16.0, 4.0) << coarse.error << " " << fine.error;
  EXPECT_NEAR(static_cast<double>(fine.steps) / static_cast<double>(coarse.steps), 4.0, 0.5);
  EXPECT_LT(fine.error, 3e-4);
  EXPECT_LT(fine.rejected, fine.steps / 10);
}

/// Largest errors of position, angular velocity and support force of the heavy top, steps ending on the rows of the
/// reference; the force from `settled` on.
std::array<double, 3> top_errors(const formats::Scene& scene, double settled, const std::vector<double>& sizes) {
  Simulation run(scene, {});
  run.start();
  std::array<double, 3> errors{};
  std::size_t next = 0;
  for (const std::vector<double>& row : test_support::reference_rows("heavy_top.csv")) {
    while (run.state().time() < row[0] - 1e-9) {
      // The last two steps before a row share what is left.
      const double time = run.state().time(), left = row[0] - time;
      const double size = scene.integrator.step * sizes[next++ % sizes.size()];
      const double end = left <= size * (1 + 1e-9) ? row[0] : time + (left < 2 * size ? 0.5 * left : size);
      EXPECT_EQ(advance(run.model(), run.scene.integrator, {end, end}, run.state(), run.workspace).outcome,
                StepOutcome::accepted);
    }
    const Vector3d x(row[1], row[2], row[3]), Omega(row[4], row[5], row[6]), force(row[11], row[12], row[13]);
    errors[0] = std::max(errors[0], (run.position("top") - x).norm());
    errors[1] = std::max(errors[1], (run.Omega("top") - Omega).norm());
    if (row[0] >= settled) errors[2] = std::max(errors[2], (-run.state().lambda() - force).norm());
  }
  return errors;
}

// Steps between half and twice the nominal one in a random order: positions, velocities and multipliers keep order 2
// with both formulations: the algorithmic acceleration is rebuilt, and with index 3 the velocities' B v, which belongs
// to the step ("Index 3 and a change of step" in DECISIONS.md). Multipliers of index 3 from 0.1 s on, after the
// transient of the start (100 steps of the coarser run, [BCA12]).
TEST_P(Controlled, RandomStepsKeepTheOrder) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> exponent(-1.0, 1.0);
  std::vector<double> sizes(97);
  for (double& size : sizes) size = std::exp2(exponent(random));
  const double settled = GetParam().formulation == Formulation::index3 ? 0.1 : 0.0;
  const auto errors = [&](double h) {
    return top_errors(with_scheme(test_support::heavy_top_scene(h, 0.3)), settled, sizes);
  };
  const auto coarse = errors(4e-4), fine = errors(1e-4);
  for (int i = 0; i < 2; ++i) {
    EXPECT_GT(0.5 * order(coarse[i], fine[i]), 1.8) << i << ": " << coarse[i] << " " << fine[i];
    EXPECT_LT(0.5 * order(coarse[i], fine[i]), 2.3) << i << ": " << coarse[i] << " " << fine[i];
  }
  // |λ| goes up to 450 N; its error holds what the last of the random steps makes of it.
  EXPECT_GT(0.5 * order(coarse[2], fine[2]), 1.7) << coarse[2] << " " << fine[2];
  EXPECT_LT(fine[2], 0.15);
}

/// A bob on a guided spring of 40 rad/s that swings with 3 rad/s: fast and slow motion together.
formats::Scene spring_pendulum() {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.5);
  scene.gravity = {0, -9.81, 0};
  formats::RigidBodySpec bob = test_support::rigid_body("bob", 1.0, {0, 0, 0}, {0.01, 0.01, 0.01});
  bob.start.pose.position = {1, 0, 0};
  scene.bodies.push_back(bob);
  scene.joints.push_back(
      test_support::joint("plane", formats::JointKind::planar, "ground", "bob", {1, 0, 0}, {0, 0, 1}));
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.a.node = "ground";
  spring.b.node = "bob";
  spring.stiffness = 1600.0;
  spring.free = 1.0;
  scene.springs.push_back(spring);
  return scene;
}

/// Positions and velocities of the bob at 0.1, 0.2, ... s.
Eigen::Matrix<double, 6, 15> bob_history(formats::Scene scene, double tolerance) {
  scene.output.interval = 0.1;
  Simulation run(controlled(std::move(scene), tolerance), {});
  run.start();
  Eigen::Matrix<double, 6, 15> rows;
  for (int k = 0; k < 15; ++k) {
    run.run(0.1 * (k + 1));
    rows.col(k) << run.position("bob"), run.velocity("bob");
  }
  return rows;
}

// Against the same run at a tolerance 50 times smaller: positions and velocities fall with the tolerance.
TEST_P(Controlled, ErrorOfAStiffSpringPendulumFollowsTheTolerance) {
  const auto scene = with_scheme(spring_pendulum());
  const auto exact = bob_history(scene, 1e-5);
  const auto error = [&](double tolerance, int first) {
    return (bob_history(scene, tolerance) - exact).middleRows(first, 3).cwiseAbs().maxCoeff();
  };
  for (const int first : {0, 3}) EXPECT_NEAR(std::log2(error(8e-3, first) / error(5e-4, first)), 4.0, 0.7) << first;
  EXPECT_LT(error(5e-4, 0), 20 * 5e-4);
}

/// Largest relative errors of energy, angular momentum about the centre of mass and velocity of a free body that
/// tumbles.
std::array<double, 3> tumbling_errors(const formats::Scene& given, double tolerance) {
  formats::Scene scene = controlled(given, tolerance);
  const Vector3d J(1, 2, 3), v(0.3, -0.2, 0.1);
  formats::RigidBodySpec body = test_support::rigid_body("body", 1.0, {0, 0, 0}, J);
  body.start.angular_velocity = {2, 3, 1};
  body.start.velocity = v;
  scene.bodies.push_back(body);
  Simulation run(scene, {});
  run.start();
  const auto momentum = [&] { return Vector3d(run.rotation("body") * J.cwiseProduct(run.Omega("body"))); };
  const Vector3d before = momentum();
  std::array<double, 3> errors{};
  run.run(scene.integrator.end, [&] {
    const double energy = run.energy().total() / run.state().initial_energy() - 1.0;
    errors[0] = std::max(errors[0], std::abs(energy));
    errors[1] = std::max(errors[1], (momentum() - before).norm() / before.norm());
    errors[2] = std::max(errors[2], (run.velocity("body") - v).norm() / v.norm());
  });
  return errors;
}

// Momentum is kept as it is; angular momentum and energy, which no such method keeps exactly, err by less than the
// tolerance of the rotations and fall with it: a tolerance 16 times smaller, 4 times the steps, 16 times less at
// order 2.
TEST_P(Controlled, FreeBodyKeepsEnergyAndMomentum) {
  const formats::Scene scene = with_scheme(test_support::empty_scene(1e-3, 5.0));
  const auto coarse = tumbling_errors(scene, 1.6e-3), fine = tumbling_errors(scene, 1e-4);
  for (int i = 0; i < 2; ++i) {
    EXPECT_LT(fine[i], 1e-4) << i;
    EXPECT_GT(coarse[i] / fine[i], 12.0) << i << ": " << coarse[i] << " " << fine[i];
  }
  EXPECT_LT(coarse[2], 1e-12);
}

/// The flexible frame of the tests, hung on a hinge.
TEST_P(Controlled, ErrorOfAFlexibleBodyFollowsTheTolerance) {
  SuperelementFiles files;
  test_support::add_file("beam", test_support::test_superelement("beam"), files);
  formats::Scene scene = with_scheme(test_support::empty_scene(1e-3, 0.3));
  scene.gravity = {0, 0, -9.81};
  formats::SuperelementBodySpec body = test_support::superelement_body("beam", "beam");
  body.damping.stiffness = 1e-3;
  scene.bodies.push_back(body);
  scene.joints.push_back(
      test_support::joint("hinge", formats::JointKind::revolute, "ground", "beam/base", {-0.2, 0, 0.1}, {0, 1, 0}));
  const auto tip = [&](double tolerance) {
    Simulation run(controlled(scene, tolerance), files);
    run.start();
    run.run(0.3);
    return run.position("beam/tip");
  };
  const Vector3d exact = tip(1e-5), coarse = tip(4e-3), fine = tip(2.5e-4);
  EXPECT_NEAR((coarse - exact).norm() / (fine - exact).norm(), 16.0, 8.0);
  EXPECT_LT((fine - exact).norm(), 20 * 2.5e-4);
}

// Rows of `interval` and breakpoints are ends of steps, whatever the error asks for.
TEST(ControlledSchedule, StepsEndOnOutputAndBreakpoints) {
  formats::Scene scene = controlled(test_support::empty_scene(1e-3, 1.0), 1e-3);
  scene.bodies.push_back(test_support::rigid_body("body", 1.0, {0, 0, 0}, {1, 1, 1}));
  scene.loads.push_back(test_support::constant_load("push", formats::LoadKind::force, "body", {0, 0, 0}));
  scene.loads.back().components[0] = formats::TimeTable{{0.123, 0.33, 0.71}, {0, 1, 0}};
  scene.output.interval = 0.1;
  Simulation run(scene, {});
  run.start();
  std::vector<double> times{0.0};
  run.run(1.0, [&] { times.push_back(run.state().time()); });
  for (int i = 1; i <= 10; ++i) EXPECT_EQ(std::count(times.begin(), times.end(), i * 0.1), 1) << i;
  for (const double t : {0.123, 0.33, 0.71}) EXPECT_EQ(std::count(times.begin(), times.end(), t), 1) << t;
  for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GT(times[i] - times[i - 1], 4e-4) << times[i];
}

// A blow makes steps fail: they are counted with the reason, and steps below min_step end the run.
TEST(ControlledSchedule, RejectedStepsSayWhy) {
  formats::Scene scene = controlled(test_support::pendulum_scene(0.1, 2.0), 1e-5);
  scene.integrator.step = 0.1;
  Simulation run(scene, {});
  run.start();
  ASSERT_TRUE(run.step());
  EXPECT_GE(run.rejected, 1);
  EXPECT_NE(run.failure.find("local error"), std::string::npos) << run.failure;
  EXPECT_NE(run.failure.find("pendulum"), std::string::npos) << run.failure;
  scene.integrator.error_control.min_step = 0.05;
  Simulation limited(scene, {});
  limited.start();
  EXPECT_FALSE(limited.step());
  EXPECT_NE(limited.schedule.limit(Units{}).find("min_step"), std::string::npos);
}

TEST(StepSize, FollowsTheErrorWithinLimits) {
  formats::IntegratorSpec options;
  options.end = 10.0;
  EXPECT_DOUBLE_EQ(next_step(options, 0.01, 0.25), 0.018);
  EXPECT_DOUBLE_EQ(next_step(options, 0.01, 0.0), 0.02);
  EXPECT_DOUBLE_EQ(next_step(options, 0.01, 0.7), 0.01);  // would grow by 8 % only
  EXPECT_DOUBLE_EQ(next_step(options, 0.01, 1.0), 0.009);
  EXPECT_DOUBLE_EQ(next_step(options, 0.9, 1e-6), 1.0);  // a tenth of the whole
  EXPECT_DOUBLE_EQ(shorter_step(0.01, 4.0), 0.0045);
  EXPECT_DOUBLE_EQ(shorter_step(0.01, 1e6), 0.002);
  EXPECT_DOUBLE_EQ(shorter_step(0.01, 0.0), 0.005);
}

// The constant of the local error: one step of a free body whose force grows with time, x = t³/6.
TEST(LocalError, IsThatOfOneStep) {
  for (const Method method : {Method::generalised_alpha, Method::hht}) {
    formats::Scene scene = controlled(test_support::empty_scene(0.1, 1.0), 1.0);
    scene.integrator.method = method;
    scene.integrator.alpha = 0.1;
    scene.integrator.step = 0.1;
    scene.bodies.push_back(test_support::rigid_body("body", 1.0, {0, 0, 0}, {1, 1, 1}));
    scene.loads.push_back(test_support::constant_load("push", formats::LoadKind::force, "body", {0, 0, 0}));
    scene.loads.back().components[0] = formats::TimeExpression{"t", {}, ""};
    Simulation run(scene, {});
    run.start();
    ASSERT_EQ(advance(run.model(), scene.integrator, {0.1, 0.1}, run.state(), run.workspace).outcome,
              StepOutcome::accepted);
    const double error = std::abs(run.position("body").x() - 1e-3 / 6.0);
    Eigen::VectorXd estimate = Eigen::VectorXd::Zero(6);
    estimate_error(scene.integrator, 0.1, run.state(), run.workspace.memory.previous, estimate);
    EXPECT_NEAR(estimate[0], error, 1e-3 * error);
    // A tenth of the time may add a tenth of the tolerance.
    EXPECT_NEAR(measure_error(run.model(), scene.integrator.error_control, 0.1 / scene.integrator.end, estimate).ratio,
                10.0 * error, 1e-2 * error);
  }
}

}  // namespace
}  // namespace tisserand::mechanism::step_control_test
