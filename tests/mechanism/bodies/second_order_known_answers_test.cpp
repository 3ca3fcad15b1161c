// SPDX-License-Identifier: GPL-3.0-or-later
// Known answers of an independent implementation of stiffening and full inertia, and laws that they obey.
#include <string>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "mechanism/bodies/superelement/tangent/second_order_tangent.hpp"
#include "tests/support/bodies/second_order_known_answers.hpp"
#include "tests/support/bodies/superelement_known_answers.hpp"
#include "tests/support/bodies/uncondensed_tangent.hpp"

namespace tisserand::mechanism::second_order_known_answers_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::InertiaOption;
using formats::StiffeningOption;
using test_support::BodyState;
using test_support::relative_difference;
using test_support::to_vector;

// The references agree with exact Lagrange equations by complex step to 2e-14; eigenvectors of the rows cost digits.
constexpr double kTolerance = 1e-11;

class SecondOrderAnswers : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    answer_ = test_support::second_order_answer(GetParam());
    result_ = answer_.entry["results"];
    gravity_ = to_vector(answer_.entry["gravity"]);
    take(InertiaOption::F, StiffeningOption::full);
  }

  void take(InertiaOption inertia, StiffeningOption stiffening) {
    body_ = second_order_body(answer_, inertia, stiffening);
    scratch_ = make_scratch(body_);
    state_ = second_order_state(answer_, body_);
    test_support::evaluate(body_, state_, gravity_, scratch_);
  }

  /// From canonical internal coordinates to those of the file: forces.
  VectorXd in_file(VectorXd r) const {
    r.tail(body_.modes) =
        MatrixXd(body_.file.modal_part.transpose()).partialPivLu().solve(VectorXd(r.tail(body_.modes)));
    return r;
  }

  VectorXd on_body(VectorXd v) const {
    v.tail(body_.modes) = body_.file.modal_part.partialPivLu().solve(VectorXd(v.tail(body_.modes)));
    return v;
  }

  VectorXd residual() const {
    VectorXd r(body_.boundary_size + body_.modes);
    r << scratch_.forces.r_B, scratch_.forces.r_I;
    return in_file(r);
  }

  VectorXd direction() const { return on_body(to_vector(answer_.entry["state"]["direction"])); }

  /// The whole tangent of one kind times the direction of the answer.
  VectorXd product(const TangentCoefficients& c, TangentKind kind) const {
    MatrixXd A;
    test_support::uncondensed_tangent(body_, scratch_, test_support::in_order(state_.nodes), gravity_, c, kind, A);
    return in_file(A * direction());
  }

  test_support::SecondOrderAnswer answer_;
  nlohmann::json result_;
  Vector3d gravity_;
  SuperelementBody body_;
  SuperelementScratch scratch_;
  BodyState state_;
};

TEST_P(SecondOrderAnswers, DeformationEnergiesAndMomenta) {
  VectorXd y(file_coordinate_count(body_));
  file_coordinates(body_, scratch_, y);
  EXPECT_LT(relative_difference(y, to_vector(result_["y"])), kTolerance);
  const SuperelementEnergy e = energy(body_, scratch_, gravity_);
  EXPECT_NEAR(e.strain, result_["strain_energy"].get<double>(), kTolerance * e.strain);
  EXPECT_NEAR(e.kinetic, result_["kinetic_energy"].get<double>(), kTolerance * e.kinetic);
  EXPECT_NEAR(e.gravity_potential, result_["gravity_potential"].get<double>(),
              kTolerance * std::abs(e.gravity_potential));
  const auto& t = scratch_.forces.inertia;
  const Vector3d P = scratch_.motion.R0 * t.pi_v, L = scratch_.motion.x0.cross(P) + scratch_.motion.R0 * t.pi_O;
  EXPECT_LT(relative_difference(P, to_vector(result_["linear_momentum"])), kTolerance);
  EXPECT_LT(relative_difference(L, to_vector(result_["angular_momentum_about_origin"])), kTolerance);
}

TEST_P(SecondOrderAnswers, ElasticForce) {
  const auto& t = scratch_.forces.strain;
  VectorXd f = t.force;
  f.head(body_.boundary_size) += body_.S_BB * t.y.head(body_.boundary_size);
  f.tail(body_.modes) += body_.S_II.cwiseProduct(t.y.tail(body_.modes));
  EXPECT_LT(relative_difference(in_file(f), to_vector(result_["f_y"])), kTolerance);
}

// K_y d = S d + Σ [(l_a + h_a)(h_a . d) + h_a (l_a . d) + e_a Γ_a d] with the rows of the body.
TEST_P(SecondOrderAnswers, StiffnessOfTheDeformedBody) {
  const auto& t = scratch_.forces.strain;
  const Stiffening& stiffening = *body_.second_order.stiffening;
  const VectorXd d = direction(), linear = stiffening.L * d, bent = t.h * d;
  FormRows<double> turned(t.h.rows(), t.h.cols());
  apply_forms<double>(stiffening.Gamma, d, turned);
  VectorXd product = stiffening.L.transpose() * bent + t.h.transpose() * (linear + bent) + turned.transpose() * t.e;
  product.head(body_.boundary_size) += body_.S_BB * d.head(body_.boundary_size);
  product.tail(body_.modes) += body_.S_II.cwiseProduct(d.tail(body_.modes));
  EXPECT_LT(relative_difference(in_file(product), to_vector(result_["Ky_direction"])), kTolerance);
}

TEST_P(SecondOrderAnswers, ForcesAreThoseOfLagrange) {
  EXPECT_LT(relative_difference(residual(), to_vector(result_["G"])), kTolerance);
  EXPECT_LT(relative_difference(residual(), to_vector(result_["G_exact_lagrange"])), kTolerance);
}

TEST_P(SecondOrderAnswers, SwitchesOfEachTerm) {
  take(InertiaOption::F, StiffeningOption::off);
  EXPECT_LT(relative_difference(residual(), to_vector(result_["G_linear_strain_no_second_order_inertia"])), kTolerance);
  take(InertiaOption::F, StiffeningOption::stress);
  EXPECT_LT(relative_difference(residual(), to_vector(result_["G_strain_only"])), kTolerance);
}

TEST_P(SecondOrderAnswers, TangentOfMass) {
  const VectorXd expected = to_vector(result_["mass_matrix_times_direction"]);
  EXPECT_LT(relative_difference(product({1.0, 0.0, 0.0}, TangentKind::step), expected), kTolerance);
  EXPECT_LT(relative_difference(product({1.0, 0.0, 0.0}, TangentKind::exact), expected), kTolerance);
}

TEST_P(SecondOrderAnswers, TangentOfStrain) {
  const VectorXd projected = to_vector(result_["static_tangent_Ky_part_times_direction"]);
  const VectorXd frame = to_vector(result_["static_tangent_frame_part_times_direction"]);
  const VectorXd both = product({0.0, 0.0, 1.0}, TangentKind::step);
  EXPECT_LT(relative_difference(both, projected + frame), kTolerance);
  // Without the frame's part.
  const int nb = body_.boundary_size;
  MatrixXd A = MatrixXd::Zero(nb + body_.modes, nb + body_.modes), K_f = MatrixXd::Zero(nb, nb);
  Eigen::Matrix<double, 3, Eigen::Dynamic> dm(3, nb), dc(3, nb);
  SuperelementTangent frozen = scratch_.tangent;
  frozen.R0 = scratch_.motion.R0;
  frozen.node = scratch_.motion.node;
  add_frame_stiffness<3>(body_, frozen, scratch_.forces.s_B, 1.0, {dm, dc}, K_f);
  A.topLeftCorner(nb, nb) = K_f;
  EXPECT_LT(relative_difference(in_file(A * direction()), frame), kTolerance);
}

// Without motion and weight the stiffness by hand is that of the dual numbers.
TEST_P(SecondOrderAnswers, StepTangentAtRestIsExact) {
  for (const auto& [inertia, stiffening] :
       {std::pair{InertiaOption::F, StiffeningOption::full}, std::pair{InertiaOption::F, StiffeningOption::stress}}) {
    take(inertia, stiffening);
    for (NodeMotion& node : state_.nodes) node.xd = node.Omega = node.xdd = node.Omegad = Vector3d::Zero();
    state_.yd.setZero();
    state_.ydd.setZero();
    test_support::evaluate(body_, state_, Vector3d::Zero(), scratch_);
    MatrixXd step, exact;
    for (const TangentCoefficients& c : {TangentCoefficients{0.0, 0.0, 1.0}, TangentCoefficients{1.0, 0.0, 0.1}}) {
      test_support::uncondensed_tangent(body_, scratch_, test_support::in_order(state_.nodes), Vector3d::Zero(), c,
                                        TangentKind::step, step);
      test_support::uncondensed_tangent(body_, scratch_, test_support::in_order(state_.nodes), Vector3d::Zero(), c,
                                        TangentKind::exact, exact);
      EXPECT_LT(relative_difference(step, exact), 1e-10);
    }
  }
}

TEST_P(SecondOrderAnswers, EliminationSolvesTheWholeSystem) {
  for (const auto& [inertia, stiffening] :
       {std::pair{InertiaOption::F, StiffeningOption::full}, std::pair{InertiaOption::F, StiffeningOption::off},
        std::pair{InertiaOption::M, StiffeningOption::stress}})
    for (const TangentKind kind : {TangentKind::step, TangentKind::exact}) {
      take(inertia, stiffening);
      SuperelementWork work = make_work(body_);
      const TangentCoefficients c{.mass = 3.0, .damping = 0.7, .stiffness = 0.2};
      const auto nodes = test_support::in_order(state_.nodes);
      if (kind == TangentKind::step)
        tangent(body_, c, scratch_, work);
      else
        exact_tangent(body_, nodes, gravity_, c, scratch_, work);
      MatrixXd A;
      test_support::uncondensed_tangent(body_, scratch_, nodes, gravity_, c, kind, A);
      condense(body_, scratch_, work);
      VectorXd r(A.rows()), d(A.rows());
      r << scratch_.forces.r_B, scratch_.forces.r_I;
      const VectorXd expected = A.partialPivLu().solve(-r);
      d.head(body_.boundary_size) = work.A_BB.partialPivLu().solve(-work.r_B_condensed);
      expand(body_, scratch_, d.data(), d.data() + body_.boundary_size, work);
      EXPECT_LT(relative_difference(d, expected), 1e-9);
      VectorXd motion(body_.modes);
      expand_motion(body_, scratch_, d.data(), motion.data(), work);
      const MatrixXd II = A.bottomRightCorner(body_.modes, body_.modes);
      EXPECT_LT(
          relative_difference(motion, -II.partialPivLu().solve(A.bottomLeftCorner(body_.modes, body_.boundary_size) *
                                                               d.head(body_.boundary_size))),
          1e-9);
    }
}

TEST_P(SecondOrderAnswers, StiffnessAndMassAtRestAreThoseOfTheFile) {
  for (std::size_t i = 0; i < state_.nodes.size(); ++i) {
    state_.nodes[i] = {};
    state_.nodes[i].x = body_.node[i].X;
  }
  state_.y.setZero();
  state_.yd.setZero();
  state_.ydd.setZero();
  state_.R0_reference.setIdentity();
  test_support::evaluate(body_, state_, Vector3d::Zero(), scratch_);
  MatrixXd A;
  const auto nodes = test_support::in_order(state_.nodes);
  test_support::uncondensed_tangent(body_, scratch_, nodes, Vector3d::Zero(), {0.0, 0.0, 1.0}, TangentKind::step, A);
  const int nb = body_.boundary_size;
  EXPECT_LT(relative_difference(A.topLeftCorner(nb, nb), body_.S_BB), 1e-12);
  EXPECT_LT(relative_difference(A.diagonal().tail(body_.modes), body_.S_II), 1e-12);
  test_support::uncondensed_tangent(body_, scratch_, nodes, Vector3d::Zero(), {1.0, 0.0, 0.0}, TangentKind::step, A);
  EXPECT_LT(relative_difference(A.topLeftCorner(nb, nb), body_.M_BB), 1e-12);
  EXPECT_LT(relative_difference(A.topRightCorner(nb, body_.modes), body_.M_BI), 1e-12);
}

// [M̄ C; Cᵀ E] is a Gram matrix, so that the kinetic energy is none less than zero.
TEST_P(SecondOrderAnswers, MassIsPositive) {
  for (const double factor : {1.0, 3.0}) {
    for (std::size_t i = 0; i < state_.nodes.size(); ++i) {
      state_.nodes[i].x += (factor - 1.0) * 0.1 * body_.node[i].X;
      state_.nodes[i].R =
          (state_.nodes[i].R * exp_so3<double>(Vector3d(0.1 * (factor - 1.0), 0.05 * double(i), 0))).eval();
    }
    test_support::evaluate(body_, state_, gravity_, scratch_);
    MatrixXd A;
    test_support::uncondensed_tangent(body_, scratch_, test_support::in_order(state_.nodes), gravity_, {1.0, 0.0, 0.0},
                                      TangentKind::step, A);
    EXPECT_LT(relative_difference(A, A.transpose()), 1e-12);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(A).eigenvalues()[0], 0.0);
  }
}

TEST_P(SecondOrderAnswers, SuperposedRigidMotionChangesNothing) {
  const VectorXd before = residual();
  const double strain = energy(body_, scratch_, gravity_).strain;
  const Eigen::Matrix3d Q = exp_so3<double>(Vector3d(0.8, -1.1, 0.4));
  for (NodeMotion& node : state_.nodes) {
    node.x = Q * node.x + Vector3d(3.0, -1.0, 2.0);
    node.R = Q * node.R;
    node.xd = Q * node.xd;
    node.xdd = Q * node.xdd;
  }
  state_.R0_reference = Q * state_.R0_reference;
  test_support::evaluate(body_, state_, Q * gravity_, scratch_);
  VectorXd after = residual();
  for (const SuperelementNode& node : body_.node)
    after.segment<3>(node.translation_row) = (Q.transpose() * after.segment<3>(node.translation_row)).eval();
  EXPECT_LT(relative_difference(after, before), kTolerance);
  EXPECT_NEAR(energy(body_, scratch_, gravity_).strain, strain, kTolerance * strain);
}

INSTANTIATE_TEST_SUITE_P(Bodies, SecondOrderAnswers, ::testing::Values("beam2", "lframe3"));

}  // namespace
}  // namespace tisserand::mechanism::second_order_known_answers_test
