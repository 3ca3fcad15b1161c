// The numbered formulas of docs/THEORY.md, sections 1 to 6, written down once more as they stand there and evaluated at
// a deformed, moving state: the program computes them.
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "mechanism/bodies/superelement/evaluate.hpp"
#include "tests/support/bodies/superelement_known_answers.hpp"

namespace tisserand::mechanism::theory_test {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::InertiaOption;
using test_support::relative_difference;

constexpr double tolerance = 1e-11;  // conditioning of the congruence costs two digits or three

Matrix3d skew(const Vector3d& a) {
  Matrix3d A;
  A << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return A;
}

// (2)
Matrix3d exponential(const Vector3d& psi) {
  const double a = psi.norm();
  const Matrix3d A = skew(psi);
  return Matrix3d::Identity() + std::sin(a) / a * A + (1.0 - std::cos(a)) / (a * a) * A * A;
}

Vector3d logarithm(const Matrix3d& R) {
  const Vector3d axis(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));  // 2 sin a times the unit vector
  const double sine = 0.5 * axis.norm(), a = std::atan2(sine, 0.5 * (R.trace() - 1.0));
  return a / (2.0 * sine) * axis;
}

// (4)
Matrix3d inverse_tangent(const Vector3d& psi) {
  const double a = psi.norm();
  const Matrix3d A = skew(psi);
  return Matrix3d::Identity() + 0.5 * A + (1.0 / (a * a) - 0.5 / (a * std::tan(0.5 * a))) * A * A;
}

/// The body lframe3 of the known answers: three nodes and three modes, about 0.2 rad of deformation.
class Theory : public ::testing::Test {
 protected:
  void take(InertiaOption inertia, double stiffness_damping = 0.0) {
    known_ = test_support::known_answer("lframe3");
    SuperelementOptions options;
    options.inertia = inertia;
    options.damping.stiffness = stiffness_damping;
    body_ = build_superelement_body(known_.element, known_.rigid, options);
    state_ = test_support::known_state(known_, body_, false);
    nodes_ = static_cast<Eigen::Index>(body_.node.size());
    size_ = 6 * nodes_ + body_.modes;
    M_.setIdentity(size_, size_);
    M_.topLeftCorner(6 * nodes_, 6 * nodes_) = body_.M_BB;
    M_.topRightCorner(6 * nodes_, body_.modes) = body_.M_BI;
    M_.bottomLeftCorner(body_.modes, 6 * nodes_) = body_.M_IB;
    S_.setZero(size_, size_);
    S_.topLeftCorner(6 * nodes_, 6 * nodes_) = body_.S_BB;
    S_.diagonal().tail(body_.modes) = body_.S_II;
    rate_.resize(size_);
    acceleration_.resize(size_);
    for (Eigen::Index i = 0; i < nodes_; ++i) {
      const NodeMotion& node = at(i);
      rate_.segment<6>(6 * i) << node.xd, node.Omega;
      acceleration_.segment<6>(6 * i) << node.xdd, node.Omegad;
    }
    rate_.tail(body_.modes) = state_.yd;
    acceleration_.tail(body_.modes) = state_.ydd;
    find_frame();
    find_deformation();
  }

  const NodeMotion& at(Eigen::Index i) const { return state_.nodes[static_cast<std::size_t>(i)]; }
  Vector3d reference(Eigen::Index i) const { return known_.element.node_position.row(i); }

  // (9) to (12)
  void find_frame() {
    MatrixXd Y(3, nodes_);
    Vector3d mean = Vector3d::Zero();
    for (Eigen::Index i = 0; i < nodes_; ++i) mean += reference(i) / static_cast<double>(nodes_);
    for (Eigen::Index i = 0; i < nodes_; ++i) Y.col(i) = reference(i) - mean;
    const double l = Y.colwise().norm().maxCoeff();
    const Eigen::JacobiSVD<MatrixXd> svd(Y / l, Eigen::ComputeThinU | Eigen::ComputeThinV);
    VectorXd inverse = svd.singularValues();
    for (double& s : inverse) s = s > 1e-6 * svd.singularValues()[0] ? 1.0 / s : 0.0;
    alpha_ =
        svd.matrixV() * inverse.asDiagonal() * svd.matrixU().transpose() * ((known_.rigid.center_of_mass - mean) / l);
    alpha_.array() += 1.0 / static_cast<double>(nodes_);

    x0_.setZero();
    origin_.setZero();
    for (Eigen::Index i = 0; i < nodes_; ++i) {
      x0_ += alpha_[i] * at(i).x;
      origin_ += alpha_[i] * reference(i);
    }
    R0_ = at(0).R;
    Matrix3d A;
    for (int iteration = 0; iteration < 8; ++iteration) {
      Vector3d sum = Vector3d::Zero();
      A.setZero();
      for (Eigen::Index i = 0; i < nodes_; ++i) {
        const Vector3d psi = psi_or_tiny(R0_.transpose() * at(i).R);
        sum += alpha_[i] * psi;
        A += alpha_[i] * inverse_tangent(-psi);
      }
      const Vector3d step = A.inverse() * sum;
      if (step.norm() < 1e-16) break;
      R0_ = R0_ * exponential(step);
    }
    U_.setZero(3, size_);
    for (Eigen::Index i = 0; i < nodes_; ++i)
      U_.middleCols<3>(6 * i + 3) = A.inverse() * alpha_[i] * inverse_tangent(psi_or_tiny(R0_.transpose() * at(i).R));
    Omega0_ = U_ * rate_;
  }
  /// (2) and (4) as they stand have no value at zero.
  static Vector3d psi_or_tiny(const Matrix3d& R) {
    return (R - Matrix3d::Identity()).norm() < 1e-12 ? Vector3d(1e-5, 0, 0) : logarithm(R);
  }

  // (13) to (15)
  void find_deformation() {
    y_.resize(size_);
    y_.tail(body_.modes) = state_.y;
    Upsilon_ = MatrixXd::Identity(size_, size_);
    for (Eigen::Index i = 0; i < nodes_; ++i) {
      const Vector3d xh = R0_.transpose() * (at(i).x - x0_), psi = logarithm(R0_.transpose() * at(i).R);
      y_.segment<6>(6 * i) << xh - (reference(i) - origin_), psi;
      Upsilon_.block<3, 3>(6 * i, 6 * i).setZero();
      Upsilon_.block<3, 3>(6 * i + 3, 6 * i + 3) = inverse_tangent(psi);
      for (Eigen::Index j = 0; j < nodes_; ++j) {
        Upsilon_.block<3, 3>(6 * i, 6 * j) += ((i == j ? 1.0 : 0.0) - alpha_[j]) * R0_.transpose();
        Upsilon_.block<3, 3>(6 * i, 6 * j + 3) += skew(xh) * U_.middleCols<3>(6 * j + 3);
        Upsilon_.block<3, 3>(6 * i + 3, 6 * j + 3) -= inverse_tangent(-psi) * U_.middleCols<3>(6 * j + 3);
      }
    }
  }

  // (17) to (20), options A and B
  VectorXd inertia_forces(InertiaOption option) const {
    const bool a = option == InertiaOption::A;
    MatrixXd P = MatrixXd::Identity(size_, size_), V = MatrixXd::Zero(size_, 3), O0 = MatrixXd::Zero(size_, size_),
             OB = MatrixXd::Zero(size_, size_);
    for (Eigen::Index i = 0; i < nodes_; ++i) {
      const Matrix3d E = R0_.transpose() * at(i).R;
      P.block<3, 3>(6 * i, 6 * i) = R0_.transpose();
      V.middleRows<3>(6 * i) = skew(R0_.transpose() * at(i).xd);
      O0.block<3, 3>(6 * i, 6 * i) = skew(Omega0_);
      if (a) {
        P.block<3, 3>(6 * i + 3, 6 * i + 3) = E;
        V.middleRows<3>(6 * i + 3) = skew(E * at(i).Omega);
        O0.block<3, 3>(6 * i + 3, 6 * i + 3) = skew(Omega0_);
      }
      OB.block<3, 3>(6 * i + 3, 6 * i + 3) = skew(a ? Vector3d(E * at(i).Omega) : at(i).Omega);
    }
    const VectorXd p = M_ * P * rate_, acceleration = P * acceleration_ + V * Omega0_;
    return P.transpose() * M_ * acceleration + P.transpose() * (a ? MatrixXd(O0 - OB) : MatrixXd(O0 + OB)) * p -
           U_.transpose() * V.transpose() * p;
  }

  // (7): the translations Φ_T
  MatrixXd translations() const {
    MatrixXd Phi = MatrixXd::Zero(size_, 3);
    for (Eigen::Index i = 0; i < nodes_; ++i) Phi.middleRows<3>(6 * i).setIdentity();
    return Phi;
  }

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

  test_support::KnownAnswer known_;
  SuperelementBody body_;
  test_support::BodyState state_;
  Eigen::Index nodes_ = 0, size_ = 0;
  MatrixXd M_, S_, U_, Upsilon_;
  VectorXd rate_, acceleration_, alpha_, y_;
  Vector3d x0_, origin_, Omega0_;
  Matrix3d R0_;
};

TEST_F(Theory, RotationsAndTheirIncrements) {
  const Vector3d psi(0.4, -0.7, 1.1), d(0.3, 0.5, -0.2);
  EXPECT_LT((logarithm(exponential(psi)) - psi).norm(), 1e-14);
  // (1), (3) and (4): exp(ψ + ε d) = exp(ψ) exp(ε T d), T the inverse of T⁻¹; central differences
  const double e = 1e-6;
  const Vector3d turned = (logarithm(exponential(psi).transpose() * exponential(psi + e * d)) -
                           logarithm(exponential(psi).transpose() * exponential(psi - e * d))) /
                          (2.0 * e);
  EXPECT_LT((inverse_tangent(psi) * turned - d).norm(), 1e-9);
}

TEST_F(Theory, TheSuperelementAndItsFrame) {
  take(InertiaOption::B);
  const MatrixXd Phi_T = translations();
  MatrixXd Phi_R = MatrixXd::Zero(size_, 3);
  for (Eigen::Index i = 0; i < nodes_; ++i) {
    Phi_R.middleRows<3>(6 * i) = -skew(reference(i));
    Phi_R.middleRows<3>(6 * i + 3).setIdentity();
  }
  EXPECT_LT((S_ * Phi_T).norm() + (S_ * Phi_R).norm(), 1e-10 * S_.norm());
  const double mass = (Phi_T.transpose() * M_ * Phi_T)(0, 0);
  EXPECT_NEAR(mass, body_.mass, tolerance * mass);
  EXPECT_LT((Phi_T.transpose() * M_ * Phi_R + mass * skew(known_.rigid.center_of_mass)).norm(), 1e-10 * mass);
  SuperelementScratch scratch = make_scratch(body_);
  test_support::evaluate(body_, state_, Vector3d::Zero(), scratch);
  EXPECT_NEAR(alpha_.sum(), 1.0, 1e-14);
  for (std::size_t i = 0; i < body_.node.size(); ++i)
    EXPECT_NEAR(body_.node[i].alpha, alpha_[static_cast<Eigen::Index>(i)], tolerance);
  EXPECT_LT((scratch.motion.x0 - x0_).norm(), tolerance);
  EXPECT_LT((scratch.motion.R0 - R0_).norm(), tolerance);
  EXPECT_LT((scratch.motion.Omega0 - Omega0_).norm(), tolerance);
  EXPECT_LT(relative_difference(scratch.motion.y_B, y_.head(6 * nodes_)), tolerance);
}

TEST_F(Theory, InternalForces) {
  take(InertiaOption::B);
  EXPECT_LT(relative_difference(computed(resting(), Vector3d::Zero()), Upsilon_.transpose() * S_ * y_), tolerance);
}

TEST_F(Theory, InertiaForcesOfAAndB) {
  for (const InertiaOption option : {InertiaOption::A, InertiaOption::B}) {
    take(option);
    const VectorXd inertia = computed(state_, Vector3d::Zero()) - computed(resting(), Vector3d::Zero());
    EXPECT_LT(relative_difference(inertia, inertia_forces(option)), 1e-10);  // a difference of larger numbers
  }
}

TEST_F(Theory, KineticEnergyOfM) {
  take(InertiaOption::M);
  const MatrixXd Phi = translations();
  MatrixXd P = MatrixXd::Identity(size_, size_);
  for (Eigen::Index i = 0; i < nodes_; ++i) P.block<3, 3>(6 * i, 6 * i) = R0_.transpose();
  const VectorXd yd = P * rate_;
  const Vector3d own = Phi.transpose() * M_ * yd;  // m times the mean velocity of the shapes
  const double m = body_.mass;
  const Vector3d c = known_.rigid.center_of_mass - origin_ + Phi.transpose() * M_ * y_ / m;  // (21)
  Vector3d origin_rate = Vector3d::Zero();
  for (Eigen::Index i = 0; i < nodes_; ++i) origin_rate += alpha_[i] * at(i).xd;
  const Vector3d center_rate =
      origin_rate + R0_ * (Omega0_.cross(c) + Vector3d(Phi.transpose() * M_ * Upsilon_ * rate_) / m);
  const double T = 0.5 * yd.dot(M_ * yd) - 0.5 * own.squaredNorm() / m + 0.5 * m * center_rate.squaredNorm();  // (22)
  SuperelementScratch scratch = make_scratch(body_);
  test_support::evaluate(body_, state_, Vector3d::Zero(), scratch);
  EXPECT_NEAR(energy(body_, scratch, Vector3d::Zero()).kinetic, T, tolerance * T);
}

TEST_F(Theory, WeightAndDamping) {
  take(InertiaOption::B);
  const Vector3d g(1.0, -2.0, -9.0), g0 = R0_.transpose() * g;
  const MatrixXd Phi = translations();
  const Vector3d c = known_.rigid.center_of_mass - origin_ + Phi.transpose() * M_ * y_ / body_.mass;
  MatrixXd A0 = MatrixXd::Zero(3, size_);
  for (Eigen::Index i = 0; i < nodes_; ++i) A0.middleCols<3>(6 * i) = alpha_[i] * R0_.transpose();
  const VectorXd weight = Upsilon_.transpose() * M_ * Phi * g0 + U_.transpose() * (body_.mass * c.cross(g0)) +
                          body_.mass * A0.transpose() * g0;  // (23)
  EXPECT_LT(relative_difference(computed(resting(), Vector3d::Zero()) - computed(resting(), g), weight), 1e-10);

  const VectorXd undamped = computed(state_, Vector3d::Zero());
  take(InertiaOption::B, 0.03);
  EXPECT_LT(relative_difference(computed(state_, Vector3d::Zero()) - undamped,
                                Upsilon_.transpose() * 0.03 * S_ * Upsilon_ * rate_),  // (24)
            1e-10);
}

}  // namespace
}  // namespace tisserand::mechanism::theory_test
