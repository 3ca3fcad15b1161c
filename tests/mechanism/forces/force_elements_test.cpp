// SPDX-License-Identifier: GPL-3.0-or-later
// Force elements in whole models: gravity per body, springs with curves and about axes; exact tangents, known motions.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/bodies/beam_states.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/scenes/model_tangent.hpp"

namespace tisserand::mechanism::force_elements_test {
namespace {

using Eigen::Vector3d;
using formats::Interpolation;
using formats::JointKind;

formats::BeamBodySpec soft_beam() {
  formats::BeamBodySpec beam;
  beam.name = "beam";
  beam.from = Vector3d(5, 0, 0);
  beam.to = Vector3d(6, 0, 0);
  beam.elements = 2;
  beam.section = test::rectangle(0.1, 0.2, 4e-5, 5.0 / 6.0);
  beam.material = test::material(1e6, 0.3, 10.0);
  return beam;
}

// Free bodies of every kind under gravity of their own fall with it: rigid motion, exact in the integrator.
TEST(Gravity, OfABodyReplacesThatOfTheScene) {
  const Vector3d own(1, -2, 3), common(0, 0, -9.81);
  SuperelementFiles files;
  test_support::add_file("frame", test_support::test_superelement("frame"), files);
  formats::Scene scene = test_support::empty_scene(0.01, 0.5);
  scene.gravity = common;
  for (const bool with_own : {true, false}) {
    formats::SuperelementBodySpec frame = test_support::superelement_body(with_own ? "frame" : "frame2", "frame");
    formats::RigidBodySpec block =
        test_support::rigid_body(with_own ? "block" : "block2", 2.0, {0.3, 0, 0}, {0.3, 0.4, 0.5});
    formats::BeamBodySpec beam = soft_beam();
    if (with_own) frame.gravity = block.gravity = beam.gravity = own;
    if (!with_own) beam.name = "beam2";
    scene.bodies.insert(scene.bodies.end(), {frame, block, beam});
  }
  test_support::Simulation run(scene, files);
  run.start();
  run.run(0.5);
  for (const char* name : {"frame/n0", "block", "beam/1"})
    EXPECT_LT((run.velocity(name) - 0.5 * own).norm(), 1e-8) << name;
  for (const char* name : {"frame2/n0", "block2", "beam2/1"})
    EXPECT_LT((run.velocity(name) - 0.5 * common).norm(), 1e-8) << name;
  EXPECT_NEAR(run.energy().total(), run.state().initial_energy(), 1e-6);
}

/// A mass on a guide along x from rest at `start`, with a spring of the given law.
formats::Scene guided_mass(const formats::LawSpec& stiffness, const formats::LawSpec& damping, double start,
                           double step, double end) {
  formats::Scene scene = test_support::empty_scene(step, end);
  scene.bodies.push_back(test_support::rigid_body("mass", 2.0, Vector3d::Zero(), {0.1, 0.1, 0.1}));
  scene.joints.push_back(
      test_support::joint("guide", JointKind::prismatic, "ground", "mass", Vector3d::Zero(), Vector3d::UnitX()));
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.coordinate = formats::CoordinateRef{"guide", ""};
  spring.stiffness = stiffness;
  spring.damping = damping;
  spring.free = -start;
  scene.springs.push_back(spring);
  return scene;
}

// Piecewise linear spring without damping: 8 per length in compression, 2 in tension, mass 2: half periods π/2 and π.
// From rest at −1: back at −1 after π/2 + π, having gone to +2 (energies ½·8·1² = ½·2·2²). Second order in the step.
TEST(CurvedSpring, BilinearPeriodAndAmplitude) {
  const formats::CurveSpec law{Interpolation::linear, {-1.0, 0.0, 1.0}, {-8.0, 0.0, 2.0}};
  const auto errors = [&](double step) {
    const double half = 0.25 * std::numbers::pi + 0.5 * std::numbers::pi;
    formats::Scene scene = guided_mass(law, 0.0, -1.0, half / std::round(half / step), 2.0 * half);
    scene.integrator.rho = 1.0;
    test_support::Simulation run(scene, {});
    run.start();
    run.run(half);
    const double far = run.position("mass").x() - 3.0;  // from the start at 0
    run.run(2.0 * half);
    return std::pair(std::abs(far), std::abs(run.position("mass").x()));
  };
  const auto [far, back] = errors(0.004);
  EXPECT_LT(far, 2e-4);
  EXPECT_LT(back, 5e-4);
  EXPECT_LT(errors(0.002).second, back / 2.5);
}

// Quadratic damper d = c q̇|q̇| as a table: dE/dt = −d(q̇) q̇, and with a cubic table of a smooth law the motion of the
// exact law 1/v = 1/v₀ + c t/m (free flight on the guide).
TEST(CurvedSpring, QuadraticDamperStopsAsItShould) {
  formats::CurveSpec law{Interpolation::cubic, {}, {}};
  for (int i = -400; i <= 400; ++i) {
    const double rate = 0.01 * i;
    law.x.push_back(rate);
    law.y.push_back(3.0 * rate * std::abs(rate));
  }
  formats::Scene scene = guided_mass(0.0, law, 0.0, 1e-3, 1.0);
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.velocity = {3, 0, 0};
  test_support::Simulation run(scene, {});
  run.start();
  run.run(1.0);
  EXPECT_NEAR(run.velocity("mass").x(), 1.0 / (1.0 / 3.0 + 3.0 * 1.0 / 2.0), 2e-5);
  EXPECT_NEAR(run.state().initial_energy() - run.energy().total(), run.state().dissipated(), 1e-4);
}

formats::Scene torsion_scene() {
  formats::Scene scene = test_support::empty_scene(0.005, 2.0);
  scene.bodies.push_back(test_support::rigid_body("wheel", 2.0, Vector3d::Zero(), {0.3, 0.4, 0.5}));
  scene.bodies.push_back(test_support::rigid_body("rim", 1.0, Vector3d::Zero(), {0.6, 0.6, 0.25}));
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.angular_velocity = {0, 0, 20};
  formats::SpringSpec spring;
  spring.name = "shaft";
  spring.kind = formats::SpringKind::torsion;
  spring.a.node = "wheel";
  spring.b.node = "rim";
  spring.axis = Vector3d::UnitZ();
  spring.stiffness = 6.0;
  spring.damping = 0.05;
  scene.springs.push_back(spring);
  return scene;
}

// Two free wheels on one axis, the relative angle is a damped oscillator of inertia J₁J₂/(J₁ + J₂) and turns several
// times around; the mean speed stays.
TEST(TorsionSpring, TwoFreeWheelsOscillateOverTurns) {
  formats::Scene scene = torsion_scene();
  test_support::Simulation run(scene, {});
  run.start();
  double largest = 0.0;
  run.run(2.0, [&] { largest = std::max(largest, std::abs(run.state().hinges()[0])); });
  const double J = 0.5 * 0.25 / 0.75, delta = 0.5 * 0.05 / J, omega = std::sqrt(6.0 / J - delta * delta);
  EXPECT_NEAR(run.state().hinges()[0], -20.0 / omega * std::exp(-2.0 * delta) * std::sin(2.0 * omega), 2e-2);
  EXPECT_GT(largest, std::numbers::pi);
  EXPECT_NEAR((0.5 * run.Omega("wheel") + 0.25 * run.Omega("rim")).z(), 0.5 * 20.0, 1e-9);
}

/// Everything that acts between markers, on bodies that are free to turn.
formats::Scene all_forces() {
  formats::Scene scene = torsion_scene();
  scene.gravity = {0.1, 0.2, -9.81};
  scene.springs[0].stiffness = formats::CurveSpec{Interpolation::cubic, {-1.0, 0.3, 1.0}, {-8.0, 0.5, 2.0}};
  scene.springs[0].damping = formats::CurveSpec{Interpolation::cubic, {-1.0, 0.0, 1.0}, {-3.0, 0.0, 1.0}};
  formats::BushingSpec mount;
  mount.name = "mount";
  mount.a.node = "ground";
  mount.b.node = "rim";
  mount.b.position = Vector3d(0.2, -0.1, 0.3);
  mount.axis = Vector3d(1, 2, 3);
  mount.stiffness.diagonal() << 5, 6, 7, 3, 2, 1;
  mount.stiffness(1, 5) = mount.stiffness(5, 1) = 0.7;
  mount.damping.diagonal() << 0.5, 0.6, 0.7, 0.3, 0.2, 0.1;
  mount.preload << 1, -2, 3, 0.3, 0.2, -0.1;
  scene.bushings.push_back(mount);
  return scene;
}

// Central differences with 1e-6 of a residual of size one hundred: 1e-8 relative to its largest derivative.
TEST(ForceElements, IterationMatrixIsTheDerivativeOfTheResidual) {
  test_support::Simulation run(all_forces(), {});
  const int n = run.model().sizes.boundary;
  for (unsigned seed = 0; seed < 4; ++seed) {
    test_support::randomise(run, seed, 0.3, 1.0);
    using test_support::Argument;
    const Eigen::MatrixXd K = test_support::iteration_matrix(run, {0, 0, 1}).topLeftCorner(n, n);
    EXPECT_LT(test_support::relative_difference(K, residual_difference(run, Argument::position, 1e-6)), 2e-8);
    const Eigen::MatrixXd C = test_support::damping_matrix(run);
    EXPECT_LT(test_support::relative_difference(C, residual_difference(run, Argument::velocity, 1e-6)), 2e-8);
  }
}

}  // namespace
}  // namespace tisserand::mechanism::force_elements_test
