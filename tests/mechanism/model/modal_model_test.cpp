// SPDX-License-Identifier: GPL-3.0-or-later
// Modal bodies inside a whole model: every joint, springs, loads and motions on their nodes, against differences and
// known answers.
#include <random>

#include <gtest/gtest.h>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "mechanism/equations/carriers.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/iteration_matrix.hpp"
#include "tests/support/bodies/modal_known_answers.hpp"
#include "tests/support/bodies/superelement_cases.hpp"
#include "tests/support/scenes/model_tangent.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::modal_model_test {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::JointKind;
using test_support::random_vector_n;
using test_support::relative_difference;
using test_support::to_matrix;
using test_support::to_vector;

BodyFiles known_files() {
  const nlohmann::json answers = test_support::modal_answers();
  BodyFiles files;
  for (const char* reference : {"node_fixed", "mean_axis"})
    files.modal_bodies[reference].body = test_support::known_body(answers, reference);
  return files;
}

/// Two modal bodies and a rigid one; joints of every kind, between a modal node and ground, a rigid body, the other
/// modal body and another node of the same body, in turn.
formats::Scene everything_on_modal_nodes() {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.gravity = {0.3, -2.0, -9.81};
  scene.bodies.push_back(test_support::modal_spec("F", "node_fixed"));
  formats::ModalBodySpec other = test_support::modal_spec("G", "mean_axis");
  other.damping = {.mass = 0.1, .stiffness = 1e-3, .ratio = 0.02, .ratios = {}};
  other.start.pose.position = {0.5, 1.5, -0.4};
  scene.bodies.push_back(other);
  scene.bodies.push_back(test_support::rigid_body("block", 2.0, {1.6, 1.0, 0.7}, {0.3, 0.4, 0.5}));
  const std::string partners[] = {"ground", "block", "G/n2", "F/n5"};
  int number = 0;
  for (int kind = 0; kind <= static_cast<int>(JointKind::generic); ++kind) {
    const std::string name = "j" + std::to_string(number);
    formats::JointSpec joint = test_support::joint(name, static_cast<JointKind>(kind), partners[number % 4], "F/n3",
                                                   {0.2, 0.4, -0.1}, {1, 2, 3});
    joint.hold = {true, false, true, true, false, true};
    joint.pitch = 0.3;
    if (joint.kind == JointKind::distance) {
      joint.position.reset();
      joint.axis.reset();
    }
    if (number % 2 == 1) std::swap(joint.a, joint.b);
    scene.joints.push_back(joint);
    ++number;
  }
  const auto coordinate = [](const char* name) { return formats::CoordinateRef{name, ""}; };
  scene.gears.push_back({"gear", coordinate("j1"), coordinate("j5/angle"), -1.7, ""});
  scene.motions.push_back({"drive", coordinate("j1"), formats::TimeExpression{"0.3*t*t", {}, ""}, ""});
  formats::SpringSpec along, between;
  along.name = "along";
  along.coordinate = coordinate("j5/z");
  between.name = "between";
  between.a.node = "F/n4";
  between.a.position = Vector3d(0.1, 0.3, 0.2);
  between.b.node = "G/n1";
  for (formats::SpringSpec* spring : {&along, &between}) {
    spring->stiffness = 30.0;
    spring->damping = 2.0;
    spring->free = 0.4;
    scene.springs.push_back(*spring);
  }
  using formats::LoadKind;
  scene.loads = {test_support::constant_load("f1", LoadKind::force, "F/n4", {1, 2, 3}),
                 test_support::constant_load("m1", LoadKind::moment, "F/n2", {3, -2, 1}),
                 test_support::constant_load("f2", LoadKind::force, "G/n5", {-1, 5, 2}),
                 test_support::constant_load("m2", LoadKind::moment, "G/n1", {0.5, 1, -2})};
  scene.loads[2].at.position = Vector3d(0.2, 0.3, -0.4);
  scene.loads[2].axes = scene.loads[3].axes = formats::LoadAxes::body;
  return scene;
}

/// The scene in a random deformed and moving state that no joint is met in.
struct Everything {
  test_support::Simulation run{everything_on_modal_nodes(), known_files()};

  Everything() {
    std::mt19937 random(4);
    State& state = run.state();
    const State before = state;
    retract(run.model(), before, random_vector_n(random, state.v().size(), 0.1), state);
    state.v() = random_vector_n(random, state.v().size(), 1.0);
    state.vdot() = random_vector_n(random, state.v().size(), 1.0);
    state.lambda() = random_vector_n(random, state.lambda().size(), 5.0);
    state.time() = state.load_time() = 0.4;
  }
  void at(const State& state) { evaluate(run.model(), state, run.workspace.now); }
  VectorXd residual(const State& state) {
    at(state);
    return run.workspace.now.residual;
  }
  /// Dense [A Bᵀ; B 0], A unscaled, at the state of the run.
  MatrixXd matrix(const TangentCoefficients& c, const ConstraintRows& rows) {
    evaluate_in_step(run.model(), run.state(), run.workspace.now);
    return test_support::dense_matrix(run, {c, TangentKind::step, rows});
  }
  int n() const { return run.model().sizes.boundary; }
  int m() const { return run.model().sizes.constraints; }
};

TEST(ModalModel, CoordinatesAreThoseOfTheFramesAndModes) {
  const Everything e;
  EXPECT_EQ(e.n(), 6 * 3 + 2 * 3);
  EXPECT_EQ(e.run.model().sizes.modal, 6);
  EXPECT_EQ(coordinate_name(e.run.model(), 18), "F, mode 1");
  EXPECT_EQ(coordinate_name(e.run.model(), 23), "G, mode 3");
}

// The residual is at most quadratic in v and linear in v̇: central differences have no truncation error.
TEST(ModalModel, MassAndDampingAreDerivativesOfTheResidual) {
  Everything e;
  const int n = e.n();
  MatrixXd M(n, n), C(n, n);
  for (int j = 0; j < n; ++j) {
    State plus = e.run.state(), minus = plus;
    plus.vdot()[j] += 0.5;
    minus.vdot()[j] -= 0.5;
    M.col(j) = e.residual(plus) - e.residual(minus);
    plus = minus = e.run.state();
    plus.v()[j] += 0.5;
    minus.v()[j] -= 0.5;
    C.col(j) = e.residual(plus) - e.residual(minus);
  }
  EXPECT_LT(relative_difference(e.matrix({1, 0, 0}, {}).topLeftCorner(n, n), M), 1e-11);
  EXPECT_LT(relative_difference(e.matrix({1, 1, 0}, {}).topLeftCorner(n, n), M + C), 1e-11);
}

// Central differences, d = 1e-5: truncation d² = 1e-10 of terms of order one to a hundred.
TEST(ModalModel, StiffnessAndRowsAreDerivativesOfResidualAndConstraints) {
  Everything e;
  const Model& model = e.run.model();
  const int n = e.n(), m = e.m();
  const double d = 1e-5;
  MatrixXd K(n, n), B(m, n), N(m, n);
  const State at = e.run.state();
  for (int j = 0; j < n; ++j) {
    State plus = at, minus = at;
    retract(model, at, d * VectorXd::Unit(n, j), plus);
    retract(model, at, -d * VectorXd::Unit(n, j), minus);
    K.col(j) = e.residual(plus) / (2 * d);
    B.col(j) = e.run.workspace.now.constraint / (2 * d);
    N.col(j) = e.run.workspace.now.constraint_rate / (2 * d);
    K.col(j) -= e.residual(minus) / (2 * d);
    B.col(j) -= e.run.workspace.now.constraint / (2 * d);
    N.col(j) -= e.run.workspace.now.constraint_rate / (2 * d);
  }
  const MatrixXd A = e.matrix({0, 0, 1}, {});
  EXPECT_LT(relative_difference(A.topLeftCorner(n, n), K), 1e-8);
  EXPECT_LT(relative_difference(A.bottomLeftCorner(m, n), B), 1e-8);
  EXPECT_LT(relative_difference(A.topRightCorner(n, m), B.transpose()), 1e-8);
  const MatrixXd rate = e.matrix({0, 0, 1}, {ConstraintRows::Kind::velocity, 0.5});
  EXPECT_LT(relative_difference(rate.bottomLeftCorner(m, n), B + 0.5 * N), 1e-8);
}

// Φ̇ = B v + Φ_t, and Φ̈ = B v̇ + bias, along a trajectory on which modes, frames and drives move.
TEST(ModalModel, RatesAndBiasAreTimeDerivativesOfTheConstraints) {
  Everything e;
  const State at = e.run.state();
  const auto along = [&](double t) {
    State moved = at;
    retract(e.run.model(), at, VectorXd(t * at.v() + 0.5 * t * t * at.vdot()), moved);
    moved.v() = at.v() + t * at.vdot();
    moved.time() += t;
    e.at(moved);
  };
  const double h = 1e-5;
  along(h);
  VectorXd rate = e.run.workspace.now.constraint / (2 * h), second = e.run.workspace.now.constraint_rate / (2 * h);
  along(-h);
  rate -= e.run.workspace.now.constraint / (2 * h);
  second -= e.run.workspace.now.constraint_rate / (2 * h);
  const MatrixXd B = e.matrix({0, 0, 1}, {}).bottomLeftCorner(e.m(), e.n());
  evaluate_bias(e.run.model(), e.run.workspace.now);
  EXPECT_LT(relative_difference(e.run.workspace.now.constraint_rate, rate), 1e-8);
  EXPECT_LT(relative_difference(B * at.vdot() + e.run.workspace.now.bias, second), 1e-8);
}

// Rows for increments of the rotation vector of the step: derivatives of Φ(retract(from, θ)) at θ = displacement.
TEST(ModalModel, PositionRowsAreDerivativesByTheRotationVectorOfTheStep) {
  Everything e;
  const Model& model = e.run.model();
  const int n = e.n(), m = e.m();
  std::mt19937 random(9);
  const State from = e.run.state();
  const VectorXd displacement = random_vector_n(random, n, 0.5);
  MatrixXd B(m, n);
  const double d = 1e-5;
  for (int j = 0; j < n; ++j) {
    State plus = from, minus = from;
    retract(model, from, displacement + d * VectorXd::Unit(n, j), plus);
    retract(model, from, displacement - d * VectorXd::Unit(n, j), minus);
    e.at(plus);
    B.col(j) = e.run.workspace.now.constraint / (2 * d);
    e.at(minus);
    B.col(j) -= e.run.workspace.now.constraint / (2 * d);
  }
  retract(model, from, displacement, e.run.state());
  e.run.workspace.now.displacement = displacement;
  const MatrixXd A = e.matrix({0, 0, 1}, {ConstraintRows::Kind::position, 0.0});
  EXPECT_LT(relative_difference(A.bottomLeftCorner(m, n), B), 1e-8);
  const VectorXd direction = random_vector_n(random, n, 1.0);
  VectorXd product(m);
  apply_jacobian(model, e.run.workspace.now, direction, product);
  EXPECT_LT(relative_difference(product, A.bottomLeftCorner(m, n) * direction), 1e-13);
}

TEST(ModalModel, PowerOfTheResidualIsTheRateOfEnergyAndLossesMinusThePowerOfLoads) {
  Everything e;
  State& state = e.run.state();
  state.lambda().setZero();
  const VectorXd r = e.residual(state);
  const double power = e.run.workspace.now.load_power, loss = e.run.workspace.now.damper_power;
  const auto energy_at = [&](double t) {
    State moved = state;
    retract(e.run.model(), state, VectorXd(t * state.v() + 0.5 * t * t * state.vdot()), moved);
    moved.v() = state.v() + t * state.vdot();
    e.at(moved);
    return evaluate_energy(e.run.model(), e.run.workspace.now).total();
  };
  const double h = 1e-5, rate = (energy_at(h) - energy_at(-h)) / (2 * h);
  EXPECT_GT(loss, 0.01);
  EXPECT_NEAR(r.dot(state.v()), rate + loss - power, 1e-7 * std::abs(rate));
}

// The modal body F with a force and a moment on node 4, and B on a spherical joint at a follower of node 5: the same
// accelerations and multipliers as the independent program, which solved it with and without a virtual body between.
TEST(ModalModel, AccelerationsAndMultipliersAreTheKnownAnswers) {
  const nlohmann::json answers = test_support::modal_answers();
  const nlohmann::json &kkt = answers.at("kkt"), &eliminated = kkt.at("eliminated");
  BodyFiles files = known_files();
  files.modal_bodies["node_fixed"].body.zeta = to_vector(kkt.at("modal_damping_ratio"));
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.gravity = to_vector(kkt.at("gravity"));
  scene.bodies.push_back(test_support::modal_spec("F", "node_fixed"));
  formats::RigidBodySpec ball =
      test_support::rigid_body("B", kkt.at("B").at("mass").get<double>(), Vector3d::Zero(), Vector3d::Ones());
  ball.inertia = to_matrix(kkt.at("B").at("J"));
  scene.bodies.push_back(ball);
  formats::JointSpec joint;
  joint.name = "ball";
  joint.a.node = "B";
  joint.a.position = Vector3d(to_vector(kkt.at("spherical_point_B")));
  joint.b.node = "F/n5";
  joint.b.position = Vector3d(to_vector(eliminated.at("p")));
  joint.axis = Vector3d::UnitZ();
  scene.joints.push_back(joint);
  using formats::LoadKind;
  const nlohmann::json& nodal = kkt.at("nodal_force");
  scene.loads = {test_support::constant_load("f", LoadKind::force, "F/n4", to_vector(nodal.at("force_global"))),
                 test_support::constant_load("m", LoadKind::moment, "F/n4", to_vector(nodal.at("moment_global"))),
                 test_support::constant_load("F", LoadKind::force, "B", to_vector(kkt.at("B_force_global"))),
                 test_support::constant_load("M", LoadKind::moment, "B", to_vector(kkt.at("B_torque_local")))};
  scene.loads[3].axes = formats::LoadAxes::body;
  test_support::Simulation run(scene, files);

  State& state = run.state();
  const test_support::ModalState known = test_support::known_modal_state(answers);
  const auto place = [&](const std::string& name, const Vector3d& x, const Matrix3d& R, const Vector3d& xd,
                         const Vector3d& Omega) {
    const int node = run.node(name);
    state.x().col(node) = x;
    state.Q().col(node) = wxyz(Eigen::Quaterniond(R));
    state.v().segment<3>(run.model().nodes[node].translation) = xd;
    state.v().segment<3>(run.model().nodes[node].rotation) = Omega;
  };
  place("F", known.frame.x, known.frame.R, known.frame.xd, known.frame.Omega);
  place("B", to_vector(kkt.at("B").at("r")), to_matrix(kkt.at("B").at("A")), to_vector(kkt.at("B").at("rdot")),
        to_vector(kkt.at("B").at("omega")));
  state.w() = known.w;
  state.v().tail(3) = known.wd;
  evaluate(run.model(), state, run.workspace.now);
  EXPECT_LT(run.workspace.now.constraint.norm(), 1e-14);
  EXPECT_LT(run.workspace.now.constraint_rate.norm(), 1e-14);
  ASSERT_FALSE(solve_accelerations(run.model(), 1e-3, "", state, run.workspace));
  // Order of the file: F with its modes, then B; here the modes come last.
  const VectorXd file = to_vector(eliminated.at("vdot"));
  VectorXd expected(15);
  expected << file.head(6), file.tail(6), file.segment(6, 3);
  EXPECT_LT(relative_difference(state.vdot(), expected), 1e-11);
  const Vector3d lambda = to_vector(eliminated.at("lambda"));
  EXPECT_LT(std::min(relative_difference(state.lambda(), lambda), relative_difference(state.lambda(), -lambda)), 1e-11);
  evaluate(run.model(), state, run.workspace.now);
  EXPECT_LT(run.workspace.now.residual.norm(), 1e-12);
}

TEST(ModalModel, NodesWithoutRotationsRefuseWhatNeedsThem) {
  BodyFiles files = known_files();
  formats::ModalBody& body = files.modal_bodies["node_fixed"].body;
  body.X[3].bottomRows<3>().setZero();
  const auto scene_with = [](JointKind kind) {
    formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
    scene.bodies.push_back(test_support::modal_spec("F", "node_fixed"));
    scene.joints.push_back(test_support::joint("j", kind, "ground", "F/n4", {0, 0, 0}, {0, 0, 1}));
    scene.joints[0].position.reset();
    return scene;
  };
  EXPECT_NO_THROW(build_model(scene_with(JointKind::spherical), files));
  EXPECT_THROW(build_model(scene_with(JointKind::revolute), files), Error);
}

}  // namespace
}  // namespace tisserand::mechanism::modal_model_test
