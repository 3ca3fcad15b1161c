// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of read_scene and check(Scene): defaults, every notation, and the text of every error.
#include "formats/scene/scene.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::scene_test {
namespace {

using ::testing::HasSubstr;

const std::string swing = R"(scene: swing
gravity: [0, 0, -9.81]
materials: {steel: {E: 2.1e11, nu: 0.3, density: 7800}}
sections: {bar: {shape: circle, radius: 0.01}}
bodies:
  beam: {type: superelement, file: parts/beam.superelement.h5, frame: paper}
  rod: {type: beam, from: [0, 0, 0], to: [1, 0, 0], elements: 2, section: bar, material: steel}
  block: {type: rigid, mass: 3, inertia: [1, 2, 2.5], nodes: {hook: {position: [1, 0, 0]}}}
joints:
  hinge: {type: revolute, a: ground, b: beam/base, axis: [0, 0, 1]}
  ball: {type: spherical, a: rod/end, b: block/hook}
loads:
  torque: {type: moment, at: beam/base, value: [0, 1, {table: [[0, 0], [0.2, 200]]}]}
integrator: {step: 0.01, end: 20}
)";

Scene read(const std::string& text, const std::vector<std::string>& changes = {}) {
  const Folder folder;
  return read_scene(folder.file("scene.yaml", text), overrides(changes));
}

std::string error(const std::string& text) {
  const Folder folder;
  const std::string path = folder.file("scene.yaml", text);
  return error_of(folder, [&] { read_scene(path, {}); });
}

TEST(Scene, ReadsEveryValueAndSetsDefaults) {
  const Folder folder;
  const Scene scene = read_scene(folder.file("scene.yaml", swing), {});
  EXPECT_EQ(scene.name, "swing");
  EXPECT_EQ(scene.units.length.label, "m");
  EXPECT_EQ(scene.gravity, Eigen::Vector3d(0, 0, -9.81));
  ASSERT_EQ(scene.bodies.size(), 3u);
  const auto& beam = std::get<SuperelementBodySpec>(scene.bodies[0]);
  EXPECT_EQ(beam.file, folder.path() + "/parts/beam.superelement.h5");
  EXPECT_FALSE(beam.rigid || beam.modes || beam.cutoff);
  EXPECT_FALSE(beam.inertia || beam.stiffening || beam.second_order);
  EXPECT_EQ(beam.frame, FrameKind::paper);
  EXPECT_EQ(beam.start.pose.orientation.coeffs(), Eigen::Quaterniond::Identity().coeffs());
  EXPECT_THAT(beam.where, HasSubstr("scene.yaml:6:3"));
  const auto& rod = std::get<BeamBodySpec>(scene.bodies[1]);
  EXPECT_EQ(rod.to, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(rod.elements, 2);
  EXPECT_EQ(rod.nodes_per_element, 2);
  EXPECT_DOUBLE_EQ(rod.section.area, M_PI * 1e-4);
  EXPECT_EQ(rod.material.youngs_modulus, 2.1e11);
  EXPECT_FALSE(rod.through || rod.orientation);
  const auto& block = std::get<RigidBodySpec>(scene.bodies[2]);
  EXPECT_EQ(block.mass, 3.0);
  EXPECT_EQ(block.inertia(2, 2), 2.5);
  EXPECT_EQ(block.nodes.at(0).name, "hook");
  EXPECT_EQ(block.nodes[0].pose.position.x(), 1.0);
  EXPECT_EQ(scene.joints.at(0).kind, JointKind::revolute);
  EXPECT_EQ(scene.joints[0].a.node, "ground");
  EXPECT_EQ(scene.joints[0].b.node, "beam/base");
  EXPECT_THAT(scene.joints[0].b.where, HasSubstr("scene.yaml:10:41"));
  EXPECT_EQ(scene.joints[0].axis.value(), Eigen::Vector3d::UnitZ());
  EXPECT_FALSE(scene.joints[1].axis || scene.joints[1].position || scene.joints[1].a.position);
  const LoadSpec& torque = scene.loads.at(0);
  EXPECT_EQ(torque.kind, LoadKind::moment);
  EXPECT_EQ(torque.axes, LoadAxes::world);
  EXPECT_EQ(std::get<double>(torque.components[1]), 1.0);
  EXPECT_EQ(std::get<TimeTable>(torque.components[2]).time, (std::vector<double>{0, 0.2}));
  EXPECT_EQ(std::get<TimeTable>(torque.components[2]).value, (std::vector<double>{0, 200}));
  EXPECT_EQ(scene.analysis, AnalysisKind::dynamics);
  const IntegratorSpec expected;
  EXPECT_EQ(scene.integrator.step, 0.01);
  EXPECT_EQ(scene.integrator.end, 20.0);
  EXPECT_EQ(scene.integrator.rho, expected.rho);
  EXPECT_EQ(scene.integrator.method, Method::generalised_alpha);
  EXPECT_EQ(scene.integrator.formulation, Formulation::stabilised_index2);
  EXPECT_EQ(scene.integrator.linear_solver, LinearSolver::automatic);
  EXPECT_EQ(scene.output.every, 1);
  EXPECT_TRUE(scene.output.channels.empty());
  EXPECT_EQ(scene.initial_tolerance, 1e-6);
}

TEST(Scene, EverySetting) {
  const Scene scene = read(replaced(
      swing, "integrator: {step: 0.01, end: 20}",
      "units: consistent\nanalysis: dynamics\n"
      "integrator: {method: hht, alpha: 0.1, formulation: index3, step: 0.5, start: -1, end: 1, tolerance: 1e-7,\n"
      "  constraint_tolerance: 1e-9, max_iterations: 7, max_halvings: 3, linear_solver: dense}\n"
      "statics: {load_steps: 4, tolerance: 1e-8, max_iterations: 11}\n"
      "output: {interval: 0.1, channels: [nodes/position, energy], from: 0.5}\n"
      "initial_tolerance: 1e-4"));
  EXPECT_FALSE(scene.units.named());
  EXPECT_EQ(scene.integrator.method, Method::hht);
  EXPECT_EQ(scene.integrator.alpha, 0.1);
  EXPECT_EQ(scene.integrator.formulation, Formulation::index3);
  EXPECT_EQ(scene.integrator.start, -1.0);
  EXPECT_EQ(scene.integrator.tolerance, 1e-7);
  EXPECT_EQ(scene.integrator.constraint_tolerance, 1e-9);
  EXPECT_EQ(scene.integrator.max_iterations, 7);
  EXPECT_EQ(scene.integrator.max_halvings, 3);
  EXPECT_EQ(scene.integrator.linear_solver, LinearSolver::dense);
  EXPECT_EQ(scene.statics.load_steps, 4);
  EXPECT_EQ(scene.statics.tolerance, 1e-8);
  EXPECT_EQ(scene.statics.max_iterations, 11);
  EXPECT_EQ(scene.output.interval, 0.1);
  EXPECT_EQ(scene.output.from, 0.5);
  EXPECT_EQ(scene.output.channels, (std::vector<std::string>{"nodes/position", "energy"}));
  EXPECT_EQ(scene.initial_tolerance, 1e-4);
  EXPECT_EQ(read(replaced(swing, "integrator: {step: 0.01, end: 20}", "analysis: statics")).analysis,
            AnalysisKind::statics);
}

TEST(Scene, StoresFromTheStartByDefault) {
  EXPECT_EQ(read(replaced(swing, "end: 20", "end: 20, start: -1")).output.from, -1.0);
  EXPECT_EQ(read(replaced(swing, "end: 20}", "end: 20, start: 2}\noutput: {every: 3}")).output.from, 2.0);
  EXPECT_EQ(read(replaced(swing, "end: 20}", "end: 20}\noutput: {from: 20}")).output.from, 20.0);  // the last instant
}

TEST(Scene, SuperelementInAllItsNotations) {
  const auto beam = [](const std::string& keys) {
    return std::get<SuperelementBodySpec>(read(replaced(swing, "frame: paper", keys)).bodies[0]);
  };
  EXPECT_EQ(beam("use: rigid").rigid, true);
  EXPECT_EQ(beam("use: flexible, modes: 0").modes, 0);
  EXPECT_EQ(beam("cutoff: 500").cutoff, 500.0);
  EXPECT_EQ(beam("inertia: A").inertia, InertiaOption::A);
  EXPECT_EQ(beam("frame: karcher").frame, FrameKind::karcher);
  for (const char* frame : {"frame: {node: base}", "frame: \"node: base\"", "frame: node:base"}) {
    EXPECT_EQ(beam(frame).frame, FrameKind::node) << frame;
    EXPECT_EQ(beam(frame).frame_node, "base") << frame;
  }
  const auto weighted = beam("weights: {positions: {base: 0.25, tip: 0.75}, rotations: {tip: 1}}");
  EXPECT_EQ(weighted.position_weights.at(1).node, "tip");
  EXPECT_EQ(weighted.position_weights[1].weight, 0.75);
  EXPECT_EQ(weighted.rotation_weights.size(), 1u);
  const auto damped = beam("damping: {mass: 1, stiffness: 2, ratio: 0.01, ratios: [0.02, 0.03]}");
  EXPECT_EQ(damped.damping.mass, 1.0);
  EXPECT_EQ(damped.damping.stiffness, 2.0);
  EXPECT_EQ(damped.damping.ratio, 0.01);
  EXPECT_EQ(damped.damping.ratios, (std::vector<double>{0.02, 0.03}));
  const auto moving = beam("pose: {position: [1, 2, 3]}, velocity: [4, 5, 6], angular_velocity: [7, 8, 9]").start;
  EXPECT_EQ(moving.pose.position, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(moving.velocity, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(moving.angular_velocity, Eigen::Vector3d(7, 8, 9));
}

TEST(Scene, RigidBodyFromASuperelement) {
  const Scene scene = read(replaced(swing, "{type: superelement, file: parts/beam.superelement.h5, frame: paper}",
                                    "{type: rigid, from: beam.superelement.h5, pose: {position: [1, 0, 0]}}"));
  const auto& body = std::get<SuperelementBodySpec>(scene.bodies[0]);
  EXPECT_TRUE(body.rigid);
  EXPECT_THAT(body.file, HasSubstr("/beam.superelement.h5"));
  EXPECT_EQ(body.start.pose.position.x(), 1.0);
}

TEST(Scene, BeamWithItsOwnSectionAndMaterial) {
  const Scene scene = read(replaced(
      swing, "section: bar, material: steel",
      "section: {A: 1, Iy: 2, Iz: 3, J: 4, shear_area_y: 5, shear_area_z: 6}, material: {E: 7, nu: 0.25, density: 8},\n"
      "    through: [0.5, 0.1, 0], orientation: [0, 0, 1], nodes_per_element: 3"));
  const auto& rod = std::get<BeamBodySpec>(scene.bodies[1]);
  EXPECT_EQ(rod.section.second_moment_z, 3.0);
  EXPECT_EQ(rod.section.polar_moment, 5.0);
  EXPECT_EQ(rod.material.density, 8.0);
  EXPECT_EQ(rod.through.value().y(), 0.1);
  EXPECT_EQ(rod.orientation.value(), Eigen::Vector3d::UnitZ());
  EXPECT_EQ(rod.nodes_per_element, 3);
}

TEST(Scene, MarkersWithOffsets) {
  const Scene scene = read(replaced(swing, "a: ground, b: beam/base, axis: [0, 0, 1]",
                                    "a: {node: ground, position: [1, 0, 0], orientation: [1, 0, 0, 0]}, b: {node: "
                                    "beam/base, orientation: [0, 1, 0, 0]}, position: [0, 0, 2]"));
  const JointSpec& hinge = scene.joints[0];
  EXPECT_EQ(hinge.a.position.value().x(), 1.0);
  EXPECT_EQ(hinge.b.orientation.value().x(), 1.0);
  EXPECT_FALSE(hinge.b.position);
  EXPECT_EQ(hinge.position.value().z(), 2.0);
}

TEST(Scene, LoadsAsFunctionsOfTime) {
  const Folder folder;
  folder.file("drive.csv", "# measured\ntime, moment\n0, 1\n0.5; -2e1\n+1 3\r\n\n");
  const std::string text =
      replaced(swing, "type: moment, at: beam/base, value: [0, 1, {table: [[0, 0], [0.2, 200]]}]",
               "type: force, at: {node: beam/base, position: [0, 1, 0]}, axes: body,\n"
               "    value: [200 * sin(t), {expression: \"t < 1 ? 5 : 0\", breakpoints: [1, 2]}, {file: drive.csv}]");
  const LoadSpec load = read_scene(folder.file("scene.yaml", text), {}).loads.at(0);
  EXPECT_EQ(load.kind, LoadKind::force);
  EXPECT_EQ(load.axes, LoadAxes::body);
  EXPECT_EQ(load.at.position.value().y(), 1.0);
  EXPECT_EQ(std::get<TimeExpression>(load.components[0]).text, "200 * sin(t)");
  EXPECT_THAT(std::get<TimeExpression>(load.components[0]).where, HasSubstr("scene.yaml:14:13"));
  EXPECT_EQ(std::get<TimeExpression>(load.components[1]).breakpoints, (std::vector<double>{1, 2}));
  EXPECT_EQ(std::get<TimeTable>(load.components[2]).time, (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(std::get<TimeTable>(load.components[2]).value, (std::vector<double>{1, -20, 3}));
}

Eigen::Quaterniond orientation(const std::string& text) {
  const Scene scene = read(replaced(swing, "frame: paper", "pose: {orientation: " + text + "}"));
  return std::get<SuperelementBodySpec>(scene.bodies[0]).start.pose.orientation;
}

/// All forms of a turn by 30 degrees about z must give cos 15° + k sin 15°; the digits of the matrix limit it to 1e-9.
TEST(Scene, OrientationInAllItsForms) {
  const Eigen::Quaterniond expected(std::cos(M_PI / 12), 0, 0, std::sin(M_PI / 12));
  for (const char* text : {"[0.96592582628906829, 0, 0, 0.25881904510252076]", "{axis: [0, 0, 2], angle_deg: 30}",
                           "{axis: [0, 0, -1], angle_deg: 330}", "{axis: [0, 0, 1e-200], angle_deg: 3990}",
                           "[[0.8660254038, -0.5, 0], [0.5, 0.8660254038, 0], [0, 0, 1]]",
                           "{x: [1.7320508075688772, 1, 0], y: [0, 1, 0]}",  // y loses its part along x
                           "{y: [-1, 1.7320508075688772, 0], z: [-1, 1.7320508075688772, 3]}",
                           "{x: [1.7320508075688772, 1, 0], z: [1.7320508075688772, 1, 2]}"}) {
    EXPECT_NEAR(orientation(text).angularDistance(expected), 0.0, 1e-9) << text;
    EXPECT_NEAR(orientation(text).norm(), 1.0, 1e-15) << text;
  }
}

class BadScene : public ::testing::TestWithParam<BadText> {};

TEST_P(BadScene, SaysWhatAndWhere) {
  const Marked text = take_mark(replaced(swing, GetParam().from, GetParam().to), "scene.yaml");
  EXPECT_EQ(error(text.text), replaced_all(GetParam().expected, "^", text.place));
}

INSTANTIATE_TEST_SUITE_P(
    Orientation, BadScene,
    ::testing::Values(
        BadText{"frame: paper", "pose: {orientation: ^[0, 0, 0, 0]}",
                "^: body 'beam': orientation is the zero quaternion, which is no rotation; give a unit "
                "quaternion [w, x, y, z]"},
        BadText{"frame: paper", "pose: {orientation: ^[1, 1, 0, 0]}",
                "^: body 'beam': orientation is a quaternion of length 1.41421356, not 1; give a unit "
                "quaternion [w, x, y, z]"},
        BadText{"frame: paper", "pose: {orientation: ^[1, 1, 0]}",
                "^: body 'beam': orientation has 3 numbers; give a quaternion [w, x, y, z], three rows of "
                "a matrix, {axis: [..], angle_deg: ..} or {x: [..], y: [..]}"},
        BadText{"frame: paper", "pose: {orientation: ^[[1, 0, 0], [0, 2, 0], [0, 0, 1]]}",
                "^: body 'beam': orientation is not a rotation matrix R: RᵀR differs from the identity by 3; give "
                "orthonormal columns, or two axes {x: [..], y: [..]}"},
        BadText{"frame: paper", "pose: {orientation: ^[[1, 0, 0], [0, -1, 0], [0, 0, 1]]}",
                "^: body 'beam': orientation is a reflection: its determinant is -1; change the sign of one column"},
        BadText{"frame: paper", "pose: {orientation: {axis: ^[0, 0, 0], angle_deg: 3}}",
                "^: body 'beam': orientation: axis has zero length; give a direction"},
        BadText{"frame: paper", "pose: {^orientation: {axis: [0, 0, 1]}}",
                "^: body 'beam': orientation: missing key 'angle_deg'"},
        BadText{"frame: paper", "pose: {^orientation: {x: [0, 0, 1]}}",
                "^: body 'beam': orientation: 1 of the axes x, y, z are given; give two of them"},
        BadText{"frame: paper", "pose: {^orientation: {x: [0, 0, 1], y: [0, 0, 2]}}",
                "^: body 'beam': orientation: the two axes are parallel; give two directions that are not parallel"},
        BadText{"frame: paper", "pose: {^orientation: {x: [0, 0, 1], axis: [0, 0, 2], angle_deg: 2}}",
                "^: body 'beam': orientation: 'axis' or 'angle_deg' is given together with 'x', 'y' or 'z'; give axis "
                "and angle_deg, or two of x, y and z"},
        BadText{"frame: paper", "pose: {orientation: {axis: [0, 0, 1], ^angle: 3, angle_deg: 2}}",
                "^: body 'beam': orientation: unknown key 'angle'; use one of axis, angle_deg, x, y, z"}));

INSTANTIATE_TEST_SUITE_P(
    Bodies, BadScene,
    ::testing::Values(
        BadText{"type: superelement", "type: ^superelment",
                "^: body 'beam': unknown type 'superelment'; did you mean 'superelement'?"},
        BadText{"  beam: {type: superelement, ", "  ^beam: {",
                "^: body 'beam': missing key 'type'; give type: superelement, rigid, beam, virtual or modal"},
        BadText{"{type: superelement, file: parts/beam.superelement.h5, frame: paper}", "^3",
                "scene.yaml:6:3: body 'beam': must be a map, not '3'; give type: superelement, rigid, beam, virtual or "
                "modal"},
        BadText{"frame: paper", "^farme: paper", "^: body 'beam': unknown key 'farme'; did you mean 'frame'?"},
        BadText{"frame: paper", "frame: ^kracher", "^: body 'beam': unknown frame 'kracher'; did you mean 'karcher'?"},
        BadText{"frame: paper", "frame: ^{node: \"\"}", "^: body 'beam': frame has no node; write frame: {node: name}"},
        BadText{"frame: paper", "modes: ^-1",
                "^: body 'beam': modes -1 must not be negative; write modes: 0 to use no modes"},
        BadText{"frame: paper", "cutoff: ^0", "^: body 'beam': cutoff 0 must be positive"},
        BadText{"frame: paper", "modes: 3, ^cutoff: 10",
                "^: body 'beam': both 'modes' and 'cutoff' are given; give one of them"},
        BadText{"frame: paper", "weights: {positions: ^{base: 0.5, tip: 0.6}}",
                "^: body 'beam': weights.positions have the sum 1.1; their sum must be 1"},
        BadText{"frame: paper", "use: rigid, ^modes: 0",
                "^: body 'beam': 'modes' has no effect with use: rigid; remove it, or give use: flexible"},
        BadText{"frame: paper", "use: rigid, ^cutoff: 10",
                "^: body 'beam': 'cutoff' has no effect with use: rigid; remove it, or give use: flexible"},
        BadText{"frame: paper", "use: rigid, ^inertia: B",
                "^: body 'beam': 'inertia' has no effect with use: rigid; remove it, or give use: flexible"},
        BadText{"frame: paper", "use: rigid, ^frame: karcher",
                "^: body 'beam': 'frame' has no effect with use: rigid; remove it, or give use: flexible"},
        BadText{"frame: paper", "use: rigid, ^weights: {}",
                "^: body 'beam': 'weights' has no effect with use: rigid; remove it, or give use: flexible"},
        BadText{"frame: paper", "use: rigid, ^damping: {ratio: 0}",
                "^: body 'beam': 'damping' has no effect with use: rigid; remove it, or give use: flexible"},
        BadText{"frame: paper", "frame: {node: base}, weights: ^{rotations: {tip: 1}}",
                "^: body 'beam': weights have no effect on a frame that is attached to node 'base'; remove them, or "
                "give frame: karcher or paper"},
        BadText{"frame: paper", "damping: {ratio: ^-0.01}",
                "^: body 'beam': damping: ratio -0.01 must not be negative"},
        BadText{"frame: paper", "damping: {^rato: 0.01}",
                "^: body 'beam': damping: unknown key 'rato'; did you mean 'ratio'?"},
        BadText{"frame: paper", "velocity: ^[1, 2]",
                "^: body 'beam': velocity has 2 numbers instead of 3; write it as [x, y, z]"},
        BadText{"mass: 3", "mass: ^0", "^: body 'block': mass 0 must be positive"},
        BadText{"mass: 3", "mass: ^-3", "^: body 'block': mass -3 must be positive"},
        BadText{
            "inertia: [1, 2, 2.5]", "inertia: ^[1, 2, 3.01]",
            "^: body 'block': the largest of the principal moments of inertia 1, 2, 3.01 exceeds the sum of the other "
            "two, which is impossible for a body; check values, order and units"},
        BadText{"block: {type: rigid, mass: 3, inertia: [1, 2, 2.5],", "^block: {type: rigid, mass: 3,",
                "^: body 'block': missing key 'inertia'"},
        BadText{"hook: {position: [1, 0, 0]}", "hook: {^positon: [1, 0, 0]}",
                "^: body 'block': node 'hook': unknown key 'positon'; did you mean 'position'?"},
        BadText{"to: [1, 0, 0]", "to: [0, 0, 0]",
                "scene.yaml:7:3: body 'rod': has zero length: both ends are at (0, 0, 0); move one end"},
        BadText{"elements: 2,", "elements: ^2.5,", "^: body 'rod': elements must be a whole number, not '2.5'"},
        BadText{"elements: 2,", "elements: ^2000000000,",
                "^: body 'rod': elements 2000000000 must lie between 1 and 100000"},
        BadText{"elements: 2,", "elements: ^0,", "^: body 'rod': elements 0 must lie between 1 and 100000"},
        BadText{"elements: 2,", "elements: 2, nodes_per_element: ^4,",
                "^: body 'rod': nodes_per_element 4 must be 2 or 3"},
        BadText{
            "elements: 2,", "elements: 2, orientation: ^[1, 0, 0],",
            "^: body 'rod': orientation (1, 0, 0) is parallel to the beam; give the direction of the local y axis, not "
            "parallel to the beam"},
        BadText{"elements: 2,", "elements: 2, through: ^[0.5, 0, 0],",
                "^: body 'rod': the point (0.5, 0, 0) of the arc lies on the line through its ends; move it off the "
                "line, or remove 'through' for a straight beam"},
        BadText{"section: bar", "section: ^ber", "^: body 'rod': unknown section 'ber'; did you mean 'bar'?"},
        BadText{"material: steel", "material: ^steal",
                "^: body 'rod': unknown material 'steal'; did you mean 'steel'?"},
        BadText{"section: bar", "section: {A: ^-1, Iy: 1, Iz: 1, J: 1, shear_area_y: 1, shear_area_z: 1}",
                "^: body 'rod': section: A -1 must be positive"},
        BadText{
            "section: bar", "section: ^{A: 1, Iy: 1, Iz: 1, J: 1}",
            "^: body 'rod': its section has no shear areas, which this beam needs; give shear_area_y and shear_area_z"},
        BadText{"nu: 0.3", "nu: ^0.7", "^: material 'steel': nu 0.7 must lie between -1 and 0.5"},
        BadText{"rod: {", "^ground: {",
                "^: body 'ground': the name is reserved for the fixed world; rename it\n"
                "scene.yaml:11:30: joint 'ball': there is no body 'rod'; use one of beam, ground, block, ground"}));

INSTANTIATE_TEST_SUITE_P(
    JointsAndLoads, BadScene,
    ::testing::Values(
        BadText{"b: beam/base", "b: ^bem/base", "^: joint 'hinge': there is no body 'bem'; did you mean 'beam'?"},
        BadText{"a: ground", "a: ^grund", "^: joint 'hinge': there is no body 'grund'; did you mean 'ground'?"},
        BadText{"a: rod/end", "a: ^rod/ende",
                "^: joint 'ball': body 'rod': there is no node 'ende'; did you mean 'end'? its nodes are 0 to 2, start "
                "and end"},
        BadText{"a: rod/end", "a: ^rod/3",
                "^: joint 'ball': body 'rod': there is no node '3'; its nodes are 0 to 2, start and end"},
        BadText{"a: rod/end", "a: ^rod",
                "^: joint 'ball': body 'rod' is flexible; 'rod' names no node; write rod/<node>, for example rod/end"},
        BadText{"b: block/hook", "b: ^block/hok",
                "^: joint 'ball': body 'block': there is no node 'hok'; did you mean 'hook'?"},
        BadText{"b: block/hook", "b: ^rod/end", "^: joint 'ball': joins 'rod/end' to itself; name two different nodes"},
        BadText{"axis: [0, 0, 1]", "axis: ^[0, 0, 0]",
                "^: joint 'hinge': axis has zero length; give a direction, for example [0, 0, 1]"},
        BadText{"hinge: {type: revolute, a: ground, b: beam/base, axis: [0, 0, 1]}",
                "^hinge: {type: revolute, a: ground, b: beam/base}",
                "^: joint 'hinge': a revolute joint needs an axis; give axis: [x, y, z], or an orientation to a or b"},
        BadText{"a: ground, b: beam/base, axis: [0, 0, 1]",
                "a: {node: ground, orientation: [1, 0, 0, 0]}, b: {node: beam/base, orientation: [1, 0, 0, 0]}, axis: "
                "^[0, 0, 1]",
                "^: joint 'hinge': axis has no effect, since both a and b have an orientation; remove it, or the "
                "orientation of a or b"},
        BadText{
            "a: rod/end, b: block/hook",
            "a: {node: rod/end, position: [0, 0, 0]}, b: {node: block/hook, position: [0, 0, 0]}, position: ^[2, 0, 0]",
            "^: joint 'ball': position has no effect, since both a and b have one; remove it, or the position of a or "
            "b"},
        BadText{"type: revolute", "type: ^revolut",
                "^: joint 'hinge': unknown type 'revolut'; did you mean 'revolute'?"},
        BadText{"a: ground", "a: {node: ground, ^postion: [1, 0, 0]}",
                "^: joint 'hinge': a: unknown key 'postion'; did you mean 'position'?"},
        BadText{"torque: {type: moment, at: beam/base", "torque: {type: moment, at: ^ground",
                "^: load 'torque': acts on the ground; name a node of a body"},
        BadText{"torque: {type: moment, at: beam/base", "torque: {type: moment, at: ^beam",
                "^: load 'torque': body 'beam' is flexible; 'beam' names no node; write beam/<node>"},
        BadText{"[0, 1, {", "[0, ^\"\", {",
                "^: load 'torque': value[1] is an empty expression; write an expression in t, or 0"},
        BadText{
            "{table: [[0, 0], [0.2, 200]]}", "^{table: [[0, 0], [0.2, 200], [0.2, 300]]}",
            "^: load 'torque': times of the table must increase, but 0.2 follows 0.2; for a jump, use two close times"},
        BadText{"{table: [[0, 0], [0.2, 200]]}", "^{expression: t, breakpoints: [2, 1]}",
                "^: load 'torque': times of the breakpoints must increase, but 1 follows 2"},
        BadText{"{table: [[0, 0], [0.2, 200]]}", "{table: [[0, 0], ^[0.2]]}",
                "^: load 'torque': value[2]: table[1] has 1 numbers instead of 2; write [time, value]"},
        BadText{"{table: [[0, 0], [0.2, 200]]}", "^{table: []}",
                "^: load 'torque': the table has 0 times and 0 values"},
        BadText{"{table: [[0, 0], [0.2, 200]]}", "^{breakpoints: [1]}",
                "^: load 'torque': value[2]: 0 of table, file, expression are given; give one of them"},
        BadText{"{table: [[0, 0], [0.2, 200]]}", "{file: ^none.csv}",
                "^: load 'torque': value[2]: none.csv: cannot open the table: No such file or directory; check path "
                "and permission"},
        BadText{
            "value: [0, 1, {table: [[0, 0], [0.2, 200]]}]", "value: ^[0, 1]",
            "^: load 'torque': value must have three components, not a list of 2; write it as [0, 0, \"sin(t)\"]"}));

INSTANTIATE_TEST_SUITE_P(
    Settings, BadScene,
    ::testing::Values(
        BadText{
            "step: 0.01", "^stpe: 0.01",
            "scene.yaml:14:1: integrator: missing key 'step'\n^: integrator: unknown key 'stpe'; did you mean 'step'?"},
        BadText{"integrator: {step: 0.01, end: 20}", "analysis: dynamics", "scene.yaml:1:1: missing key 'integrator'"},
        BadText{"step: 0.01", "step: ^0", "^: integrator: step 0 must be positive"},
        BadText{"step: 0.01", "step: ^1e-15",
                "^: integrator: step 1e-15 makes 2e+16 steps; the limit is 1e+12; give a larger step"},
        BadText{"end: 20", "end: ^0", "^: integrator: end 0 must be later than start 0"},
        BadText{"end: 20", "start: 2, end: ^1", "^: integrator: end 1 must be later than start 2"},
        BadText{"end: 20", "end: 20, rho: ^1.5", "^: integrator: rho 1.5 must lie between 0 and 1"},
        BadText{"end: 20", "end: 20, method: hht, alpha: ^0.4",
                "^: integrator: alpha 0.4 must lie between 0 and 0.3333"},
        BadText{"end: 20", "end: 20, method: hht, ^rho: 0.8",
                "^: integrator: 'rho' has no effect with method: hht; give alpha, or use method: generalised_alpha"},
        BadText{"end: 20", "end: 20, ^alpha: 0.1",
                "^: integrator: 'alpha' has no effect with method: generalised_alpha; give rho, or use method: hht"},
        BadText{"end: 20}", "end: 20}\noutput: {from: ^20.5}",
                "^: output: from 20.5 is later than the end 20 of the integrator; nothing would be stored; give an "
                "earlier time"},
        BadText{"end: 20", "end: 20, max_iterations: ^0", "^: integrator: max_iterations 0 must be 1 or more"},
        BadText{"end: 20", "end: 20, method: ^newmark",
                "^: integrator: unknown method 'newmark'; use one of generalised_alpha, hht, bdf, radau, auto"},
        BadText{"end: 20}", "end: 20}\nstatics: {load_steps: ^0}", "^: statics: load_steps 0 must be 1 or more"},
        BadText{"end: 20}", "end: 20}\noutput: {every: ^0}", "^: output: every 0 must be 1 or more"},
        BadText{"end: 20}", "end: 20}\noutput: {interval: ^-1}", "^: output: interval -1 must be positive"},
        BadText{"end: 20}", "end: 20}\n^output: {interval: 1, every: 2}",
                "^: output: both 'every' and 'interval' are given; give one of them"},
        BadText{"end: 20}", "end: 20}\noutput: {channels: ^nodes}",
                "^: output: channels must be a list, not 'nodes'; write it as [nodes, energy]"},
        BadText{"end: 20}", "end: 20}\ninitial_tolerance: ^0", "^: initial_tolerance 0 must be positive"},
        BadText{"end: 20}", "end: 20}\nanalysis: ^modal",
                "^: unknown analysis 'modal'; use one of dynamics, statics, "
                "assembly, kinematics, inverse_dynamics, modes"},
        BadText{"[0, 0, -9.81]", "^9.81", "^: gravity must be a list of numbers, not '9.81'; write it as [1, 2, 3]"}));

TEST(Scene, TellsAllErrorsAtOnceInTheOrderOfTheLines) {
  std::string text = replaced(swing, "nu: 0.3", "nu: 0.6");
  text = replaced(text, "frame: paper", "frame: paper, modes: -1, use: stiff");
  text = replaced(text, "mass: 3", "mass: heavy");
  text = replaced(text, "a: rod/end", "a: rood/end");
  text = replaced(text, "end: 20", "end: -20");
  EXPECT_EQ(error(text),
            "scene.yaml:3:36: material 'steel': nu 0.6 must lie between -1 and 0.5\n"
            "scene.yaml:6:85: body 'beam': modes -1 must not be negative; write modes: 0 to use no modes\n"
            "scene.yaml:6:94: body 'beam': unknown use 'stiff'; use one of flexible, rigid\n"
            "scene.yaml:8:30: body 'block': mass must be a number, not 'heavy'\n"
            "scene.yaml:11:30: joint 'ball': there is no body 'rood'; did you mean 'rod'?\n"
            "scene.yaml:14:31: integrator: end -20 must be later than start 0");
}

TEST(Scene, FaultyTables) {
  const Folder folder;
  const std::string path =
      folder.file("scene.yaml", replaced(swing, "{table: [[0, 0], [0.2, 200]]}", "{file: drive.csv}"));
  const auto error_with = [&](const std::string& table) {
    folder.file("drive.csv", table);
    return error_of(folder, [&] { read_scene(path, {}); });
  };
  EXPECT_THAT(error_with("0, 1\n1, x\n"),
              HasSubstr("drive.csv:2:4: 'x' is not a finite number; give two numbers per line: time, value"));
  EXPECT_THAT(error_with("0, 1\n1, inf\n"), HasSubstr("drive.csv:2:4: 'inf' is not a finite number"));
  EXPECT_THAT(error_with("0, 1, 2\n"), HasSubstr("drive.csv:1:1: the line has 3 numbers instead of 2"));
  EXPECT_THAT(error_with("time, value\n"), HasSubstr("drive.csv: the table has no line with two numbers"));
  EXPECT_THAT(error_with("0, 1\n0, 2\n"),
              HasSubstr("load 'torque': times of the table must increase, but 0 follows 0"));
}

TEST(Scene, CheckOfAStructThatNoFileGave) {
  Scene scene = read(swing);
  EXPECT_NO_THROW(check(scene));
  std::get<SuperelementBodySpec>(scene.bodies[0]).start.velocity =
      Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  std::get<RigidBodySpec>(scene.bodies[2]).start.pose.orientation = Eigen::Quaterniond(0, 0, 0, 0);
  std::get<RigidBodySpec>(scene.bodies[2]).inertia(0, 1) = 0.5;
  scene.integrator.step = std::numeric_limits<double>::quiet_NaN();
  scene.loads[0].components[0] = std::numeric_limits<double>::infinity();
  scene.joints.push_back(scene.joints[0]);
  const Folder folder;
  const std::string text = error_of(folder, [&] { check(scene); });
  EXPECT_THAT(text, HasSubstr("body 'beam': velocity must be finite"));
  EXPECT_THAT(text, HasSubstr("body 'block': the quaternion of the orientation has length 0, not 1"));
  EXPECT_THAT(text, HasSubstr("body 'block': inertia is not symmetric"));
  EXPECT_THAT(text, HasSubstr("integrator: step nan must be positive"));
  EXPECT_THAT(text, HasSubstr("load 'torque': value[0] must be finite"));
  EXPECT_THAT(text, HasSubstr("joint 'hinge': the name is used twice"));
}

}  // namespace
}  // namespace tisserand::formats::scene_test
