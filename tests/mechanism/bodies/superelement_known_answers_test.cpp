// SPDX-License-Identifier: GPL-3.0-or-later
// Known answers of an independent implementation: weights, frame, y, U, forces, tangent products.
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "mechanism/bodies/superelement/evaluate.hpp"
#include "tests/support/bodies/superelement_known_answers.hpp"
#include "tests/support/bodies/uncondensed_tangent.hpp"

namespace tisserand::mechanism::superelement_known_answers_test {
namespace {

using formats::FrameKind;
using formats::InertiaOption;
using test_support::relative_difference;
using test_support::to_matrix;
using test_support::to_vector;

// The references agree between two programs to 7e-15; conditioning of the congruence and of the frame costs two digits
// more.
constexpr double kTolerance = 1e-11;

class KnownAnswers : public ::testing::TestWithParam<std::tuple<std::string, FrameKind, InertiaOption>> {
 protected:
  void SetUp() override {
    const auto& [name, frame, inertia] = GetParam();
    known_ = test_support::known_answer(name);
    SuperelementOptions options;
    options.frame = frame;
    options.inertia = inertia;
    body_ = build_superelement_body(known_.element, known_.rigid, options);
    result_ = known_.entry["results"][frame == FrameKind::paper ? "paper" : "karcher"];
    forces_ = result_[inertia == InertiaOption::A ? "optA" : "optB"];
    scratch_ = make_scratch(body_);
    state_ = test_support::known_state(known_, body_, frame == FrameKind::paper);
    test_support::evaluate(body_, state_, Eigen::Vector3d::Zero(), scratch_);
  }

  /// Forces on the file's coordinates from those on the canonical ones: r_I(file) = Q⁻ᵀ r_I (S_BI is 0 in these files).
  Eigen::VectorXd in_file_coordinates(const Eigen::VectorXd& r) const {
    Eigen::VectorXd out = r;
    const Eigen::MatrixXd Q_transposed = body_.file.modal_part.transpose();
    out.tail(body_.modes) = Q_transposed.partialPivLu().solve(Eigen::VectorXd(r.tail(body_.modes)));
    return out;
  }

  Eigen::VectorXd residual() const {
    Eigen::VectorXd r(body_.boundary_size + body_.modes);
    r << scratch_.forces.r_B, scratch_.forces.r_I;
    return in_file_coordinates(r);
  }

  /// (tangent of one kind) times the velocity or acceleration of the state.
  Eigen::VectorXd tangent_product(const TangentCoefficients& c, const Eigen::VectorXd& file_vector) const {
    Eigen::MatrixXd A;
    test_support::uncondensed_tangent(body_, scratch_, test_support::in_order(state_.nodes), Eigen::Vector3d::Zero(), c,
                                      TangentKind::step, A);
    Eigen::VectorXd v = file_vector;
    v.tail(body_.modes) = body_.file.modal_part.partialPivLu().solve(Eigen::VectorXd(file_vector.tail(body_.modes)));
    return in_file_coordinates(A * v);
  }

  test_support::KnownAnswer known_;
  SuperelementBody body_;
  nlohmann::json result_, forces_;
  SuperelementScratch scratch_;
  test_support::BodyState state_;
};

TEST_P(KnownAnswers, Weights) {
  const Eigen::VectorXd alpha = to_vector(known_.entry["alpha_robust"]);
  for (std::size_t i = 0; i < body_.node.size(); ++i) {
    EXPECT_NEAR(body_.node[i].alpha, alpha[i], kTolerance);
    EXPECT_NEAR(body_.node[i].alpha_rotation, alpha[i], kTolerance);
  }
}

TEST_P(KnownAnswers, Frame) {
  EXPECT_LT((scratch_.motion.x0 - to_vector(result_["x0"])).norm(), kTolerance);
  EXPECT_LT((scratch_.motion.R0 - to_matrix(result_["R0"])).norm(), kTolerance);
  EXPECT_LT((scratch_.motion.Omega0 - to_vector(result_["Omega0"])).norm(), kTolerance);
  const Eigen::MatrixXd U = to_matrix(result_["U"]);
  for (std::size_t i = 0; i < body_.node.size(); ++i)
    EXPECT_LT((scratch_.motion.node[i].U - U.middleCols<3>(body_.node[i].rotation_row)).norm(), kTolerance);
}

TEST_P(KnownAnswers, Deformation) {
  Eigen::VectorXd y(file_coordinate_count(body_));
  file_coordinates(body_, scratch_, y);
  EXPECT_LT(relative_difference(y, to_vector(result_["y"])), kTolerance);
}

TEST_P(KnownAnswers, Energies) {
  const SuperelementEnergy e = energy(body_, scratch_, Eigen::Vector3d::Zero());
  EXPECT_NEAR(e.strain, result_["V"].get<double>(), kTolerance * e.strain);
  EXPECT_NEAR(e.kinetic, forces_["T"].get<double>(), kTolerance * e.kinetic);
}

TEST_P(KnownAnswers, Forces) {
  const Eigen::VectorXd internal = to_vector(result_["Gint_exact"]), inertia = to_vector(forces_["Giner"]);
  EXPECT_LT(relative_difference(residual(), internal + inertia), kTolerance);
  for (NodeMotion& node : state_.nodes) node.xd = node.Omega = node.xdd = node.Omegad = Eigen::Vector3d::Zero();
  state_.yd.setZero();
  state_.ydd.setZero();
  test_support::evaluate(body_, state_, Eigen::Vector3d::Zero(), scratch_);
  EXPECT_LT(relative_difference(residual(), internal), kTolerance);
}

TEST_P(KnownAnswers, TangentProducts) {
  const Eigen::VectorXd v = to_vector(known_.entry["v"]), a = to_vector(known_.entry["a"]);
  EXPECT_LT(relative_difference(tangent_product({.mass = 1.0}, a), to_vector(forces_["Msup_times_a"])), kTolerance);
  EXPECT_LT(relative_difference(tangent_product({.damping = 1.0}, v), to_vector(forces_["Csup_times_v"])), kTolerance);
}

INSTANTIATE_TEST_SUITE_P(Cardona, KnownAnswers,
                         ::testing::Combine(::testing::Values("beam2", "lframe3"),
                                            ::testing::Values(FrameKind::karcher, FrameKind::paper),
                                            ::testing::Values(InertiaOption::A, InertiaOption::B)));

}  // namespace
}  // namespace tisserand::mechanism::superelement_known_answers_test
