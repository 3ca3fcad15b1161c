// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid mechanisms with published or exact solutions: joints, drives, gears and springs together.
#include <array>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/equations/round_off.hpp"
#include "mechanism/step/redundancy.hpp"
#include "tests/support/scenes/andrews.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::rigid_mechanisms_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;
using test_support::Andrews;
using test_support::andrews;
using test_support::body_at;
using test_support::drive;
using test_support::empty_scene;
using test_support::joint;
using test_support::rigid_body;
using test_support::Simulation;

const Vector3d z = Vector3d::UnitZ();

double coordinate(Simulation& run, const std::string& name) {
  evaluate(run.model(), run.state(), run.workspace.now);
  evaluate_coordinates(run.model(), run.state(), run.workspace.now);
  for (std::size_t i = 0; i < run.model().coordinates.size(); ++i)
    if (run.model().coordinates[i].name == name) return run.workspace.now.coordinates[i].value;
  ADD_FAILURE() << "no coordinate " << name;
  return 0.0;
}

double rate(Simulation& run, const std::string& name) {
  coordinate(run, name);
  for (std::size_t i = 0; i < run.model().coordinates.size(); ++i)
    if (run.model().coordinates[i].name == name) return run.workspace.now.coordinates[i].rate;
  return 0.0;
}

// ---- N-four-bar (IFToMM benchmark library; exact equation of motion in one angle) ---------------------------------

/// Two windows: uprights from (i, 0) to (i + sin θ, cos θ), i = 0, 1, 2, and two links along x; thin rods of 1 m and
/// 1 kg. The uprights turn with θ' = 1.
formats::Scene four_bar(double step, double theta) {
  formats::Scene scene = empty_scene(step, 10.0);
  scene.integrator.rho = 0.95;
  scene.gravity = {0, -9.81, 0};
  const double I = 1.0 / 12.0;
  const Vector3d tip(std::sin(theta), std::cos(theta), 0);
  for (int i = 0; i < 3; ++i) {
    const std::string name = "u" + std::to_string(i);
    formats::RigidBodySpec upright = body_at(name, 1.0, Vector3d(i, 0, 0) + 0.5 * tip, {I, I, I});
    upright.start.angular_velocity = -z;
    upright.start.velocity = -0.5 * z.cross(tip);
    scene.bodies.push_back(upright);
    scene.joints.push_back(joint("a" + std::to_string(i), JointKind::revolute, "ground", name, Vector3d(i, 0, 0), z));
  }
  for (int i = 0; i < 2; ++i) {
    const std::string n = std::to_string(i), next = "u" + std::to_string(i + 1);
    formats::RigidBodySpec link = body_at("h" + n, 1.0, Vector3d(i + 0.5, 0, 0) + tip, {I, I, I});
    link.start.velocity = -z.cross(tip);
    scene.bodies.push_back(link);
    scene.joints.push_back(joint("b" + n, JointKind::revolute, "u" + n, "h" + n, Vector3d(i, 0, 0) + tip, z));
    scene.joints.push_back(joint("c" + n, JointKind::revolute, next, "h" + n, Vector3d(i + 1, 0, 0) + tip, z));
  }
  return scene;
}

// I th'' = W g sin th with I = (N+1)/3 + N, W = (N+1)/2 + N: th(4 s) = 12.68425959, th'(4 s) = 1.07651118 for N = 2
// (DOP853, 1e-13). The mechanism is overconstrained (6 rows of 35) and passes singular positions.
TEST(FourBar, TurnsLikeTheExactEquation) {
  Simulation run(four_bar(1e-3, 0.0), {});
  run.start();
  run.run(4.0);
  // Where the uprights lie flat, positions follow from constraints quadratically: tolerance 1e-10 leaves 1e-5.
  EXPECT_NEAR(-coordinate(run, "a0"), 12.68425959, 2e-5);
  EXPECT_NEAR(-rate(run, "a0"), 1.07651118, 2e-4);
  // The library allows 0.1 J of 35.8 J.
  EXPECT_NEAR(evaluate_energy(run.model(), run.workspace.now).total(), run.state().initial_energy(), 0.01);
}

/// θ at `end` from θ(0) = π/2, θ'(0) = 1 by the symplectic scheme of order two, error below 1e-8.
double four_bar_angle(double end) {
  const double h = 1e-5, c = (1.5 + 2.0) * 9.81 / (1.0 + 2.0);
  double theta = 0.5 * std::numbers::pi, turning = 1.0;
  for (long k = std::lround(end / h); k > 0; --k) {
    turning += 0.5 * h * c * std::sin(theta);
    theta += h * turning;
    turning += 0.5 * h * c * std::sin(theta);
  }
  return theta;
}

// Rank 28 at the start and 29 later: rows that were left out open, are found, and are chosen anew.
TEST(FourBar, MovesOnFromWhereItLiesFlat) {
  Simulation run(four_bar(1e-3, 0.5 * std::numbers::pi), {});
  run.start();
  EXPECT_LT(run.started.mobility.rank, 29);
  int choices = 0;
  run.run(1.5, [&] { choices += run.report.row_choices; });
  EXPECT_GT(choices, 0);
  EXPECT_NEAR(-coordinate(run, "a0"), four_bar_angle(1.5) - 0.5 * std::numbers::pi, 1e-3);
  EXPECT_NEAR(evaluate_energy(run.model(), run.workspace.now).total(), run.state().initial_energy(), 0.01);
  EXPECT_LT(largest_violation(run.model(), run.workspace.now, Rows::left_out).value, 1e-7);
}

TEST(FourBar, RedundantRowsAreCounted) {
  Simulation run(four_bar(1e-3, 0.0), {});
  run.start();
  const StartReport& report = run.started;
  EXPECT_EQ(report.mobility.degrees_of_freedom, 1);
  EXPECT_EQ(report.mobility.constraints, 35);
  EXPECT_EQ(report.mobility.rank, 29);  // 30 coordinates
}

// ---- Andrews' squeezing mechanism (Schiehlen 1990; IVP test set, F. Mazzia) ---------------------------------------

// beta(0.03 s) = 15.81077119629904, published reference solution of the IVP test set (deTestSet, Ex_andrews.f); the
// crank reaches 1140 rad/s. Order 2, and at the finest step 1e-4 relative.
TEST(Andrews, MeetsThePublishedSolution) {
  double previous = 0.0;
  for (const double step : {2e-5, 1e-5}) {
    Simulation run(andrews(step), {});
    run.start();
    run.run(0.03);
    const double error = Andrews::be + coordinate(run, "O") - 15.81077119629904;
    if (previous != 0.0) {
      EXPECT_NEAR(previous / error, 4.0, 0.4);
    }
    previous = error;
    EXPECT_NEAR(Andrews::ga + coordinate(run, "B"), 0.04082224013073, 40 * std::abs(error));
  }
  EXPECT_LT(std::abs(previous), 1e-4 * 15.81);
}

// ---- Bricard's mechanism: overconstrained in every position ---------------------------------------------------------

formats::Scene bricard(double step) {
  formats::Scene scene = empty_scene(step, 10.0);
  scene.integrator.rho = 0.95;
  scene.gravity = {0, -9.81, 0};
  const std::array<Vector3d, 6> P{Vector3d(0, 0, 0),  Vector3d(1, 0, 0),  Vector3d(1, -1, 0),
                                  Vector3d(1, -1, 1), Vector3d(0, -1, 1), Vector3d(0, 0, 1)};
  const std::array<int, 6> axis{1, 2, 0, 1, 2, 0};
  for (std::size_t i = 0; i < 5; ++i) {
    const Vector3d along = (P[i + 1] - P[i]).cwiseAbs();
    const Vector3d inertia = Vector3d::Constant((1.0 + 0.01) / 12.0) + along * (0.02 / 12.0 - (1.0 + 0.01) / 12.0);
    scene.bodies.push_back(body_at("bar" + std::to_string(i), 1.0, 0.5 * (P[i] + P[i + 1]), inertia));
  }
  for (std::size_t i = 0; i < 6; ++i)
    scene.joints.push_back(joint("p" + std::to_string(i), JointKind::revolute,
                                 i == 0 ? "ground" : "bar" + std::to_string(i - 1),
                                 i == 5 ? "ground" : "bar" + std::to_string(i), P[i], Vector3d::Unit(axis[i])));
  return scene;
}

Vector3d third_corner(Simulation& run) {
  evaluate(run.model(), run.state(), run.workspace.now);
  return marker_position({2, Vector3d(0, 0, 0.5), Eigen::Matrix3d::Identity()}, run.workspace.now.motion[2]);
}

// Path of P3 (one-coordinate reduction, energy drift 1.6e-10 J): 30 rows of rank 29.
TEST(Bricard, MovesWithOneRedundantRow) {
  Simulation run(bricard(1e-3), {});
  run.start();
  const StartReport& report = run.started;
  EXPECT_EQ(report.mobility.constraints, 30);
  EXPECT_EQ(report.mobility.rank, 29);
  EXPECT_EQ(report.mobility.degrees_of_freedom, 1);
  run.run(1.0);
  EXPECT_LT((third_corner(run) - Vector3d(0.510501, -1.649168, 0.140123)).norm(), 1e-4);
  run.run(2.0);
  EXPECT_LT((third_corner(run) - Vector3d(-0.969340, -1.221247, 0.754278)).norm(), 1e-4);
  // The row that is left out drifts with what the others violate: with violations up to constraint_tolerance, 1e-10,
  // energy would be off by 6e-4 J here; errors of the method are 1.6e-7 J.
  EXPECT_NEAR(run.energy().total(), run.state().initial_energy(), 1e-6);
}

// ---- drives and couplings -------------------------------------------------------------------------------------------

/// Crank r = 0.15 (ground to crank), rod l = 0.3, slider along x; the crank turns with `formula`.
formats::Scene slider_crank(const std::string& formula) {
  formats::Scene scene = empty_scene(1e-3, 1.0);
  scene.bodies.push_back(body_at("crank", 0.36, {0.075, 0, 0}, {1e-4, 1e-4, 7e-4}));
  scene.bodies.push_back(body_at("rod", 0.15, {0.3, 0, 0}, {1e-5, 1.2e-3, 1.2e-3}));
  scene.bodies.push_back(body_at("slider", 0.08, {0.45, 0, 0}, {1e-5, 1e-5, 1e-5}));
  scene.joints.push_back(joint("main", JointKind::revolute, "ground", "crank", {0, 0, 0}, z));
  scene.joints.push_back(joint("pin", JointKind::revolute, "crank", "rod", {0.15, 0, 0}, z));
  scene.joints.push_back(joint("wrist", JointKind::spherical, "rod", "slider", {0.45, 0, 0}, z));
  scene.joints.push_back(joint("guide", JointKind::prismatic, "ground", "slider", {0.45, 0, 0}, {1, 0, 0}));
  scene.motions.push_back(drive("main", formula));
  scene.initial_tolerance = 10.0;
  return scene;
}

// x = r cos θ + sqrt(l² − r² sin² θ) of the rigid slider-crank, θ = 3 t + 0.2 sin 5 t: kinematics exact at every step.
TEST(Motion, SliderFollowsTheDrivenCrank) {
  Simulation run(slider_crank("3*t + 0.2*sin(5*t)"), {});
  run.start();
  run.run(0.8);
  const double t = 0.8, theta = 3 * t + 0.2 * std::sin(5 * t), omega = 3 + std::cos(5 * t);
  const double root = std::sqrt(0.09 - 0.0225 * std::pow(std::sin(theta), 2));
  const double x = 0.15 * std::cos(theta) + root;
  const double xd = -0.15 * std::sin(theta) * omega * (1 + 0.15 * std::cos(theta) / root);
  EXPECT_NEAR(coordinate(run, "main"), theta, 1e-9);
  EXPECT_NEAR(coordinate(run, "guide"), x - 0.45, 1e-9);
  EXPECT_NEAR(rate(run, "guide"), xd, 1e-8);
}

// Work of the drive = change of the energy: the trapezoidal rule and the integrator are both of order 2.
TEST(Motion, WorkOfTheDriveIsTheEnergyOfTheMechanism) {
  double previous = 0.0;
  for (const double step : {2e-3, 1e-3}) {
    formats::Scene scene = slider_crank("3*t*t");
    scene.integrator.step = step;
    Simulation run(scene, {});
    run.start();
    run.run(1.0);
    evaluate(run.model(), run.state(), run.workspace.now);
    const double error =
        evaluate_energy(run.model(), run.workspace.now).total() - run.state().initial_energy() - run.state().work();
    if (previous != 0.0) {
      EXPECT_NEAR(previous / error, 4.0, 0.8);
    }
    previous = error;
  }
  EXPECT_LT(std::abs(previous), 1e-4);
}

/// Two shafts through the origin, driven and free, whose axes enclose the angle `bend`.
formats::Scene two_shafts(JointKind kind, double bend, const std::string& formula) {
  formats::Scene scene = empty_scene(1e-3, 1.0);
  const Vector3d out(std::sin(bend), 0, std::cos(bend));
  for (const std::string name : {"in", "out"}) {
    formats::RigidBodySpec shaft = rigid_body(name, 1.0, Vector3d::Zero(), {0.01, 0.01, 0.02});
    if (name == "out") shaft.start.pose.orientation = Eigen::AngleAxisd(bend, Vector3d::UnitY());
    scene.bodies.push_back(shaft);
  }
  scene.joints.push_back(joint("bearing_in", JointKind::revolute, "ground", "in", {0, 0, 0}, z));
  formats::JointSpec bearing = joint("bearing_out", JointKind::generic, "ground", "out", {0, 0, 0}, out);
  bearing.hold = {false, false, false, true, true, false};
  scene.joints.push_back(bearing);
  formats::JointSpec shafts = joint("shafts", kind, "in", "out", {0, 0, 0}, z);
  shafts.axis.reset();
  shafts.a.orientation = Eigen::Quaterniond::Identity();
  shafts.b.orientation = Eigen::Quaterniond::Identity();
  scene.joints.push_back(shafts);
  scene.motions.push_back(drive("bearing_in", formula));
  scene.initial_tolerance = 10.0;
  return scene;
}

// Hooke's joint: with the pin of the driven shaft across the plane of the shafts at the start ... tan(out) = tan(in)
// cos(bend) or tan(in)/cos(bend) by the phase of the forks; here the pin x of A lies in the plane of the shafts.
TEST(UniversalJoint, TurnsByTheFormulaOfHooke) {
  const double bend = 0.6, in = 0.9;
  Simulation run(two_shafts(JointKind::universal, bend, "0.9*t"), {});
  run.start();
  run.run(1.0);
  EXPECT_NEAR(std::tan(coordinate(run, "bearing_out/angle")), std::tan(in) / std::cos(bend), 1e-8);
}

TEST(ConstantVelocityJoint, TurnsBothShaftsAlike) {
  Simulation run(two_shafts(JointKind::constant_velocity, 0.6, "0.9*t + 0.3*sin(7*t)"), {});
  run.start();
  run.run(1.0);
  EXPECT_NEAR(coordinate(run, "bearing_out/angle"), 0.9 + 0.3 * std::sin(7.0), 1e-8);
}

/// A wheel on a hinge at x with inertia J about z.
void add_wheel(const std::string& name, double x, double J, formats::Scene& scene) {
  scene.bodies.push_back(body_at(name, 1.0, {x, 0, 0}, {J, J, J}));
  scene.joints.push_back(joint("hinge_" + name, JointKind::revolute, "ground", name, {x, 0, 0}, z));
}

formats::GearSpec gear(const std::string& first, const std::string& second, double ratio) {
  formats::GearSpec spec;
  spec.name = "gear";
  spec.first.name = first;
  spec.second.name = second;
  spec.ratio = ratio;
  return spec;
}

// J_1 α = T − n² J_2 α: α = T/(J_1 + n² J_2); the angle α t²/2 is exact for the integrator. Many turns.
TEST(Gear, AcceleratesWithTheReflectedInertia) {
  formats::Scene scene = empty_scene(0.01, 3.0);
  add_wheel("one", 0, 0.1, scene);
  add_wheel("two", 1, 0.4, scene);
  scene.gears.push_back(gear("hinge_one", "hinge_two", -2.5));
  scene.loads.push_back(test_support::constant_load("torque", formats::LoadKind::moment, "one", {0, 0, 26.0}));
  Simulation run(scene, {});
  run.start();
  run.run(3.0);
  const double alpha = 26.0 / (0.1 + 2.5 * 2.5 * 0.4);
  EXPECT_NEAR(coordinate(run, "hinge_one"), 0.5 * alpha * 9.0, 1e-7);
  EXPECT_NEAR(coordinate(run, "hinge_two"), -2.5 * 0.5 * alpha * 9.0, 1e-7);
}

// T = (J + m r²) α, and a screw of pitch p: T = (J + m (p/2π)²) α.
TEST(RackAndPinion, MovesTheRackByTheRadius) {
  formats::Scene scene = empty_scene(0.01, 2.0);
  add_wheel("pinion", 0, 0.2, scene);
  scene.bodies.push_back(body_at("rack", 3.0, {0, -0.1, 0}, {0.1, 0.1, 0.1}));
  scene.joints.push_back(joint("slide", JointKind::prismatic, "ground", "rack", {0, -0.1, 0}, {1, 0, 0}));
  scene.gears.push_back(gear("hinge_pinion", "slide", 0.1));
  scene.loads.push_back(test_support::constant_load("torque", formats::LoadKind::moment, "pinion", {0, 0, 7.0}));
  Simulation run(scene, {});
  run.start();
  run.run(2.0);
  const double angle = 0.5 * 4.0 * 7.0 / (0.2 + 3.0 * 0.01);
  EXPECT_NEAR(coordinate(run, "hinge_pinion"), angle, 1e-7);
  EXPECT_NEAR(coordinate(run, "slide"), 0.1 * angle, 1e-8);
}

TEST(Screw, AdvancesByThePitchPerTurn) {
  formats::Scene scene = empty_scene(0.01, 2.0);
  scene.bodies.push_back(body_at("nut", 3.0, {0, 0, 0}, {0.1, 0.1, 0.2}));
  formats::JointSpec screw = joint("screw", JointKind::screw, "ground", "nut", {0, 0, 0}, z);
  screw.pitch = 0.5;
  scene.joints.push_back(screw);
  scene.loads.push_back(test_support::constant_load("torque", formats::LoadKind::moment, "nut", {0, 0, 7.0}));
  Simulation run(scene, {});
  run.start();
  run.run(2.0);
  const double advance = 0.5 / (2 * std::numbers::pi);
  const double angle = 0.5 * 4.0 * 7.0 / (0.2 + 3.0 * advance * advance);
  EXPECT_NEAR(coordinate(run, "screw/angle"), angle, 1e-7);
  EXPECT_NEAR(coordinate(run, "screw/z"), advance * angle, 1e-8);
}

// ---- springs
// ----------------------------------------------------------------------------------------------------------

/// 2 kg on a guide along x, spring along its coordinate.
formats::Scene oscillator(double step) {
  formats::Scene scene = empty_scene(step, 5.0);
  scene.bodies.push_back(body_at("mass", 2.0, {0, 0, 0}, {0.1, 0.1, 0.1}));
  scene.joints.push_back(joint("guide", JointKind::prismatic, "ground", "mass", {0, 0, 0}, {1, 0, 0}));
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.coordinate = formats::CoordinateRef{"guide", ""};
  spring.stiffness = 50.0;
  spring.damping = 4.0;
  spring.free = -0.1;
  scene.springs.push_back(spring);
  return scene;
}

// x = −0.1 + 0.1 e^{−δt} (cos ωt + δ/ω sin ωt), δ = c/(2 m), ω² = k/m − δ².
TEST(SpringAlongAJoint, SwingsLikeTheDampedOscillator) {
  Simulation run(oscillator(5e-4), {});
  run.start();
  run.run(1.0);
  const double delta = 1.0, omega = std::sqrt(25.0 - 1.0);
  const double exact = -0.1 + 0.1 * std::exp(-delta) * (std::cos(omega) + delta / omega * std::sin(omega));
  EXPECT_NEAR(coordinate(run, "guide"), exact, 1e-7);  // (ωh)²/12 of 0.1
  evaluate(run.model(), run.state(), run.workspace.now);
  const double balance =
      evaluate_energy(run.model(), run.workspace.now).total() - run.state().initial_energy() + run.state().dissipated();
  EXPECT_NEAR(balance, 0.0, 1e-6);
}

// Thrown against a stop of k_s without damping the mass returns with its speed after half a period π sqrt(m/k_s).
TEST(Stop, ReturnsTheEnergyAfterHalfAPeriod) {
  formats::Scene scene = oscillator(1e-4);
  scene.springs[0].stiffness = scene.springs[0].damping = 0.0;
  scene.springs[0].upper = 0.2;
  scene.springs[0].stop_stiffness = 2e4;
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.velocity = {1.0, 0, 0};
  scene.integrator.rho = 1.0;
  Simulation run(scene, {});
  run.start();
  run.run(0.5);
  const double contact = std::numbers::pi * std::sqrt(2.0 / 2e4);
  EXPECT_NEAR(rate(run, "guide"), -1.0, 2e-3);
  EXPECT_NEAR(coordinate(run, "guide"), 0.2 - (0.5 - 0.2 - contact), 2e-3);
}

// Hanging on a spring between two points: k (l − l_0) = m g.
TEST(SpringBetweenPoints, HangsAtItsStaticLength) {
  formats::Scene scene = empty_scene(1e-3, 1.0);
  scene.analysis = formats::AnalysisKind::statics;
  scene.gravity = {0, 0, -9.81};
  scene.bodies.push_back(body_at("mass", 2.0, {0, 0, -1}, {0.1, 0.1, 0.1}));
  scene.joints.push_back(joint("guide", JointKind::prismatic, "ground", "mass", {0, 0, -1}, {0, 0, 1}));
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.a.node = "ground";
  spring.b.node = "mass";
  spring.stiffness = 400.0;
  spring.free = 0.8;
  scene.springs.push_back(spring);
  Simulation run(scene, {});
  run.start();
  ASSERT_EQ(solve_statics(run.model(), scene.statics, {}, run.state(), run.workspace).outcome, StepOutcome::accepted);
  EXPECT_NEAR(coordinate(run, "spring"), 0.8 + 2.0 * 9.81 / 400.0, 1e-10);
}

// A point mass on a massless rod: x, y at 10 s from DOP853 (1e-13), problem of the IFToMM library.
TEST(DistanceJoint, SwingsAsTheMathematicalPendulum) {
  double previous = 0.0;
  for (const double step : {1e-3, 5e-4}) {
    formats::Scene scene = empty_scene(step, 10.0);
    scene.gravity = {0, -9.81, 0};
    scene.bodies.push_back(body_at("bob", 1.0, {-1, 0, 0}, {0.1, 0.1, 0.1}));
    formats::JointSpec rod = joint("rod", JointKind::distance, "ground", "bob", {0, 0, 0}, z);
    rod.position.reset();
    rod.axis.reset();
    scene.joints.push_back(rod);
    Simulation run(scene, {});
    run.start();
    run.run(10.0);
    const double error = (run.state().x().col(0) - Vector3d(-0.27508746, -0.96141921, 0)).norm();
    if (previous != 0.0) {
      EXPECT_NEAR(previous / error, 4.0, 0.4);
    }
    previous = error;
  }
  EXPECT_LT(previous, 1e-3);
}

}  // namespace
}  // namespace tisserand::mechanism::rigid_mechanisms_test
