// SPDX-License-Identifier: GPL-3.0-or-later
// The floating-frame body and its nodes against known answers, Lagrange's equations and the laws that they imply.
#include "mechanism/bodies/modal/body.hpp"

#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "tests/support/bodies/modal_known_answers.hpp"
#include "tests/support/bodies/superelement_cases.hpp"

namespace tisserand::mechanism::modal_body_test {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using test_support::relative_difference;
using test_support::to_matrix;
using test_support::to_vector;

/// What the known answers are given to: sums of products of numbers of order one, so round-off alone.
constexpr double known_tolerance = 1e-11;

/// The body of the known answers without stiffness and damping, in one state.
struct Case {
  nlohmann::json answers = test_support::modal_answers();
  formats::ModalBody file;
  BuiltModalBody built;
  test_support::ModalState state;
  ModalScratch scratch;

  explicit Case(const std::string& reference)
      : file(test_support::known_body(answers, reference)),
        built(build_modal_body(file, {}, {})),
        state(test_support::known_modal_state(answers)),
        scratch(make_scratch(built.body)) {}

  VectorXd residual(const Vector3d& gravity) {
    update_kinematics(built.body, state.frame, state.modes(), gravity, scratch);
    mechanism::residual(built.body, scratch);
    return scratch.r;
  }
  MatrixXd tangent(const TangentCoefficients& c, const Vector3d& gravity) {
    residual(gravity);
    mechanism::tangent(built.body, c, scratch);
    return scratch.tangent;
  }
  VectorXd velocity() const {
    VectorXd v(6 + built.body.modes);
    v << state.frame.xd, state.frame.Omega, state.wd;
    return v;
  }
  void remove_stiffness() { built.body.stiffness.setZero(); }
};

class EveryReference : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(ModalBody, EveryReference, ::testing::Values("node_fixed", "mean_axis"),
                         [](const auto& name) { return name.param; });

TEST_P(EveryReference, ForcesAndTangentsAreTheKnownAnswers) {
  Case c(GetParam());
  c.remove_stiffness();
  const nlohmann::json& known = c.answers.at("results_" + GetParam());
  const Vector3d none = Vector3d::Zero(), gravity = to_vector(c.answers.at("state").at("gravity"));
  EXPECT_LT(relative_difference(c.residual(none), to_vector(known.at("inertia_force_M_a_minus_s"))), known_tolerance);
  EXPECT_LT(relative_difference(c.residual(none) - c.residual(gravity), to_vector(known.at("gravity"))),
            known_tolerance);
  EXPECT_LT(relative_difference(c.tangent({1, 0, 0}, none), to_matrix(known.at("M"))), known_tolerance);
  EXPECT_LT(relative_difference(c.tangent({0, 1, 0}, none), to_matrix(known.at("C_minus_ds_dv"))), known_tolerance);
  EXPECT_LT(relative_difference(c.tangent({0, 0, 1}, none), to_matrix(known.at("Kin_d_Ma_minus_s_dq"))),
            known_tolerance);
  c.residual(none);
  EXPECT_NEAR(energy(c.built.body, c.state.frame, gravity, c.scratch).kinetic, known.at("kinetic_energy").get<double>(),
              14 * known_tolerance);
}

TEST_P(EveryReference, MomentaAreTheKnownAnswers) {
  Case c(GetParam());
  const nlohmann::json& known = c.answers.at("results_" + GetParam());
  const VectorXd p = c.tangent({1, 0, 0}, Vector3d::Zero()) * c.velocity();
  const Vector3d about_origin = c.state.frame.x.cross(p.head<3>()) + c.state.frame.R * p.segment<3>(3);
  EXPECT_LT(relative_difference(p.head<3>(), to_vector(known.at("linear_momentum"))), known_tolerance);
  EXPECT_LT(relative_difference(about_origin, to_vector(known.at("angular_momentum_about_origin"))), known_tolerance);
}

TEST_P(EveryReference, IntegralsAndModesOfTheNodesAreTheKnownAnswers) {
  const nlohmann::json answers = test_support::modal_answers();
  const formats::ModalBody body = test_support::known_body(answers, GetParam());
  const nlohmann::json& known = answers.at("body").at(GetParam()).at("constants");
  EXPECT_LT((body.integrals.C1 - to_matrix(known.at("C1"))).cwiseAbs().maxCoeff(), known_tolerance);  // 0: mean axis
  EXPECT_LT(relative_difference(body.integrals.P0, to_matrix(known.at("P0"))), known_tolerance);
  EXPECT_LT(relative_difference(body.integrals.J_mu, to_matrix(known.at("Jmu"))), known_tolerance);
  EXPECT_LT(relative_difference(body.integrals.N_mu, to_matrix(known.at("Nmu"))), known_tolerance);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_LT(relative_difference(Eigen::Map<const Matrix3d>(body.integrals.P1.data() + 9 * i),
                                  to_matrix(known.at("P1")[at])),
              known_tolerance);
    for (Eigen::Index j = 0; j < 3; ++j)
      EXPECT_LT(relative_difference(Eigen::Map<const Matrix3d>(body.integrals.P2.col(i).data() + 9 * j),
                                    to_matrix(known.at("P2")[at][j])),
                known_tolerance);
  }
  // The eigenproblem of the fixture: no repeated values, so the modes are unique up to their sign.
  VectorXd omega2;
  MatrixXd X;
  test_support::lumped_modes(test_support::known_model(answers), {body.reference_node, body.reference_component}, 3,
                             omega2, X);
  EXPECT_LT(relative_difference(omega2, body.omega2), 1e-9);
  for (std::size_t k = 0; k < body.X.size(); ++k)
    EXPECT_LT((X.middleRows<6>(6 * static_cast<Eigen::Index>(k)) - body.X[k]).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_TRUE(formats::check(body, "known").empty());
}

// v·(M v̇ − s) = dT/dt along the motion; in a sum that is at most cubic in time, so central differences of two step
// sizes leave round-off (1e-16/1e-3) alone.
TEST_P(EveryReference, InertiaForcesDoTheWorkOfTheKineticEnergy) {
  Case c(GetParam());
  c.remove_stiffness();
  const double power = c.residual(Vector3d::Zero()).dot(c.velocity());
  const auto kinetic = [&c](double t) {
    Case moved = c;
    const test_support::ModalState& s = c.state;
    moved.state.frame.R = s.frame.R * exp_so3<double>(Vector3d(t * s.frame.Omega + 0.5 * t * t * s.frame.Omegad));
    moved.state.frame.xd = s.frame.xd + t * s.frame.xdd;
    moved.state.frame.Omega = s.frame.Omega + t * s.frame.Omegad;
    moved.state.w = s.w + t * s.wd + 0.5 * t * t * s.wdd;
    moved.state.wd = s.wd + t * s.wdd;
    moved.residual(Vector3d::Zero());
    return energy(moved.built.body, moved.state.frame, Vector3d::Zero(), moved.scratch).kinetic;
  };
  const double h = 1e-3;
  const double rate = (8.0 * (kinetic(h) - kinetic(-h)) - (kinetic(2 * h) - kinetic(-2 * h))) / (12.0 * h);
  EXPECT_GT(std::abs(power), 1.0);
  EXPECT_NEAR(power, rate, 1e-9 * std::abs(power));
}

// d/dt of the momenta of a body that nothing acts on is what the rows of forces and of moments say: the angular one
// needs the gyroscopic term of the rotary inertias, which energy does not see.
TEST_P(EveryReference, RowsOfTheFrameAreTheRatesOfTheMomenta) {
  Case c(GetParam());
  c.remove_stiffness();
  const VectorXd r = c.residual(Vector3d::Zero());
  const auto momenta = [&c](double t) {
    Case moved = c;
    const test_support::ModalState& s = c.state;
    moved.state.frame.x = s.frame.x + t * s.frame.xd + 0.5 * t * t * s.frame.xdd;
    moved.state.frame.R = s.frame.R * exp_so3<double>(Vector3d(t * s.frame.Omega + 0.5 * t * t * s.frame.Omegad));
    moved.state.frame.xd = s.frame.xd + t * s.frame.xdd;
    moved.state.frame.Omega = s.frame.Omega + t * s.frame.Omegad;
    moved.state.w = s.w + t * s.wd + 0.5 * t * t * s.wdd;
    moved.state.wd = s.wd + t * s.wdd;
    const VectorXd p = moved.tangent({1, 0, 0}, Vector3d::Zero()) * moved.velocity();
    Eigen::Matrix<double, 6, 1> sum;
    sum << p.head<3>(), moved.state.frame.x.cross(p.head<3>()) + moved.state.frame.R * p.segment<3>(3);
    return sum;
  };
  const double h = 1e-3;
  const Eigen::Matrix<double, 6, 1> rate =
      (8.0 * (momenta(h) - momenta(-h)) - (momenta(2 * h) - momenta(-2 * h))) / (12.0 * h);
  EXPECT_LT(relative_difference(r.head<3>(), rate.head<3>()), 1e-9);
  const Vector3d about_origin = c.state.frame.x.cross(r.head<3>()) + c.state.frame.R * r.segment<3>(3);
  EXPECT_LT(relative_difference(about_origin, rate.tail<3>()), 1e-9);
}

TEST_P(EveryReference, InertiaIsPositiveDefiniteAndDampingOfModesIsGyroscopic) {
  Case c(GetParam());
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    c.state.w = test_support::random_vector_n(random, 3, 0.3);
    const MatrixXd M = c.tangent({1, 0, 0}, Vector3d::Zero());
    EXPECT_TRUE(M.isApprox(M.transpose(), 1e-14));
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(M).eigenvalues()[0], 0.0);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix3d>(c.scratch.J).eigenvalues()[0], 0.0);
    const MatrixXd C = c.tangent({0, 1, 0}, Vector3d::Zero()).bottomRightCorner(3, 3);
    EXPECT_LT((C + C.transpose()).cwiseAbs().maxCoeff(), 1e-14);
  }
}

// A rigid motion of the world superposed turns forces and leaves moments and modal forces.
TEST_P(EveryReference, TurningTheWorldTurnsForces) {
  Case c(GetParam());
  const Vector3d gravity(0.3, -2.0, -9.81);
  const VectorXd before = c.residual(gravity);
  const Matrix3d Q = exp_so3<double>(Vector3d(0.4, -1.1, 0.7));
  NodeMotion& frame = c.state.frame;
  frame.x = Q * frame.x + Vector3d(1, 2, 3);
  frame.R = Q * frame.R;
  frame.xd = Q * frame.xd;
  frame.xdd = Q * frame.xdd;
  VectorXd expected = before;
  expected.head<3>() = Q * before.head<3>();
  EXPECT_LT(relative_difference(c.residual(Q * gravity), expected), 1e-14);
}

// Without modes the body is a rigid one: Newton and Euler about the frame at the centre of mass.
TEST(ModalBody, WithoutModesIsARigidBody) {
  Case c("node_fixed");
  formats::ModalBodySpec spec;
  spec.modes = 0;
  const BuiltModalBody rigid = build_modal_body(c.file, spec, {});
  ModalScratch scratch = make_scratch(rigid.body);
  update_kinematics(rigid.body, c.state.frame, c.state.modes(), {0, 0, -9.81}, scratch);
  residual(rigid.body, scratch);
  const Matrix3d J = c.file.integrals.P0.trace() * Matrix3d::Identity() - c.file.integrals.P0 + c.file.integrals.J_mu;
  const NodeMotion& n = c.state.frame;
  Eigen::Matrix<double, 6, 1> expected;
  expected << 4.9 * (n.xdd - Vector3d(0, 0, -9.81)), J * n.Omegad + n.Omega.cross(J * n.Omega);
  EXPECT_LT(relative_difference(scratch.r, expected), 1e-14);
}

TEST(ModalBody, UnitsAndChoiceOfModesAndDamping) {
  Case c("node_fixed");
  formats::ModalBodySpec spec;
  spec.modes = 2;
  spec.damping = {.mass = 0.5, .stiffness = 0.01, .ratio = 0.1, .ratios = {0.3}};
  c.file.zeta[1] = 0.02;
  const ModalBody body = build_modal_body(c.file, spec, {1000.0, 0.001, 1.0}).body;  // from m, kg to mm, t
  ASSERT_EQ(body.modes, 2);
  const double omega2 = c.file.omega2[1];
  EXPECT_DOUBLE_EQ(body.damping[0], 0.5 + 0.01 * c.file.omega2[0] + 2 * 0.3 * std::sqrt(c.file.omega2[0]));
  EXPECT_DOUBLE_EQ(body.damping[1], 0.5 + 0.01 * omega2 + 2 * 0.12 * std::sqrt(omega2));
  EXPECT_DOUBLE_EQ(body.mass, 0.0049);
  EXPECT_NEAR(body.P0(0, 0), c.file.integrals.P0(0, 0) * 1e3, 1e-9);
  EXPECT_NEAR(body.C1(1, 0), c.file.integrals.C1(1, 0) * std::sqrt(1e-3), 1e-15);
  spec.modes.reset();
  spec.cutoff = std::sqrt(300.0) / static_cast<double>(2.0 * std::numbers::pi);
  EXPECT_EQ(build_modal_body(c.file, spec, {}).body.modes, 2);  // 75, 210, 507
  spec.cutoff.reset();
  spec.modes = 4;
  EXPECT_THROW(build_modal_body(c.file, spec, {}), Error);
}

// ---- nodes -------------------------------------------------------------------------------------------------------

/// Follower of node 5: the node itself, and a marker with offset p and axes D on it.
struct Follower {
  Case c{"node_fixed"};
  ModalNodeTerms terms;
  NodeMotion motion;
  Vector3d p;
  Matrix3d D;

  Follower() : terms(make_terms(c.built.nodes[4])) {
    c.residual(Vector3d::Zero());
    update_node<3>(c.built.nodes[4], c.scratch, c.state.frame, motion, terms);
    p = to_vector(c.answers.at("follower").at("p"));
    D = to_matrix(c.answers.at("follower").at("D"));
  }
  /// From [ẋ; Ω] of the node to those of the marker.
  Eigen::Matrix<double, 6, 6> offset() const {
    Eigen::Matrix<double, 6, 6> T = Eigen::Matrix<double, 6, 6>::Identity();
    T.topRightCorner<3, 3>() = -motion.R * skew<double>(p);
    T.bottomRightCorner<3, 3>() = D.transpose();
    return T;
  }
};

TEST(ModalNode, FollowsAsInTheKnownAnswers) {
  const Follower f;
  const nlohmann::json& known = f.c.answers.at("follower");
  EXPECT_LT(relative_difference(f.motion.x + f.motion.R * f.p, to_vector(known.at("position"))), known_tolerance);
  EXPECT_LT(relative_difference(f.motion.R * f.D, to_matrix(known.at("rotation"))), known_tolerance);
  EXPECT_LT(relative_difference(f.offset() * f.terms.T, to_matrix(known.at("T"))), known_tolerance);
  Eigen::Matrix<double, 6, 1> twist, acceleration, centripetal = Eigen::Matrix<double, 6, 1>::Zero();
  twist << f.motion.xd, f.motion.Omega;
  acceleration << f.motion.xdd, f.motion.Omegad;
  centripetal.head<3>() = f.motion.R * f.motion.Omega.cross(f.motion.Omega.cross(f.p));
  EXPECT_LT(relative_difference(f.offset() * twist, to_vector(known.at("twist"))), known_tolerance);
  EXPECT_LT(relative_difference(f.offset() * f.terms.bias + centripetal, to_vector(known.at("bias"))), known_tolerance);
  EXPECT_LT(relative_difference(f.offset() * acceleration + centripetal, to_vector(known.at("acceleration"))),
            known_tolerance);
}

TEST(ModalNode, PullsForcesBackAsInTheKnownAnswers) {
  const Follower f;
  const nlohmann::json& known = f.c.answers.at("follower");
  const Vector3d force = to_vector(known.at("force_global")), couple = to_vector(known.at("couple_follower_axes"));
  const Vector3d g = f.motion.R.transpose() * force;
  Eigen::Matrix<double, 6, 1> at_node;
  at_node << force, f.p.cross(g) + f.D * couple;
  EXPECT_LT(relative_difference(f.terms.T.transpose() * at_node, to_vector(known.at("pulled_back"))), known_tolerance);
  Eigen::Matrix<double, 6, 6> K = Eigen::Matrix<double, 6, 6>::Zero();
  K.bottomRightCorner<3, 3>() = skew<double>(f.p) * skew<double>(g);
  MatrixXd tangent = f.terms.T.transpose() * K * f.terms.T;
  add_geometric_stiffness(f.c.built.nodes[4], f.terms, at_node, tangent);
  EXPECT_LT(relative_difference(tangent, to_matrix(known.at("pull_back_tangent"))), known_tolerance);
}

// ∂(T v)/∂q by central differences (1e-10), with angles on both sides of the switch of series at 0.1 rad.
TEST(ModalNode, RateGradientIsTheDerivativeOfTheVelocity) {
  for (const double size : {0.02, 1.0}) {
    Follower f;
    f.c.state.w *= size / 0.05;
    const auto twist = [&](const VectorXd& d) {
      Case moved = f.c;
      NodeMotion& frame = moved.state.frame;
      frame.x += d.head<3>();
      frame.R = frame.R * exp_so3<double>(Vector3d(d.segment<3>(3)));
      moved.state.w += d.tail(3);
      moved.residual(Vector3d::Zero());
      NodeMotion motion;
      ModalNodeTerms terms = make_terms(moved.built.nodes[4]);
      update_node<3>(moved.built.nodes[4], moved.scratch, frame, motion, terms);
      Eigen::Matrix<double, 6, 1> v;
      v << motion.xd, motion.Omega;
      return v;
    };
    MatrixXd Z(6, 9), expected(6, 9);
    const double h = 1e-5;
    for (int j = 0; j < 9; ++j)
      expected.col(j) = (twist(h * VectorXd::Unit(9, j)) - twist(-h * VectorXd::Unit(9, j))) / (2 * h);
    f.c.residual(Vector3d::Zero());
    update_node<3>(f.c.built.nodes[4], f.c.scratch, f.c.state.frame, f.motion, f.terms);
    rate_gradient(f.c.built.nodes[4], f.c.scratch, f.terms, Z);
    EXPECT_LT(relative_difference(Z, expected), 1e-9) << size;
    EXPECT_LT(relative_difference(Z * f.c.velocity(), f.terms.bias), 1e-13) << size;
  }
}

}  // namespace
}  // namespace tisserand::mechanism::modal_body_test
