// SPDX-License-Identifier: GPL-3.0-or-later
// The one door: residual, tangents and constraint rows of a scene that holds one of everything, against differences.
#include "mechanism/model/model.hpp"

#include <map>

#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/iteration_matrix.hpp"
#include "tests/support/bodies/beam_states.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/bodies/superelement_cases.hpp"
#include "tests/support/bodies/uncondensed_tangent.hpp"
#include "tests/support/scenes/model_tangent.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::model_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using test_support::random_vector;

/// Superelement, two-node and three-node beams, rigid body, all joints, all loads, gravity; no internal modes, so that
/// the matrix is not condensed.
formats::Scene mixed_scene() {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.gravity = {0.3, -2.0, -9.81};
  scene.bodies.push_back(test_support::superelement_body("frame", "guyan"));
  scene.bodies.push_back(test_support::rigid_body("block", 2.0, {1.6, 1.0, 0.7}, {0.3, 0.4, 0.5}));
  for (const int nodes : {2, 3}) {
    formats::BeamBodySpec beam;
    beam.name = nodes == 2 ? "beam2" : "beam3";
    beam.from = nodes == 2 ? Vector3d(1.5, 1.0, 0.7) : Vector3d(0, 0, 0);
    beam.to = nodes == 2 ? Vector3d(2.5, 1.0, 0.7) : Vector3d(-1, 0.2, 0);
    beam.elements = 2;
    beam.nodes_per_element = nodes;
    beam.section = test::rectangle(0.1, 0.2, 4e-5, 5.0 / 6.0);
    beam.material = test::material(1e5, 0.3, 10.0);
    scene.bodies.push_back(beam);
  }
  using formats::JointKind;
  scene.joints = {test_support::joint("fixed", JointKind::fixed, "frame/n5", "block", {1.5, 1.0, 0.7}, {1, 2, 3}),
                  test_support::joint("hinge", JointKind::revolute, "block", "beam2/start", {1.5, 1.0, 0.7}, {0, 1, 1}),
                  test_support::joint("ball", JointKind::spherical, "frame/n0", "beam3/start", {0, 0, 0}, {0, 0, 1})};
  using formats::LoadKind;
  scene.loads = {test_support::constant_load("f1", LoadKind::force, "beam2/end", {1, 2, 3}),
                 test_support::constant_load("m1", LoadKind::moment, "frame/n2", {3, -2, 1}),
                 test_support::constant_load("f2", LoadKind::force, "block", {-1, 5, 2}),
                 test_support::constant_load("m2", LoadKind::moment, "beam3/1", {0.5, 1, -2})};
  scene.loads[2].at.position = Vector3d(0.2, 0.3, -0.4);
  scene.loads[2].axes = scene.loads[3].axes = formats::LoadAxes::body;
  return scene;
}

/// The mixed scene in a random deformed and moving state, with random multipliers.
struct Mixed {
  SuperelementFiles files;
  test_support::Simulation run;

  static SuperelementFiles make_files() {
    SuperelementFiles files;
    test_support::add_file("guyan", test_support::test_superelement("guyan"), files);
    return files;
  }
  Mixed() : files(make_files()), run(mixed_scene(), files) {
    std::mt19937 random(4);
    State& state = run.state();
    const State before = state;
    retract(run.model(), before, test_support::random_vector_n(random, state.v().size(), 0.03), state);
    state.v() = test_support::random_vector_n(random, state.v().size(), 1.0);
    state.vdot() = test_support::random_vector_n(random, state.v().size(), 1.0);
    state.lambda() = test_support::random_vector_n(random, state.lambda().size(), 5.0);
  }
  VectorXd residual(const State& state) {
    evaluate(run.model(), state, run.workspace.now);
    return run.workspace.now.residual;
  }
  /// Dense [A Bᵀ; B 0], A unscaled.
  MatrixXd matrix(const TangentCoefficients& c, TangentKind kind, const ConstraintRows& rows) {
    evaluate_in_step(run.model(), run.state(), run.workspace.now);
    return test_support::dense_matrix(run, {c, kind, rows});
  }
};

/// Largest difference of columns, relative to the largest entry of the column block.
double difference(const MatrixXd& a, const MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

// Central differences: the residual is at most quadratic in v and linear in v̇, so the differences have no truncation
// error.
TEST(MixedScene, MassAndDampingAreDerivativesOfTheResidual) {
  Mixed mixed;
  const int n = mixed.run.model().sizes.boundary;
  MatrixXd M(n, n), C(n, n);
  for (int j = 0; j < n; ++j) {
    State plus = mixed.run.state(), minus = plus;
    plus.vdot()[j] += 0.5;
    minus.vdot()[j] -= 0.5;
    M.col(j) = mixed.residual(plus) - mixed.residual(minus);
    plus = minus = mixed.run.state();
    plus.v()[j] += 0.5;
    minus.v()[j] -= 0.5;
    C.col(j) = mixed.residual(plus) - mixed.residual(minus);
  }
  for (const TangentKind kind : {TangentKind::step, TangentKind::exact}) {
    EXPECT_LT(difference(mixed.matrix({1, 0, 0}, kind, {}).topLeftCorner(n, n), M), 1e-11);
    EXPECT_LT(difference(mixed.matrix({1, 1, 0}, kind, {}).topLeftCorner(n, n), M + C), 1e-11);
  }
}

TEST(MixedScene, ExactStiffnessIsTheDerivativeOfTheResidualAndConstraintRowsOfTheConstraints) {
  Mixed mixed;
  const Model& model = mixed.run.model();
  const int n = model.sizes.boundary, m = model.sizes.constraints;
  const double d = 1e-5;  // truncation d² = 1e-10, round-off 1e-11 of stiff forces
  MatrixXd K(n, n), B(m, n), N(m, n);
  for (int j = 0; j < n; ++j) {
    const State at = mixed.run.state();
    State plus = at, minus = at;
    retract(model, at, d * VectorXd::Unit(n, j), plus);
    retract(model, at, -d * VectorXd::Unit(n, j), minus);
    K.col(j) = mixed.residual(plus) / (2 * d);
    B.col(j) = mixed.run.workspace.now.constraint / (2 * d);
    N.col(j) = mixed.run.workspace.now.constraint_rate / (2 * d);
    K.col(j) -= mixed.residual(minus) / (2 * d);
    B.col(j) -= mixed.run.workspace.now.constraint / (2 * d);
    N.col(j) -= mixed.run.workspace.now.constraint_rate / (2 * d);
  }
  const MatrixXd A = mixed.matrix({0, 0, 1}, TangentKind::exact, {});
  EXPECT_LT(difference(A.topLeftCorner(n, n), K), 1e-8);
  EXPECT_LT(difference(A.bottomLeftCorner(m, n), B), 1e-8);
  EXPECT_LT(difference(A.topRightCorner(n, m), B.transpose()), 1e-8);
  EXPECT_TRUE(A.bottomRightCorner(m, m).isZero(0.0));
  const MatrixXd rate = mixed.matrix({0, 0, 1}, TangentKind::exact, {ConstraintRows::Kind::velocity, 0.5});
  EXPECT_LT(difference(rate.bottomLeftCorner(m, n), B + 0.5 * N), 1e-8);
}

// Rows for increments of the rotation vector of the step: the derivative of Φ(retract(from, θ)) at θ = displacement.
TEST(MixedScene, PositionRowsAreDerivativesByTheRotationVectorOfTheStep) {
  Mixed mixed;
  const Model& model = mixed.run.model();
  const int n = model.sizes.boundary, m = model.sizes.constraints;
  std::mt19937 random(9);
  const State from = mixed.run.state();
  const VectorXd displacement = test_support::random_vector_n(random, n, 0.8);
  MatrixXd B(m, n);
  const double d = 1e-5;
  for (int j = 0; j < n; ++j) {
    State plus = from, minus = from;
    retract(model, from, displacement + d * VectorXd::Unit(n, j), plus);
    retract(model, from, displacement - d * VectorXd::Unit(n, j), minus);
    mixed.residual(plus);
    B.col(j) = mixed.run.workspace.now.constraint / (2 * d);
    mixed.residual(minus);
    B.col(j) -= mixed.run.workspace.now.constraint / (2 * d);
  }
  retract(model, from, displacement, mixed.run.state());
  mixed.run.workspace.now.displacement = displacement;
  const MatrixXd A = mixed.matrix({0, 0, 1}, TangentKind::step, {ConstraintRows::Kind::position, 0.0});
  EXPECT_LT(difference(A.bottomLeftCorner(m, n), B), 1e-8);
}

// One whole Newton step: eliminated inside the element against the uncondensed system assembled here, index 3, both
// kinds of tangent. Iterates to 1e-12 of their largest component.
TEST(Condensation, NewtonStepOfTheWholeSystemEqualsTheUncondensedOne) {
  SuperelementFiles files;
  test_support::add_file("frame", test_support::test_superelement("frame"), files);
  for (const formats::InertiaOption option : {formats::InertiaOption::A, formats::InertiaOption::B})
    for (const TangentKind kind : {TangentKind::step, TangentKind::exact}) {
      formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
      scene.gravity = {0.3, -2.0, -9.81};
      formats::SuperelementBodySpec spec = test_support::superelement_body("frame", "frame");
      spec.inertia = option;
      spec.damping = {.mass = 0.1, .stiffness = 1e-3, .ratio = 0.02, .ratios = {}};
      scene.bodies.push_back(spec);
      scene.joints.push_back(test_support::joint("hinge", formats::JointKind::revolute, "ground", "frame/n0",
                                                 Vector3d::Zero(), {0, 0, 1}));
      test_support::Simulation run(scene, files);
      const Model& model = run.model();
      std::mt19937 random(4);
      State& state = run.state();
      const State before = state;
      retract(model, before, test_support::random_vector_n(random, state.v().size(), 0.03), state);
      state.v() = test_support::random_vector_n(random, state.v().size(), 1.0);
      state.vdot() = test_support::random_vector_n(random, state.v().size(), 1.0);
      state.lambda() = test_support::random_vector_n(random, state.lambda().size(), 5.0);
      evaluate(model, state, run.workspace.now);

      const TangentCoefficients c{4e4, 2e2, 1.0};
      const int nb = model.sizes.boundary, n = model.sizes.velocities(), m = model.sizes.constraints;
      MatrixXd whole = MatrixXd::Zero(n + m, n + m), element;
      test_support::uncondensed_tangent(body_of(model, 0), run.workspace.now.superelements[0],
                                        nodes_of(model, 0, run.workspace.now), scene.gravity, c, kind, element);
      whole.topLeftCorner(n, n) = element;  // the only body: its coordinates are the global ones in order
      Eigen::Matrix<double, 12, 12> K;
      const Joint& joint = model.joints[0];
      joint_stiffness(joint, NodeMotion{}, run.workspace.now.motion[joint.b.node], state.lambda().data(), K);
      whole.topLeftCorner(6, 6) += c.stiffness * K.bottomRightCorner(6, 6);
      whole.block(n, 0, m, 6) = run.workspace.now.joints[0].B.topRightCorner(m, 6);
      whole.block(0, n, 6, m) = run.workspace.now.joints[0].B.topRightCorner(m, 6).transpose();
      VectorXd right(n + m);
      right << -run.workspace.now.residual, -run.workspace.now.superelements[0].forces.r_I,
          -run.workspace.now.constraint;
      const double s = 1e5;  // rows of constraints and multipliers scaled, so that the reference is accurate
      whole.bottomRows(m) *= s;
      right.tail(m) *= s;
      whole.rightCols(m) *= s;
      VectorXd expected = whole.fullPivLu().solve(right);
      expected.tail(m) *= s;

      ASSERT_TRUE(run.workspace.matrix.factor(model, state, {c, kind, {}}, run.workspace.now).regular);
      const VectorXd rows = -run.workspace.now.constraint;
      run.workspace.matrix.solve_increment(model, rows, run.workspace.now);
      ASSERT_EQ(run.workspace.matrix.increment.size(), n);
      ASSERT_GT(n, nb);
      EXPECT_LT(test_support::relative_difference(run.workspace.matrix.increment, expected.head(n)), 1e-12);
      EXPECT_LT(test_support::relative_difference(run.workspace.matrix.multipliers, expected.tail(m)), 1e-12);
    }
}

TEST(Names, OfCoordinatesAndConstraints) {
  Mixed mixed;
  const Model& model = mixed.run.model();
  EXPECT_EQ(coordinate_name(model, 0), "frame/n0, translation x");
  EXPECT_EQ(coordinate_name(model, 22), "block, rotation about its y axis");
  EXPECT_EQ(constraint_name(model, 7), "hinge, translation y");
  EXPECT_EQ(constraint_name(model, 9), "hinge, z axis of B normal to x axis of A");
}

// Sums over the pools: the rate of the total energy is the power of the loads minus nothing else, on free motion (no
// joints act, since the state here is open): evaluated as v · r with the loads' part.
TEST(MixedScene, PowerOfTheResidualIsTheRateOfEnergyMinusThePowerOfLoads) {
  Mixed mixed;
  State& state = mixed.run.state();
  state.lambda().setZero();
  const VectorXd r = mixed.residual(state);
  const double power = mixed.run.workspace.now.load_power;
  const double h = 1e-5;
  const auto energy_at = [&](double t) {
    State moved = state;
    retract(mixed.run.model(), state, VectorXd(t * state.v() + 0.5 * t * t * state.vdot()), moved);
    moved.v() = state.v() + t * state.vdot();
    evaluate(mixed.run.model(), moved, mixed.run.workspace.now);
    return evaluate_energy(mixed.run.model(), mixed.run.workspace.now).total();
  };
  const double rate = (energy_at(h) - energy_at(-h)) / (2 * h);
  EXPECT_GT(std::abs(rate), 1.0);
  EXPECT_NEAR(r.dot(state.v()), rate - power, 1e-6 * std::abs(rate));
}

// Internal coordinates are condensed with blocks that stay in the evaluation: factors end with them, whoever made
// others.
TEST(MixedScene, AnotherTangentEndsTheFactors) {
  Mixed mixed;
  Workspace& workspace = mixed.run.workspace;
  const TangentRequest request{{100.0, 10.0, 1.0}, TangentKind::step, {}};
  evaluate(mixed.run.model(), mixed.run.state(), workspace.now);
  ASSERT_TRUE(workspace.matrix.factor(mixed.run.model(), mixed.run.state(), request, workspace.now).regular);
  EXPECT_TRUE(workspace.matrix.serves(request, workspace.now));
  EXPECT_FALSE(workspace.matrix.serves({{50.0, 10.0, 1.0}, TangentKind::step, {}}, workspace.now));
  evaluate(mixed.run.model(), mixed.run.state(), workspace.now);
  EXPECT_TRUE(workspace.matrix.serves(request, workspace.now));
  MatrixValues other(mixed.run.model());
  evaluate_tangent(mixed.run.model(), mixed.run.state(), {{1.0, 0.0, 0.0}, TangentKind::step, {}}, workspace.now,
                   other);
  EXPECT_FALSE(workspace.matrix.serves(request, workspace.now));
}

}  // namespace
}  // namespace tisserand::mechanism::model_test
