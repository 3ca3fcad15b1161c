// SPDX-License-Identifier: GPL-3.0-or-later
// Tangents of the superelement body: against complex steps, and condensed against uncondensed.
#include <complex>
#include <string>
#include <tuple>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/bodies/superelement_cases.hpp"
#include "tests/support/bodies/uncondensed_tangent.hpp"

namespace tisserand::mechanism::superelement_tangent_test {
namespace {

using Complex = std::complex<double>;
using formats::FrameKind;
using formats::InertiaOption;
using test_support::BodyState;
using test_support::relative_difference;

constexpr double kStep = 1e-30;  // complex step: no difference is formed, so no cancellation
const Eigen::Vector3d kGravity(0.7, -9.1, 2.0);

struct Case {
  std::string element;
  FrameKind frame;
  InertiaOption inertia;
  double damping;  ///< of M̄ and S̄, and ratio of the modes
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.element << " frame " << static_cast<int>(c.frame) << ' ' << "ABM"[static_cast<int>(c.inertia)]
             << " damping " << c.damping;
}

SuperelementBody make_body(const Case& c) {
  const formats::Superelement element = test_support::test_superelement(c.element);
  SuperelementOptions options;
  options.frame = c.frame;
  options.frame_node = element.node_name[0];
  options.inertia = c.inertia;
  options.damping = {.mass = c.damping, .stiffness = 0.1 * c.damping, .ratio = 0.05 * c.damping, .ratios = {}};
  options.damping.ratio_internal = 0.03 * c.damping;
  return build_superelement_body(element, formats::rigid_properties(element), options);
}

NodeMotionOf<Complex> moved(const NodeMotion& node, const Eigen::Vector3d& x, const Eigen::Vector3d& theta,
                            const TangentCoefficients& c) {
  const Complex i(0.0, kStep);
  NodeMotionOf<Complex> out;
  out.x = node.x + i * c.stiffness * x;
  out.R = node.R + i * c.stiffness * (node.R * skew<double>(theta));
  out.xd = node.xd + i * c.damping * x;
  out.Omega = node.Omega + i * c.damping * theta;
  out.xdd = node.xdd + i * c.mass * x;
  out.Omegad = node.Omegad + i * c.mass * theta;
  return out;
}

struct Derivatives {
  Eigen::MatrixXd residual;  ///< (nb + m)²
  Eigen::MatrixXd y;         ///< nb x (nb + m)
};

/// c_m ∂/∂v̇ + c_c ∂/∂v + c_k ∂/∂q of the residual and of y_B by complex steps through the kernels.
Derivatives complex_step(const SuperelementBody& body, const BodyState& state, const Eigen::Matrix3d& R0,
                         const TangentCoefficients& c) {
  const int nb = body.boundary_size, n = nb + body.modes;
  Derivatives result{Eigen::MatrixXd(n, n), Eigen::MatrixXd(nb, n)};
  auto motion = make_local_motion<Complex>(body);
  auto forces = make_forces<Complex>(body);
  std::vector<NodeMotionOf<Complex>> nodes(body.node.size());
  for (int column = 0; column < n; ++column) {
    const Eigen::VectorXd d = Eigen::VectorXd::Unit(n, column);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const SuperelementNode& node = body.node[i];
      const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
      nodes[i] =
          moved(state.nodes[i], node.has_translation() ? Eigen::Vector3d(d.segment<3>(node.translation_row)) : zero,
                node.has_rotation() ? Eigen::Vector3d(d.segment<3>(node.rotation_row)) : zero, c);
    }
    const Complex i(0.0, kStep);
    motion.y_I = state.y + i * c.stiffness * d.tail(body.modes);
    motion.rate_I = state.yd + i * c.damping * d.tail(body.modes);
    motion.acceleration_I = state.ydd + i * c.mass * d.tail(body.modes);
    motion.R0 = R0.cast<Complex>();
    local_motion<Complex>(body, test_support::in_order(nodes), motion);
    superelement_forces(body, motion, kGravity, forces);
    result.residual.col(column) << forces.r_B.imag() / kStep, forces.r_I.imag() / kStep;
    result.y.col(column) = motion.y_B.imag() / kStep;
  }
  return result;
}

class SuperelementTangents : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    body_ = make_body(GetParam());
    state_ = test_support::random_state(body_, 7, 0.1);
    scratch_ = make_scratch(body_);
    work_ = make_work(body_);
    test_support::evaluate(body_, state_, kGravity, scratch_);
  }
  Eigen::MatrixXd tangent_of(const TangentCoefficients& c, TangentKind kind) const {
    Eigen::MatrixXd A;
    test_support::uncondensed_tangent(body_, scratch_, test_support::in_order(state_.nodes), kGravity, c, kind, A);
    return A;
  }
  Eigen::Matrix3d start_of_frame() const {
    return GetParam().frame == FrameKind::paper ? state_.R0_reference : scratch_.motion.R0;
  }
  double step_error(const TangentCoefficients& c) const {
    return relative_difference(tangent_of(c, TangentKind::step), reference(c).residual);
  }
  Derivatives reference(const TangentCoefficients& c) const { return complex_step(body_, state_, start_of_frame(), c); }

  SuperelementBody body_;
  BodyState state_;
  SuperelementScratch scratch_;
  SuperelementWork work_;
};

TEST_P(SuperelementTangents, ExactKindIsTheDerivativeOfTheResidual) {
  for (const TangentCoefficients& c :
       {TangentCoefficients{.mass = 1}, {.damping = 1}, {.stiffness = 1}, {1.0, 3.0, 20.0}})
    EXPECT_LT(relative_difference(tangent_of(c, TangentKind::exact), reference(c).residual), 1e-12);
}

TEST_P(SuperelementTangents, StepKindHasExactMassAndPseudodamping) {
  EXPECT_LT(step_error({.mass = 1}), 1e-12);
  if (GetParam().inertia == InertiaOption::M) return;
  EXPECT_LT(step_error({.damping = 1}), 1e-12);
  EXPECT_LT(step_error({1.0, 3.0, 0.0}), 1e-12);
}

// Step stiffness is Υᵀ S̄ Υ with Υ = ∂y/∂q.
TEST_P(SuperelementTangents, StepStiffnessUsesTheExactProjector) {
  const TangentCoefficients c{.stiffness = 1};
  const Eigen::MatrixXd Upsilon = reference(c).y;
  Eigen::MatrixXd expected = Upsilon.transpose() * body_.S_BB * Upsilon;
  expected.bottomRightCorner(body_.modes, body_.modes) += Eigen::MatrixXd(body_.S_II.asDiagonal());
  EXPECT_LT(relative_difference(tangent_of(c, TangentKind::step), expected), 1e-12);
}

// Pseudodamping of option M: the gyroscopic coupling of internal coordinates is left out, and U̇, which falls with the
// deformation.
class CenterOfMassTangents : public SuperelementTangents {};

TEST_P(CenterOfMassTangents, LeaveOutWhatVanishesWithoutDeformation) {
  const TangentCoefficients c{.damping = 1};
  const auto set_state = [&](double deformation) {
    state_ = test_support::random_state(body_, 7, deformation);
    test_support::evaluate(body_, state_, kGravity, scratch_);
  };
  set_state(0.0);
  const int m = body_.modes;
  const Eigen::MatrixXd exact = reference(c).residual;
  Eigen::MatrixXd left_out = exact - tangent_of(c, TangentKind::step);
  const Eigen::MatrixXd gyroscopic =
      2.0 / body_.mass * body_.Gamma_I.transpose() * skew<double>(scratch_.motion.Omega0) * body_.Gamma_I;
  left_out.bottomRightCorner(m, m) -= gyroscopic;
  EXPECT_LT(left_out.cwiseAbs().maxCoeff(), 1e-12 * exact.cwiseAbs().maxCoeff());
  const auto boundary_error = [&](double deformation) {
    set_state(deformation);
    const Eigen::Index nb = body_.boundary_size;
    return relative_difference(tangent_of(c, TangentKind::step).topLeftCorner(nb, nb),
                               reference(c).residual.topLeftCorner(nb, nb));
  };
  const double small = boundary_error(1e-3);
  EXPECT_LT(small, 1e-2);
  if (small > 1e-12) {  // a frame of one node has U̇ = 0
    EXPECT_NEAR(boundary_error(1e-2) / small, 10.0, 3.0);
  }
}

/// Schur complement, condensed residual and both parts of the solution against a dense solve of the whole system.
void expect_condensed_equals_whole(const SuperelementBody& body, const SuperelementScratch& scratch,
                                   const Eigen::MatrixXd& A, SuperelementWork& work) {
  const Eigen::Index nb = body.boundary_size, m = body.modes;
  const Eigen::MatrixXd A_BI = A.topRightCorner(nb, m), A_IB = A.bottomLeftCorner(m, nb),
                        A_II = A.bottomRightCorner(m, m);
  EXPECT_LT(relative_difference(work.A_BB, A.topLeftCorner(nb, nb) - A_BI * A_II.inverse() * A_IB), 1e-12);
  Eigen::VectorXd r(nb + m);
  r << scratch.forces.r_B, scratch.forces.r_I;
  const Eigen::VectorXd whole = -A.partialPivLu().solve(r);
  condense(body, scratch, work);
  const Eigen::VectorXd dq_B = -work.A_BB.partialPivLu().solve(work.r_B_condensed);
  Eigen::VectorXd dy_I(m);
  expand(body, scratch, dq_B.data(), dy_I.data(), work);
  EXPECT_LT(relative_difference(dq_B, whole.head(nb)), 1e-12);
  if (m > 0) {
    EXPECT_LT((dy_I - whole.tail(m)).cwiseAbs().maxCoeff(), 1e-12 * whole.cwiseAbs().maxCoeff());
    expand_motion(body, scratch, dq_B.data(), dy_I.data(), work);
    EXPECT_LT(relative_difference(dy_I, -A_II.partialPivLu().solve(A_IB * dq_B)), 1e-12);
  }
}

TEST_P(SuperelementTangents, CondensedEqualsUncondensed) {
  // A step of 0.05, then others, then the first again: the cached constants must follow the coefficients.
  const TangentCoefficients first{1.1 * 1600.0, 0.55 * 40.0, 1.0}, second{1.0, 0.3, 0.02};
  for (const TangentCoefficients& c : {first, second, first}) {
    tangent(body_, c, scratch_, work_);
    expect_condensed_equals_whole(body_, scratch_, tangent_of(c, TangentKind::step), work_);
    exact_tangent(body_, test_support::in_order(state_.nodes), kGravity, c, scratch_, work_);
    expect_condensed_equals_whole(body_, scratch_, tangent_of(c, TangentKind::exact), work_);
  }
}

// Two uses that work with the same matrices in turn, each with coefficients of its own, are solved as if alone.
TEST_P(SuperelementTangents, UsesOfOneBodyTakeTurns) {
  const BodyState other_state = test_support::random_state(body_, 11, 0.1);
  SuperelementScratch other = make_scratch(body_);
  test_support::evaluate(body_, other_state, kGravity, other);
  const TangentCoefficients c{1.1 * 1600.0, 0.55 * 40.0, 1.0}, other_c{1.0, 0.3, 0.02};
  tangent(body_, c, scratch_, work_);
  const Eigen::MatrixXd A_BB = work_.A_BB;
  condense(body_, scratch_, work_);
  const Eigen::VectorXd r_B = work_.r_B_condensed, dq_B = Eigen::VectorXd::LinSpaced(body_.boundary_size, -1.0, 2.0);
  Eigen::VectorXd alone(body_.modes), in_turn(body_.modes);
  expand(body_, scratch_, dq_B.data(), alone.data(), work_);

  tangent(body_, c, scratch_, work_);
  EXPECT_EQ(work_.A_BB, A_BB);
  tangent(body_, other_c, other, work_);
  EXPECT_NE(work_.A_BB, A_BB);
  condense(body_, other, work_);
  condense(body_, scratch_, work_);
  EXPECT_EQ(work_.r_B_condensed, r_B);
  expand(body_, other, dq_B.data(), in_turn.data(), work_);
  expand(body_, scratch_, dq_B.data(), in_turn.data(), work_);
  EXPECT_EQ(in_turn, alone);
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::string element : {"beam", "frame", "guyan", "mixed", "network"})
    for (const InertiaOption inertia : {InertiaOption::A, InertiaOption::B, InertiaOption::M}) {
      all.push_back({element, FrameKind::karcher, inertia, 0.0});
      all.push_back({element, FrameKind::karcher, inertia, 0.4});
      if (element == "network") continue;
      if (inertia != InertiaOption::M) all.push_back({element, FrameKind::paper, inertia, 0.4});
      all.push_back({element, FrameKind::node, inertia, 0.0});
    }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Bodies, SuperelementTangents, ::testing::ValuesIn(cases()));

std::vector<Case> cases_of_the_exact_center() {
  std::vector<Case> all = cases();
  std::erase_if(all, [](const Case& c) { return c.inertia != InertiaOption::M; });
  return all;
}

INSTANTIATE_TEST_SUITE_P(Bodies, CenterOfMassTangents, ::testing::ValuesIn(cases_of_the_exact_center()));

}  // namespace
}  // namespace tisserand::mechanism::superelement_tangent_test
