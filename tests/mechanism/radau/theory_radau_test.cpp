// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas (73) to (77) of docs/THEORY.md, written down once more as they stand there and compared with the stages of a
// step, its error estimate and its projection.
#include <cmath>
#include <complex>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/radau/radau.hpp"
#include "tests/support/bodies/theory_motion.hpp"
#include "tests/support/scenes/model_tangent.hpp"

namespace tisserand::mechanism::theory_radau_test {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using test_support::relative_difference;
using test_support::Simulation;
namespace theory = test_support::theory;

/// A of collocation at the stages of Radau IIA: a_ij integrates polynomials of degree two from 0 to c_i exactly.
Matrix3d collocation() {
  const Vector3d c(0.4 - 0.1 * std::sqrt(6.0), 0.4 + 0.1 * std::sqrt(6.0), 1.0);
  Matrix3d values, integrals;
  for (int k = 0; k < 3; ++k) {
    values.col(k) = c.array().pow(k);
    integrals.col(k) = c.array().pow(k + 1) / (k + 1.0);
  }
  return integrals * values.inverse();
}

/// Two rods on spherical joints that move in space.
formats::Scene rods() {
  formats::Scene scene = test_support::empty_scene(0.02, 1.0);
  scene.gravity = {0, 0, -9.81};
  std::string before = "ground";
  for (int i = 0; i < 2; ++i) {
    formats::RigidBodySpec rod =
        test_support::rigid_body(i == 0 ? "one" : "two", 1.0 + i, Vector3d::Zero(), {0.01, 1.0 / 12.0, 1.0 / 10.0});
    rod.start.pose.position = {0.5 + i, 0, 0};
    if (i == 1) rod.start.angular_velocity = {3.0, 1.0, 2.0};
    scene.bodies.push_back(rod);
    scene.joints.push_back(test_support::joint("joint" + std::to_string(i), formats::JointKind::spherical, before,
                                               rod.name, {1.0 * i, 0, 0}, Vector3d::UnitZ()));
    before = rod.name;
  }
  return scene;
}

class TheoryRadau : public ::testing::Test {
 protected:
  void SetUp() override {
    run_.start();
    workspace_.memory.previous.block() = run_.state().block();
    evaluate(model_, run_.state(), workspace_.now);
    newton_.renew(run_.state(), workspace_.now);
    StepReport report;
    ASSERT_TRUE(newton_.ready(h, report));
    radau::predict(model_, run_.state(), {h, h}, radau::Stages(model_.sizes), stages_);
    radau::Accuracy accuracy;
    accuracy.units.tolerance = 1e-13;
    accuracy.most_iterations = 40;
    accuracy.multipliers = 1e-10;
    accuracy.fresh_parts = true;
    State state = run_.state();
    ASSERT_TRUE(newton_.iterate(accuracy, stages_, state, workspace_, report));
  }
  const State& begin() const { return workspace_.memory.previous; }
  /// [A, rows] of a request at the start.
  MatrixXd matrix(const TangentRequest& request) {
    evaluate(model_, begin(), run_.workspace.now);
    return test_support::dense_matrix(run_, begin(), request);
  }
  MatrixXd part(const TangentCoefficients& c) {
    const int n = model_.sizes.boundary;
    return matrix({c, TangentKind::step, {}}).topLeftCorner(n, n);
  }

  static constexpr double h = 0.02;
  Simulation run_{rods(), {}};
  const Model& model_ = run_.model();
  Workspace workspace_{model_};
  radau::Newton newton_{model_};
  radau::Stages stages_{model_.sizes};
};

// (73), (74)
TEST_F(TheoryRadau, Stages) {
  const Matrix3d A = collocation(), w = A.inverse();
  EXPECT_LT((A - radau::coefficients().A).norm(), 1e-14);
  MatrixXd rate = stages_.d * w.transpose() / h;
  for (int i = 0; i < 3; ++i)
    for (const Node& node : model_.nodes) {
      auto turn = rate.col(i).segment<3>(node.rotation);
      turn = (theory::tangent(stages_.d.col(i).segment<3>(node.rotation)) * turn).eval();
    }
  EXPECT_LT(relative_difference(stages_.v, rate), 1e-12);
  const MatrixXd from_start = stages_.v.colwise() - begin().v();
  EXPECT_LT(relative_difference(stages_.a, from_start * w.transpose() / h), 1e-12);
  for (int i = 0; i < 3; ++i) {
    State state = begin();
    retract(model_, begin(), stages_.d.col(i), state);
    state.v() = stages_.v.col(i);
    state.vdot() = stages_.a.col(i);
    state.lambda() = stages_.lambda.col(i);
    state.time() = state.load_time() = radau::coefficients().c[i] * h;
    evaluate(model_, state, workspace_.now);
    EXPECT_LT(workspace_.now.residual.norm(), 1e-8 * workspace_.now.force_scale[0]) << i;
    EXPECT_LT(workspace_.now.constraint_rate.norm(), 1e-11) << i;
  }
}

// (76), (77): what the real matrix makes of the error.
TEST_F(TheoryRadau, ErrorEstimate) {
  const radau::Coefficients& method = radau::coefficients();
  const int n = model_.sizes.boundary, rows = model_.sizes.constraints;
  const double omega = method.gamma / h;
  newton_.estimate(stages_, begin());
  const VectorXd error = newton_.correction;
  const MatrixXd M = part({1, 0, 0}), C = part({0, 1, 0}), K = part({0, 0, 1});
  const MatrixXd B = matrix({{1, 0, 0}, TangentKind::step, {}}).bottomLeftCorner(rows, n);
  const MatrixXd B_omega =
      matrix({{1, 0, 0}, TangentKind::step, {ConstraintRows::Kind::velocity, 1.0 / omega}}).bottomLeftCorner(rows, n);
  EXPECT_GT((B_omega - B).norm(), 1e-3);
  const VectorXd e_q = begin().v() / omega + stages_.d * method.e;
  const VectorXd e_v = begin().vdot() / omega + (stages_.v.colwise() - begin().v()) * method.e;
  MatrixXd system = MatrixXd::Zero(n + rows, n + rows);
  system << omega * omega * M + omega * C + K, B.transpose(), B_omega, MatrixXd::Zero(rows, rows);
  VectorXd right(n + rows);
  right << omega * omega * M * e_q + omega * (M * e_v + C * e_q), B * e_q;
  EXPECT_LT(relative_difference(error, system.partialPivLu().solve(right).head(n)), 1e-7);  // e_q nearly cancels
}

// (75): changes of the projection have the weight A_ω, and close what they are asked to.
TEST_F(TheoryRadau, Projection) {
  const int n = model_.sizes.boundary, rows = model_.sizes.constraints;
  const double omega = radau::coefficients().gamma / h;
  const MatrixXd A = omega * omega * part({1, 0, 0}) + omega * part({0, 1, 0}) + part({0, 0, 1});
  const MatrixXd B = matrix({{1, 0, 0}, TangentKind::step, {}}).bottomLeftCorner(rows, n);
  State state = begin();
  retract(model_, begin(), stages_.d.col(2), state);
  VectorXd moved = 1e-4 * VectorXd::LinSpaced(n, -1.0, 1.0);  // off the constraints
  retract(model_, State(state), moved, state);
  VectorXd delta = VectorXd::Zero(n);
  for (int count = 0; count < 12; ++count) {
    evaluate(model_, state, workspace_.now);
    newton_.project(workspace_.now.constraint, workspace_.now);
    delta += newton_.correction;
    retract(model_, State(state), newton_.correction, state);
  }
  evaluate(model_, state, workspace_.now);
  EXPECT_LT(workspace_.now.constraint.norm(), 1e-12);
  const VectorXd weighed = A * delta, mu = B.transpose().colPivHouseholderQr().solve(weighed);
  EXPECT_LT((weighed - B.transpose() * mu).norm(), 1e-9 * weighed.norm());
}

}  // namespace
}  // namespace tisserand::mechanism::theory_radau_test
