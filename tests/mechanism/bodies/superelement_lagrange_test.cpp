// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of the superelement body against Lagrange's equations on deformed states, and the balances that follow from
// them.
#include <complex>
#include <string>

#include <gtest/gtest.h>

#include "mechanism/bodies/superelement/forces/full_inertia.hpp"
#include "mechanism/bodies/superelement/tangent/second_order_tangent.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/bodies/second_order_known_answers.hpp"
#include "tests/support/bodies/superelement_cases.hpp"
#include "tests/support/bodies/uncondensed_tangent.hpp"

namespace tisserand::mechanism::superelement_lagrange_test {
namespace {

using Complex = std::complex<double>;
using ComplexNode = NodeMotionOf<Complex>;
using formats::FrameKind;
using formats::InertiaOption;
using test_support::BodyState;
using test_support::relative_difference;

constexpr double kStep = 1e-30;
const Complex kI(0.0, kStep);
const Eigen::Vector3d kGravity(0.7, -9.1, 2.0);

struct Case {
  std::string element;
  FrameKind frame;
  InertiaOption inertia;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.element << " frame " << static_cast<int>(c.frame) << ' ' << "ABM"[static_cast<int>(c.inertia)];
}

SuperelementBody make_body(const Case& c, const formats::Damping& damping) {
  const formats::Superelement element = test_support::test_superelement(c.element);
  SuperelementOptions options;
  options.frame = c.frame;
  options.frame_node = element.node_name[0];
  options.inertia = c.inertia;
  options.damping = damping;
  return build_superelement_body(element, formats::rigid_properties(element), options);
}

/// Configuration and velocity of one body in complex numbers.
struct ComplexState {
  std::vector<ComplexNode> nodes;
  Eigen::VectorXcd y, yd;
};

ComplexState to_complex(const BodyState& state) {
  ComplexState out;
  for (const NodeMotion& node : state.nodes) {
    ComplexNode n;
    n.x = node.x;
    n.R = node.R;
    n.xd = node.xd;
    n.Omega = node.Omega;
    n.xdd.setZero();
    n.Omegad.setZero();
    out.nodes.push_back(n);
  }
  out.y = state.y;
  out.yd = state.yd;
  return out;
}

/// q <- q + c dq (material rotation increments), v <- v + d dv.
void move(const SuperelementBody& body, const Eigen::VectorXd& dq, Complex c, const Eigen::VectorXd& dv, Complex d,
          ComplexState& state) {
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    ComplexNode& n = state.nodes[i];
    if (node.has_translation()) {
      n.x += c * dq.segment<3>(node.translation_row);
      n.xd += d * dv.segment<3>(node.translation_row);
    }
    if (node.has_rotation()) {
      n.R += (n.R * skew<Complex>(c * dq.segment<3>(node.rotation_row))).eval();
      n.Omega += d * dv.segment<3>(node.rotation_row);
    }
  }
  state.y += c * dq.tail(body.modes);
  state.yd += d * dv.tail(body.modes);
}

struct Energies {
  Complex kinetic, potential;
};

/// T = ½ ẏᵀ M̄ ẏ (option M: + ½ m (|ẋ_cm|² − |Φ_TᵀM̄ ẏ/m|²)) and V = ½ yᵀ S̄ y − m g·x_cm, straight from their
/// definitions.
Energies energies(const SuperelementBody& body, const ComplexState& state, const Eigen::Matrix3d& R0,
                  const Eigen::Vector3d& gravity) {
  auto motion = make_local_motion<Complex>(body);
  motion.R0 = R0.cast<Complex>();
  motion.y_I = state.y;
  motion.rate_I = state.yd;
  local_motion<Complex>(body, test_support::in_order(state.nodes), motion);
  const auto form = [](const auto& a, const Eigen::MatrixXd& A, const auto& b) {
    return (a.transpose() * (A * b))(0, 0);
  };
  Energies e;
  e.kinetic = 0.5 * form(motion.rate_B, body.M_BB, motion.rate_B) + 0.5 * (state.yd.transpose() * state.yd)(0, 0);
  e.potential = 0.5 * form(motion.y_B, body.S_BB, motion.y_B);
  if (body.modes > 0) {
    e.kinetic += form(motion.rate_B, body.M_BI, state.yd);
    e.potential += 0.5 * (state.y.transpose() * (body.S_II.asDiagonal() * state.y))(0, 0);
  }
  if (body.inertia == InertiaOption::M) {
    const Vec3<Complex> mean = mean_of<Complex>(body, motion.rate_B, motion.rate_I);
    e.kinetic +=
        0.5 * body.mass * (dot3<Complex>(motion.center_velocity, motion.center_velocity) - dot3<Complex>(mean, mean));
  }
  if (body.second_order.inertia) {
    auto terms = make_inertia_terms<Complex>(*body.second_order.inertia);
    static_cast<void>(inertia_forces<Complex>(body, motion, Vec3<Complex>::Zero(), terms));
    e.kinetic = terms.kinetic;
  }
  const Vec3<Complex> center = motion.x0 + motion.R0 * deformed_center_of_mass<Complex>(body, motion);
  e.potential -= body.mass * dot3<Complex>(gravity.cast<Complex>(), center);
  return e;
}

Eigen::VectorXd pack(const SuperelementBody& body, const BodyState& state, Eigen::Vector3d NodeMotion::*x,
                     Eigen::Vector3d NodeMotion::*theta, const Eigen::VectorXd& internal) {
  Eigen::VectorXd out(body.boundary_size + body.modes);
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    if (body.node[i].has_translation()) out.segment<3>(body.node[i].translation_row) = state.nodes[i].*x;
    if (body.node[i].has_rotation()) out.segment<3>(body.node[i].rotation_row) = state.nodes[i].*theta;
  }
  out.tail(body.modes) = internal;
  return out;
}

/// d/dt ∂T/∂v + Ω × ∂T/∂Ω (rotations) − ∂T/∂q + ∂V/∂q. T is quadratic in v, so the central difference of ∂T/∂v is
/// exact; time and q derivatives are complex steps.
Eigen::VectorXd lagrange(const SuperelementBody& body, const BodyState& state, const Eigen::Matrix3d& R0) {
  const Eigen::VectorXd v = pack(body, state, &NodeMotion::xd, &NodeMotion::Omega, state.yd);
  const Eigen::VectorXd a = pack(body, state, &NodeMotion::xdd, &NodeMotion::Omegad, state.ydd);
  const Eigen::Index n = v.size();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd momentum(n), result(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(n, i);
    ComplexState plus = to_complex(state), minus = to_complex(state), here = to_complex(state);
    move(body, v, kI, a, kI, plus);
    move(body, v, kI, a, kI, minus);
    move(body, zero, 0.0, unit, 1.0, plus);
    move(body, zero, 0.0, unit, -1.0, minus);
    const Complex p = 0.5 * (energies(body, plus, R0, kGravity).kinetic - energies(body, minus, R0, kGravity).kinetic);
    move(body, unit, kI, zero, 0.0, here);
    const Energies e = energies(body, here, R0, kGravity);
    momentum[i] = p.real();
    result[i] = (p.imag() - e.kinetic.imag() + e.potential.imag()) / kStep;
  }
  for (std::size_t i = 0; i < body.node.size(); ++i)
    if (body.node[i].has_rotation()) {
      const int row = body.node[i].rotation_row;
      result.segment<3>(row) += state.nodes[i].Omega.cross(momentum.segment<3>(row));
    }
  return result;
}

/// Forces of the body at the state, boundary then internal.
Eigen::VectorXd forces_of(const SuperelementBody& body, const BodyState& state, SuperelementScratch& scratch) {
  test_support::evaluate(body, state, kGravity, scratch);
  Eigen::VectorXd r(body.boundary_size + body.modes);
  r << scratch.forces.r_B, scratch.forces.r_I;
  return r;
}

// What any antisymmetric W adds to the forces is what it adds to Lagrange's equations of the kinetic energy, and the
// mass of the step tangent stays exact.
TEST(SuperelementForces, RelativeTurnsMeetLagrangesEquations) {
  for (const char* name : {"beam2", "lframe3"}) {
    test_support::SecondOrderAnswer answer = test_support::second_order_answer(name);
    const SuperelementBody without = second_order_body(answer, InertiaOption::F, formats::StiffeningOption::full);
    const Eigen::Index n = answer.element.size();
    for (int k = 0; k < 3; ++k) {
      const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(
          n, n, [k](Eigen::Index i, Eigen::Index j) { return 0.02 * std::sin(1.0 + k + 3.0 * i + 7.0 * j * j); });
      answer.companion.W[k] = A - A.transpose();
    }
    const SuperelementBody with = second_order_body(answer, InertiaOption::F, formats::StiffeningOption::full);
    const BodyState state = second_order_state(answer, with);
    SuperelementScratch scratch = make_scratch(with), other = make_scratch(without);
    const Eigen::VectorXd all = forces_of(with, state, scratch), added = all - forces_of(without, state, other);
    const Eigen::Matrix3d R0 = scratch.motion.R0;
    EXPECT_GT(added.norm(), 1e-4 * all.norm()) << name;
    EXPECT_LT((added - (lagrange(with, state, R0) - lagrange(without, state, R0))).norm(), 1e-11 * all.norm()) << name;
    const auto tangent = [&](TangentKind kind) {
      Eigen::MatrixXd A;
      test_support::uncondensed_tangent(with, scratch, test_support::in_order(state.nodes), kGravity, {1.0, 0.0, 0.0},
                                        kind, A);
      return A;
    };
    const Eigen::MatrixXd exact = tangent(TangentKind::exact);
    EXPECT_LT((tangent(TangentKind::step) - exact).norm(), 1e-12 * exact.norm()) << name;
  }
}

class SuperelementForcesOf : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    body_ = make_body(GetParam(), {});
    state_ = test_support::random_state(body_, 11, 0.15);
    scratch_ = make_scratch(body_);
  }
  SuperelementBody body_;
  BodyState state_;
  SuperelementScratch scratch_;
};

TEST_P(SuperelementForcesOf, MeetLagrangesEquations) {
  test_support::evaluate(body_, state_, kGravity, scratch_);
  const Eigen::Matrix3d R0 = GetParam().frame == FrameKind::paper ? state_.R0_reference : scratch_.motion.R0;
  Eigen::VectorXd r(body_.boundary_size + body_.modes);
  r << scratch_.forces.r_B, scratch_.forces.r_I;
  // T(v + e) − T(v − e) cancels one or two digits.
  EXPECT_LT(relative_difference(r, lagrange(body_, state_, R0)), 1e-12);
}

// ẋ_cm of option M is the derivative of x_cm along the motion, and ẍ_cm that of ẋ_cm.
TEST_P(SuperelementForcesOf, ExactCentreOfMassMovesAsItsDerivatives) {
  if (GetParam().inertia != InertiaOption::M) return;
  test_support::evaluate(body_, state_, kGravity, scratch_);
  const Eigen::VectorXd v = pack(body_, state_, &NodeMotion::xd, &NodeMotion::Omega, state_.yd);
  const Eigen::VectorXd a = pack(body_, state_, &NodeMotion::xdd, &NodeMotion::Omegad, state_.ydd);
  ComplexState moved = to_complex(state_);
  move(body_, v, kI, a, kI, moved);
  auto motion = make_local_motion<Complex>(body_);
  motion.R0 = scratch_.motion.R0.cast<Complex>();
  motion.y_I = moved.y;
  motion.rate_I = moved.yd;
  local_motion<Complex>(body_, test_support::in_order(moved.nodes), motion);
  const Vec3<Complex> center = motion.x0 + motion.R0 * deformed_center_of_mass<Complex>(body_, motion);
  const Vec3<Complex> velocity = motion.R0 * motion.center_velocity;
  const Eigen::Matrix3d R0 = scratch_.motion.R0;
  EXPECT_LT((R0 * scratch_.motion.center_velocity - center.imag() / kStep).norm(), 1e-13);
  EXPECT_LT((R0 * scratch_.motion.center_acceleration - velocity.imag() / kStep).norm(), 1e-12);
}

// The same motion seen from a turned world: material quantities and energies stay, world vectors turn. The incremental
// frame is not objective within a step (its R_ref would have to turn too), which is done here.
TEST_P(SuperelementForcesOf, TurnWithASuperposedRotation) {
  const Eigen::Matrix3d Q = exp_so3<double>(Eigen::Vector3d(1.1, -0.4, 1.9));
  const Eigen::Vector3d shift(3.0, -2.0, 5.0);
  test_support::evaluate(body_, state_, kGravity, scratch_);
  const Eigen::VectorXd r_B = scratch_.forces.r_B, r_I = scratch_.forces.r_I;
  const SuperelementEnergy before = energy(body_, scratch_, Eigen::Vector3d::Zero());
  for (NodeMotion& node : state_.nodes) {
    node.x = shift + Q * node.x;
    node.R = Q * node.R;
    node.xd = Q * node.xd;
    node.xdd = Q * node.xdd;
  }
  if (GetParam().frame == FrameKind::paper) state_.R0_reference = Q * state_.R0_reference;
  if (body_.frame == FrameAlgorithm::polar)
    state_.R0_reference = Q * state_.R0_reference;  // a start within the right basin
  test_support::evaluate(body_, state_, Q * kGravity, scratch_);
  const SuperelementEnergy after = energy(body_, scratch_, Eigen::Vector3d::Zero());
  EXPECT_NEAR(after.strain, before.strain, 1e-12 * before.strain);
  EXPECT_NEAR(after.kinetic, before.kinetic, 1e-12 * before.kinetic);
  Eigen::VectorXd expected = r_B;
  for (const SuperelementNode& node : body_.node)
    if (node.has_translation()) expected.segment<3>(node.translation_row) = Q * r_B.segment<3>(node.translation_row);
  EXPECT_LT(relative_difference(scratch_.forces.r_B, expected), 1e-12);
  if (body_.modes > 0) {
    EXPECT_LT((scratch_.forces.r_I - r_I).norm(), 1e-12 * r_B.norm());
  }
}

// ẋ = c + ω × r and its derivative on every node: no internal force, and resultants of Newton and Euler.
TEST_P(SuperelementForcesOf, RigidMotionObeysNewtonAndEuler) {
  const Eigen::Matrix3d R = exp_so3<double>(Eigen::Vector3d(0.3, 1.2, -0.8));
  const Eigen::Vector3d x0(1, 2, 3), v(0.4, -0.7, 0.2), omega(1.5, -2.0, 0.9), vd(0.3, 0.1, -0.6),
      omegad(-0.8, 0.5, 1.1);
  for (std::size_t i = 0; i < body_.node.size(); ++i) {
    const Eigen::Vector3d arm = R * body_.node[i].X;
    state_.nodes[i] = {x0 + arm,
                       R,
                       v + omega.cross(arm),
                       R.transpose() * omega,
                       vd + omegad.cross(arm) + omega.cross(omega.cross(arm)),
                       R.transpose() * omegad};
  }
  state_.y.setZero();
  state_.yd.setZero();
  state_.ydd.setZero();
  state_.R0_reference = R;
  test_support::evaluate(body_, state_, Eigen::Vector3d::Zero(), scratch_);
  EXPECT_LT(scratch_.motion.y_B.norm(), 1e-14);
  EXPECT_LT((scratch_.motion.Omega0 - R.transpose() * omega).norm(), 1e-13);
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < body_.node.size(); ++i) {
    const SuperelementNode& node = body_.node[i];
    if (node.has_translation()) {
      const Eigen::Vector3d f = scratch_.forces.r_B.segment<3>(node.translation_row);
      force += f;
      moment += (R * node.X).cross(f);
    }
    if (node.has_rotation()) moment += R * scratch_.forces.r_B.segment<3>(node.rotation_row);
  }
  const formats::RigidProperties rigid = formats::rigid_properties(test_support::test_superelement(GetParam().element));
  const Eigen::Vector3d c = R * body_.center_of_mass;
  const Eigen::Matrix3d J = R * rigid.inertia * R.transpose();
  const Eigen::Vector3d expected_force = rigid.mass * (vd + omegad.cross(c) + omega.cross(omega.cross(c)));
  const Eigen::Vector3d expected_moment = J * omegad + omega.cross(J * omega) + c.cross(expected_force);
  EXPECT_LT((force - expected_force).norm(), 1e-12 * expected_force.norm());
  EXPECT_LT((moment - expected_moment).norm(), 1e-12 * expected_moment.norm());
}

// Free forces of a deformed body: resultants of internal forces vanish (Karcher), whatever the deformation.
TEST_P(SuperelementForcesOf, InternalForcesAreInEquilibrium) {
  for (NodeMotion& node : state_.nodes) node.xd = node.Omega = node.xdd = node.Omegad = Eigen::Vector3d::Zero();
  state_.yd.setZero();
  state_.ydd.setZero();
  test_support::evaluate(body_, state_, Eigen::Vector3d::Zero(), scratch_);
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < body_.node.size(); ++i) {
    const SuperelementNode& node = body_.node[i];
    if (node.has_translation()) {
      const Eigen::Vector3d f = scratch_.forces.r_B.segment<3>(node.translation_row);
      force += f;
      moment += (state_.nodes[i].x - scratch_.motion.x0).cross(f);
    }
    if (node.has_rotation()) moment += state_.nodes[i].R * scratch_.forces.r_B.segment<3>(node.rotation_row);
  }
  const double scale = scratch_.forces.r_B.norm();
  ASSERT_GT(scale, 1.0);
  EXPECT_LT(force.norm(), 1e-12 * scale);
  if (GetParam().frame != FrameKind::paper) {
    EXPECT_LT(moment.norm(), 1e-12 * scale);
  }
}

// Work of the weight along a closed loop through deformed states: exact potential, so only quadrature error remains;
// the trapezoid rule on a periodic analytic path converges faster than any power, 200 points reach round-off.
TEST_P(SuperelementForcesOf, WeightDoesNoWorkAlongAClosedLoop) {
  if (GetParam().frame == FrameKind::paper) return;  // R_ref changes from step to step: no potential over several steps
  const BodyState start = state_;
  const Eigen::VectorXd p = pack(body_, start, &NodeMotion::xd, &NodeMotion::Omega, start.yd);
  const Eigen::VectorXd q = pack(body_, start, &NodeMotion::xdd, &NodeMotion::Omegad, start.ydd);
  double work = 0.0, path = 0.0;
  const int points = 200;
  for (int k = 0; k < points; ++k) {
    const double t = 2.0 * 3.14159265358979323846 * k / points;
    const Eigen::VectorXd offset = 0.3 * (std::cos(t) * p + std::sin(t) * q),
                          rate = 0.3 * (-std::sin(t) * p + std::cos(t) * q);
    Eigen::VectorXd increment = rate;
    state_ = start;
    for (std::size_t i = 0; i < body_.node.size(); ++i) {
      const SuperelementNode& node = body_.node[i];
      state_.nodes[i].xd = state_.nodes[i].Omega = state_.nodes[i].xdd = state_.nodes[i].Omegad =
          Eigen::Vector3d::Zero();
      if (node.has_translation()) state_.nodes[i].x += offset.segment<3>(node.translation_row);
      if (!node.has_rotation()) continue;
      const Eigen::Vector3d psi = offset.segment<3>(node.rotation_row);
      state_.nodes[i].R = start.nodes[i].R * exp_so3<double>(psi);
      increment.segment<3>(node.rotation_row) = tangent_so3<double>(psi) * rate.segment<3>(node.rotation_row);
    }
    state_.y += offset.tail(body_.modes);
    state_.yd.setZero();
    state_.ydd.setZero();
    test_support::evaluate(body_, state_, kGravity, scratch_);
    Eigen::VectorXd r(body_.boundary_size + body_.modes);
    r << scratch_.forces.r_B, scratch_.forces.r_I;
    test_support::evaluate(body_, state_, Eigen::Vector3d::Zero(), scratch_);
    r.head(body_.boundary_size) -= scratch_.forces.r_B;
    r.tail(body_.modes) -= scratch_.forces.r_I;
    const double power = r.dot(increment);
    work += power / points;
    path += std::abs(power) / points;
  }
  ASSERT_GT(path, 0.1);
  EXPECT_LT(std::abs(work), 1e-12 * path);
}

TEST_P(SuperelementForcesOf, DampingLeavesRigidMotionAlone) {
  formats::Damping damping{.mass = 3.0, .stiffness = 0.2, .ratio = 0.1, .ratios = {}};
  damping.ratios = {0.3};
  if (body_.modes > 0) damping.ratios_internal = {0.2};
  const SuperelementBody damped = make_body(GetParam(), damping);
  SuperelementScratch scratch = make_scratch(damped);
  // Deformed: the damping force is there, and its power is that of damping_power().
  test_support::evaluate(damped, state_, kGravity, scratch);
  test_support::evaluate(body_, state_, kGravity, scratch_);
  const Eigen::VectorXd v = pack(body_, state_, &NodeMotion::xd, &NodeMotion::Omega, state_.yd);
  Eigen::VectorXd difference(v.size());
  difference << scratch.forces.r_B - scratch_.forces.r_B, scratch.forces.r_I - scratch_.forces.r_I;
  const double power = damping_power(damped, scratch);
  EXPECT_GT(power, 0.1);
  EXPECT_NEAR(difference.dot(v), power, 1e-12 * difference.norm() * v.norm());
  // Rigid rates on the deformed body: nothing.
  const Eigen::Vector3d omega(1.5, -2.0, 0.9);
  for (NodeMotion& node : state_.nodes) {
    node.xd = Eigen::Vector3d(0.4, -0.7, 0.2) + omega.cross(node.x);
    node.Omega = node.R.transpose() * omega;
  }
  state_.yd.setZero();
  test_support::evaluate(damped, state_, kGravity, scratch);
  test_support::evaluate(body_, state_, kGravity, scratch_);
  if (GetParam().frame == FrameKind::paper) return;  // its frame does not turn with the body exactly
  EXPECT_LT((scratch.forces.r_B - scratch_.forces.r_B).norm(), 1e-12 * scratch.forces.r_B.norm());
  EXPECT_LT(damping_power(damped, scratch), 1e-22);
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::string element : {"beam", "frame", "guyan", "mixed", "network"})
    for (const InertiaOption inertia : {InertiaOption::A, InertiaOption::B, InertiaOption::M}) {
      all.push_back({element, FrameKind::karcher, inertia});
      if (element == "network") continue;
      if (inertia != InertiaOption::M) all.push_back({element, FrameKind::paper, inertia});
      all.push_back({element, FrameKind::node, inertia});
    }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Bodies, SuperelementForcesOf, ::testing::ValuesIn(cases()));

}  // namespace
}  // namespace tisserand::mechanism::superelement_lagrange_test
