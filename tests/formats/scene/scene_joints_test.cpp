// SPDX-License-Identifier: GPL-3.0-or-later
// Joints with keys of their own, gears, motions and springs of scene.yaml: every key, and the text of every error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/scene/scene.hpp"
#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::scene_joints_test {
namespace {

using ::testing::HasSubstr;

const std::string machine = R"(scene: machine
bodies:
  a: {type: rigid, mass: 1, inertia: [1, 1, 1]}
  b: {type: rigid, mass: 1, inertia: [1, 1, 1]}
  c: {type: rigid, mass: 1, inertia: [1, 1, 1]}
joints:
  hinge: {type: revolute, a: ground, b: a, axis: [0, 0, 1]}
  slide: {type: prismatic, a: ground, b: b, axis: [1, 0, 0], x_axis: [0, 1, 0]}
  nut: {type: screw, a: ground, b: c, axis: [0, 0, 1], pitch: -0.02}
  rod: {type: distance, a: a, b: c, length: 2}
  half: {type: generic, a: a, b: c, hold: [x, rz]}
  pair: {type: gear, between: [hinge, nut/angle], ratio: -2.5}
  rack: {type: rack_and_pinion, between: [hinge, slide], radius: 0.1}
motions:
  drive: {coordinate: hinge, value: "3*t"}
springs:
  strut: {a: ground, b: b, stiffness: 20, damping: 3, free: 0.4}
  door: {coordinate: nut/z, lower: -1, upper: 2, stop_stiffness: 1e4, stop_damping: 0.5, force: {table: [[0, 0], [1, 5]]}}
integrator: {step: 0.01, end: 1}
)";

Scene read(const std::string& text) {
  const Folder folder;
  return read_scene(folder.file("scene.yaml", text), {});
}

std::string error(const std::string& from, const std::string& to) {
  const Folder folder;
  const std::string path = folder.file("scene.yaml", replaced(machine, from, to));
  return error_of(folder, [&] { read_scene(path, {}); });
}

TEST(SceneJoints, EveryKeyIsRead) {
  const Scene scene = read(machine);
  ASSERT_EQ(scene.joints.size(), 5u);
  EXPECT_EQ(scene.joints[1].kind, JointKind::prismatic);
  EXPECT_EQ(scene.joints[1].x_axis.value(), Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(scene.joints[2].pitch, -0.02);
  EXPECT_EQ(scene.joints[3].length.value(), 2.0);
  EXPECT_EQ(scene.joints[4].hold, (std::array<bool, 6>{true, false, false, false, false, true}));
  ASSERT_EQ(scene.gears.size(), 2u);
  EXPECT_EQ(scene.gears[0].second.name, "nut/angle");
  EXPECT_EQ(scene.gears[0].ratio, -2.5);
  EXPECT_EQ(scene.gears[1].ratio, 0.1);
  ASSERT_EQ(scene.motions.size(), 1u);
  EXPECT_EQ(scene.motions[0].coordinate.name, "hinge");
  EXPECT_EQ(std::get<TimeExpression>(scene.motions[0].value).text, "3*t");
  ASSERT_EQ(scene.springs.size(), 2u);
  EXPECT_FALSE(scene.springs[0].coordinate);
  EXPECT_EQ(scene.springs[0].b.node, "b");
  EXPECT_EQ(std::get<double>(scene.springs[0].stiffness), 20.0);
  EXPECT_EQ(std::get<double>(scene.springs[0].damping), 3.0);
  EXPECT_EQ(scene.springs[0].free.value(), 0.4);
  EXPECT_EQ(scene.springs[1].coordinate->name, "nut/z");
  EXPECT_EQ(scene.springs[1].lower.value(), -1.0);
  EXPECT_EQ(scene.springs[1].upper.value(), 2.0);
  EXPECT_EQ(scene.springs[1].stop_stiffness, 1e4);
  EXPECT_EQ(scene.springs[1].stop_damping, 0.5);
  EXPECT_EQ(std::get<TimeTable>(scene.springs[1].force.value()).value[1], 5.0);
}

TEST(SceneJoints, EveryErrorIsReportedWithItsRemedy) {
  struct Case {
    std::string from, to, words;
  };
  for (const Case& c : std::vector<Case>{
           {"type: prismatic", "type: prismatc", "did you mean 'prismatic'?"},
           {"axis: [1, 0, 0], x_axis", "x_axis", "a prismatic joint needs an axis"},
           {"x_axis: [0, 1, 0]", "x_axis: [2, 0, 0]", "x_axis is zero or parallel to axis"},
           {", pitch: -0.02", "", "pitch"},
           {"pitch: -0.02", "pitch: 0", "pitch 0 must be a finite length that is not zero"},
           {"length: 2", "length: -2", "length -2 must be positive"},
           {"length: 2", "pitch: 2", "'pitch' belongs to joints of type screw"},
           {"hold: [x, rz]", "hold: []", "hold names no direction"},
           {"hold: [x, rz]", "hold: [x, rw]", "rw"},
           {"between: [hinge, nut/angle]", "between: [hinge]", "between must name two joint coordinates"},
           {"between: [hinge, nut/angle]", "between: [hnge, nut/angle]", "did you mean 'hinge'?"},
           {"ratio: -2.5", "ratio: 0", "ratio 0 must be finite and not zero"},
           {"coordinate: hinge", "coordinate: hing", "did you mean 'hinge'?"},
           {"a: ground, b: b, stiffness: 20", "coordinate: slide, b: b, stiffness: 20", "give one of them"},
           {"stiffness: 20, damping: 3", "damping: -3", "damping -3 must not be negative"},
           {"lower: -1", "lower: 3", "lower stop 3 is not below the upper one 2"},
           {"stop_stiffness: 1e4", "stop_stiffness: -1", "stop_stiffness"},
           {"stiffness: 20, damping: 3, free: 0.4", "free: 0.4", "has no effect; give stiffness"}})
    EXPECT_THAT(error(c.from, c.to), HasSubstr(c.words)) << c.from << " -> " << c.to;
}

TEST(SceneJoints, OneOrientedMarkerGivesARevoluteJointItsAxis) {
  for (const char* markers :
       {"a: {node: ground, orientation: [0, 1, 0, 0]}, b: a", "a: ground, b: {node: a, orientation: [0, 1, 0, 0]}"}) {
    const JointSpec hinge = read(replaced(machine, "a: ground, b: a, axis: [0, 0, 1]", markers)).joints[0];
    EXPECT_FALSE(hinge.axis) << markers;
    EXPECT_NE(hinge.a.orientation.has_value(), hinge.b.orientation.has_value()) << markers;
  }
}

}  // namespace
}  // namespace tisserand::formats::scene_joints_test
