// SPDX-License-Identifier: GPL-3.0-or-later
// Sub-assemblies in motion, for every kind of entry: an instance moves as the same entries written into the scene do, a
// placed one as its image under the pose, a mirrored one as its mirror image.
#include <cmath>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/run/output.hpp"
#include "tests/formats/yaml/text_input.hpp"
#include "tests/support/bodies/modal_known_answers.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::assembly_mirror_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test_support::Simulation;

// ---- files ------------------------------------------------------------------------------------------------------

/// A frame on a path that is no image of its mirror image.
formats::Superelement frame() { return test_support::test_superelement("frame"); }

/// Five nodes of different masses, its frame anywhere in the part.
formats::ModalBody modal(const std::string& reference) {
  formats::ModalBody body = test_support::known_body(test_support::modal_answers(), reference);
  body.frame_position = {0.3, -0.2, 0.5};
  body.frame_orientation = wxyz(Eigen::Quaterniond(exp_so3<double>(Vector3d(0.7, -0.4, 1.1))));
  return body;
}

// ---- scenes ---------------------------------------------------------------------------------------------------------

/// Where an instance stands: x -> p + G x, with the mirror plane ("" if none) before the rotation vector.
struct Place {
  std::string plane;
  Vector3d p, turn;

  Matrix3d S() const {
    Vector3d diagonal = Vector3d::Ones();
    if (!plane.empty()) diagonal[plane == "yz" ? 0 : plane == "xz" ? 1 : 2] = -1.0;
    return diagonal.asDiagonal();
  }
  Matrix3d G() const { return exp_so3<double>(turn) * S(); }
};

std::string list(const Vector3d& v) { return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z()); }

std::string head(const Vector3d& gravity, const std::string& formulation) {
  return fmt::format(
      "scene: test\ngravity: {}\ninitial_tolerance: 100\nintegrator: {{step: 0.01, end: 0.2, tolerance: "
      "1e-12, constraint_tolerance: 1e-13, formulation: {}}}\n",
      list(gravity), formulation);
}

std::string indented(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) result += "    " + line + "\n";
  return result;
}

const Vector3d gravity(0.8, -1.7, -9.0);

struct Case {
  std::string name;
  std::string entries;    ///< beside the two bodies
  bool reversed = false;  ///< displacements along z of its joint change their sign
  std::string formulation = "stabilised_index2";
  double accuracy = 1e-7;  ///< relative, of the image
};
void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

std::string by_hand(const Case& one) { return head(gravity, one.formulation) + one.entries; }

std::string as_instance(const Case& one, const Place& place) {
  const Vector3d axis = place.turn.norm() > 0.0 ? Vector3d(place.turn.normalized()) : Vector3d(Vector3d::UnitZ());
  std::string text = head(place.G() * gravity, one.formulation) + "assemblies:\n  part:\n" + indented(one.entries);
  text += fmt::format(
      "instances:\n  one:\n    use: part\n    pose: {{position: {}, orientation: {{axis: {}, angle_deg: {:.17g}}}}}\n",
      list(place.p), list(axis), place.turn.norm() * 180.0 / M_PI);
  return text + (place.plane.empty() ? "" : "    mirror: " + place.plane + "\n");
}

/// Values of the end of a run by name of what they belong to, without the name of the instance.
struct Outcome {
  std::map<std::string, Vector3d> position, velocity, angular_velocity;
  std::map<std::string, Matrix3d> rotation;
  std::map<std::string, double> coordinate, rate, force;
  double energy = 0.0;
};

Outcome run(const std::string& text) {
  const formats::Folder folder;
  (void)folder.file("in.csv", "0 0\n0.05 2\n0.3 -1\n");
  const formats::Scene scene = formats::read_scene(folder.file("scene.yaml", text), {});
  BodyFiles files;
  test_support::add_file(folder.path() + "/frame.h5", frame(), files.superelements);
  for (const std::string reference : {"node_fixed", "mean_axis"})
    files.modal_bodies[folder.path() + "/" + reference + ".h5"].body = modal(reference);
  Simulation simulation(scene, files);
  simulation.start();
  simulation.run(scene.integrator.end);
  const formats::ResultsLayout layout = results_layout(simulation.model(), scene);
  formats::ResultsRow row;
  row.resize(layout);
  fill_row(simulation.model(), simulation.state(), simulation.workspace.now, row);
  const auto own = [](const std::string& name) { return name.starts_with("one/") ? name.substr(4) : name; };
  Outcome outcome;
  for (std::size_t i = 0; i < layout.nodes.size(); ++i) {
    const auto c = static_cast<Eigen::Index>(i);
    const std::string name = own(layout.nodes[i]);
    const Eigen::Vector4d q = row.node_rotation.col(c);
    outcome.position[name] = row.node_position.col(c);
    outcome.velocity[name] = row.node_velocity.col(c);
    outcome.angular_velocity[name] = row.node_angular_velocity.col(c);
    outcome.rotation[name] = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  }
  for (std::size_t i = 0; i < layout.coordinates.size(); ++i) {
    outcome.coordinate[own(layout.coordinates[i].name)] = row.joint_coordinate[i];
    outcome.rate[own(layout.coordinates[i].name)] = row.joint_rate[i];
  }
  for (std::size_t i = 0; i < layout.springs.size(); ++i)
    outcome.force[own(layout.springs[i].name)] = row.spring_force[i];
  outcome.energy = row.kinetic + row.strain;
  return outcome;
}

// Newton stops at 1e-12 of the largest force, whose components depend on the axes, which leaves up to 1e-8 in
// velocities of the lightest nodes (a beam of 1e-1 kg with forces of 1e3): motions differ by less than 1e-7 of their
// size. Stabilised index 2 weights its position corrections with the iteration matrix; whether that is kept or made
// anew is decided by thresholds that round-off may pass in one image alone. Modal bodies, whose matrices change much,
// differ by up to 1e-6 then, with index 3 by no more than others.

void expect_image(const Outcome& original, const Outcome& image, const Place& place, double tolerance) {
  const Matrix3d G = place.G(), S = place.S();
  ASSERT_EQ(original.position.size(), image.position.size());
  const auto same = [&](const auto& expected, const auto& actual, const std::string& what) {
    EXPECT_LT((expected - actual).norm(), tolerance * (1.0 + expected.norm())) << what;
  };
  for (const auto& [name, x] : original.position) {
    ASSERT_TRUE(image.position.contains(name)) << name;
    same(Vector3d(place.p + G * x), image.position.at(name), name + " position");
    same(Vector3d(G * original.velocity.at(name)), image.velocity.at(name), name + " velocity");
    same(Vector3d(G.determinant() * G * original.angular_velocity.at(name)), image.angular_velocity.at(name),
         name + " angular velocity");
    // Part frames of an instance that is mirrored in itself are mirrored at its own plane.
    const Matrix3d own = name.starts_with("r/") && !place.plane.empty() ? Place{"yz", {}, {}}.S() : S;
    same(Matrix3d(G * original.rotation.at(name) * own), image.rotation.at(name), name + " rotation");
  }
  const auto equal = [&](const std::map<std::string, double>& expected, const std::map<std::string, double>& actual,
                         const char* what) {
    ASSERT_EQ(expected.size(), actual.size()) << what;
    for (const auto& [name, value] : expected)
      EXPECT_NEAR(value, actual.at(name), tolerance * (1.0 + std::abs(value))) << name << ' ' << what;
  };
  equal(original.force, image.force, "force");
  EXPECT_NEAR(original.energy, image.energy, tolerance * (1.0 + original.energy));
  if (!place.plane.empty()) return;  // signs of coordinates: expect_coordinates()
  equal(original.coordinate, image.coordinate, "coordinate");
  equal(original.rate, image.rate, "rate");
}

/// Mirrored: all coordinates keep their signs but those that SCENE.md names.
void expect_coordinates(const Outcome& original, const Outcome& image, const Case& one) {
  for (const auto& [name, value] : original.coordinate) {
    const double sign = one.reversed && (name == "j" || name.ends_with("/z")) ? -1.0 : 1.0;
    EXPECT_NEAR(value, sign * image.coordinate.at(name), one.accuracy * (1.0 + std::abs(value))) << name;
    EXPECT_NEAR(original.rate.at(name), sign * image.rate.at(name), one.accuracy * (1.0 + std::abs(value))) << name;
  }
}

// ---- the table ------------------------------------------------------------------------------------------------------

/// a turns and moves; b stands beside it.
const std::string two_bodies = R"yaml(bodies:
  a:
    type: rigid
    mass: 2
    center_of_mass: [0.1, 0.2, 0.3]
    inertia: [1, 2, 2.5, 0.1, 0.2, 0.3]
    nodes: {n: {position: [0.3, 0.5, -0.2], orientation: {axis: [1, 0, 2], angle_deg: 35}}}
    pose: {position: [0.5, 0.2, 0.1], orientation: {axis: [1, 2, 3], angle_deg: 25}}
    velocity: [0.3, -0.2, 0.1]
    angular_velocity: [0.4, 0.7, -0.6]
  b:
    type: rigid
    mass: 1.5
    inertia: [0.5, 0.4, 0.6, 0.05, 0, 0]
    center_of_mass: [0, -0.1, 0.2]
    pose: {position: [1, 0.7, 0.4]}
    velocity: [-0.1, 0.2, 0.3]
)yaml";
const std::string hung =
    "joints: {p: {type: revolute, a: ground, b: a, axis: [1, 2, 0.5], position: [0.5, 0.2, 0.1]}}\n";

std::string with_bodies(const std::string& entries) { return two_bodies + entries; }
std::string with_joint(const std::string& rest) {
  return two_bodies + "joints: {j: {a: a/n, b: b, position: [0.9, 0.6, 0.2], " + rest + "}}\n";
}

/// Bodies from files, hung between the two: every option of superelements, both formulations, both modal references.
void add_files(std::vector<Case>& all) {
  const std::string place =
      "pose: {position: [1, 0.7, 0.4], orientation: {axis: [1, 1, 0], angle_deg: 60}}, "
      "angular_velocity: [0.3, 1, 0.2]}\n";
  const auto with_file = [&](const std::string& body, const std::string& ends) {
    return with_bodies("  f: {" + body + ", " + place + "joints:\n" + ends);
  };
  const std::string ends =
      "  j: {type: spherical, a: b, b: f/n0}\n  k: {type: universal, a: a/n, b: {node: f/n5, position: [0.1, 0.2, "
      "0.3]}, axis: [1, 2, -1], x_axis: [0, 1, 1]}\n";
  for (const std::string formulation : {"stabilised_index2", "index3"})
    for (const std::string option : {"inertia: A", "inertia: B", "inertia: M", "frame: paper", "frame: {node: n2}",
                                     "weights: {positions: {n0: 0.2, n2: 0.5, n5: 0.3}}", "use: rigid", "mirror: yz",
                                     "damping: {mass: 0.1, stiffness: 0.01}, mirror: [xy, xz], modes: 3"})
      all.push_back({fmt::format("superelement_{}_{}", all.size(), formulation),
                     with_file("type: superelement, file: frame.h5, gravity: [0, 4, 1], " + option, ends), false,
                     formulation});
  all.push_back(
      {"files_in_instances_inside",
       two_bodies + "assemblies:\n  side:\n    parameters: {at: b}\n    bodies:\n      c: {type: superelement, file: "
                    "frame.h5, pose: {orientation: {axis: [1, 1, 0], angle_deg: 60}}}\n    joints: {k: {type: "
                    "spherical, a: $at, b: c/n2}}\ninstances:\n  l: {use: side, parameters: {at: a}}\n  r: {use: side, "
                    "mirror: yz, pose: {position: [1, 0.7, 0.4]}}\n"});
  all.push_back({"rigid_from_file", with_file("type: rigid, from: frame.h5, mirror: xy", ends)});
  for (const std::string formulation : {"stabilised_index2", "index3"})
    for (const std::string body : {"node_fixed.h5, mirror: xz", "node_fixed.h5", "mean_axis.h5, damping: {ratio: 0.1}"})
      all.push_back(
          {fmt::format("modal_{}_{}", all.size(), formulation),
           with_file("type: modal, file: " + body,
                     "  j: {type: spherical, a: b, b: f/n1}\n  k: {type: universal, a: a/n, b: {node: f/n5, "
                     "position: [0.1, 0.2, 0.3], orientation: {axis: [1, 0, 2], angle_deg: 15}}}\n  l: {type: "
                     "point_on_plane, a: ground, b: f, axis: [1, 2, 3]}\n"),
           false, formulation, formulation == "index3" ? 1e-7 : 1e-6});
}

std::vector<Case> cases() {
  const std::string axis = "axis: [1, 2, -1], x_axis: [0, 1, 1]";
  std::vector<Case> all{
      {"free", with_bodies("")},
      {"gravity_of_a_body", two_bodies + "    gravity: [1, 2, 3]\n"},
      {"virtual",
       with_bodies("  v: {type: virtual, pose: {position: [0.8, 0.5, 0.3], orientation: {axis: [0, 1, 1], angle_deg: "
                   "40}}, nodes: {k: {position: [0.1, 0.2, 0.3], orientation: {axis: [1, 1, 0], angle_deg: 15}}}}\n"
                   "joints:\n  tie: {type: fixed, a: a/n, b: v}\n  j: {type: universal, a: v/k, b: b, " +
                   axis + "}\n")},
      {"beam", with_bodies("  rod: {type: beam, from: [0.1, 0.2, 0], to: [0.9, 0.3, 0.4], through: [0.5, 0.5, 0.1], "
                           "orientation: [0, 1, 2], elements: 2, section: bar, material: rubber, pose: {position: [0, "
                           "0.1, 0]}, angular_velocity: [0.5, 1, 2]}\n"
                           "materials: {rubber: {E: 1e6, nu: 0.3, density: 1000}}\n"
                           "sections: {bar: {shape: rectangle, width: 0.02, height: 0.04}}\n"
                           "joints: {j: {type: spherical, a: rod/end, b: b}}\n")},
      {"ground_markers",
       with_bodies(
           "joints:\n  j: {type: revolute, a: {node: ground, position: [0.9, 0.6, 0.2], orientation: {axis: [1, "
           "2, 0], angle_deg: 50}}, b: {node: a/n, position: [0.1, -0.1, 0.2]}}\n  k: {type: prismatic, a: "
           "{node: a, orientation: {axis: [0, 1, 2], angle_deg: 20}}, b: b}\n")},
      {"gear",
       with_bodies("joints:\n  p: {type: revolute, a: ground, b: a, axis: [1, 2, 0.5]}\n  q: {type: revolute, a: "
                   "ground, b: b, axis: [0, 2, 1]}\n  g: {type: gear, between: [p, q], ratio: -2.5}\n")},
      {"rack",
       with_bodies("joints:\n  p: {type: revolute, a: ground, b: a, axis: [1, 2, 0.5]}\n  q: {type: prismatic, a: "
                   "ground, b: b, axis: [0, 2, 1]}\n  g: {type: rack_and_pinion, between: [p, q], radius: 0.4}\n")},
      {"motion", with_bodies(hung + "motions: {m: {coordinate: p, value: \"2 * t^2 + 0.1 * in\"}}\n"
                                    "inputs: {in: {file: in.csv, interpolation: cubic}}\n")},
      {"motion_table",
       with_bodies(hung + "motions: {m: {coordinate: p, value: {table: [[0, 0], [0.1, 0.05], [0.3, 0.4]]}}}\n")},
      {"spring",
       with_bodies("springs: {s: {a: {node: ground, position: [1, 2, 3]}, b: {node: a/n, position: [0.1, 0, 0.2]}, "
                   "stiffness: 300, damping: 5, free: 2, force: \"4 * sin(9 * t)\"}}\n")},
      {"torsion", with_bodies("springs: {s: {type: torsion, a: a/n, b: b, " + axis +
                              ", stiffness: 20, damping: 1, free: 0.4}}\n")},
      {"stops_and_curves",
       with_bodies(hung + "springs: {s: {coordinate: p, stiffness: {table: [[-1, -5], [0, 0], [0.1, 9], [1, 10]], "
                          "interpolation: cubic}, damping: {table: [[-1, -2], [1, 3]]}, lower: -0.02, upper: 0.01, "
                          "stop_stiffness: 500, stop_damping: 0.3}}\n")},
      {"bushing",
       with_bodies(
           "bushings:\n  u:\n    a: a/n\n    b: {node: b, position: [0.1, 0, 0]}\n    axis: [1, 2, -1]\n    x_axis: "
           "[0, 1, 1]\n    stiffness:\n      - [900, 20, 30, 5, 6, 7]\n      - [10, 800, 25, 8, 9, 3]\n      - "
           "[30, 15, 700, 2, 4, 6]\n      - [5, 8, 2, 60, 3, 1]\n      - [6, 2, 4, 3, 70, 5]\n      - [7, 3, 6, "
           "1, 5, 80]\n    damping: [3, 4, 5, 1, 2, 1]\n    free: [0.01, 0.02, -0.03, 0.1, 0.2, 0.3]\n    preload: "
           "[5, 6, 7, 1, 2, 3]\n")},
      {"bushing_without_axis",
       with_bodies(
           "bushings: {u: {a: a, b: b, stiffness: [300, 400, 500, 20, 30, 40], preload: [1, 2, 3, 4, 5, 6]}}\n")},
      {"loads",
       with_bodies(
           "loads:\n  f: {type: force, at: {node: a/n, position: [0.1, 0.2, 0]}, value: [3, \"9 * sin(5 * t)\", "
           "-2]}\n  m: {type: moment, at: b, value: [\"t\", 2, 1]}\n  g: {type: force, at: a/n, axes: body, value: "
           "[1, {table: [[0, 1], [1, 9]]}, -3]}\n  n: {type: moment, at: a/n, axes: body, value: [1, {expression: "
           "\"4 * t\"}, 0.5]}\n")},
      {"channels",
       with_bodies(hung +
                   "channels:\n  speed: {type: rate, of: p}\n  angle: {type: coordinate, of: p}\n  height: {type: "
                   "position, of: {node: a/n, position: [0, 0.1, 0.2]}, axis: z}\n  aside: {type: position, of: b, "
                   "axis: [1, 1, 0], origin: [0.2, 0.3, 0]}\n  rise: {type: velocity, of: a/n, axis: y}\n  apart: "
                   "{type: distance, a: {node: ground, position: [1, 1, 1]}, b: b}\n"
                   "inputs: {in: {file: in.csv}}\n"
                   "loads: {f: {type: force, at: b, value: [\"-8 * height + in\", \"3 * aside - 2 * apart\", "
                   "\"-5*rise\"]}}\n"
                   "springs: {s: {coordinate: p, force: \"-2 * speed - angle + sin(t)\"}}\n")},
      {"friction",
       with_bodies("joints:\n  p: {type: revolute, a: ground, b: a, axis: [1, 2, 0.5], friction: {coefficient: 0.2, "
                   "velocity: 0.01, radius: 0.1, arm: 0.3}}\n  q: {type: prismatic, a: ground, b: b, axis: [0, 2, 1], "
                   "friction: {coefficient: 0.1, static_coefficient: 0.15, velocity: 0.01, arm: 0.5}}\n")},
      {"friction_of_a_ball", with_joint("type: spherical, friction: {coefficient: 0.2, velocity: 0.02, radius: 0.1}")},
      {"instances_inside",
       "parameters: {m: 3}\n" + two_bodies +
           "assemblies:\n  link:\n    parameters: {hang: a/n}\n    bodies: {c: {type: rigid, mass: $m, inertia: [1, 1, "
           "2], "
           "nodes: {e: {position: [0, 0, -0.3]}}}}\n    joints: {k: {type: revolute, a: $hang, b: c, axis: [1, 1, "
           "0]}}\n"
           "    channels: {speed: {type: rate, of: k}}\n"
           "    springs: {s: {coordinate: k, stiffness: 4, force: \"-3 * speed\"}}\n"
           "instances:\n  l: {use: link, count: 2, step: {position: [0, 0, -0.3]}, parameters: {hang: $previous/c/e}, "
           "first: "
           "{hang: a/n}}\n  r: {use: link, mirror: yz, pose: {position: [0.2, 0, 0]}, parameters: {hang: b}}\n"}};
  for (const char* type : {"fixed", "revolute", "spherical", "universal", "constant_velocity", "prismatic", "planar",
                           "point_on_line", "point_on_plane"})
    all.push_back(
        {type, with_joint(std::string("type: ") + type + (type == std::string("spherical") ? "" : ", " + axis))});
  for (const char* type : {"cylindrical", "parallel_axes"})
    all.push_back({type, with_joint(std::string("type: ") + type + ", " + axis), true});
  all.push_back({"constant_orientation", with_joint("type: constant_orientation"), true});
  all.push_back({"screw", with_joint("type: screw, pitch: 0.3, " + axis), true});
  all.push_back({"generic", with_joint("type: generic, hold: [x, rx, ry], " + axis), true});
  all.push_back({"generic_pins", with_joint("type: generic, hold: [x, y, z, rz], " + axis), true});
  all.push_back(
      {"distance", with_bodies("joints: {j: {type: distance, a: a/n, b: {node: b, position: [0.4, 0.1, 0]}}}\n")});
  all.push_back({"cylindrical_with_friction",
                 with_joint("type: cylindrical, friction: {coefficient: 0.2, velocity: 0.02, radius: 0.1}, " + axis),
                 true});
  add_files(all);
  return all;
}

class Assembly : public ::testing::TestWithParam<Case> {};

TEST_P(Assembly, MovesAsTheSameEntriesInTheScene) {
  const Outcome original = run(by_hand(GetParam()));
  const Place here{"", Vector3d::Zero(), Vector3d::Zero()};
  // The same numbers, in the same order: not even round-off differs but by the pose that is written out.
  expect_image(original, run(as_instance(GetParam(), here)), here, 1e-12);
}

TEST_P(Assembly, MovesAsItsImage) {
  const Outcome original = run(by_hand(GetParam()));
  const Place turned{"", {3, -1, 2}, {0.4, -1.1, 0.7}};
  expect_image(original, run(as_instance(GetParam(), turned)), turned, GetParam().accuracy);
  for (const char* plane : {"yz", "xz", "xy"}) {
    SCOPED_TRACE(plane);
    const Place mirrored_place{plane, {1, 2, -1}, {-0.6, 0.3, 0.9}};
    const Outcome image = run(as_instance(GetParam(), mirrored_place));
    expect_image(original, image, mirrored_place, GetParam().accuracy);
    expect_coordinates(original, image, GetParam());
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Assembly, ::testing::ValuesIn(cases()),
                         [](const ::testing::TestParamInfo<Case>& given) { return given.param.name; });

}  // namespace
}  // namespace tisserand::mechanism::assembly_mirror_test
