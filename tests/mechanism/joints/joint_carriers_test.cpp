// SPDX-License-Identifier: GPL-3.0-or-later
// Every joint between every pair of carriers of markers: derivatives against differences through the one door,
// reactions without work, invariance, swapped bodies.
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/iteration_matrix.hpp"
#include "tests/support/bodies/beam_states.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/bodies/superelement_cases.hpp"
#include "tests/support/scenes/joint_kinds.hpp"
#include "tests/support/scenes/model_tangent.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::joint_carriers_test {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::JointKind;
using test_support::Simulation;

/// What can carry a marker: one word per kind of body.
const std::vector<std::string> kCarriers = {"ground", "rigid",        "superelement",
                                            "beam",   "virtual kept", "virtual follower"};

struct Pair {
  std::string a, b;
};

/// All pairs but ground with ground, and virtual bodies of both treatments (the treatment is that of the scene).
std::vector<Pair> pairs() {
  std::vector<Pair> all;
  for (const std::string& a : kCarriers)
    for (const std::string& b : kCarriers)
      if ((a != "ground" || b != "ground") && (a == b || !a.starts_with("virtual") || !b.starts_with("virtual")))
        all.push_back({a, b});
  return all;
}

/// Adds a body of that kind, called `name`; returns the node that carries the marker. All part frames are the world at
/// the start, all bodies turn with the same angular velocity, so that the joint is met in velocities too.
/// Ties of virtual bodies come after the joint that is tested: `ties`.
std::string add_body(const std::string& carrier, const std::string& name, const Vector3d& spin, formats::Scene& scene,
                     std::vector<formats::JointSpec>& ties) {
  if (carrier == "ground") return "ground";
  if (carrier.starts_with("virtual")) {
    scene.virtual_bodies = carrier == "virtual kept" ? formats::VirtualBodies::keep : formats::VirtualBodies::eliminate;
    const std::string rigid = add_body("rigid", name, spin, scene, ties);
    formats::VirtualBodySpec body;
    body.name = name + "_virtual";
    body.start.pose.position = {0.2, 0.1, -0.1};
    body.start.velocity = spin.cross(body.start.pose.position);
    body.start.angular_velocity = spin;
    scene.bodies.push_back(body);
    ties.push_back(test_support::joint(name + "_tie", JointKind::fixed, rigid, body.name, body.start.pose.position,
                                       Vector3d::UnitZ()));
    return body.name;
  }
  if (carrier == "rigid") {
    formats::RigidBodySpec body = test_support::rigid_body(name, 2.0, {0.4, 0.1, 0.2}, {0.2, 0.3, 0.4});
    body.start.angular_velocity = spin;
    scene.bodies.push_back(body);
    return name;
  }
  if (carrier == "superelement") {
    formats::SuperelementBodySpec body = test_support::superelement_body(name, "frame");
    body.start.angular_velocity = spin;
    scene.bodies.push_back(body);
    return name + "/n2";
  }
  formats::BeamBodySpec beam;
  beam.name = name;
  beam.from = {0.3, -0.2, 0.1};
  beam.to = {1.1, 0.4, -0.3};
  beam.elements = 2;
  beam.section = test::rectangle(0.1, 0.2, 4e-5, 5.0 / 6.0);
  beam.material = test::material(1e5, 0.3, 10.0);
  beam.start.angular_velocity = spin;
  scene.bodies.push_back(beam);
  return name + "/1";
}

/// Two bodies (or one and ground) and the joint between them at the world's origin, away from all nodes.
formats::Scene jointed(JointKind kind, const Pair& pair, bool swapped) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.gravity = {0.4, -0.3, -9.81};
  const bool grounded = pair.a == "ground" || pair.b == "ground";
  const Vector3d spin = grounded ? Vector3d::Zero() : Vector3d(1.0, -2.0, 0.5);
  std::vector<formats::JointSpec> ties;
  const std::string a = add_body(pair.a, "one", spin, scene, ties), b = add_body(pair.b, "two", spin, scene, ties);
  formats::JointSpec spec =
      test_support::joint("j", kind, swapped ? b : a, swapped ? a : b, Vector3d::Zero(), {0.3, 0.5, 1.0});
  test_support::give_own_key(spec, a);
  scene.joints.push_back(spec);
  scene.joints.insert(scene.joints.end(), ties.begin(), ties.end());
  return scene;
}

SuperelementFiles files() {
  SuperelementFiles all;
  test_support::add_file("frame", test_support::test_superelement("frame"), all);
  return all;
}

/// A run in a random valid state (positions moved by up to 0.1, the joint open) with random velocities and multipliers.
struct Opened {
  Simulation run;

  Opened(JointKind kind, const Pair& pair, const SuperelementFiles& files, unsigned seed)
      : run(jointed(kind, pair, false), files) {
    std::mt19937 random(seed);
    State& state = run.state();
    const State before = state;
    retract(run.model(), before, test_support::random_vector_n(random, state.v().size(), 0.1), state);
    state.v() = test_support::random_vector_n(random, state.v().size(), 1.0);
    state.vdot().setZero();
    state.lambda() = test_support::random_vector_n(random, state.lambda().size(), 5.0);
  }
  /// Bᵀλ: the residual less that without multipliers.
  VectorXd reactions(const State& state) {
    evaluate(run.model(), state, run.workspace.now);
    const VectorXd with = run.workspace.now.residual;
    State without = state;
    without.lambda().setZero();
    evaluate(run.model(), without, run.workspace.now);
    return with - run.workspace.now.residual;
  }
  /// Dense [A Bᵀ; B 0], A unscaled.
  MatrixXd matrix(const State& state, const ConstraintRows& rows) {
    evaluate(run.model(), state, run.workspace.now);
    return test_support::dense_matrix(run, state, {{1, 0, 1}, TangentKind::step, rows});
  }
};

class JointBetweenCarriers : public ::testing::TestWithParam<JointKind> {
 protected:
  const SuperelementFiles files_ = files();
};

INSTANTIATE_TEST_SUITE_P(Joints, JointBetweenCarriers, ::testing::ValuesIn(test_support::every_joint()),
                         test_support::joint_test_name);

// Central differences with d = 1e-5 of functions of size one to ten: truncation 1e-10, round-off 1e-10.
TEST_P(JointBetweenCarriers, RowsColumnsAndGeometricStiffnessAreDerivatives) {
  const double d = 1e-5, accuracy = 2e-8;
  for (const Pair& pair : pairs()) {
    SCOPED_TRACE(pair.a + " to " + pair.b);
    Opened opened(GetParam(), pair, files_, 3);
    const Model& model = opened.run.model();
    const int n = model.sizes.boundary, m = model.sizes.constraints, v = model.sizes.velocities();
    const State at = opened.run.state();
    State without = at;
    without.lambda().setZero();
    const MatrixXd A = opened.matrix(at, {}), plain = opened.matrix(without, {});
    const MatrixXd rate = opened.matrix(at, {ConstraintRows::Kind::velocity, 0.5});
    MatrixXd K(n, n), B(m, n), N(m, n);
    for (int j = 0; j < n; ++j) {
      State plus = at, minus = at;
      retract(model, at, d * VectorXd::Unit(v, j), plus);
      retract(model, at, -d * VectorXd::Unit(v, j), minus);
      K.col(j) = opened.reactions(plus) / (2 * d);
      B.col(j) = opened.run.workspace.now.constraint / (2 * d);
      N.col(j) = opened.run.workspace.now.constraint_rate / (2 * d);
      K.col(j) -= opened.reactions(minus) / (2 * d);
      B.col(j) -= opened.run.workspace.now.constraint / (2 * d);
      N.col(j) -= opened.run.workspace.now.constraint_rate / (2 * d);
    }
    EXPECT_LT((A.bottomLeftCorner(m, n) - B).cwiseAbs().maxCoeff(), accuracy);
    EXPECT_LT((A.topRightCorner(n, m) - B.transpose()).cwiseAbs().maxCoeff(), accuracy);
    EXPECT_LT((rate.bottomLeftCorner(m, n) - B - 0.5 * N).cwiseAbs().maxCoeff(), accuracy);
    // Elastic forces of size 1e5 cancel in K: round-off 1e-16 · 1e5/d.
    EXPECT_LT(((A - plain).topLeftCorner(n, n) - K).cwiseAbs().maxCoeff(), 1e-5);
  }
}

// Φ̈ − B v̇ at v̇ = 0 is the change of B v along the motion with constant ẋ and Ω.
TEST_P(JointBetweenCarriers, BiasIsTheChangeOfTheRate) {
  const double h = 1e-5;
  for (const Pair& pair : pairs()) {
    SCOPED_TRACE(pair.a + " to " + pair.b);
    Opened opened(GetParam(), pair, files_, 5);
    const Model& model = opened.run.model();
    const State at = opened.run.state();
    VectorXd change = VectorXd::Zero(model.sizes.constraints);
    for (const double sign : {1.0, -1.0}) {
      State moved = at;
      retract(model, at, sign * h * at.v(), moved);
      evaluate(model, moved, opened.run.workspace.now);
      change += sign * opened.run.workspace.now.constraint_rate / (2 * h);
    }
    evaluate(model, at, opened.run.workspace.now);
    evaluate_bias(model, opened.run.workspace.now);
    EXPECT_LT((opened.run.workspace.now.bias - change).cwiseAbs().maxCoeff(), 2e-8);
  }
}

// The power of the reactions is λ·(B v): none on velocities that the joint admits.
TEST_P(JointBetweenCarriers, ReactionsDoNoWork) {
  for (const Pair& pair : pairs()) {
    SCOPED_TRACE(pair.a + " to " + pair.b);
    Opened opened(GetParam(), pair, files_, 7);
    const State& state = opened.run.state();
    const VectorXd reactions = opened.reactions(state);
    const double power = reactions.dot(state.v().head(reactions.size()));
    EXPECT_NEAR(power, state.lambda().dot(opened.run.workspace.now.constraint_rate), 1e-9);
  }
}

// A rigid motion of the whole world turns Φ of coincident origins and leaves every other equation and the reaction in
// axes of A as they are.
TEST_P(JointBetweenCarriers, RigidMotionOfTheWorldChangesNothing) {
  const Matrix3d Q = exp_so3<double>(Vector3d(1.1, -0.4, 1.9));
  const Vector3d shift(3.0, -2.0, 5.0);
  for (const Pair& pair : pairs()) {
    if (pair.a == "ground" || pair.b == "ground") continue;
    SCOPED_TRACE(pair.a + " to " + pair.b);
    Opened opened(GetParam(), pair, files_, 9);
    const Model& model = opened.run.model();
    const Joint& joint = model.joints.front();
    State turned = opened.run.state();
    for (int i = 0; i < model.sizes.nodes; ++i) {
      turned.x().col(i) = Q * turned.x().col(i) + shift;
      const Eigen::Vector4d q = turned.Q().col(i);
      turned.Q().col(i) = wxyz(Eigen::Quaterniond(Q) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
      const int row = model.nodes[i].translation;
      if (row >= 0) turned.v().segment<3>(row) = (Q * turned.v().segment<3>(row)).eval();
    }
    for (const Joint& one : model.joints)
      if (one.coincident) turned.lambda().segment<3>(one.row) = (Q * turned.lambda().segment<3>(one.row)).eval();
    const auto values = [&](const State& state) {
      evaluate(model, state, opened.run.workspace.now);
      evaluate_bias(model, opened.run.workspace.now);
      VectorXd all(2 * model.sizes.constraints + 6);
      const JointReaction r =
          joint_reaction(joint, motion_of(opened.run.workspace.now, joint.a.node),
                         motion_of(opened.run.workspace.now, joint.b.node), state.lambda().data() + joint.row);
      all << opened.run.workspace.now.constraint, opened.run.workspace.now.bias, r.force, r.moment;
      return all;
    };
    VectorXd before = values(opened.run.state());
    for (const Joint& one : model.joints)
      for (const int first : {0, model.sizes.constraints})
        if (one.coincident) before.segment<3>(first + one.row) = (Q * before.segment<3>(first + one.row)).eval();
    EXPECT_LT((values(turned) - before).cwiseAbs().maxCoeff(), 1e-11);
  }
}

/// World force and moment on B at its origin, from the accelerations at the start.
JointReaction world_reaction(Simulation& run) {
  const Joint& joint = run.model().joints.front();
  evaluate(run.model(), run.state(), run.workspace.now);
  const NodeMotion &a = motion_of(run.workspace.now, joint.a.node), &b = motion_of(run.workspace.now, joint.b.node);
  const JointReaction r = joint_reaction(joint, a, b, run.state().lambda().data() + joint.row);
  const Matrix3d R = marker_rotation(joint.a, a);
  return {R * r.force, R * r.moment};
}

TEST_P(JointBetweenCarriers, SwappingTheBodiesFlipsTheReactions) {
  for (const Pair& pair : pairs()) {
    if (pair.a > pair.b) continue;  // each pair once
    // A fixed joint is then a tie like the body's own: which of them stays a joint depends on the order of the bodies.
    if (GetParam() == JointKind::fixed && pair.b == "virtual follower") continue;
    SCOPED_TRACE(pair.a + " to " + pair.b);
    JointReaction reaction[2];
    for (const bool swapped : {false, true}) {
      Simulation run(jointed(GetParam(), pair, swapped), files_);
      run.start();
      reaction[swapped] = world_reaction(run);
    }
    // Round-off 1e-16 times the condition of a mass matrix with rotary inertias of slender beams, 1e5.
    const double size = reaction[0].force.norm() + reaction[0].moment.norm();
    EXPECT_LT((reaction[0].force + reaction[1].force).norm(), 1e-9 * (1.0 + size));
    EXPECT_LT((reaction[0].moment + reaction[1].moment).norm(), 1e-9 * (1.0 + size));
  }
}

}  // namespace
}  // namespace tisserand::mechanism::joint_carriers_test
