// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas (1) to (25) of docs/THEORY.md, written down once more as they stand there: what the tests of the theory
// compare the kernels with.
#pragma once

#include <Eigen/Core>

#include "tests/support/bodies/superelement_cases.hpp"

namespace tisserand::test_support::theory {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d skew(const Vector3d& a);
Matrix3d exponential(const Vector3d& psi);                                         ///< (2)
Vector3d logarithm(const Matrix3d& R);                                             ///< its inverse
Matrix3d tangent(const Vector3d& psi);                                             ///< (3)
Matrix3d inverse_tangent(const Vector3d& psi);                                     ///< (4)
Matrix3d inverse_tangent_rate(const Vector3d& psi, const Vector3d& psi_rate);      ///< (5)
Matrix3d inverse_tangent_derivative(const Vector3d& psi, const Vector3d& vector);  ///< Z(ψ, b) of (21)

/// (10) for points in columns.
Eigen::VectorXd weights(const Eigen::Matrix3Xd& points, const Vector3d& center);

/// What a body is made of, all coordinates in one matrix; nodes with translations and rotations.
struct Constants {
  explicit Constants(const mechanism::SuperelementBody& body);

  Eigen::Index nodes = 0, modes = 0, size = 0;
  Eigen::MatrixXd M, S;   ///< (7): N x N
  Eigen::MatrixXd Phi;    ///< (8): N x 6, arms from x₀
  Eigen::MatrixXd Gamma;  ///< Φ_TᵀM̄: 3 x N
  double mass = 0.0;      ///< (9)
  Vector3d center;        ///< (9), from x₀
};

/// The motion of one body at one instant: frame by (11) to (14), deformation by (17) to (19), its rates by (23) to
/// (25).
struct Motion {
  /// `R0`: the rotation from which (13) starts.
  Motion(const mechanism::SuperelementBody& body, const BodyState& state, const Matrix3d& R0);

  const mechanism::NodeMotion& at(Eigen::Index i) const { return state.nodes[static_cast<std::size_t>(i)]; }
  Vector3d psi(Eigen::Index i) const { return y.segment<3>(6 * i + 3); }
  Vector3d xh(Eigen::Index i) const { return R0.transpose() * (at(i).x - x0); }
  Matrix3d E(Eigen::Index i) const { return R0.transpose() * at(i).R; }

  BodyState state;
  Eigen::Index nodes = 0, size = 0;
  Eigen::VectorXd alpha;
  Eigen::VectorXd qd, qdd;  ///< rates of q: ẋ (world), Ω (node), ẏ_I
  Vector3d x0;
  Matrix3d R0, A;
  Eigen::MatrixXd A0;  ///< (33)
  Eigen::MatrixXd U, Upsilon;
  Vector3d Omega0, Omega0d, v0, a0;
  Eigen::VectorXd y, yd, ydd;

 private:
  void find_frame();
  void find_deformation(const mechanism::SuperelementBody& body);
  void find_rates();
};

/// K_f of (21), (22) for the forces f on y.
Eigen::MatrixXd frame_stiffness(const Motion& motion, const Eigen::VectorXd& f);

}  // namespace tisserand::test_support::theory
