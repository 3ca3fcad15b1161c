// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness of springs and bushings between two nodes, and the test whether they let a part float.
#include "reducer/elements/spring.hpp"

#include "common/math/rotation.hpp"
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// Motion at the end of a rigid arm in axes B from that of its node in part axes: u + θ × arm, θ.
Matrix6 carried_by_arm(const Eigen::Vector3d& arm, const Eigen::Matrix3d& R_PB) {
  Matrix6 T = Matrix6::Zero();
  T.topLeftCorner<3, 3>() = R_PB.transpose();
  T.topRightCorner<3, 3>() = -R_PB.transpose() * skew<double>(arm);
  T.bottomRightCorner<3, 3>() = R_PB.transpose();
  return T;
}

}  // namespace

Matrix12 scalar_spring(double stiffness, const SpringEnd& first, const SpringEnd& second) {
  Eigen::Matrix<double, 12, 1> elongation = Eigen::Matrix<double, 12, 1>::Zero();
  elongation.segment<3>(first.component < 3 ? 0 : 3) = -first.R_PA.col(first.component % 3);
  elongation.segment<3>(second.component < 3 ? 6 : 9) = second.R_PA.col(second.component % 3);
  return stiffness * elongation * elongation.transpose();
}

std::optional<Matrix12> axial_spring(double stiffness, const Eigen::Vector3d& first_to_second) {
  if (!(first_to_second.norm() > 0.0)) return std::nullopt;
  const Eigen::Vector3d n = first_to_second.normalized();
  Eigen::Matrix<double, 12, 1> elongation;
  elongation << -n, Eigen::Vector3d::Zero(), n, Eigen::Vector3d::Zero();
  return stiffness * elongation * elongation.transpose();
}

Matrix12 bushing(const Matrix6& K_B, const BushingPlace& place) {
  Eigen::Matrix<double, 6, 12> relative;
  relative << -carried_by_arm(place.first_arm, place.R_PB), carried_by_arm(place.second_arm, place.R_PB);
  const Matrix12 K = relative.transpose() * K_B * relative;
  return 0.5 * (K + K.transpose());
}

double rigid_motion_defect(const Matrix12& K, const Eigen::Vector3d& first_to_second) {
  const double distance = first_to_second.norm(), length = distance > 0.0 ? distance : 1.0;
  Eigen::Matrix<double, 12, 1> scale;
  scale << Eigen::Vector3d::Constant(length), Eigen::Vector3d::Ones(), Eigen::Vector3d::Constant(length),
      Eigen::Vector3d::Ones();
  const Matrix12 K_scaled = scale.asDiagonal() * K * scale.asDiagonal();
  const double largest = K_scaled.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) return 0.0;
  const Eigen::Matrix3d half = skew<double>(Eigen::Vector3d(0.5 / length * first_to_second));
  Eigen::Matrix<double, 12, 6> R = Eigen::Matrix<double, 12, 6>::Zero();
  for (int node = 0; node < 2; ++node) {
    R.block<6, 6>(6 * node, 0).setIdentity();
    R.block<3, 3>(6 * node, 3) = node == 0 ? half : -half;
  }
  return (K_scaled * R).cwiseAbs().maxCoeff() / largest;
}

void element_matrices(const Mesh&, const Spring& spring, ElementMatrices& out) {
  out.S = spring.stiffness;
  out.M.setZero(12, 12);
}

}  // namespace tisserand::reducer
