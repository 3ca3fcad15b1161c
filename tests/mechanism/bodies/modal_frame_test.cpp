// SPDX-License-Identifier: GPL-3.0-or-later
// Modal bodies whose file rotates the body frame in the part (mean axis, principal axes). Nodes, markers, printed poses
// and stored instants equal those of the same body without that rotation.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/analyses/assembly.hpp"
#include "mechanism/run/stored_state.hpp"
#include "mechanism/simulate.hpp"
#include "tests/formats/yaml/text_input.hpp"
#include "tests/support/bodies/modal_known_answers.hpp"
#include "tests/support/scenes/virtual_bodies.hpp"

namespace tisserand::mechanism::modal_frame_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test_support::Outcome;
using test_support::Simulation;

formats::ModalBody straight() {
  formats::ModalBody body = test_support::known_body(test_support::modal_answers(), "mean_axis");
  body.frame_position = {0.3, -0.2, 0.5};
  return body;
}

/// Copy of the body whose frame has the orientation R in the part. Its data are in the axes of this frame.
formats::ModalBody in_turned_axes(formats::ModalBody body, const Matrix3d& R) {
  body.frame_orientation = wxyz(Eigen::Quaterniond(R));
  body.node_position = (body.node_position * R).eval();
  for (Matrix3d& inertia : body.node_inertia) inertia = (R.transpose() * inertia * R).eval();
  for (auto& X : body.X) {
    X.topRows<3>() = (R.transpose() * X.topRows<3>()).eval();
    X.bottomRows<3>() = (R.transpose() * X.bottomRows<3>()).eval();
  }
  body.integrals = formats::integrals_of(body);
  return body;
}

BodyFiles files(const std::string& folder, const formats::ModalBody& body) {
  BodyFiles all;
  all.modal_bodies[folder + "/f.h5"].body = body;
  return all;
}

formats::ModalBody turned() { return in_turned_axes(straight(), exp_so3<double>(Vector3d(0.7, -0.4, 1.1))); }

/// Scene with joints and loads in the axes of nodes. `of_f`, `of_b`: pose and velocities of the bodies.
std::string scene_text(const std::string& analysis, const std::string& of_f, const std::string& of_b) {
  return "scene: test\ngravity: [1, -2, -9]\nanalysis: " + analysis +
         "\nintegrator: {step: 0.01, end: 0.2, tolerance: 1e-12, constraint_tolerance: 1e-13}\n"
         "initial_tolerance: 100\n"
         "bodies:\n  f: {type: modal, file: f.h5, " +
         of_f + "}\n  b: {type: rigid, mass: 1, inertia: [0.3, 0.4, 0.5], " + of_b +
         "}\njoints:\n  ball: {type: spherical, a: {node: ground, position: [0.1, 0.2, 0.3]}, b: {node: f/n1, "
         "position: "
         "[0.1, -0.2, 0.15]}}\n  hinge: {type: revolute, a: {node: f/n5, position: [0.2, 0.1, 0], orientation: {axis: "
         "[1, 0, 2], angle_deg: 40}}, b: {node: b, position: [0, 0, 0.2], orientation: [1, 0, 0, 0]}}\n"
         "  line: {type: point_on_plane, a: ground, b: {node: f, position: [0.1, 0, 0]}, axis: [0, 0, 1]}\n"
         "loads:\n  push: {type: force, at: {node: f/n3, position: [0.1, 0.2, 0.3]}, axes: body, value: [3, 2, -1]}\n"
         "  turn: {type: moment, at: f, axes: body, value: [0.1, 0.4, -0.2]}\n";
}

const std::string rough_f =
    "pose: {position: [0.4, 0.3, 0.2], orientation: {axis: [1, 2, 3], angle_deg: 50}}, velocity: [0.1, 0.2, 0.3], "
    "angular_velocity: [0.5, -1, 2]";
const std::string rough_b = "pose: {position: [1, 0.5, 0.2]}, velocity: [0, 0.1, -0.2], angular_velocity: [0.2, 0, 1]";

constexpr double accuracy = 1e-9;  // Newton stops at 1e-12, in the same world axes for both

TEST(ModalFrame, NodesMoveAsWithoutATurnedFrame) {
  const formats::Folder folder;
  const formats::Scene scene =
      formats::read_scene(folder.file("scene.yaml", scene_text("dynamics", rough_f, rough_b)), {});
  const Outcome expected = test_support::run_scene(scene, files(folder.path(), straight()), 0.2);
  const Outcome found = test_support::run_scene(scene, files(folder.path(), turned()), 0.2);
  test_support::expect_equal(expected.motion, found.motion, accuracy);
  test_support::expect_equal(expected.reaction, found.reaction, 1e-7);
}

/// The end of an assembly and the poses that it prints.
struct Assembled {
  Outcome outcome;
  std::vector<std::string> poses;
};

Assembled assembled(const formats::Scene& scene, const BodyFiles& all) {
  Simulation run(scene, all);
  const State before = run.state();
  EXPECT_TRUE(assemble(run.model(), {1e-12}, run.state(), run.workspace.now).closed);
  Assembled result{test_support::outcome_of(scene, run), body_poses(scene, run.model(), before, run.state())};
  return result;
}

std::string inside_braces(const std::string& line) {
  const std::size_t begin = line.find('{');
  return line.substr(begin + 1, line.size() - begin - 2);
}

TEST(ModalFrame, PrintedPosesOfAnAssemblyMakeTheAssembledMechanism) {
  const formats::Folder folder;
  const formats::Scene rough =
      formats::read_scene(folder.file("rough.yaml", scene_text("assembly", rough_f, rough_b)), {});
  const Assembled expected = assembled(rough, files(folder.path(), straight()));
  const Assembled found = assembled(rough, files(folder.path(), turned()));
  // The nearest velocities come from normal equations with a damping of 1e-9: round-off of 1e-16 leaves up to 1e-7.
  test_support::expect_equal(expected.outcome.motion, found.outcome.motion, 1e-6);
  ASSERT_EQ(found.poses.size(), 2u);
  const formats::Scene exact = formats::read_scene(
      folder.file("exact.yaml", scene_text("assembly", inside_braces(found.poses[0]), inside_braces(found.poses[1]))),
      {});
  for (const formats::ModalBody& body : {straight(), turned()}) {
    Simulation run(exact, files(folder.path(), body));
    const Outcome at_start = test_support::outcome_of(exact, run);
    test_support::expect_equal(found.outcome.motion, at_start.motion, accuracy);
  }
}

TEST(ModalFrame, StoredInstantsGiveTheStateBack) {
  const formats::Folder folder;
  const formats::Scene scene =
      formats::read_scene(folder.file("scene.yaml", scene_text("dynamics", rough_f, rough_b)), {});
  const BodyFiles all = files(folder.path(), turned());
  const std::string results = folder.path() + "/a.results.h5";
  const RunEnd end = simulate(RunRequest{scene, all, std::nullopt, results, "", std::nullopt}, {});
  Simulation run(scene, all);
  static_cast<void>(read_stored_state(run.model(), results, std::nullopt, run.state(), run.workspace));
  EXPECT_LT((run.state().x() - end.state.x()).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((run.state().v() - end.state.v()).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT((run.state().w() - end.state.w()).cwiseAbs().maxCoeff(), 1e-14);
  const double cosine = Eigen::Vector4d(run.state().Q().col(0)).dot(Eigen::Vector4d(end.state.Q().col(0)));
  EXPECT_NEAR(std::abs(cosine), 1.0, 1e-14);
}

}  // namespace
}  // namespace tisserand::mechanism::modal_frame_test
