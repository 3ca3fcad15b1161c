// SPDX-License-Identifier: GPL-3.0-or-later
// Kinematics of sections 1 to 5 of docs/THEORY.md.
#include "tests/support/bodies/theory_motion.hpp"

#include <cmath>

#include <Eigen/LU>
#include <Eigen/SVD>

namespace tisserand::test_support::theory {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// e of (4), and e' of (5).
double e_of(double a) { return 1.0 / (a * a) - 0.5 / (a * std::tan(0.5 * a)); }
double e_slope(double a) { return (0.125 - 1.5 * e_of(a)) / (a * a) + 0.5 * e_of(a) * e_of(a); }

}  // namespace

Matrix3d skew(const Vector3d& a) {
  Matrix3d A;
  A << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return A;
}

Matrix3d exponential(const Vector3d& psi) {
  const double a = psi.norm();
  if (a == 0.0) return Matrix3d::Identity();
  const Matrix3d A = skew(psi);
  return Matrix3d::Identity() + std::sin(a) / a * A + (1.0 - std::cos(a)) / (a * a) * A * A;
}

Vector3d logarithm(const Matrix3d& R) {
  const Vector3d axis(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));  // 2 sin a times the unit vector
  const double sine = 0.5 * axis.norm(), a = std::atan2(sine, 0.5 * (R.trace() - 1.0));
  if (sine == 0.0) return Vector3d::Zero();
  return a / (2.0 * sine) * axis;
}

Matrix3d tangent(const Vector3d& psi) {
  const double a = psi.norm();
  const Matrix3d A = skew(psi);
  return Matrix3d::Identity() - (1.0 - std::cos(a)) / (a * a) * A + (a - std::sin(a)) / (a * a * a) * A * A;
}

Matrix3d inverse_tangent(const Vector3d& psi) {
  if (psi.norm() == 0.0) return Matrix3d::Identity();
  const Matrix3d A = skew(psi);
  return Matrix3d::Identity() + 0.5 * A + e_of(psi.norm()) * A * A;
}

Matrix3d inverse_tangent_rate(const Vector3d& psi, const Vector3d& psi_rate) {
  const double a = psi.norm();
  const Matrix3d A = skew(psi), B = skew(psi_rate);
  return 0.5 * B + e_of(a) * (B * A + A * B) + 2.0 * e_slope(a) * psi.dot(psi_rate) * A * A;
}

Matrix3d inverse_tangent_derivative(const Vector3d& psi, const Vector3d& vector) {
  Matrix3d Z;
  for (int k = 0; k < 3; ++k) Z.col(k) = inverse_tangent_rate(psi, Vector3d::Unit(k)) * vector;
  return Z;
}

VectorXd weights(const Eigen::Matrix3Xd& points, const Vector3d& center) {
  const Vector3d mean = points.rowwise().mean();
  const MatrixXd Y = points.colwise() - mean;
  const double l = Y.colwise().norm().maxCoeff();
  const Eigen::JacobiSVD<MatrixXd> svd(Y / l, Eigen::ComputeThinU | Eigen::ComputeThinV);
  VectorXd inverse = svd.singularValues();
  for (double& s : inverse) s = s > 1e-6 * svd.singularValues()[0] ? 1.0 / s : 0.0;
  VectorXd alpha = svd.matrixV() * inverse.asDiagonal() * svd.matrixU().transpose() * ((center - mean) / l);
  alpha.array() += 1.0 / static_cast<double>(points.cols());
  return alpha;
}

Constants::Constants(const mechanism::SuperelementBody& body)
    : nodes(static_cast<Index>(body.node.size())), modes(body.modes), size(6 * nodes + modes) {
  M.setIdentity(size, size);
  M.topLeftCorner(6 * nodes, 6 * nodes) = body.M_BB;
  M.topRightCorner(6 * nodes, modes) = body.M_BI;
  M.bottomLeftCorner(modes, 6 * nodes) = body.M_IB;
  S.setZero(size, size);
  S.topLeftCorner(6 * nodes, 6 * nodes) = body.S_BB;
  S.diagonal().tail(modes) = body.S_II;
  Phi.setZero(size, 6);
  for (Index i = 0; i < nodes; ++i) {
    Phi.block<3, 3>(6 * i, 0).setIdentity();
    Phi.block<3, 3>(6 * i, 3) = -skew(body.node[static_cast<std::size_t>(i)].X);
    Phi.block<3, 3>(6 * i + 3, 3).setIdentity();
  }
  Gamma = Phi.leftCols<3>().transpose() * M;
  mass = (Gamma * Phi)(0, 0);
  const Matrix3d moment = -(Gamma * Phi.rightCols<3>()) / mass;  // the skew matrix of the centre
  center = {moment(2, 1), moment(0, 2), moment(1, 0)};
}

Motion::Motion(const mechanism::SuperelementBody& body, const BodyState& of_state, const Matrix3d& start)
    : state(of_state),
      nodes(static_cast<Index>(body.node.size())),
      size(6 * nodes + body.modes),
      alpha(nodes),
      qd(size),
      qdd(size),
      R0(start) {
  for (Index i = 0; i < nodes; ++i) {
    alpha[i] = body.node[static_cast<std::size_t>(i)].alpha;
    qd.segment<6>(6 * i) << at(i).xd, at(i).Omega;
    qdd.segment<6>(6 * i) << at(i).xdd, at(i).Omegad;
  }
  qd.tail(body.modes) = state.yd;
  qdd.tail(body.modes) = state.ydd;
  find_frame();
  find_deformation(body);
  find_rates();
}

// (11) to (14)
void Motion::find_frame() {
  x0.setZero();
  for (Index i = 0; i < nodes; ++i) x0 += alpha[i] * at(i).x;
  for (int iteration = 0; iteration < 8; ++iteration) {
    Vector3d h = Vector3d::Zero();
    A.setZero();
    for (Index i = 0; i < nodes; ++i) {
      const Vector3d turn = logarithm(R0.transpose() * at(i).R);
      h += alpha[i] * turn;
      A += alpha[i] * inverse_tangent(-turn);
    }
    const Vector3d step = A.inverse() * h;
    if (step.norm() < 1e-16) break;
    R0 = (R0 * exponential(step)).eval();
  }
  U.setZero(3, size);
  A0.setZero(3, size);
  for (Index i = 0; i < nodes; ++i) {
    U.middleCols<3>(6 * i + 3) = A.inverse() * alpha[i] * inverse_tangent(logarithm(E(i)));
    A0.middleCols<3>(6 * i) = alpha[i] * R0.transpose();
  }
}

// (17) to (19)
void Motion::find_deformation(const mechanism::SuperelementBody& body) {
  y.resize(size);
  y.tail(body.modes) = state.y;
  Upsilon = MatrixXd::Identity(size, size);
  for (Index i = 0; i < nodes; ++i) {
    const Vector3d turn = logarithm(E(i));
    y.segment<6>(6 * i) << xh(i) - body.node[static_cast<std::size_t>(i)].X, turn;
    Upsilon.block<3, 3>(6 * i, 6 * i).setZero();
    Upsilon.block<3, 3>(6 * i + 3, 6 * i + 3) = inverse_tangent(turn);
    for (Index j = 0; j < nodes; ++j) {
      Upsilon.block<3, 3>(6 * i, 6 * j) += ((i == j ? 1.0 : 0.0) - alpha[j]) * R0.transpose();
      Upsilon.block<3, 3>(6 * i, 6 * j + 3) += skew(xh(i)) * U.middleCols<3>(6 * j + 3);
      Upsilon.block<3, 3>(6 * i + 3, 6 * j + 3) -= inverse_tangent(-turn) * U.middleCols<3>(6 * j + 3);
    }
  }
}

// (23) to (25)
void Motion::find_rates() {
  Omega0 = U * qd;
  v0 = A0 * qd;
  a0 = A0 * qdd;
  yd = qd;
  ydd = qdd;
  Omega0d.setZero();
  std::vector<Vector3d> bias;
  for (Index i = 0; i < nodes; ++i) {
    const Vector3d turn = psi(i);
    yd.segment<3>(6 * i) = R0.transpose() * at(i).xd - v0 + xh(i).cross(Omega0);
    yd.segment<3>(6 * i + 3) = inverse_tangent(turn) * at(i).Omega - inverse_tangent(turn).transpose() * Omega0;
    const Matrix3d rate = inverse_tangent_rate(turn, yd.segment<3>(6 * i + 3));
    bias.push_back(rate * at(i).Omega - rate.transpose() * Omega0);
    Omega0d += U.middleCols<3>(6 * i + 3) * (at(i).Omegad + tangent(turn) * bias.back());
  }
  for (Index i = 0; i < nodes; ++i) {
    const Vector3d turn = psi(i), u_rate = yd.segment<3>(6 * i);
    ydd.segment<3>(6 * i) = R0.transpose() * at(i).xdd - a0 - 2.0 * Omega0.cross(u_rate) - Omega0d.cross(xh(i)) -
                            Omega0.cross(Omega0.cross(xh(i)));
    ydd.segment<3>(6 * i + 3) = inverse_tangent(turn) * at(i).Omegad - inverse_tangent(turn).transpose() * Omega0d +
                                bias[static_cast<std::size_t>(i)];
  }
}

MatrixXd frame_stiffness(const Motion& m, const VectorXd& f) {
  const auto f_u = [&](Index i) { return Vector3d(f.segment<3>(6 * i)); };
  const auto f_psi = [&](Index i) { return Vector3d(f.segment<3>(6 * i + 3)); };
  Vector3d F = Vector3d::Zero(), mu = Vector3d::Zero();
  for (Index i = 0; i < m.nodes; ++i) {
    F += f_u(i);
    mu -= m.xh(i).cross(f_u(i)) + inverse_tangent(m.psi(i)) * f_psi(i);
  }
  const Matrix3d to_gamma = m.A.transpose().inverse();
  const Vector3d gamma = to_gamma * mu;
  MatrixXd d_mu = MatrixXd::Zero(3, m.size), mean = d_mu;
  for (Index i = 0; i < m.nodes; ++i) {
    const MatrixXd u = m.Upsilon.middleRows<3>(6 * i), turn = m.Upsilon.middleRows<3>(6 * i + 3);
    d_mu += skew(f_u(i)) * u - inverse_tangent_derivative(m.psi(i), f_psi(i)) * turn;
    mean += m.alpha[i] * inverse_tangent_derivative(m.psi(i), gamma) * turn;
  }
  const MatrixXd d_gamma = to_gamma * (d_mu - mean);
  MatrixXd K = MatrixXd::Zero(m.size, m.size);
  for (Index j = 0; j < m.nodes; ++j) {
    K.middleRows<3>(6 * j) = -m.R0 * skew(f_u(j) - m.alpha[j] * F) * m.U;
    K.middleRows<3>(6 * j + 3) =
        -inverse_tangent_derivative(-m.psi(j), f_psi(j) + m.alpha[j] * gamma) * m.Upsilon.middleRows<3>(6 * j + 3) +
        m.alpha[j] * inverse_tangent(m.psi(j)).transpose() * d_gamma;
  }
  return K;
}

}  // namespace tisserand::test_support::theory
