// SPDX-License-Identifier: GPL-3.0-or-later
// Laws at the ends of their ranges: bushings that are wound up by whole turns, tables that end, axes that turn over.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/trial.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::law_range_test {
namespace {

using Eigen::Vector3d;
using test_support::Trial;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// 10 N m/rad on a hinge that is driven by step5 from 0 to 5 rad: moment 10 q + I q̈ of the drive.
void expect_proportional(const Trial& trial, const std::string& what) {
  const std::vector<double> q = trial.channel("joints/coordinate/hinge"), moment = trial.channel("motions/force/turn"),
                            rate = trial.channel("joints/rate/hinge");
  ASSERT_NEAR(q.back(), 5.0, 1e-9);
  for (std::size_t i = 0; i < q.size(); ++i)  // I = 1e-3 and |q̈| < 8 rad/s²
    EXPECT_NEAR(std::abs(moment[i]), 10.0 * q[i], 8e-3) << what << ' ' << q[i];
}

// The bushing acts on rotations about z alone: its turns are counted.
TEST(BushingTurns, OneAxisThatTurnsFar) {
  const Trial trial("fail4_bushing_half_turn");
  expect_proportional(trial, "one axis");
  EXPECT_THAT(trial.report().doubts, IsEmpty());
}

// A bushing that acts about all axes says at half a turn that it turns over, and which key counts turns. With the key
// it is right.
TEST(BushingTurns, AllAxesWithTheKey) {
  const std::string all = "bushings.torsion.stiffness=[0, 0, 0, 20, 30, 10]";
  const Trial silent("fail4_bushing_half_turn", {all});
  EXPECT_THAT(silent.report().doubts, Contains(HasSubstr("beyond half a turn")));
  EXPECT_THAT(silent.report().doubts, Contains(HasSubstr("'turns: z'")));
  const Trial trial("fail4_bushing_half_turn", {all, "bushings.torsion.turns=z"});
  expect_proportional(trial, "all axes");
  EXPECT_THAT(trial.report().doubts, IsEmpty());
}

// A wheel that spins past half a turn of such a bushing: no step is short enough for its energy.
TEST(BushingTurns, TheEnergyReportNamesTheBushing) {
  const Trial trial("fail4_bushing_half_turn",
                    {"bushings.torsion.stiffness=[0, 0, 0, 20, 30, 10]", "motions={}",
                     "bodies.wheel.angular_velocity=[0, 0, 400]", "integrator={step: 1e-3, end: 0.5}"});
  EXPECT_THAT(trial.report().doubts, Contains(HasSubstr("bushing 'torsion' passed half a turn, where its moment jumps")));
  EXPECT_THAT(trial.report().doubts, ::testing::Not(Contains(HasSubstr("shorter step"))));
}

// Turns are counted by every method, in the plane, and where checkpoints begin the memory of steps anew.
TEST(BushingTurns, ByEveryMethod) {
  for (const char* setting :
       {"integrator={method: radau, step: 0.005, end: 2.5}", "integrator={method: bdf, end: 2.5}",
        "integrator={method: hht, step: 0.005, end: 2.5}", "integrator.formulation=index3",
        "effects={planar: on}", "checkpoint={every: 37}"}) {
    const Trial trial("fail4_bushing_half_turn", {setting});
    expect_proportional(trial, setting);
    EXPECT_THAT(trial.report().doubts, IsEmpty()) << setting;
  }
}

// A bushing that acts on translations alone counts turns where it is asked.
TEST(BushingTurns, WithoutMoments) {
  const Trial trial("fail4_bushing_half_turn",
                    {"bushings.torsion.stiffness=[1e3, 1e3, 1e3, 0, 0, 0]", "bushings.torsion.turns=z"});
  EXPECT_NEAR(trial.last("joints/coordinate/torsion/turn"), 5.0, 1e-9);
  EXPECT_NEAR(trial.last("motions/force/turn"), 0.0, 1e-2);
}

formats::BushingSpec between_ground_and(const std::string& body) {
  formats::BushingSpec mount;
  mount.name = "mount";
  mount.a.node = "ground";
  mount.b.node = body;
  mount.a.orientation = mount.b.orientation = Eigen::Quaterniond::Identity();
  mount.free = Eigen::Matrix<double, 6, 1>::Zero();
  return mount;
}

// A top whose tilt β a bushing of k in tilt, and of nothing about the axis, holds against: V = ½ k β². It precesses
// with φ̇ at a constant tilt where I_t φ̇² sin β cos β − I_p ω₃ φ̇ sin β = k β, over 16 turns of its spin.
TEST(BushingTurns, ASpinningTopPrecesses) {
  const double It = 0.03, Ip = 0.05, k = 4.0, beta = 0.3, spin = 100.0;
  const double a = It * std::sin(beta) * std::cos(beta), b = -Ip * spin * std::sin(beta), c = -k * beta;
  const double precession = -2.0 * c / (b - std::sqrt(b * b - 4.0 * a * c));  // the slow one
  const auto error = [&](double step) {
    formats::Scene scene = test_support::empty_scene(step, 1.0);
    formats::RigidBodySpec top = test_support::rigid_body("top", 2.0, Vector3d::Zero(), {It, It, Ip});
    const Eigen::Quaterniond tilt(Eigen::AngleAxisd(beta, Vector3d::UnitX()));
    top.start.pose.orientation = tilt;
    top.start.angular_velocity =
        precession * Vector3d::UnitZ() + (spin - precession * std::cos(beta)) * (tilt * Vector3d::UnitZ());
    scene.bodies.push_back(top);
    formats::BushingSpec mount = between_ground_and("top");
    mount.stiffness.diagonal() << 100, 100, 100, k, k, 0;
    scene.bushings.push_back(mount);
    test_support::Simulation run(scene, {});
    run.start();
    run.run(1.0);
    evaluate(run.model(), run.state(), run.workspace.now);
    EXPECT_NEAR(run.workspace.now.bushings[0].deflection[5], spin + (1.0 - std::cos(beta)) * precession, 0.5) << step;
    const Vector3d axis = run.workspace.now.motion[run.model().rigid_bodies[0].node].R.col(2);
    const Vector3d expected = Eigen::AngleAxisd(precession, Vector3d::UnitZ()) * (tilt * Vector3d::UnitZ());
    return (axis - expected).norm();
  };
  const double coarse = error(1e-3), fine = error(5e-4);
  EXPECT_LT(fine, 2e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.6);
}

// A wheel wound up by several turns goes on from a stored instant with its turns.
TEST(BushingTurns, SurviveARestart) {
  const test_support::TemporaryFolder folder;
  formats::Scene scene = test_support::empty_scene(0.002, 2.0);
  scene.bodies.push_back(test_support::rigid_body("wheel", 1.0, Vector3d::Zero(), {1, 1, 1}));
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.angular_velocity = {0, 0, 20};
  scene.bushings.push_back(between_ground_and("wheel"));
  scene.bushings[0].stiffness.diagonal() << 100, 100, 100, 0, 0, 0.5;
  const BodyFiles files = read_body_files(scene);
  const RunEnd whole = simulate({scene, files, std::nullopt, folder.file("a.results.h5"), "", std::nullopt}, {});
  const RunEnd rest =
      simulate({scene, files, std::nullopt, folder.file("b.results.h5"), folder.file("a.results.h5"), 1.5}, {});
  EXPECT_NEAR(whole.state.hinges()[0], 20.0 / std::sqrt(0.5) * std::sin(2.0 * std::sqrt(0.5)), 1e-3);
  EXPECT_NEAR(rest.state.hinges()[0], whole.state.hinges()[0], 1e-4);
  EXPECT_THAT(whole.report.doubts, IsEmpty());
}

/// Body on a slide along x with 0.1 m/s and a spring between ground and it.
formats::Scene sliding(const formats::LawSpec& stiffness, const formats::LawSpec& damping) {
  formats::Scene scene = test_support::empty_scene(0.01, 1.0);
  scene.bodies.push_back(test_support::rigid_body("body", 1.0, Vector3d::Zero(), {1, 1, 1}));
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.velocity = {0.1, 0, 0};
  scene.joints.push_back(test_support::joint("slide", formats::JointKind::prismatic, "ground", "body", Vector3d::Zero(),
                                             Vector3d::UnitX()));
  formats::SpringSpec spring;
  spring.name = "s";
  spring.coordinate = formats::CoordinateRef{"slide", ""};
  spring.stiffness = stiffness;
  spring.damping = damping;
  scene.springs.push_back(spring);
  return scene;
}

std::vector<std::string> doubts_of(const formats::Scene& scene) {
  const test_support::TemporaryFolder folder;
  return simulate(scene, folder.file("a.results.h5"), {}).doubts;
}

TEST(TableRange, SpringsThatLeaveTheirTablesAreNamed) {
  const auto straight = [](double x, double y) {
    return formats::CurveSpec{formats::Interpolation::linear, {-x, x}, {-y, y}};
  };
  EXPECT_THAT(doubts_of(sliding(straight(0.1, 0.1), 0.0)), IsEmpty());
  EXPECT_THAT(doubts_of(sliding(straight(0.01, 0.01), 0.0)),
              Contains(HasSubstr("spring 's' has a deflection of 0.01098")));
  EXPECT_THAT(doubts_of(sliding(0.0, straight(0.05, 0.01))),
              Contains(HasSubstr("outside the table of its damping from -0.05 to 0.05")));
}

TEST(TableRange, DrivesThatGoOnBehindTheirTablesAreNamed) {
  formats::Scene scene = sliding(0.0, 0.0);
  scene.springs.clear();
  std::get<formats::RigidBodySpec>(scene.bodies[0]).start.velocity.reset();
  scene.motions.push_back(test_support::drive("slide", "0"));
  scene.motions[0].value = formats::TimeTable{{0.0, 0.2, 0.4}, {0.0, 0.1, 0.1}};
  EXPECT_THAT(doubts_of(scene), IsEmpty()) << "ends at rest";
  scene.motions[0].value = formats::TimeTable{{0.0, 0.2, 0.4, 0.6, 0.8}, {0.0, 0.01, 0.04, 0.09, 0.16}};
  EXPECT_THAT(doubts_of(scene),
              Contains(HasSubstr("continues with the last rate outside its table, which covers t = 0 to 0.8")));
}

// A torsional spring between axes that a ball joint lets turn over.
TEST(TableRange, AnglesAboutAxesThatTurnOverAreNamed) {
  formats::Scene scene = test_support::empty_scene(0.01, 1.0);
  scene.bodies.push_back(test_support::rigid_body("body", 1.0, Vector3d::Zero(), {1, 1, 1}));
  formats::RigidBodySpec& body = std::get<formats::RigidBodySpec>(scene.bodies[0]);
  formats::SpringSpec spring;
  spring.name = "s";
  spring.kind = formats::SpringKind::torsion;
  spring.a.node = "ground";
  spring.b.node = "body";
  spring.stiffness = 1e-3;
  scene.springs.push_back(spring);
  body.start.angular_velocity = {2.0, 0, 0};
  EXPECT_THAT(doubts_of(scene), IsEmpty());
  body.start.angular_velocity = {3.0, 0, 0};
  EXPECT_THAT(doubts_of(scene), Contains(HasSubstr("This angle is not defined if the axes have opposite directions")));
}

}  // namespace
}  // namespace tisserand::mechanism::law_range_test
