// SPDX-License-Identifier: GPL-3.0-or-later
// Orders of convergence, conditioning, changes of step, energy, breakpoints, rejected steps and restarts of the
// integrator.
#include "mechanism/step/step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/iteration_matrix.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/scenes/rotor.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/schemes.hpp"

namespace tisserand::mechanism::integrator_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::Formulation;
using test_support::order;
using test_support::Pendulum;
using test_support::Scheme;
using test_support::Simulation;

class EveryScheme : public ::testing::TestWithParam<Scheme> {
 protected:
  formats::Scene with_scheme(formats::Scene scene) const {
    scene.integrator.rho = 0.9;
    return test_support::with_scheme(GetParam(), std::move(scene));
  }
};

INSTANTIATE_TEST_SUITE_P(Schemes, EveryScheme, test_support::all_schemes(), test_support::scheme_name);

// After one period T the pendulum is at rest again: a remaining rate w means that it is late by w/(angular
// acceleration).
TEST_P(EveryScheme, PendulumHasTheExactPeriod) {
  const auto delay = [this](int steps) {
    Simulation run(with_scheme(test_support::pendulum_scene(Pendulum::period() / steps, Pendulum::period())), {});
    run.start();
    run.run(Pendulum::period());
    const double acceleration = Pendulum::mass * Pendulum::gravity * Pendulum::arm / Pendulum::inertia_about_hinge();
    return run.Omega("pendulum").z() / acceleration / Pendulum::period();
  };
  const double coarse = delay(200), fine = delay(400);
  EXPECT_LT(std::abs(fine), 2e-4);
  EXPECT_NEAR(order(std::abs(coarse), std::abs(fine)), 2.0, 0.1);
  EXPECT_LT(std::abs((4.0 * fine - coarse) / 3.0), 5e-6);  // extrapolated to step zero
}

/// Largest errors of position, angular velocity and support force over the rows of the reference, from `settled` on for
/// the force.
std::array<double, 3> heavy_top_errors(formats::Scene scene, double settled) {
  Simulation run(std::move(scene), {});
  run.start();
  std::array<double, 3> errors{};
  for (const std::vector<double>& row : test_support::reference_rows("heavy_top.csv")) {
    run.run(row[0]);
    const Vector3d x(row[1], row[2], row[3]), Omega(row[4], row[5], row[6]), force(row[11], row[12], row[13]);
    errors[0] = std::max(errors[0], (run.position("top") - x).norm());
    errors[1] = std::max(errors[1], (run.Omega("top") - Omega).norm());
    if (row[0] >= settled) errors[2] = std::max(errors[2], (-run.state().lambda() - force).norm());
  }
  return errors;
}

// Positions and velocities of order 2 in the maximum norm; multipliers: stabilised index 2 with the corrected start in
// the maximum norm, index 3 after the start transient (100 steps of the coarser run). [BCA12], [ABC15].
TEST_P(EveryScheme, HeavyTopConvergesWithOrderTwo) {
  const double h = 1e-3;
  const double settled = GetParam().formulation == Formulation::index3 ? 0.2 : 0.0;
  const auto coarse = heavy_top_errors(with_scheme(test_support::heavy_top_scene(h, 0.5)), settled);
  const auto fine = heavy_top_errors(with_scheme(test_support::heavy_top_scene(h / 2, 0.5)), settled);
  const std::array<const char*, 3> names{"position", "angular velocity", "support force"};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GT(order(coarse[i], fine[i]), 1.85) << names[i] << " " << coarse[i] << " " << fine[i];
    EXPECT_LT(order(coarse[i], fine[i]), 2.3) << names[i] << " " << coarse[i] << " " << fine[i];
  }
  EXPECT_LT(fine[0], 5e-3);
}

// The loads move no body, so that increments of positions do not see them: kept factors of the rotor half a turn ago
// would double their error in each iteration. A turn of ωh in a step leaves errors of order (ωh)²; those of the start
// transient of index 3 are left out.
TEST_P(EveryScheme, ARotorLoadsItsBearingAcrossItsPlane) {
  const double settled = GetParam().formulation == Formulation::index3 ? 0.3 : 0.0;
  for (const double step : {1e-3, 2e-3, 5e-3}) {
    const double turn = test_support::Rotor::rate * step;
    EXPECT_LT(test_support::Rotor::error(with_scheme(test_support::Rotor::scene(step, 0.6)), settled), turn * turn)
        << step;
  }
}

/// λ that positions and velocities of the state demand.
VectorXd consistent_multipliers(Simulation& run) {
  State copy = run.state();
  Workspace workspace(run.model());
  solve_accelerations(run.model(), run.scene.integrator.step, "", copy, workspace);
  return copy.lambda();
}

// The scaled iteration matrix and the work of a step do not depend on its size (iterations are with kept factors).
// Round-off of λ: positions are rounded to ε L, which index 3 turns into accelerations of ε L/(β h²), and the double
// integration of its recurrence multiplies by about 100; stabilised index 2 sees velocities and has none of that.
// Measured after 150 steps, when the start transient of index 3 has gone.
TEST_P(EveryScheme, ConditioningDoesNotDependOnTheStep) {
  double least = 1.0, most = 0.0;
  for (const double h : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    formats::Scene scene = with_scheme(test_support::pendulum_scene(h, 10.0));
    auto& start = std::get<formats::RigidBodySpec>(scene.bodies[0]).start;
    start.angular_velocity = {0, 0, 3};
    Simulation run(scene, {});
    run.start();
    double error = 0.0;
    for (int i = 0; i < 200; ++i) {
      ASSERT_TRUE(run.step()) << h << " " << run.failure;
      if (i >= 150) error = std::max(error, (run.state().lambda() - consistent_multipliers(run)).cwiseAbs().maxCoeff());
    }
    EXPECT_EQ(run.rejected, 0) << h;
    EXPECT_LE(run.iterations, 200 * 8) << h;
    const FactorReport factors = run.workspace.matrix.factor(
        run.model(), run.state(), {step_coefficients(alpha_parameters(run.scene.integrator), h)}, run.workspace.now);
    least = std::min(least, factors.reciprocal_condition);
    most = std::max(most, factors.reciprocal_condition);
    // λ of size 20 N; the error of the method is 4e-2 at 1e-2 and falls with h².
    const double round_off = GetParam().formulation == Formulation::index3
                                 ? 500.0 * 2.2e-16 * Pendulum::arm * Pendulum::mass / (0.25 * h * h)
                                 : 2e-5;
    EXPECT_LT(error, 2e3 * h * h + round_off) << h;
  }
  EXPECT_LT(most / least, 100.0);
}

/// Largest |λ − λ(q, v)| after t = 1.5 of a pendulum whose step is halved there.
double multiplier_error_after_halving(formats::Scene scene, double h) {
  Simulation run(std::move(scene), {});
  run.start();
  run.run(1.5);
  double error = 0.0;
  for (int i = 1; i <= 60; ++i) {
    const double end = 1.5 + 0.5 * h * i;
    EXPECT_EQ(advance(run.model(), run.scene.integrator, {end, end}, run.state(), run.workspace).outcome,
              StepOutcome::accepted);
    error = std::max(error, (run.state().lambda() - consistent_multipliers(run)).cwiseAbs().maxCoeff());
  }
  return error;
}

// The algorithmic acceleration stands for another instant when the step changes, and with index 3 the velocities carry
// a violation B v of order h² that belongs to their step: both rebuilt, λ keeps order 2 through the change.
TEST_P(EveryScheme, MultipliersKeepTheirOrderThroughAChangeOfStep) {
  const double coarse = multiplier_error_after_halving(with_scheme(test_support::pendulum_scene(0.01, 2.0)), 0.01);
  const double fine = multiplier_error_after_halving(with_scheme(test_support::pendulum_scene(0.005, 2.0)), 0.005);
  EXPECT_GT(order(coarse, fine), 1.8) << coarse << " " << fine;
}

// At steps of 1e-5 an increment of positions of 1e-13 still is an acceleration of 4e-3: the iteration goes on until
// increments are round-off, or the energy is off by 5e-7 of the kinetic one here. The error of the method is (ω h)²/12,
// 1e-10.
TEST_P(EveryScheme, SmallStepsKeepTheEnergy) {
  Simulation run(with_scheme(test_support::pendulum_scene(1e-5, 0.1)), {});
  run.start();
  run.run(0.1);
  const Energy energy = run.energy();
  EXPECT_LT(std::abs(energy.total() - run.state().initial_energy()), 2e-8 * energy.kinetic);
  EXPECT_LE(run.iterations, 3 * run.steps);
}

// With ρ = 1 the energy error of the pendulum is periodic: no larger in the tenth period than in the first two (5 %
// allowed for the instants at which it is sampled).
TEST(Energy, OfAPendulumDoesNotDriftWithoutNumericalDissipation) {
  formats::Scene scene = test_support::pendulum_scene(Pendulum::period() / 200, 10 * Pendulum::period());
  scene.integrator.rho = 1.0;
  Simulation run(scene, {});
  run.start();
  const double size = Pendulum::mass * Pendulum::gravity * Pendulum::arm;
  double early = 0.0, late = 0.0;
  run.run(10 * Pendulum::period(), [&] {
    const double error = std::abs(run.energy().total() - run.state().initial_energy()) / size;
    double& worst = run.state().time() < 2 * Pendulum::period() ? early : late;
    worst = std::max(worst, error);
  });
  EXPECT_LT(early, 1e-3);
  EXPECT_LT(late, 1.05 * early);
}

/// Slope of the energy over time, by least squares over the accepted steps, of a bob of 1 kg on a massless rod of 1 m
/// that is let go where the rod is level.
double energy_drift(double h, double rho, double end) {
  formats::Scene scene = test_support::empty_scene(h, end);
  scene.gravity = {0, -9.81, 0};
  scene.integrator.rho = rho;
  formats::RigidBodySpec bob = test_support::rigid_body("bob", 1.0, {0, 0, 0}, {0.1, 0.1, 0.1});
  bob.start.pose.position = {-1, 0, 0};
  scene.bodies.push_back(bob);
  formats::JointSpec rod;
  rod.name = "rod";
  rod.kind = formats::JointKind::distance;
  rod.a.node = "ground";
  rod.b.node = "bob";
  scene.joints.push_back(rod);
  Simulation run(scene, {});
  run.start();
  double n = 0.0, t = 0.0, e = 0.0, tt = 0.0, te = 0.0;
  run.run(end, [&] {
    if (run.steps % 10 != 0) return;
    const double time = run.state().time() - 0.5 * end, energy = run.energy().total() - run.state().initial_energy();
    n += 1.0, t += time, e += energy, tt += time * time, te += time * energy;
  });
  return (te - t * e / n) / (tt - t * t / n);
}

// Positions are closed by δ = C h³ v̈ along the rod, C = 1/12 at ρ = 1 [ABC15], v̈ = −3 θ̇ θ̈ there. Closed along a rod of
// a time τ before the middle of the step they are pushed along the path by δ θ̇ τ: θ̈ of it per kg and step is fed in,
// C h² 3 τ <θ̇² θ̈²> per second. With θ̇² = 2 g sin θ, θ̈ = g cos θ the mean over a period is 2 g³ B(3/4, 3/2)/B(1/4, 1/2)
// = 2 g³ 0.1828. The rod of the start of the step, τ = h/2, would feed 3.4e-7 J/s; less than a tenth of that is asked
// for. ρ = 0.9 itself dissipates less than this at ω h = 0.006.
TEST(Energy, OfAPendulumIsNotFedByThePositionProjection) {
  const double h = 0.002, g = 9.81;
  const double of_the_start = 1.0 / 12.0 * 3.0 * h * h * (0.5 * h) * 2.0 * g * g * g * 0.1828;
  for (const double rho : {1.0, 0.9}) EXPECT_LT(std::abs(energy_drift(h, rho, 100.0)), 0.1 * of_the_start) << rho;
}

// Dzhanibekov's body against the reference; space-fixed angular momentum and energy hold to the order of the method.
TEST(FreeRigidBody, TumblesLikeTheReference) {
  const auto errors = [](double h) {
    formats::Scene scene = test_support::empty_scene(h, 4.0);
    formats::RigidBodySpec body = test_support::rigid_body("body", 1.0, {0, 0, 0}, {1, 2, 3});
    body.start.angular_velocity = {0.01, 5, 0.01};
    scene.bodies.push_back(body);
    scene.integrator.rho = 1.0;
    Simulation run(scene, {});
    run.start();
    std::array<double, 3> worst{};
    for (const std::vector<double>& row : test_support::reference_rows("free_rigid_body.csv")) {
      run.run(row[0]);
      const Vector3d Omega = run.Omega("body");
      const Eigen::Quaterniond q(row[1], row[2], row[3], row[4]);
      worst[0] = std::max(worst[0], (Omega - Vector3d(row[5], row[6], row[7])).norm());
      worst[1] = std::max(worst[1], q.angularDistance(run.rotation("body")));
      const Vector3d momentum = run.rotation("body") * Vector3d(Vector3d(1, 2, 3).asDiagonal() * Omega);
      worst[2] = std::max(worst[2], (momentum - Vector3d(0.01, 10, 0.03)).norm());
    }
    return worst;
  };
  const auto coarse = errors(0.01), fine = errors(0.005);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(order(coarse[i], fine[i]), 2.0, 0.15) << coarse[i] << " " << fine[i];
  EXPECT_LT(fine[0], 0.02);
}

formats::Scene pushed_body(const formats::TimeFunctionSpec& force) {
  formats::Scene scene = test_support::empty_scene(0.1, 1.0);
  scene.bodies.push_back(test_support::rigid_body("body", 1.0, {0, 0, 0}, {1, 1, 1}));
  scene.loads.push_back(test_support::constant_load("push", formats::LoadKind::force, "body", {0, 0, 0}));
  scene.loads.back().components[0] = force;
  return scene;
}

TEST(Breakpoints, StepsEndOnThemExactly) {
  Simulation run(pushed_body(formats::TimeTable{{0.123, 0.33, 0.3300001, 0.71}, {0, 1, 1, 0}}), {});
  run.start();
  std::vector<double> times;
  run.run(1.0, [&] { times.push_back(run.state().time()); });
  for (const double t : {0.1, 0.123, 0.2, 0.33, 0.3300001, 0.4, 0.71, 1.0})
    EXPECT_EQ(std::count(times.begin(), times.end(), t), 1) << t;
  EXPECT_EQ(times.size(), 14u);
}

// A constant force is integrated exactly; with a jump at t = 0.55 only if the accelerations start anew there:
// v = 0.55 · 1 + 0.45 · 3, x = 0.55²/2 + 0.55 · 0.45 + 3 · 0.45²/2. Work of the same.
TEST_P(EveryScheme, AJumpOfALoadRestartsTheAccelerations) {
  Simulation run(with_scheme(pushed_body(formats::TimeExpression{"t < 0.55 ? 1 : 3", {0.55}, ""})), {});
  run.start();
  run.run(1.0);
  const double v = 0.55 + 0.45 * 3;
  EXPECT_NEAR(run.velocity("body").x(), v, 1e-12);
  EXPECT_NEAR(run.position("body").x(), 0.55 * 0.55 / 2 + 0.55 * 0.45 + 3 * 0.45 * 0.45 / 2, 1e-12);
  EXPECT_NEAR(run.state().work(), 0.5 * v * v, 1e-12);
}

/// A damped flexible pendulum on a hinge, with a table of loads.
struct Flexible {
  SuperelementFiles files;
  formats::Scene scene;

  explicit Flexible(Formulation formulation) : scene(test_support::empty_scene(2e-3, 1.0)) {
    test_support::add_file("beam", test_support::test_superelement("beam"), files);
    scene.gravity = {0, 0, -9.81};
    formats::SuperelementBodySpec body = test_support::superelement_body("beam", "beam");
    body.damping.stiffness = 1e-3;
    scene.bodies.push_back(body);
    scene.joints.push_back(
        test_support::joint("hinge", formats::JointKind::revolute, "ground", "beam/base", {-0.2, 0, 0.1}, {0, 1, 0}));
    scene.loads.push_back(test_support::constant_load("push", formats::LoadKind::force, "beam/tip", {0, 0, 0}));
    scene.loads[0].components[1] = formats::TimeTable{{0.0, 1.0}, {0.0, 20.0}};
    scene.integrator.formulation = formulation;
  }
};

// A step that is not accepted leaves no trace, also where its size differed from the last one.
TEST_P(EveryScheme, ARejectedStepLeavesTheStateBitEqual) {
  Flexible flexible(GetParam().formulation);
  Simulation run(with_scheme(flexible.scene), flexible.files);
  run.start();
  run.run(0.02);
  const std::vector<double> before = run.state().block();
  formats::IntegratorSpec options = run.scene.integrator;
  options.max_iterations = 1;
  options.tolerance = 1e-30;
  options.constraint_tolerance = 1e-30;
  for (const double step : {2e-3, 1e-3, 0.7}) {
    const double end = run.state().time() + step;
    EXPECT_EQ(advance(run.model(), options, {end, end}, run.state(), run.workspace).outcome,
              StepOutcome::too_many_iterations);
    EXPECT_EQ(run.state().block(), before) << step;
  }
}

TEST_P(EveryScheme, ARunContinuedFromACopyOfTheStateIsBitEqual) {
  Flexible flexible(GetParam().formulation);
  Simulation first(with_scheme(flexible.scene), flexible.files), second(with_scheme(flexible.scene), flexible.files);
  first.start();
  first.run(0.1);
  first.workspace.forget();
  second.state().block() = first.state().block();
  for (int i = 1; i <= 50; ++i) {
    const double end = 0.1 + 2e-3 * i;
    for (Simulation* run : {&first, &second})
      ASSERT_EQ(advance(run->model(), run->scene.integrator, {end, end}, run->state(), run->workspace).outcome,
                StepOutcome::accepted);
    ASSERT_EQ(first.state().block(), second.state().block()) << "step " << i;
  }
  EXPECT_GT(std::abs(first.state().work()), 0.0);
}

// Index 3 and stabilised index 2 are two discretisations of one problem: they meet with order 2.
TEST(Formulations, AgreeInTheLimit) {
  const auto difference = [](double h) {
    std::array<Vector3d, 2> tip;
    for (const Formulation formulation : {Formulation::index3, Formulation::stabilised_index2}) {
      Flexible flexible(formulation);
      flexible.scene.integrator.step = h;
      Simulation run(flexible.scene, flexible.files);
      run.start();
      run.run(0.4);
      tip[formulation == Formulation::index3] = run.position("beam/tip");
    }
    return (tip[0] - tip[1]).norm();
  };
  const double coarse = difference(4e-3), fine = difference(2e-3);
  EXPECT_LT(fine, 1e-3);
  EXPECT_GT(order(coarse, fine), 1.7) << coarse << " " << fine;
}

}  // namespace
}  // namespace tisserand::mechanism::integrator_test
