// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas (62) to (72) of docs/THEORY.md, written down once more as they stand there and compared with steps that the
// program takes.
#include <cmath>
#include <complex>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "mechanism/equations/increments.hpp"
#include "mechanism/step/generalised_alpha.hpp"
#include "mechanism/step/step_control.hpp"
#include "tests/support/bodies/theory_motion.hpp"
#include "tests/support/scenes/model_tangent.hpp"
#include "tests/support/scenes/schemes.hpp"

namespace tisserand::mechanism::theory_step_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::JointKind;
using test_support::relative_difference;
using test_support::Scheme;
using test_support::Simulation;
namespace theory = test_support::theory;

/// Two rods on spherical joints that move in space; the first one hangs on the ground unless `free`.
formats::Scene rods(double step, bool free = false) {
  formats::Scene scene = test_support::empty_scene(step, 1.0);
  scene.gravity = {0, 0, -9.81};
  scene.integrator.tolerance = 1e-12;
  scene.integrator.constraint_tolerance = 1e-13;
  std::string before = "ground";
  for (int i = 0; i < 2; ++i) {
    formats::RigidBodySpec rod =
        test_support::rigid_body(i == 0 ? "one" : "two", 1.0 + i, Vector3d::Zero(), {0.01, 1.0 / 12.0, 1.0 / 10.0});
    rod.start.pose.position = {0.5 + i, 0, 0};
    if (i == 1) rod.start.angular_velocity = {3.0, 1.0, 2.0};
    scene.bodies.push_back(rod);
    if (i == 1 || !free)
      scene.joints.push_back(test_support::joint("joint" + std::to_string(i), JointKind::spherical, before, rod.name,
                                                 {1.0 * i, 0, 0}, Vector3d::UnitZ()));
    before = rod.name;
  }
  return scene;
}

/// A run after some steps, and the step that follows.
struct OneStep {
  Simulation run;
  State before, after;

  explicit OneStep(const formats::Scene& scene) : run(scene, {}), before(run.state()), after(run.state()) {
    run.start();
    run.run(20.0 * scene.integrator.step);
    before = run.state();
    EXPECT_TRUE(run.step());
    after = run.state();
  }
  double h() const { return run.scene.integrator.step; }
  AlphaParameters alpha() const { return alpha_parameters(run.scene.integrator); }
  /// What (64) adds to the positions, without δ.
  VectorXd displacement() const {
    const AlphaParameters p = alpha();
    return h() * before.v() + h() * h() * ((0.5 - p.beta) * before.algorithmic() + p.beta * after.algorithmic());
  }
  /// The increment of all positions, rotation vectors for rotations.
  VectorXd increment() const {
    VectorXd d(before.v().size());
    for (std::size_t i = 0; i < run.model().nodes.size(); ++i) {
      const Node& node = run.model().nodes[i];
      const auto k = static_cast<Eigen::Index>(i);
      d.segment<3>(node.translation) = after.x().col(k) - before.x().col(k);
      d.segment<3>(node.rotation) = theory::logarithm(quaternion(before.Q().col(k)).toRotationMatrix().transpose() *
                                                      quaternion(after.Q().col(k)).toRotationMatrix());
    }
    return d;
  }
};

class TheoryStep : public ::testing::TestWithParam<Scheme> {
 protected:
  static formats::Scene scene(double step, bool free = false) {
    return test_support::with_scheme(GetParam(), rods(step, free));
  }
  static bool stabilised() { return GetParam().formulation == formats::Formulation::stabilised_index2; }
};
INSTANTIATE_TEST_SUITE_P(Schemes, TheoryStep, test_support::all_schemes(), test_support::scheme_name);

// (62) to (64), (67): what a step satisfies at its end.
TEST_P(TheoryStep, EquationsOfAStep) {
  OneStep step(scene(2e-3));
  const AlphaParameters p = step.alpha();
  const State &n = step.before, &next = step.after;
  EXPECT_LT(relative_difference((1.0 - p.alpha_m) * next.algorithmic() + p.alpha_m * n.algorithmic(),
                                (1.0 - p.alpha_f) * next.vdot() + p.alpha_f * n.vdot()),
            1e-12);
  EXPECT_LT(relative_difference(next.v(),
                                n.v() + step.h() * ((1.0 - p.gamma) * n.algorithmic() + p.gamma * next.algorithmic())),
            1e-12);
  const VectorXd delta = step.increment() - step.displacement();
  Simulation& run = step.run;
  evaluate(run.model(), next, run.workspace.now);
  const Evaluation& now = run.workspace.now;
  EXPECT_LT(now.constraint.lpNorm<Eigen::Infinity>(), 1e-12);
  EXPECT_LT(now.residual.lpNorm<Eigen::Infinity>(), 1e-9 * now.force_scale[0]);
  if (!stabilised()) {
    EXPECT_LT(delta.norm(), 1e-13);
    EXPECT_GT(now.constraint_rate.lpNorm<Eigen::Infinity>(), 1e-8);
    return;
  }
  EXPECT_LT(now.constraint_rate.lpNorm<Eigen::Infinity>(), 1e-10);
  EXPECT_GT(delta.norm(), 1e-9);
  // W δ + Bᵀμ = 0 with B of the middle of the step, up to what is of higher order in the step.
  State middle = n;
  retract(run.model(), n, 0.5 * step.increment(), middle);
  evaluate(run.model(), middle, run.workspace.now);
  const int size = run.model().sizes.boundary, rows = run.model().sizes.constraints;
  const TangentCoefficients c = step_coefficients(p, step.h());
  const MatrixXd A = test_support::dense_matrix(run, middle, {{c.mass, 0.0, 0.0}, TangentKind::step, {}});
  const MatrixXd Bt = A.bottomLeftCorner(rows, size).transpose();
  const VectorXd W_delta = A.topLeftCorner(size, size) * delta;
  const VectorXd mu = Bt.colPivHouseholderQr().solve(W_delta);
  EXPECT_LT((W_delta - Bt * mu).norm(), 2e-2 * W_delta.norm());
}

// W of (67) moves no centre of mass.
TEST_P(TheoryStep, ProjectionKeepsTheCentreOfMass) {
  if (!stabilised()) return;
  const OneStep step(scene(2e-3, true));
  const VectorXd delta = step.increment() - step.displacement();
  Vector3d sum = Vector3d::Zero();
  double largest = 0.0;
  for (int i = 0; i < 2; ++i) {
    const Node& node = step.run.model().nodes[static_cast<std::size_t>(step.run.node(i == 0 ? "one" : "two"))];
    const Vector3d moved = delta.segment<3>(node.translation);
    sum += (1.0 + i) * moved;
    largest = std::max(largest, moved.norm());
  }
  EXPECT_GT(largest, 1e-10);
  EXPECT_LT(sum.norm(), 1e-5 * largest);  // δ is a difference of positions, with their round-off
}

// (65): parameters; an amplitude of high frequency falls to ρ of it.
TEST(TheoryAlpha, ParametersAndDamping) {
  formats::IntegratorSpec spec;
  for (const double rho : {0.0, 0.4, 0.9, 1.0}) {
    spec.method = formats::Method::generalised_alpha;
    spec.rho = rho;
    const AlphaParameters p = alpha_parameters(spec);
    EXPECT_DOUBLE_EQ(p.alpha_m, (2.0 * rho - 1.0) / (rho + 1.0));
    EXPECT_DOUBLE_EQ(p.alpha_f, rho / (rho + 1.0));
    EXPECT_DOUBLE_EQ(p.gamma, 0.5 + p.alpha_f - p.alpha_m);
    EXPECT_DOUBLE_EQ(p.beta, 0.25 * (p.gamma + 0.5) * (p.gamma + 0.5));
    // v̇ = −ω² q with h = 1 in (q, v, a, v̇) by (62) to (64)
    const double square = 1e12;
    Eigen::Matrix4d next, last;
    next << 1.0, 0.0, -p.beta, 0.0, 0.0, 1.0, -p.gamma, 0.0, 0.0, 0.0, 1.0 - p.alpha_m, -(1.0 - p.alpha_f), square, 0.0,
        0.0, 1.0;
    last << 1.0, 1.0, 0.5 - p.beta, 0.0, 0.0, 1.0, 1.0 - p.gamma, 0.0, 0.0, 0.0, -p.alpha_m, p.alpha_f, 0.0, 0.0, 0.0,
        0.0;
    const Eigen::Matrix4d step = next.partialPivLu().solve(last);
    EXPECT_NEAR(step.eigenvalues().cwiseAbs().maxCoeff(), rho, 1e-3) << rho;  // of a triple eigenvalue
  }
  spec.method = formats::Method::hht;
  spec.alpha = 0.1;
  const AlphaParameters p = alpha_parameters(spec);
  EXPECT_EQ(p.alpha_m, 0.0);
  EXPECT_EQ(p.alpha_f, 0.1);
  EXPECT_DOUBLE_EQ(p.gamma, 0.6);
  EXPECT_DOUBLE_EQ(p.beta, 0.25 * 1.1 * 1.1);
}

// (66): v̈₀ by a difference of accelerations along the motion; a change of step.
TEST(TheoryAlpha, AlgorithmicAcceleration) {
  const double h = 1e-4;
  Simulation run(rods(h), {});
  run.start();
  const AlphaParameters p = alpha_parameters(run.scene.integrator);
  State& state = run.state();
  const double epsilon = 1e-5;
  State ahead = state;
  retract(run.model(), state, epsilon * state.v() + 0.5 * epsilon * epsilon * state.vdot(), ahead);
  ahead.v() += epsilon * state.vdot();
  const VectorXd vdot = state.vdot(), start = state.algorithmic();
  solve_accelerations(run.model(), h, "", ahead, run.workspace);
  const VectorXd rate = (ahead.vdot() - vdot) / epsilon;
  EXPECT_LT(relative_difference(start - vdot, (p.alpha_m - p.alpha_f) * h * rate), 1e-2);
  rebuild_algorithmic_acceleration(0.3 * h, state);
  EXPECT_LT(relative_difference(state.algorithmic(), vdot + 0.3 * (start - vdot)), 1e-14);
}

// (68) to (70): coefficients, A, and the rows beside it, against differences at an iterate of a step.
TEST_P(TheoryStep, IterationMatrix) {
  Simulation run(scene(0.02), {});
  run.start();
  const double h = 0.02;
  const StepScheme scheme = step_scheme(run.model(), run.scene.integrator, run.state(), h);
  const AlphaParameters p = alpha_parameters(run.scene.integrator);
  const TangentCoefficients c = scheme.request.coefficients;
  EXPECT_DOUBLE_EQ(c.mass, (1.0 - p.alpha_m) / ((1.0 - p.alpha_f) * p.beta * h * h));
  EXPECT_DOUBLE_EQ(c.damping, p.gamma / (p.beta * h));
  EXPECT_EQ(c.stiffness, 1.0);
  const State last = run.state();
  const int size = run.model().sizes.boundary, rows = run.model().sizes.constraints;
  VectorXd displacement = h * last.v() + 0.5 * h * h * last.vdot();
  for (int i = 0; i < size; ++i) displacement[i] += 0.01 * std::sin(1.0 + i);
  // Residual and φ of (70) when the unknowns of (68) move by d.
  const auto at = [&](const VectorXd& d) {
    State state = last;
    run.workspace.now.displacement = displacement + d;
    retract(run.model(), last, run.workspace.now.displacement, state);
    state.v() += 0.3 * VectorXd::LinSpaced(size, 0.0, 1.0) + c.damping * d;
    state.vdot() += c.mass * d;
    evaluate_in_step(run.model(), state, run.workspace.now);
    VectorXd both(size + rows);
    both << run.workspace.now.residual, stabilised()
                                            ? VectorXd(p.beta * h / p.gamma * run.workspace.now.constraint_rate)
                                            : run.workspace.now.constraint;
    return both;
  };
  const double epsilon = 1e-6;
  MatrixXd differences(size + rows, size);
  for (int k = 0; k < size; ++k) {
    const VectorXd d = epsilon * VectorXd::Unit(size, k);
    differences.col(k) = (at(d) - at(-d)) / (2.0 * epsilon);
  }
  at(VectorXd::Zero(size));
  State state = last;
  retract(run.model(), last, displacement, state);
  state.v() += 0.3 * VectorXd::LinSpaced(size, 0.0, 1.0);
  const MatrixXd A = test_support::dense_matrix(run, state, {c, TangentKind::exact, scheme.request.rows});
  // T(θ) turns increments of the rotation vector into those of the rotation. B T holds it for index 3; the stiffness
  // and ∂(B v)/∂q leave it out.
  MatrixXd T = MatrixXd::Identity(size, size);
  for (const Node& node : run.model().nodes)
    T.block<3, 3>(node.rotation, node.rotation) = theory::tangent(displacement.segment<3>(node.rotation));
  const MatrixXd B = test_support::dense_matrix(run, state, {c, TangentKind::exact, {}}).bottomLeftCorner(rows, size);
  const MatrixXd B_hat = A.bottomLeftCorner(rows, size);
  EXPECT_LT(relative_difference(stabilised() ? MatrixXd(B + (B_hat - B) * T) : B_hat, differences.bottomRows(rows)),
            1e-6);
  if (!stabilised()) {
    EXPECT_LT(relative_difference(B_hat, B * T), 1e-13);
  }
  const MatrixXd K = test_support::dense_matrix(run, state, {{c.mass, c.damping, 0.0}, TangentKind::exact, {}})
                         .topLeftCorner(size, size);
  const MatrixXd stiffness = A.topLeftCorner(size, size) - K;  // c_k ∂r/∂q
  EXPECT_LT(relative_difference(K + stiffness * T, differences.topRows(size)), 1e-5);
}

// (71), (72)
TEST(TheoryAlpha, ErrorAndNextStep) {
  OneStep step(rods(2e-3));
  const AlphaParameters p = step.alpha();
  step.before.step() = 3e-3;  // a_n was built for a longer step
  VectorXd error(step.before.v().size());
  estimate_error(step.run.scene.integrator, step.h(), step.after, step.before, error);
  const VectorXd rebuilt = step.before.vdot() + 2.0 / 3.0 * (step.before.algorithmic() - step.before.vdot());
  const double C = std::abs(1.0 / 6.0 - p.beta - 0.5 * (p.alpha_m - p.alpha_f));
  EXPECT_LT(relative_difference(error, C * step.h() * step.h() * (step.after.algorithmic() - rebuilt)), 1e-12);
  formats::IntegratorSpec options = step.run.scene.integrator;
  options.error_control.active = true;
  for (const double ratio : {0.01, 0.3, 0.5, 1.0, 4.0, 100.0}) {
    double factor = std::min(2.0, std::max(0.2, 0.9 / std::sqrt(ratio)));
    if (factor > 1.0 && factor < 1.2) factor = 1.0;
    EXPECT_NEAR(next_step(options, 1e-3, ratio), factor * 1e-3, 1e-15) << ratio;
  }
}

}  // namespace
}  // namespace tisserand::mechanism::theory_step_test
