// SPDX-License-Identifier: GPL-3.0-or-later
// What joints ask of the nodes that they hold, and what is said of nodes that are not where the joint is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/run/output.hpp"
#include "tests/formats/yaml/text_input.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/virtual_bodies.hpp"

namespace tisserand::mechanism::joint_nodes_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;
using test_support::fixed_joint;
using test_support::joint;
using test_support::Simulation;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

SuperelementFiles files_of(const std::string& name) {
  SuperelementFiles files;
  test_support::add_file("body", test_support::test_superelement(name), files);
  return files;
}

formats::Scene scene_with(const std::string& body) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.push_back(test_support::superelement_body(body, "body"));
  return scene;
}

formats::JointSpec holding(formats::JointSpec spec, const std::array<bool, 6>& hold) {
  spec.hold = hold;
  return spec;
}

/// Supports of three nodes with translations alone, isostatic: a ball, a line along the first edge, a plane.
void expect_weight(const formats::JointSpec& plane) {
  formats::Scene scene = scene_with("net");
  scene.analysis = formats::AnalysisKind::statics;
  scene.gravity = {0, 0, -10};
  scene.joints = {joint("ball", JointKind::spherical, "ground", "net/n0", {0, 0, 0}, {0, 0, 1}),
                  joint("line", JointKind::point_on_line, "ground", "net/n1", {1.2, 0, 0}, {1, 0, 0}), plane};
  Simulation run(scene, files_of("network"));
  run.start();
  const StaticsReport report = solve_statics(run.model(), scene.statics, {}, run.state(), run.workspace);
  ASSERT_EQ(report.outcome, StepOutcome::accepted) << report.explanation;
  const formats::ResultsLayout layout = results_layout(run.model(), scene);
  formats::ResultsRow row;
  row.resize(layout);
  fill_row(run.model(), run.state(), run.workspace.now, row);
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < 3; ++i) sum += run.model().joints[i].a.R * row.joint_force.col(i);
  EXPECT_LT((sum - Vector3d(0, 0, 4.6 * 10)).norm(), 1e-8);
  EXPECT_GT(row.joint_force.col(2).norm(), 1.0);
}

// 4.6 is the mass of the network.
TEST(JointNodes, APointOnAPlaneNeedsNoRotation) {
  expect_weight(joint("plane", JointKind::point_on_plane, "ground", "net/n2", {0, 1, 0}, {0, 0, 1}));
  expect_weight(holding(joint("plane", JointKind::generic, "ground", "net/n2", {0, 1, 0}, {0, 0, 1}),
                        {false, false, true, false, false, false}));
}

std::string error_of(const formats::Scene& scene, const std::string& file) {
  try {
    (void)build_model(scene, files_of(file));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(JointNodes, AxesAreThoseOfA) {
  formats::Scene scene = scene_with("net");
  scene.bodies.push_back(test_support::rigid_body("plate", 1.0, {0, 0, 0}, {1, 1, 1}));
  scene.joints = {joint("plane", JointKind::point_on_plane, "net/n2", "plate", {0, 1, 0}, {0, 0, 1})};
  EXPECT_THAT(error_of(scene, "network"),
              AllOf(HasSubstr("joint 'plane' takes its axes from node 'net/n2', which has no rotations"),
                    HasSubstr("exchange a and b")));
  std::swap(scene.joints[0].a, scene.joints[0].b);
  EXPECT_EQ(error_of(scene, "network"), "");
  scene.joints[0].kind = JointKind::revolute;
  EXPECT_THAT(error_of(scene, "network"),
              HasSubstr("joint 'plane' holds the rotation of node 'net/n2', which has none"));
}

formats::BushingSpec bushing_on(const std::string& a, const std::string& b) {
  formats::BushingSpec spec;
  spec.name = "mount";
  spec.a.node = a;
  spec.b.node = b;
  spec.stiffness.topLeftCorner<3, 3>() = Eigen::Vector3d(1e4, 2e4, 3e4).asDiagonal();
  return spec;
}

// 4.6 is the mass of the network; the mount sinks by force over stiffness.
TEST(JointNodes, ABushingWithoutRotationsNeedsNoneAtB) {
  formats::Scene scene = scene_with("net");
  scene.analysis = formats::AnalysisKind::statics;
  scene.gravity = {0, 0, -10};
  scene.joints = {joint("ball", JointKind::spherical, "ground", "net/n0", {0, 0, 0}, {0, 0, 1}),
                  joint("line", JointKind::point_on_line, "ground", "net/n1", {1.2, 0, 0}, {1, 0, 0})};
  scene.bushings = {bushing_on("ground", "net/n2")};
  Simulation run(scene, files_of("network"));
  run.start();
  const StaticsReport report = solve_statics(run.model(), scene.statics, {}, run.state(), run.workspace);
  ASSERT_EQ(report.outcome, StepOutcome::accepted) << report.explanation;
  formats::ResultsRow row;
  row.resize(results_layout(run.model(), scene));
  fill_row(run.model(), run.state(), run.workspace.now, row);
  Vector3d sum = row.bushing_force.col(0);
  for (int i = 0; i < 2; ++i) sum += run.model().joints[i].a.R * row.joint_force.col(i);
  EXPECT_LT((sum - Vector3d(0, 0, 4.6 * 10)).norm(), 1e-8);
  const Bushing& mount = run.model().bushings[0];
  const Vector3d sunk = (run.workspace.now.bushings[0].deflection - mount.free).head<3>();
  EXPECT_LT((mount.stiffness.topLeftCorner<3, 3>() * sunk + row.bushing_force.col(0)).norm(), 1e-8);
  EXPECT_LT(sunk.z(), -1e-4);
}

TEST(JointNodes, BushingsSayWhichRotationsTheyMiss) {
  formats::Scene scene = scene_with("net");
  scene.bodies.push_back(test_support::rigid_body("plate", 1.0, {0, 0, 0}, {1, 1, 1}));
  scene.bushings = {bushing_on("plate", "net/n2")};
  EXPECT_EQ(error_of(scene, "network"), "");
  scene.bushings[0].damping(4, 4) = 1.0;
  EXPECT_THAT(error_of(scene, "network"),
              HasSubstr("bushing 'mount' holds the rotation of node 'net/n2', which has none"));
  scene.bushings = {bushing_on("net/n2", "plate")};
  EXPECT_THAT(error_of(scene, "network"),
              AllOf(HasSubstr("bushing 'mount' takes its axes from node 'net/n2'"), HasSubstr("exchange a and b")));
}

// Node n2 of this body has rotations alone.
TEST(JointNodes, HeldTurnsNeedNoTranslation) {
  formats::Scene scene = scene_with("frame");
  scene.joints = {joint("turn", JointKind::constant_orientation, "ground", "frame/n2", {0, 0, 0}, {0, 0, 1})};
  ASSERT_EQ(error_of(scene, "mixed"), "");
  Simulation run(scene, files_of("mixed"));
  run.start();
  EXPECT_TRUE(run.model().coordinates.empty());
  EXPECT_EQ(run.model().joints[0].size(), 3);
  scene.joints[0].kind = JointKind::spherical;
  EXPECT_THAT(error_of(scene, "mixed"), HasSubstr("holds the position of node 'frame/n2', which has no translations"));
}

/// A block with a hook at its corner, and a beam from the origin to (2, 0, 0).
formats::Scene block_and_beam(const formats::JointSpec& spec) {
  formats::Scene scene = scene_with("beam");
  formats::RigidBodySpec block = test_support::rigid_body("block", 1.0, {0, 0, 0}, {1, 1, 1});
  block.start.pose.position = {2.3, 0.4, 0};
  block.nodes = {{"hook", {{-0.3, -0.4, 0}, Eigen::Quaterniond::Identity()}}};
  scene.bodies.push_back(block);
  scene.joints = {spec};
  return scene;
}

std::vector<std::string> notes_of(const formats::JointSpec& spec) {
  formats::Scene scene = block_and_beam(spec);
  std::get<formats::SuperelementBodySpec>(scene.bodies.front()).second_order = false;  // it has no companion file
  return build_model(scene, files_of("beam")).notes;
}

formats::JointSpec at(const Vector3d& position, formats::JointSpec spec) {
  spec.position = position;
  return spec;
}

// The tip of the beam is at (2, 0, 0), the block's frame 0.5 from it, its hook there.
TEST(RigidArms, AreNotedWithTheirLength) {
  const Vector3d tip = files_of("beam").at("body").superelement.node_position.row(1);
  ASSERT_EQ(tip, Vector3d(2, 0, 0));
  EXPECT_THAT(notes_of(fixed_joint("weld", "beam/tip", "block")),
              ElementsAre("rigid arms connect joints with the nodes that they name: 'weld' 0.5 m from "
                          "'beam/tip'"));
  EXPECT_THAT(notes_of(fixed_joint("weld", "beam/tip", "block/hook")), IsEmpty());
  // Told where it is: the block's frame may be elsewhere, the node of the beam is expected there.
  EXPECT_THAT(notes_of(at(tip, fixed_joint("weld", "beam/tip", "block"))), IsEmpty());
  EXPECT_THAT(notes_of(at(tip + Vector3d(0, 0, 1e-3), fixed_joint("weld", "beam/tip", "block"))),
              ElementsAre(HasSubstr("'weld' 0.001 m from 'beam/tip'")));
  EXPECT_THAT(notes_of(at(tip * (1.0 + 1e-8), fixed_joint("weld", "beam/tip", "block/hook"))), IsEmpty());
}

TEST(RigidArms, AreThoseThatTheJointHolds) {
  const auto from_base = [](JointKind kind, const Vector3d& axis) {
    formats::JointSpec spec = joint("j", kind, "beam/base", "block/hook", {0, 0, 0}, axis);
    spec.position.reset();
    return notes_of(spec);
  };
  EXPECT_THAT(from_base(JointKind::spherical, {1, 0, 0}), ElementsAre(HasSubstr("'j' 2 m from 'beam/base'")));
  EXPECT_THAT(from_base(JointKind::cylindrical, {1, 0, 0}), IsEmpty());
  EXPECT_THAT(from_base(JointKind::cylindrical, {0, 1, 0}), ElementsAre(HasSubstr("'j' 2 m from 'beam/base'")));
  EXPECT_THAT(from_base(JointKind::constant_orientation, {1, 0, 0}), IsEmpty());
  EXPECT_THAT(from_base(JointKind::distance, {1, 0, 0}), IsEmpty());
}

// Twelve virtual bodies, 1 m to 12 m from the ties that eliminate them: the ten longest and a count.
TEST(RigidArms, OfManyJointsTheLongestAreNamed) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.push_back(test_support::rigid_body("block", 1.0, {0, 0, 0}, {1, 1, 1}));
  for (int i = 1; i <= 12; ++i) {
    const std::string name = "hub_" + std::to_string(i);
    scene.bodies.push_back(test_support::virtual_body(name, {static_cast<double>(i), 0, 0}));
    scene.joints.push_back(fixed_joint("tie_" + std::to_string(i), "block", name));
  }
  const BuiltModel built = build_model(scene, {});
  ASSERT_EQ(built.notes.size(), 1u);
  EXPECT_THAT(built.notes[0], AllOf(HasSubstr("'tie_12' 12 m from 'block', 'tie_11'"), HasSubstr("'tie_3'"),
                                    HasSubstr(" and 2 more"), Not(HasSubstr("'tie_2'"))));
}

// 0.0833 + 0.0833 < 0.1667, by 6e-4 of it: four typed digits of a flat square of 1 m and 1 kg.
TEST(FlatBodies, TypedWithFourDigitsAreAcceptedWithANote) {
  const auto notes = [](const std::string& inertia) {
    const formats::Folder folder;
    const std::string text =
        "scene: flat\nintegrator: {step: 0.01, end: 1}\nbodies: {plate: {type: rigid, mass: 1, inertia: ";
    return build_model(formats::read_scene(folder.file("scene.yaml", text + inertia + "}}\n"), {}), {}).notes;
  };
  EXPECT_THAT(notes("[0.0833, 0.0833, 0.1667]"),
              ElementsAre(AllOf(
                  HasSubstr("body 'plate': the largest of the principal moments of inertia 0.0833, 0.0833, 0.1667"),
                  HasSubstr("by 0.0006 of its value"))));
  EXPECT_THAT(notes("[1, 1, 2]"), IsEmpty());
  EXPECT_THROW(notes("[0.0833, 0.0833, 0.1669]"), Error);  // by 1.8e-3
}

}  // namespace
}  // namespace tisserand::mechanism::joint_nodes_test
