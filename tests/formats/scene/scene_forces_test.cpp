// SPDX-License-Identifier: GPL-3.0-or-later
// Springs with curves and about axes, bushings, gravity and the start of bodies in scene.yaml: every key, the text of
// every error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/scene/scene.hpp"
#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::scene_forces_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string machine = R"(scene: machine
gravity: [0, 0, -9.81]
bodies:
  a: {type: rigid, mass: 1, inertia: [1, 1, 1], gravity: [0, 0, 1.5]}
  b: {type: rigid, mass: 1, inertia: [1, 1, 1]}
joints:
  hinge: {type: revolute, a: ground, b: a, axis: [0, 0, 1]}
springs:
  strut: {a: ground, b: b, stiffness: {file: bump.csv, interpolation: cubic}, damping: {table: [[-1, -3], [0, 0], [1, 2]]}}
  bar: {type: torsion, a: a, b: b, axis: [0, 1, 0], x_axis: [1, 0, 0], stiffness: 30}
bushings:
  mount: {a: ground, b: b, axis: [0, 0, 1], stiffness: [1, 2, 3, 4, 5, 6], damping: [0, 0, 0, 1, 1, 1], preload: [0, 0, 9, 0, 0, 0]}
  field:
    a: a
    b: {node: b, position: [0, 0, 1]}
    free: [0, 0, 1, 0, 0, 0]
    stiffness: [[1, 0, 0, 0, 0, 0], [0, 2, 0, 0, 0, 7], [0, 0, 3, 0, 0, 0], [0, 0, 0, 4, 0, 0], [0, 0, 0, 0, 5, 0], [0, 7, 0, 0, 0, 6]]
integrator: {step: 0.01, end: 1}
)";

Scene read(const std::string& text) {
  const Folder folder;
  folder.file("bump.csv", "deflection, force\n-0.1, -50\n0, 0\n0.1, 20\n");
  return read_scene(folder.file("scene.yaml", text), {});
}

std::string error(const std::string& from, const std::string& to) {
  const Folder folder;
  folder.file("bump.csv", "deflection, force\n-0.1, -50\n0, 0\n0.1, 20\n");
  const std::string path = folder.file("scene.yaml", replaced(machine, from, to));
  return error_of(folder, [&] { read_scene(path, {}); });
}

TEST(SceneForces, EveryKeyIsRead) {
  const Scene scene = read(machine);
  EXPECT_EQ(std::get<RigidBodySpec>(scene.bodies[0]).gravity.value(), Eigen::Vector3d(0, 0, 1.5));
  EXPECT_FALSE(std::get<RigidBodySpec>(scene.bodies[1]).gravity);
  const CurveSpec& bump = std::get<CurveSpec>(scene.springs[0].stiffness);
  EXPECT_EQ(bump.interpolation, Interpolation::cubic);
  EXPECT_EQ(bump.y, (std::vector<double>{-50, 0, 20}));
  EXPECT_EQ(std::get<CurveSpec>(scene.springs[0].damping).interpolation, Interpolation::linear);
  EXPECT_EQ(scene.springs[1].kind, SpringKind::torsion);
  EXPECT_EQ(scene.springs[1].x_axis.value(), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(std::get<double>(scene.springs[1].stiffness), 30.0);
  EXPECT_EQ(scene.bushings[0].stiffness.diagonal()[4], 5.0);
  EXPECT_EQ(scene.bushings[0].preload[2], 9.0);
  EXPECT_FALSE(scene.bushings[0].free);
  EXPECT_EQ(scene.bushings[1].stiffness(1, 5), 7.0);
  EXPECT_EQ((*scene.bushings[1].free)[2], 1.0);
}

// Zero that is written is given; nothing is free.
TEST(SceneStart, WhatIsWrittenDiffersFromWhatIsNot) {
  const Scene scene = read(replaced(replaced(machine, "end: 1}", "end: 1}\ninitial: {hinge: {rate: 2.5, value: -0.5}}"),
                                    "gravity: [0, 0, 1.5]", "velocity: [0, 0, 0]"));
  EXPECT_EQ(std::get<RigidBodySpec>(scene.bodies[0]).start.velocity, Eigen::Vector3d(0, 0, 0));
  EXPECT_FALSE(std::get<RigidBodySpec>(scene.bodies[0]).start.angular_velocity.has_value());
  ASSERT_EQ(scene.initial.size(), 1u);
  EXPECT_EQ(scene.initial[0].coordinate.name, "hinge");
  EXPECT_EQ(scene.initial[0].rate, 2.5);
  EXPECT_EQ(scene.initial[0].value, -0.5);
  EXPECT_THAT(error("end: 1}", "end: 1}\ninitial: {hinge: {}}"),
              HasSubstr("initial 'hinge': neither value nor rate is given; give one or both"));
  const Scene moving = read(replaced(machine, "end: 1}", "end: 1}\ninitial: {b: {velocity: [1, 2, 3]}}"));
  EXPECT_EQ(moving.initial[0].velocity.value(), Eigen::Vector3d(1, 2, 3));
  EXPECT_THAT(error("end: 1}", "end: 1}\ninitial: {hinge: {velocity: [1, 2, 3]}}"),
              HasSubstr("initial 'hinge': there is no body of this name"));
  EXPECT_THAT(error("end: 1}", "end: 1}\ninitial: {a: {angular_velocity: [1, 2, 3], rate: 1}}"),
              HasSubstr("initial 'a': value and rate have no effect on a body"));
  EXPECT_THAT(error("bodies:\n  a: {type: rigid,",
                    "initial: {a: {velocity: [1, 2, 3]}}\nbodies:\n  a: {type: rigid, velocity: [0, 0, 0],"),
              HasSubstr("initial 'a': the body itself gives velocity; remove one"));
  EXPECT_THAT(error("end: 1}", "end: 1}\ninitial: {hing: {rate: 1}}"),
              HasSubstr("initial 'hing': there is no joint 'hing'; did you mean 'hinge'?"));
}

const std::string loaded = R"yaml(scene: loaded
bodies:
  wing: {type: superelement, file: wing.superelement.h5}
  plate: {type: rigid, from: wing.superelement.h5}
  wheel: {type: rigid, mass: 1, inertia: [1, 1, 1]}
loads:
  gust: {type: part_load, body: wing, case: wind, value: "100 * sin(3 * t)"}
  push: {type: force, at: wheel, value: [0, 0, 1]}
  still: {type: part_load, body: plate, case: wind, value: 7}
integrator: {step: 0.01, end: 1}
)yaml";

std::string error_of_loads(const std::string& from, const std::string& to) {
  const Folder folder;
  const std::string path = folder.file("scene.yaml", replaced(loaded, from, to));
  return error_of(folder, [&] { read_scene(path, {}); });
}

TEST(SceneForces, PartLoads) {
  const Scene scene = read(loaded);
  ASSERT_EQ(scene.loads.size(), 1u);
  ASSERT_EQ(scene.part_loads.size(), 2u);
  EXPECT_EQ(scene.part_loads[0].name, "gust");
  EXPECT_EQ(scene.part_loads[0].body, "wing");
  EXPECT_EQ(scene.part_loads[0].load_case, "wind");
  EXPECT_EQ(std::get<TimeExpression>(scene.part_loads[0].value).text, "100 * sin(3 * t)");
  EXPECT_EQ(std::get<double>(scene.part_loads[1].value), 7.0);
}

TEST(SceneForces, BadPartLoads) {
  EXPECT_THAT(error_of_loads("body: wing, case", "body: wheel, case"),
              HasSubstr("load 'gust': body 'wheel' is not a superelement; use one of wing, plate"));
  EXPECT_THAT(error_of_loads("body: wing, case", "body: wingg, case"),
              HasSubstr("load 'gust': there is no superelement 'wingg'; did you mean 'wing'?"));
  EXPECT_THAT(error_of_loads("case: wind, value: 7", "value: 7"), HasSubstr("missing key 'case'"));
  EXPECT_THAT(error_of_loads("case: wind, value: 7", "case: wind"), HasSubstr("missing key 'value'"));
  EXPECT_THAT(error_of_loads("case: wind, value: 7", "case: wind, axes: body, value: 7"),
              HasSubstr("unknown key 'axes'"));
  EXPECT_THAT(error_of_loads("still:", "push:"), HasSubstr("push"));
  EXPECT_THAT(error_of_loads("type: part_load, body: wing", "type: part_lode, body: wing"), HasSubstr("part_load"));
}

// Names of an assembly are those of the instance; the load turns with its body.
TEST(SceneForces, PartLoadsOfAssemblies) {
  const Scene scene = read(R"(scene: aeroplane
assemblies:
  side:
    bodies: {wing: {type: superelement, file: wing.superelement.h5}}
    loads: {gust: {type: part_load, body: wing, case: wind, value: 3}}
instances: {left: {use: side}, right: {use: side, mirror: xz, pose: {position: [0, 1, 0]}}}
integrator: {step: 0.01, end: 1}
)");
  ASSERT_EQ(scene.part_loads.size(), 2u);
  EXPECT_EQ(scene.part_loads[1].name, "right/gust");
  EXPECT_EQ(scene.part_loads[1].body, "right/wing");
  EXPECT_EQ(std::get<double>(scene.part_loads[1].value), 3.0);
}

// z of the markers is reversed in the mirror: displacements along z and turns about x and y change their signs.
TEST(SceneForces, FieldsAreMirrored) {
  const Scene scene = read(R"(scene: car
assemblies:
  side:
    bodies: {wheel: {type: rigid, mass: 1, inertia: [1, 1, 1]}}
    bushings:
      mount:
        a: ground
        b: wheel
        preload: [1, 2, 3, 4, 5, 6]
        damping: [1, 2, 3, 4, 5, 6]
        stiffness: [[1, 0, 0, 0, 9, 0], [0, 2, 0, 0, 0, 7], [0, 0, 3, 0, 0, 0], [0, 0, 0, 4, 8, 0], [9, 0, 0, 8, 5, 0], [0, 7, 0, 0, 0, 6]]
instances: {left: {use: side}, right: {use: side, mirror: xz}}
integrator: {step: 0.01, end: 1}
)");
  ASSERT_EQ(scene.bushings.size(), 2u);
  const BushingSpec &left = scene.bushings[0], &right = scene.bushings[1];
  EXPECT_EQ(right.name, "right/mount");
  EXPECT_EQ(right.b.node, "right/wheel");
  Eigen::Matrix<double, 6, 1> sign;
  sign << 1, 1, -1, -1, -1, 1;
  EXPECT_EQ(right.preload, left.preload.cwiseProduct(sign));
  EXPECT_EQ(right.damping, left.damping);
  EXPECT_EQ(right.stiffness, sign.asDiagonal() * left.stiffness * sign.asDiagonal());
  EXPECT_EQ(right.stiffness(0, 4), -9.0);
  EXPECT_LT((right.axis.value() - Eigen::Vector3d(0, 0, -1)).norm(), 1e-15);
}

TEST(SceneForces, WhatIsWrongIsNamed) {
  EXPECT_THAT(error("gravity: [0, 0, 1.5]", "gravity: [0, 0]"), HasSubstr("gravity"));
  EXPECT_THAT(error("[[-1, -3], [0, 0], [1, 2]]", "[[0, 0], [-1, -3]]"),
              HasSubstr("the first column of the table of damping must increase, but -1 follows 0"));
  EXPECT_THAT(error("[[-1, -3], [0, 0], [1, 2]]", "[[0, 0]]"), HasSubstr("the table of damping has 1 points"));
  EXPECT_THAT(error("[[-1, -3], [0, 0], [1, 2]]", "[[-1, 3], [0, 0]]"),
              HasSubstr("the table of damping adds energy: force 3 and rate -1 have opposite signs"));
  EXPECT_THAT(error("interpolation: cubic", "interpolation: cubik"), HasSubstr("cubic"));
  EXPECT_THAT(error("file: bump.csv", "file: bumb.csv"), HasSubstr("bumb.csv"));
  EXPECT_THAT(error("file: bump.csv, ", ""), HasSubstr("a curve needs either 'table' or 'file'"));
  EXPECT_THAT(error("axis: [0, 1, 0], x_axis: [1, 0, 0], ", ""), HasSubstr("a spring of type torsion needs an axis"));
  EXPECT_THAT(error("type: torsion, ", ""), HasSubstr("'axis' belongs to springs of type torsion"));
  EXPECT_THAT(error("a: a, b: b, axis: [0, 1, 0], x_axis: [1, 0, 0]", "coordinate: hinge"),
              HasSubstr("'type' has no effect with 'coordinate'"));
  EXPECT_THAT(error("type: torsion, a: a, b: b", "type: torsion, a: a, b: a"), HasSubstr("joins 'a' to itself"));
  EXPECT_THAT(error("[1, 2, 3, 4, 5, 6]", "[1, 2, 3]"), HasSubstr("stiffness has 3 numbers instead of 6"));
  EXPECT_THAT(error("[0, 2, 0, 0, 0, 7]", "[0, 2, 0]"), HasSubstr("stiffness[1] has 3 numbers instead of 6"));
  EXPECT_THAT(error("[0, 0, 0, 1, 1, 1]", "[0, 0, 0, 1, -1, 1]"),
              HasSubstr("the symmetric part of the damping matrix has the negative eigenvalue -1"));
  EXPECT_THAT(error("free: [0, 0, 1, 0, 0, 0]", "free: [0, 0, 1, 3, 1, 0]"), HasSubstr("half a turn or more"));
  EXPECT_THAT(error("free: [0, 0, 1, 0, 0, 0]", "free: 3"), HasSubstr("free"));
  EXPECT_THAT(error("stiffness: [1, 2, 3, 4, 5, 6], damping: [0, 0, 0, 1, 1, 1], preload: [0, 0, 9, 0, 0, 0]", ""),
              HasSubstr("bushing 'mount': has no effect; give"));
  EXPECT_THAT(error("a: ground, b: b, axis: [0, 0, 1]", "a: ground, b: c, axis: [0, 0, 1]"), HasSubstr("'c'"));
}

// The points of a drive as a smooth curve unless the scene says otherwise; steps of velocity only where nothing has
// mass.
TEST(SceneForces, TablesOfMotionsChooseTheirCurve) {
  const auto turned = [](const std::string& value, const std::string& analysis) {
    return replaced(
        replaced(machine, "springs:", "motions: {drive: {coordinate: hinge, value: " + value + "}}\nsprings:"),
        "integrator:", analysis + "\nintegrator:");
  };
  const auto chosen = [&](const std::string& value, const std::string& analysis) {
    return std::get<TimeTable>(read(turned(value, analysis)).motions[0].value).motion;
  };
  EXPECT_EQ(chosen("{table: [[0, 0], [1, 1]]}", ""), TableMotion::smooth);
  EXPECT_EQ(chosen("{file: bump.csv, interpolation: natural}", ""), TableMotion::natural);
  EXPECT_EQ(chosen("{file: bump.csv, interpolation: linear}", "analysis: kinematics"), TableMotion::linear);
  EXPECT_EQ(chosen("{table: [[0, 0], [1, 1]], interpolation: linear}", ""), TableMotion::linear);  // no step inside
  const auto fault = [&](const std::string& value, const std::string& analysis) {
    const Folder folder;
    folder.file("bump.csv", "deflection, force\n-0.1, -50\n0, 0\n0.1, 20\n");
    const std::string path = folder.file("scene.yaml", turned(value, analysis));
    return error_of(folder, [&] { read_scene(path, {}); });
  };
  for (const char* analysis : {"", "analysis: inverse_dynamics", "analyses: {a: {type: statics}, b: {type: dynamics}}"})
    EXPECT_THAT(fault("{file: bump.csv, interpolation: linear}", analysis),
                HasSubstr("motion 'drive': the velocity of a linear table jumps at its points"))
        << analysis;
  const auto follows = [&](const std::string& analysis, const std::string& interpolation) {
    const Folder folder;
    folder.file("bump.csv", "time, value\n0, 0\n1, 20\n2, 10\n");
    const std::string path =
        folder.file("scene.yaml", turned("2*cam", analysis) + "inputs: {cam: {file: bump.csv, time: 1, value: 2, " +
                                      "interpolation: " + interpolation + "}}\n");
    return error_of(folder, [&] { read_scene(path, {}); });
  };
  EXPECT_THAT(follows("", "linear"),
              HasSubstr("motion 'drive': input 'cam' is linear between its points. Its velocity jumps there"));
  EXPECT_THAT(follows("", "cubic"), Not(HasSubstr("input 'cam'")));
  EXPECT_THAT(follows("analysis: statics", "linear"), Not(HasSubstr("input 'cam'")));
  EXPECT_THAT(fault("{expression: t, interpolation: natural}", ""), HasSubstr("'interpolation' belongs to tables"));
  EXPECT_THAT(fault("{file: bump.csv, interpolation: cubic}", ""), HasSubstr("smooth"));
  EXPECT_THAT(error("stiffness: 30", "stiffness: 30, force: {table: [[0, 0], [1, 1]], interpolation: natural}"),
              HasSubstr("unknown key 'interpolation'"));
}

// Those of internal modes beside those of the free body, which scene_test.cpp reads; modal bodies have none.
TEST(SceneForces, RatiosOfInternalModesAreRead) {
  const auto body = [](const std::string& type, const std::string& damping) {
    return "scene: rod\nintegrator: {step: 0.01, end: 1}\nbodies: {rod: {type: " + type + ", file: rod.h5, damping: {" +
           damping + "}}}\n";
  };
  const Damping damping = std::get<SuperelementBodySpec>(
                              read(body("superelement", "ratio_internal: 0.01, ratios_internal: [0.02]")).bodies[0])
                              .damping;
  EXPECT_EQ(damping.ratio_internal, 0.01);
  EXPECT_EQ(damping.ratios_internal, std::vector<double>{0.02});
  const auto fault = [&](const std::string& type, const std::string& text) {
    const Folder folder;
    const std::string path = folder.file("scene.yaml", body(type, text));
    return error_of(folder, [&] { read_scene(path, {}); });
  };
  EXPECT_THAT(fault("superelement", "ratios_internal: [0.1, -0.01]"),
              HasSubstr("damping: ratios_internal -0.01 must not be negative"));
  EXPECT_THAT(fault("modal", "ratio_internal: 0.1"),
              HasSubstr("body 'rod': damping: modal bodies have no internal modes"));
}

}  // namespace
}  // namespace tisserand::formats::scene_forces_test
