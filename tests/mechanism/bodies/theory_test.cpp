// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas (1) to (42) of docs/THEORY.md, written down once more as they stand there and compared with what the program
// computes at a deformed, moving state. theory_second_order_test.cpp has section 8, the rooms joints, step and radau
// the rest.
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "common/math/rotation.hpp"
#include "formats/superelement/weights.hpp"
#include "mechanism/bodies/superelement/evaluate.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/bodies/second_order_known_answers.hpp"
#include "tests/support/bodies/superelement_known_answers.hpp"
#include "tests/support/bodies/theory_motion.hpp"
#include "tests/support/bodies/uncondensed_tangent.hpp"

namespace tisserand::mechanism::theory_test {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::InertiaOption;
using test_support::relative_difference;
namespace theory = test_support::theory;

constexpr double tolerance = 1e-11;       // conditioning of the congruence costs two digits or three
constexpr double of_differences = 1e-10;  // of a difference of larger numbers

/// Block diagonal of one 3 x 3 matrix per node for translations and one for rotations; 1 or 0 for internal coordinates.
template <class Translation, class Rotation>
MatrixXd diagonal(const theory::Motion& m, Translation translation, Rotation rotation, double internal) {
  MatrixXd D = MatrixXd::Zero(m.size, m.size);
  D.diagonal().tail(m.size - 6 * m.nodes).setConstant(internal);
  for (Index i = 0; i < m.nodes; ++i) {
    D.block<3, 3>(6 * i, 6 * i) = translation(i);
    D.block<3, 3>(6 * i + 3, 6 * i + 3) = rotation(i);
  }
  return D;
}

/// The matrices of options A and B: (26) to (28), and V₁ and the momenta of (31).
struct Options {
  bool a = false;
  MatrixXd P, V, O0, OB;

  Options(const theory::Motion& m, InertiaOption option) : a(option == InertiaOption::A) {
    const Matrix3d zero = Matrix3d::Zero(), one = Matrix3d::Identity(), turning = theory::skew(m.Omega0);
    const auto rate = [&](Index i) { return a ? Vector3d(m.E(i) * m.at(i).Omega) : m.at(i).Omega; };
    P = diagonal(
        m, [&](Index) { return Matrix3d(m.R0.transpose()); }, [&](Index i) { return a ? m.E(i) : one; }, 1.0);
    O0 = diagonal(
        m, [&](Index) { return turning; }, [&](Index) { return a ? turning : zero; }, 0.0);
    OB = diagonal(
        m, [&](Index) { return zero; }, [&](Index i) { return theory::skew(rate(i)); }, 0.0);
    V.setZero(m.size, 3);
    for (Index i = 0; i < m.nodes; ++i) {
      V.middleRows<3>(6 * i) = theory::skew(m.R0.transpose() * m.at(i).xd);
      if (a) V.middleRows<3>(6 * i + 3) = theory::skew(rate(i));
    }
  }

  /// (30), for any mass matrix.
  VectorXd forces(const theory::Motion& m, const MatrixXd& M) const {
    const VectorXd p = M * P * m.qd, acceleration = P * m.qdd + V * m.Omega0;  // (29)
    const MatrixXd O = a ? MatrixXd(O0 - OB) : MatrixXd(O0 + OB);
    return P.transpose() * M * acceleration + P.transpose() * O * p - m.U.transpose() * V.transpose() * p;
  }

  /// C₁ + C₂ + C₃ of (31), for any momenta.
  MatrixXd velocity_tangent(const theory::Motion& m, const MatrixXd& M, const VectorXd& p) const {
    MatrixXd V1 = MatrixXd::Zero(m.size, 3);
    for (Index i = 0; i < 2 * m.nodes; ++i)
      if (a || i % 2 == 0) V1.middleRows<3>(3 * i) = -theory::skew(p.segment<3>(3 * i));
    const MatrixXd turned = diagonal(
        m, [](Index) { return Matrix3d(Matrix3d::Zero()); },
        [&](Index i) { return theory::skew(p.segment<3>(6 * i + 3)); }, 0.0);
    const MatrixXd C1 = P.transpose() * (O0 * M + M * O0.transpose()) * P;
    const MatrixXd C2 = P.transpose() * (M * V + V1) * m.U - m.U.transpose() * (V1.transpose() + V.transpose() * M) * P;
    const MatrixXd C3 = (a ? -1.0 : 1.0) * P.transpose() * (OB * M - turned) * P;
    EXPECT_LT((C1 - C1.transpose()).norm() + (C2 + C2.transpose()).norm(), tolerance * C1.norm());
    return C1 + C2 + C3;
  }
};

/// J of (33), and the shift of the centre of mass of (32).
MatrixXd center_rows(const theory::Motion& m, const theory::Constants& part, const MatrixXd& Gamma) {
  const Vector3d c = part.center + Gamma * m.y / part.mass;
  return m.A0 - theory::skew(c) * m.U + Gamma * m.Upsilon / part.mass;
}

/// The body lframe3 of the known answers: three nodes and three modes, about 0.2 rad of deformation.
class Theory : public ::testing::Test {
 protected:
  void take(InertiaOption inertia, const formats::Damping& damping = {}) {
    known_ = test_support::known_answer("lframe3");
    SuperelementOptions options;
    options.inertia = inertia;
    options.damping = damping;
    body_ = build_superelement_body(known_.element, known_.rigid, options);
    state_ = test_support::known_state(known_, body_, false);
  }
  theory::Motion motion() const { return {body_, state_, state_.nodes[0].R}; }

  VectorXd computed(const test_support::BodyState& state, const Vector3d& gravity) const {
    return test_support::residual_vector(body_, state, gravity);
  }
  test_support::BodyState resting() const {
    test_support::BodyState rest = state_;
    for (NodeMotion& node : rest.nodes) node.xd = node.Omega = node.xdd = node.Omegad = Vector3d::Zero();
    rest.yd.setZero();
    rest.ydd.setZero();
    return rest;
  }
  SuperelementScratch evaluated() const {
    SuperelementScratch scratch = make_scratch(body_);
    test_support::evaluate(body_, state_, Vector3d::Zero(), scratch);
    return scratch;
  }
  MatrixXd tangent_of(const test_support::BodyState& state, const TangentCoefficients& c, TangentKind kind) const {
    SuperelementScratch scratch = make_scratch(body_);
    test_support::evaluate(body_, state, Vector3d::Zero(), scratch);
    MatrixXd A;
    test_support::uncondensed_tangent(body_, scratch, test_support::in_order(state.nodes), Vector3d::Zero(), c, kind,
                                      A);
    return A;
  }

  test_support::KnownAnswer known_;
  SuperelementBody body_;
  test_support::BodyState state_;
};

// (1) to (5), beside the functions of the program; (1), (3): exp(ψ + ε d) = exp(ψ) exp(ε T d), by central differences.
TEST_F(Theory, RotationsAndTheirIncrements) {
  const Vector3d psi(0.4, -0.7, 1.1), d(0.3, 0.5, -0.2);
  EXPECT_LT((exp_so3<double>(psi) - theory::exponential(psi)).norm(), 1e-14);
  EXPECT_LT((log_so3<double>(theory::exponential(psi)) - psi).norm(), 1e-14);
  EXPECT_LT((tangent_so3<double>(psi) - theory::tangent(psi)).norm(), 1e-14);
  EXPECT_LT((inverse_tangent_so3<double>(psi) - theory::inverse_tangent(psi)).norm(), 1e-14);
  EXPECT_LT((inverse_tangent_rate<double>(psi, d) - theory::inverse_tangent_rate(psi, d)).norm(), 1e-13);
  EXPECT_LT((theory::inverse_tangent(-psi) - theory::inverse_tangent(psi).transpose()).norm(), 1e-15);
  EXPECT_LT((theory::inverse_tangent(psi) * theory::tangent(psi) - Matrix3d::Identity()).norm(), 1e-14);
  const double e = 1e-6;
  const auto turned = [&](double by) {
    return theory::logarithm(theory::exponential(psi).transpose() * theory::exponential(psi + by * d));
  };
  EXPECT_LT(((turned(e) - turned(-e)) / (2.0 * e) - theory::tangent(psi) * d).norm(), 1e-9);
  const Matrix3d rate = (theory::inverse_tangent(psi + e * d) - theory::inverse_tangent(psi - e * d)) / (2.0 * e);
  EXPECT_LT((theory::inverse_tangent_rate(psi, d) - rate).norm(), 1e-9);
}

// (6) to (9): order of the coordinates, canonical form, rigid motions, mass.
TEST_F(Theory, TheSuperelement) {
  take(InertiaOption::B);
  const theory::Constants part(body_);
  EXPECT_EQ(body_.node[1].translation_row, 6);
  EXPECT_EQ(body_.node[1].rotation_row, 9);
  EXPECT_LT((part.S * part.Phi).norm(), 1e-10 * part.S.norm());
  EXPECT_NEAR(part.mass, body_.mass, tolerance * part.mass);
  EXPECT_LT((part.center - body_.center_of_mass).norm(), 1e-10);
  EXPECT_LT((part.Gamma * part.Phi.rightCols<3>() + part.mass * theory::skew(part.center)).norm(), 1e-10);
  // The congruence leaves the frequencies of the free body as they were.
  const auto free_frequencies = [](const MatrixXd& S, const MatrixXd& M) {
    return VectorXd(Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(S, M, Eigen::EigenvaluesOnly).eigenvalues());
  };
  EXPECT_LT(relative_difference(free_frequencies(part.S, part.M),
                                free_frequencies(known_.element.stiffness, known_.element.mass)),
            1e-9);
}

// (10) to (14)
TEST_F(Theory, WeightsAndMeanFrame) {
  take(InertiaOption::B);
  const VectorXd alpha = theory::weights(known_.element.node_position.transpose(), known_.rigid.center_of_mass);
  EXPECT_NEAR(alpha.sum(), 1.0, 1e-14);
  for (std::size_t i = 0; i < body_.node.size(); ++i) {
    EXPECT_NEAR(body_.node[i].alpha, alpha[static_cast<Index>(i)], tolerance);
    EXPECT_NEAR(body_.node[i].alpha_rotation, alpha[static_cast<Index>(i)], tolerance);
    const Vector3d X = known_.element.node_position.row(static_cast<Index>(i)).transpose() -
                       known_.element.node_position.transpose() * alpha;
    EXPECT_LT((body_.node[i].X - X).norm(), tolerance);
  }
  const theory::Motion m = motion();
  const SuperelementScratch scratch = evaluated();
  EXPECT_LT((scratch.motion.x0 - m.x0).norm(), tolerance);
  EXPECT_LT((scratch.motion.R0 - m.R0).norm(), tolerance);
  Vector3d sum = Vector3d::Zero();
  for (Index i = 0; i < m.nodes; ++i) {
    sum += m.alpha[i] * theory::logarithm(scratch.motion.R0.transpose() * m.at(i).R);
    EXPECT_LT((scratch.motion.node[static_cast<std::size_t>(i)].U - m.U.middleCols<3>(6 * i + 3)).norm(), tolerance);
  }
  EXPECT_LT(sum.norm(), 1e-13);
  // The body lies off the line of two nodes: the sum stays one, and the frame is at the point nearest to its centre.
  Eigen::Matrix3Xd line(3, 2);
  line << 0.0, 2.0, 0.0, 0.0, 0.0, 0.0;
  const VectorXd two = formats::frame_weights(line, {0.5, 0.3, 0.0}).alpha;
  EXPECT_LT((two - theory::weights(line, {0.5, 0.3, 0.0})).norm() + (two - Eigen::Vector2d(0.75, 0.25)).norm(), 1e-14);
}

// (15)
TEST_F(Theory, FrameOfThePaper) {
  known_ = test_support::known_answer("lframe3");
  SuperelementOptions options;
  options.frame = formats::FrameKind::paper;
  body_ = build_superelement_body(known_.element, known_.rigid, options);
  state_ = test_support::known_state(known_, body_, true);
  const Matrix3d& R_ref = state_.R0_reference;
  Vector3d b0 = Vector3d::Zero();
  for (std::size_t i = 0; i < body_.node.size(); ++i)
    b0 += body_.node[i].alpha_rotation * theory::logarithm(R_ref.transpose() * state_.nodes[i].R);
  const SuperelementScratch scratch = evaluated();
  EXPECT_LT((scratch.motion.R0 - R_ref * theory::exponential(b0)).norm(), tolerance);
  for (std::size_t i = 0; i < body_.node.size(); ++i) {
    const Matrix3d U = theory::tangent(b0) * body_.node[i].alpha_rotation *
                       theory::inverse_tangent(theory::logarithm(R_ref.transpose() * state_.nodes[i].R));
    EXPECT_LT((scratch.motion.node[i].U - U).norm(), tolerance);
  }
}

// (16): a body whose nodes have no rotations.
TEST_F(Theory, FrameOfPositionsAlone) {
  const formats::Superelement element = test_support::test_superelement("network");
  body_ = build_superelement_body(element, formats::rigid_properties(element), {});
  state_ = test_support::random_state(body_, 3, 0.1);
  const SuperelementScratch scratch = evaluated();
  Eigen::Matrix3Xd x(3, 4), X(3, 4);
  for (Index i = 0; i < 4; ++i) {
    x.col(i) = state_.nodes[static_cast<std::size_t>(i)].x;
    X.col(i) = element.node_position.row(i);
  }
  x = (x.colwise() - Vector3d(x.rowwise().mean())).eval();
  X = (X.colwise() - Vector3d(X.rowwise().mean())).eval();
  const Matrix3d& R0 = scratch.motion.R0;
  Vector3d sum = Vector3d::Zero();
  Matrix3d D = Matrix3d::Zero();
  for (Index i = 0; i < 4; ++i) {
    const Vector3d xh = R0.transpose() * x.col(i);
    sum += 0.25 * X.col(i).cross(xh);
    D += 0.25 * (X.col(i).dot(xh) * Matrix3d::Identity() - xh * X.col(i).transpose());
  }
  EXPECT_LT(sum.norm(), 1e-13);
  for (Index i = 0; i < 4; ++i) {
    const Matrix3d U = D.inverse() * 0.25 * theory::skew(X.col(i)) * R0.transpose();
    EXPECT_LT((scratch.motion.node[static_cast<std::size_t>(i)].U_x - U).norm(), tolerance);
  }
}

// (17) to (19), (23) to (25): the rates are those of the bodies that need them.
TEST_F(Theory, DeformationAndItsRates) {
  take(InertiaOption::M);
  const theory::Motion m = motion();
  const SuperelementScratch scratch = evaluated();
  const LocalMotion<double>& own = scratch.motion;
  const Index nb = 6 * m.nodes;
  EXPECT_LT(relative_difference(own.y_B, m.y.head(nb)), tolerance);
  EXPECT_LT((own.Omega0 - m.Omega0).norm() + (own.origin_velocity - m.v0).norm(), tolerance);
  EXPECT_LT(relative_difference(own.deformation_rate_B, m.yd.head(nb)), tolerance);
  EXPECT_LT(relative_difference(m.Upsilon * m.qd, m.yd), tolerance);
  EXPECT_LT(relative_difference(own.deformation_acceleration_B, m.ydd.head(nb)), tolerance);
  EXPECT_LT((own.Omega0d - m.Omega0d).norm() + (own.origin_acceleration - m.a0).norm(), tolerance);
}

// (20) to (22)
TEST_F(Theory, ElasticForcesAndTheirTangents) {
  take(InertiaOption::B);
  const theory::Motion m = motion();
  const MatrixXd S = theory::Constants(body_).S;
  EXPECT_LT(relative_difference(computed(resting(), Vector3d::Zero()), m.Upsilon.transpose() * S * m.y), tolerance);
  const MatrixXd K = m.Upsilon.transpose() * S * m.Upsilon;
  EXPECT_LT(relative_difference(tangent_of(state_, {0.0, 0.0, 1.0}, TangentKind::step), K), tolerance);
  EXPECT_LT(relative_difference(tangent_of(resting(), {0.0, 0.0, 1.0}, TangentKind::exact),
                                K + theory::frame_stiffness(m, S * m.y)),
            of_differences);
}

// (26) to (31)
TEST_F(Theory, InertiaOfAAndB) {
  for (const InertiaOption option : {InertiaOption::A, InertiaOption::B}) {
    take(option);
    const theory::Motion m = motion();
    const MatrixXd M = theory::Constants(body_).M;
    const Options with(m, option);
    const SuperelementScratch scratch = evaluated();
    EXPECT_LT(relative_difference(scratch.motion.rate_B, (with.P * m.qd).head(6 * m.nodes)), tolerance);
    const VectorXd inertia = computed(state_, Vector3d::Zero()) - computed(resting(), Vector3d::Zero());
    EXPECT_LT(relative_difference(inertia, with.forces(m, M)), of_differences);
    EXPECT_LT(
        relative_difference(tangent_of(state_, {1.0, 0.0, 0.0}, TangentKind::step), with.P.transpose() * M * with.P),
        tolerance);
    for (const TangentKind kind : {TangentKind::step, TangentKind::exact})
      EXPECT_LT(relative_difference(tangent_of(state_, {0.0, 1.0, 0.0}, kind),
                                    with.velocity_tangent(m, M, M * with.P * m.qd)),
                of_differences);
  }
}

// (32) to (36)
TEST_F(Theory, InertiaOfM) {
  take(InertiaOption::M);
  const theory::Motion m = motion();
  const theory::Constants part(body_);
  const MatrixXd& Gamma = part.Gamma;
  const MatrixXd less = part.M - Gamma.transpose() * Gamma / part.mass;
  const Vector3d c = part.center + Gamma * m.y / part.mass, c_rate = Gamma * m.yd / part.mass,
                 c_acceleration = Gamma * m.ydd / part.mass;
  const MatrixXd J = center_rows(m, part, Gamma);
  const SuperelementScratch scratch = evaluated();
  EXPECT_LT((scratch.motion.center - c).norm() + (scratch.motion.center_velocity - J * m.qd).norm(), tolerance);
  const Vector3d acceleration =
      m.a0 + m.Omega0d.cross(c) + m.Omega0.cross(m.Omega0.cross(c)) + 2.0 * m.Omega0.cross(c_rate) + c_acceleration;
  EXPECT_LT((scratch.motion.center_acceleration - acceleration).norm(), tolerance);
  const Options b(m, InertiaOption::B);
  const VectorXd yd = b.P * m.qd;
  const double T = 0.5 * yd.dot(less * yd) + 0.5 * part.mass * (J * m.qd).squaredNorm();
  EXPECT_NEAR(energy(body_, scratch, Vector3d::Zero()).kinetic, T, tolerance * T);
  const VectorXd inertia = computed(state_, Vector3d::Zero()) - computed(resting(), Vector3d::Zero());
  EXPECT_LT(relative_difference(inertia, b.forces(m, less) + part.mass * J.transpose() * acceleration), of_differences);
}

// (37): without U̇ in J̇ and without the gyroscopic coupling of internal coordinates.
TEST_F(Theory, StepTangentOfM) {
  const TangentCoefficients c{1.3, 0.7, 0.0};
  take(InertiaOption::M);
  const theory::Motion m = motion();
  const theory::Constants part(body_);
  const MatrixXd& Gamma = part.Gamma;
  const Options b(m, InertiaOption::B);
  const MatrixXd J = center_rows(m, part, Gamma);
  MatrixXd Upsilon_rate = MatrixXd::Zero(m.size, m.size), turns = Upsilon_rate, J_turned = J;
  for (Index i = 0; i < m.nodes; ++i) {
    const Matrix3d rate = theory::inverse_tangent_rate(m.psi(i), m.yd.segment<3>(6 * i + 3));
    Upsilon_rate.middleRows<3>(6 * i) = theory::skew(m.yd.segment<3>(6 * i)) * m.U;
    Upsilon_rate.middleRows<3>(6 * i + 3) = -rate.transpose() * m.U;
    Upsilon_rate.block<3, 3>(6 * i + 3, 6 * i + 3) += rate;
    for (Index j = 0; j < m.nodes; ++j)
      Upsilon_rate.block<3, 3>(6 * i, 6 * j) -=
          ((i == j ? 1.0 : 0.0) - m.alpha[j]) * theory::skew(m.Omega0) * m.R0.transpose();
    turns.block<3, 3>(6 * i + 3, 6 * i + 3) = theory::skew(m.at(i).Omega);
  }
  const MatrixXd A0_rate = -theory::skew(m.Omega0) * m.A0;
  const MatrixXd J_rate = A0_rate - theory::skew(Gamma * m.yd / part.mass) * m.U + Gamma * Upsilon_rate / part.mass;
  const MatrixXd A_v = 2.0 * (theory::skew(m.Omega0) * J + J_rate) - J * turns;
  const MatrixXd Pt = b.P.transpose();
  const MatrixXd W = c.mass * Pt + c.damping * (Pt * b.O0 + Pt * b.OB - m.U.transpose() * b.V.transpose());
  const MatrixXd Z = c.mass * b.P + c.damping * (b.O0.transpose() * b.P + b.V * m.U);
  const MatrixXd GG = Gamma.transpose() * Gamma;
  MatrixXd added = part.mass * J.transpose() * (c.mass * J + c.damping * A_v) -
                   (W * GG * b.P + Pt * GG * (Z - c.mass * b.P)) / part.mass;
  added.bottomRightCorner(body_.modes, body_.modes).setZero();
  const VectorXd p = (part.M - GG / part.mass) * b.P * m.qd;
  const MatrixXd of_b = c.mass * Pt * part.M * b.P + c.damping * b.velocity_tangent(m, part.M, p);
  EXPECT_LT(relative_difference(tangent_of(state_, c, TangentKind::step), of_b + added), of_differences);
}

// (38): the condensed tangent and residual, and what they give back.
TEST_F(Theory, EliminationOfInternalCoordinates) {
  for (const InertiaOption option : {InertiaOption::A, InertiaOption::B, InertiaOption::M}) {
    take(option);
    const TangentCoefficients c{1.3, 0.7, 2.0};
    const Index nb = body_.boundary_size, m = body_.modes;
    const MatrixXd A = tangent_of(state_, c, TangentKind::step);
    const MatrixXd eliminated = A.topRightCorner(nb, m) * A.bottomRightCorner(m, m).inverse();
    SuperelementScratch scratch = evaluated();
    SuperelementWork work = make_work(body_);
    tangent(body_, c, scratch, work);
    EXPECT_LT(relative_difference(work.A_BB, A.topLeftCorner(nb, nb) - eliminated * A.bottomLeftCorner(m, nb)),
              tolerance);
    condense(body_, scratch, work);
    const VectorXd r_B = scratch.forces.r_B - eliminated * scratch.forces.r_I;
    EXPECT_LT(relative_difference(work.r_B_condensed, r_B), tolerance);
    const VectorXd dq = VectorXd::LinSpaced(nb, -1.0, 1.0);
    VectorXd dy(m);
    expand(body_, scratch, dq.data(), dy.data(), work);
    EXPECT_LT(relative_difference(A.bottomRightCorner(m, m) * dy, -scratch.forces.r_I - A.bottomLeftCorner(m, nb) * dq),
              tolerance);
  }
}

// (39)
TEST_F(Theory, Weight) {
  for (const InertiaOption option : {InertiaOption::A, InertiaOption::B, InertiaOption::M}) {
    take(option);
    const theory::Constants part(body_);
    const theory::Motion m = motion();
    const Vector3d g(1.0, -2.0, -9.0);
    const VectorXd weight = part.mass * center_rows(m, part, part.Gamma).transpose() * m.R0.transpose() * g;
    EXPECT_LT(relative_difference(computed(resting(), Vector3d::Zero()) - computed(resting(), g), weight),
              of_differences);
  }
}

// (40), (41): each of the four parts.
TEST_F(Theory, Damping) {
  take(InertiaOption::B);
  const VectorXd undamped = computed(state_, Vector3d::Zero());
  const theory::Constants part(body_);
  const theory::Motion m = motion();
  formats::Damping damping;
  damping.stiffness = 0.03;
  damping.mass = 0.2;
  damping.ratio = 0.01;
  damping.ratio_internal = 0.02;
  const MatrixXd J0 = part.Phi.transpose() * part.M * part.Phi, MPhi = part.M * part.Phi;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> free_modes(part.S, part.M);
  MatrixXd D = 0.03 * part.S + 0.2 * (part.M - MPhi * J0.inverse() * MPhi.transpose());
  for (Index k = 6; k < part.size; ++k) {
    const VectorXd f = part.M * free_modes.eigenvectors().col(k);
    D += 2.0 * 0.01 * std::sqrt(free_modes.eigenvalues()[k]) * f * f.transpose();
  }
  D.diagonal().tail(body_.modes) += 2.0 * 0.02 * body_.S_II.cwiseSqrt();
  take(InertiaOption::B, damping);
  EXPECT_LT(
      relative_difference(computed(state_, Vector3d::Zero()) - undamped, m.Upsilon.transpose() * D * m.Upsilon * m.qd),
      1e-8);  // the modes of the free body come from another eigenproblem
}

}  // namespace
}  // namespace tisserand::mechanism::theory_test
