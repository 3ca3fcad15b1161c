// SPDX-License-Identifier: GPL-3.0-or-later
// What results say about force elements, against the laws of these at a known state.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "formats/scene/scene.hpp"
#include "mechanism/analyses/kinematics.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/run/output.hpp"
#include "tests/formats/yaml/text_input.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::force_output_test {
namespace {

using Eigen::Vector3d;

struct Stored {
  formats::ResultsLayout layout;
  formats::ResultsRow row;
};

/// The row of the only analysis of a scene: at the start in dynamics, after a step in inverse dynamics.
Stored at_start(const std::string& text) {
  const formats::Folder folder;
  test_support::Simulation run(formats::read_scene(folder.file("scene.yaml", text), {}), {});
  run.start();
  Workspace& workspace = run.workspace;
  if (run.scene.analysis == formats::AnalysisKind::statics) {
    const StaticsReport report = solve_statics(run.model(), run.scene.statics, {}, run.state(), workspace);
    EXPECT_EQ(report.outcome, StepOutcome::accepted) << report.explanation;
  } else if (run.scene.analysis == formats::AnalysisKind::inverse_dynamics) {
    const StepReport step = move_along(run.model(), run.scene.integrator, {0.01, 0.01}, run.state(), workspace);
    EXPECT_EQ(step.outcome, StepOutcome::accepted);
    EXPECT_TRUE(solve_multipliers(run.model(), run.state(), workspace));
  }
  Stored stored{results_layout(run.model(), run.scene), {}};
  stored.row.resize(stored.layout);
  fill_row(run.model(), run.state(), run.workspace.now, stored.row);
  return stored;
}

const std::string head = "scene: test\ngravity: [0, 0, -10]\nintegrator: {step: 0.01, end: 1}\n";

// A distance of 1.2 with free length 1 and an upper stop at 1.1; the force on b is negative where it pulls b to a.
TEST(ForceOutput, SpringsAndTheirStops) {
  const Stored stored = at_start(head + R"(
bodies: {b: {type: rigid, mass: 2, inertia: [1, 1, 1], pose: {position: [0, 0, 1.2]}, velocity: [0, 0, 0.5]}}
joints: {guide: {type: prismatic, a: ground, b: b, axis: [0, 0, 1]}}
springs:
  plain: {coordinate: guide, stiffness: 30, free: -0.1, damping: 4}
  stopped: {a: ground, b: b, stiffness: 50, free: 1, upper: 1.1, stop_stiffness: 700, stop_damping: 2, force: 3}
  turn: {type: torsion, a: ground, b: b, axis: [1, 0, 0], stiffness: 5, free: 0.2}
)");
  ASSERT_EQ(stored.layout.springs.size(), 3u);
  EXPECT_TRUE(stored.layout.springs[1].length);
  EXPECT_FALSE(stored.layout.springs[2].length);
  ASSERT_EQ(stored.layout.stops.size(), 1u);
  EXPECT_EQ(stored.layout.stops[0].name, "stopped");
  const double stop = -700.0 * 0.1 * (1.0 + 2.0 * 0.5);
  EXPECT_NEAR(stored.row.spring_force[0], -30.0 * 0.1 - 4.0 * 0.5, 1e-11);
  EXPECT_NEAR(stored.row.stop_force[0], stop, 1e-11);
  EXPECT_NEAR(stored.row.spring_force[1], -50.0 * 0.2 + 3.0 + stop, 1e-11);
  EXPECT_NEAR(stored.row.spring_force[2], 5.0 * 0.2, 1e-12);
}

// At the deflection 0 the wrench on b is K free + preload, in the axes of a: z along the world's x, x along its y.
TEST(ForceOutput, BushingsInAxesOfA) {
  const Stored stored = at_start(head + R"(
bodies: {b: {type: rigid, mass: 2, center_of_mass: [0.3, 0.1, -0.2], inertia: [1, 1, 1]}}
bushings:
  mount: {a: ground, b: {node: b, position: [0.4, 0.5, 0.6]}, axis: [1, 0, 0], x_axis: [0, 1, 0],
          stiffness: [10, 20, 30, 4, 5, 6], free: [0.1, 0.2, 0.3, 0.01, 0, 0], preload: [1, 2, 3, 0, 0.5, 0]}
)");
  EXPECT_EQ(stored.layout.bushings, std::vector<std::string>{"mount"});
  EXPECT_LT((stored.row.bushing_force.col(0) - Vector3d(1 + 1, 4 + 2, 9 + 3)).norm(), 1e-12);
  EXPECT_LT((stored.row.bushing_moment.col(0) - Vector3d(0.04, 0.5, 0)).norm(), 1e-12);
}

// A block slides along x with N = m g: the friction is μ m g against it, along z of marker a.
TEST(ForceOutput, FrictionBesideTheReaction) {
  const Stored stored = at_start(head + R"(
bodies: {block: {type: rigid, mass: 2, inertia: [1, 1, 1], velocity: [0.7, 0, 0]}}
joints: {rail: {type: prismatic, a: ground, b: block, axis: [1, 0, 0], friction: {coefficient: 0.3, velocity: 0.01}}}
)");
  EXPECT_EQ(stored.layout.frictions, std::vector<std::string>{"rail"});
  EXPECT_LT((stored.row.friction_force.col(0) - Vector3d(0, 0, -0.3 * 2 * 10)).norm(), 1e-8);
  EXPECT_LT(stored.row.friction_moment.col(0).norm(), 1e-8);
  EXPECT_NEAR(stored.row.joint_force.col(0).norm(), 20.0, 1e-8);
}

constexpr double lead = 0.5 / (2 * std::numbers::pi), m = 2, g = 10, I = 0.1;

std::string nut(const std::string& more) {
  return head + "bodies: {nut: {type: rigid, mass: 2, inertia: [0.1, 0.1, 0.1]}}\n" +
         "joints: {screw: {type: screw, a: ground, b: nut, axis: [0, 0, 1], pitch: 0.5}}\n" + more;
}

/// The thread carries the force F along the screw and turns the nut by -lead F.
void expect_thread(const Stored& stored, double F) {
  EXPECT_LT((stored.row.joint_force.col(0) - Vector3d(0, 0, F)).norm(), 1e-8 * F);
  EXPECT_LT((stored.row.joint_moment.col(0) - Vector3d(0, 0, -lead * F)).norm(), 1e-8 * lead * F);
  EXPECT_TRUE(stored.layout.couplings.empty());
}

// Held by a spring on its angle: m g, and the moment of the spring, m g lead, against it.
TEST(ForceOutput, ThreadOfAScrewInStatics) {
  const Stored stored = at_start(nut("springs: {hold: {coordinate: screw/angle, stiffness: 40}}\nanalysis: statics\n"));
  expect_thread(stored, m * g);
  EXPECT_NEAR(stored.row.spring_force[0], m * g * lead, 1e-8);
}

// Sliding down by itself: (I + m lead^2) angle'' = -m g lead, and F = m (g + lead angle'').
TEST(ForceOutput, ThreadOfAScrewInDynamics) { expect_thread(at_start(nut("")), m * g * I / (I + m * lead * lead)); }

// Driven with angle'' = 3.
TEST(ForceOutput, ThreadOfAScrewInInverseDynamics) {
  const Stored stored =
      at_start(nut("motions: {turn: {coordinate: screw/angle, value: \"1.5*t*t\"}}\nanalysis: inverse_dynamics\n"));
  const double F = m * (g + lead * 3);
  expect_thread(stored, F);
  EXPECT_NEAR(stored.row.motion_force[0], I * 3 + lead * F, 1e-8);
}

/// The stored forces of the only coupling along its first and second coordinate: `ratio` times as much on the first.
void expect_coupling(const Stored& stored, double ratio, double second) {
  ASSERT_EQ(stored.layout.couplings.size(), 1u);
  EXPECT_NEAR(stored.row.coupling_second_force[0], second, 1e-8 * std::abs(second));
  EXPECT_NEAR(stored.row.coupling_first_force[0], -ratio * second, 1e-8 * std::abs(ratio * second));
}

std::string gears(const std::string& more) {
  return head + R"(
bodies:
  one: {type: rigid, mass: 1, inertia: [1, 1, 0.3]}
  two: {type: rigid, mass: 1, inertia: [1, 1, 0.2], pose: {position: [1, 0, 0]}}
joints:
  hinge_1: {type: revolute, a: ground, b: one, axis: [0, 0, 1]}
  hinge_2: {type: revolute, a: ground, b: two, axis: [0, 0, 1]}
  pair: {type: gear, between: [hinge_1, hinge_2], ratio: -2.5}
)" + more;
}
const std::string torque = "loads: {torque: {type: moment, at: one, value: [0, 0, 6]}}\n";

// A torque of 6 turns the first by 6/(I1 + ratio^2 I2), the second `ratio` times as much, which the gear alone drives.
TEST(ForceOutput, GearsInDynamics) {
  const Stored stored = at_start(gears(torque));
  expect_coupling(stored, -2.5, 0.2 * -2.5 * 6 / (0.3 + 2.5 * 2.5 * 0.2));
  EXPECT_FALSE(stored.layout.couplings[0].first_length || stored.layout.couplings[0].second_length);
}

// A spring on the second holds the torque on the first: the gear gives -6 to this and 6/ratio to that.
TEST(ForceOutput, GearsInStatics) {
  expect_coupling(
      at_start(gears(torque + "springs: {hold: {coordinate: hinge_2, stiffness: 50}}\nanalysis: statics\n")), -2.5,
      6 / -2.5);
}

TEST(ForceOutput, GearsInInverseDynamics) {
  const Stored stored =
      at_start(gears("motions: {turn: {coordinate: hinge_1, value: \"1.5*t*t\"}}\nanalysis: inverse_dynamics\n"));
  expect_coupling(stored, -2.5, 0.2 * -2.5 * 3);
  EXPECT_NEAR(stored.row.motion_force[0], (0.3 + 2.5 * 2.5 * 0.2) * 3, 1e-8);
}

std::string rack(const std::string& more) {
  return head + R"(
bodies:
  one: {type: rigid, mass: 1, inertia: [1, 1, 0.3]}
  bar: {type: rigid, mass: 4, inertia: [1, 1, 1], pose: {position: [0, -0.1, 0]}}
joints:
  pinion: {type: revolute, a: ground, b: one, axis: [0, 0, 1]}
  slide: {type: prismatic, a: ground, b: bar, axis: [1, 0, 0]}
  pair: {type: rack_and_pinion, between: [pinion, slide], radius: 0.1}
)" + more;
}

// The force on the rack is its mass times radius times the pinion's angular acceleration 6/(I + m r^2); the moment on
// the pinion is the force times the radius.
TEST(ForceOutput, RackAndPinionInDynamics) {
  const Stored stored = at_start(rack(torque));
  expect_coupling(stored, 0.1, 4 * 0.1 * 6 / (0.3 + 4 * 0.1 * 0.1));
  EXPECT_FALSE(stored.layout.couplings[0].first_length);
  EXPECT_TRUE(stored.layout.couplings[0].second_length);
}

TEST(ForceOutput, RackAndPinionInStatics) {
  expect_coupling(at_start(rack(torque + "springs: {hold: {coordinate: slide, stiffness: 50}}\nanalysis: statics\n")),
                  0.1, 6 / 0.1);
}

TEST(ForceOutput, RackAndPinionInInverseDynamics) {
  expect_coupling(
      at_start(rack("motions: {turn: {coordinate: pinion, value: \"1.5*t*t\"}}\nanalysis: inverse_dynamics\n")), 0.1,
      4 * 0.1 * 3);
}

TEST(ForceOutput, NothingWhereThereIsNone) {
  const Stored stored = at_start(head + "bodies: {b: {type: rigid, mass: 2, inertia: [1, 1, 1]}}\n");
  EXPECT_TRUE(stored.layout.springs.empty() && stored.layout.stops.empty() && stored.layout.bushings.empty() &&
              stored.layout.frictions.empty() && stored.layout.couplings.empty());
}

}  // namespace
}  // namespace tisserand::mechanism::force_output_test
