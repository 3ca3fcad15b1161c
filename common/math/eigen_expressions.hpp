// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions of Eigen that most files use. The precompiled header of clang includes this file, so that they are
// instantiated once. No file needs to include it.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

namespace tisserand::internal {

/// Contains each expression once. It is never called.
inline double name_eigen_expressions(Eigen::MatrixXd& A, Eigen::VectorXd& v, Eigen::Matrix3d& R, Eigen::Vector3d& p,
                                     Eigen::Matrix<double, 6, 6>& K, Eigen::Matrix<double, 6, 1>& w,
                                     Eigen::Quaterniond& q) {
  Eigen::MatrixXd B = A.transpose() * A;
  B.noalias() += A * A.transpose();
  B.noalias() -= A * B;
  B = (0.5 * (B + B.transpose())).eval();
  B.topLeftCorner(2, 2) = A.bottomRightCorner(2, 2) - A.block(0, 0, 2, 2);
  B.block<3, 3>(0, 0) += R * R.transpose() + 2.0 * R.transpose() * R;
  B.middleCols(0, 1) = A.middleRows(0, 1).transpose();
  B.col(0) = A * v + A.transpose() * v;
  B.row(0) = v.transpose() * A;
  B.setZero(2, 2);
  B.setIdentity();
  v.noalias() += A * v;
  v.noalias() -= A.transpose() * v;
  v.segment(0, 2) = v.head(2) + v.tail(2) * 2.0;
  v.segment<3>(0) = R * p - R.transpose() * p;
  v.segment<3>(0) += p.cross(R.col(0)) + p.normalized() - p / 2.0;
  v.cwiseAbs().maxCoeff();
  v = v.cwiseProduct(v).cwiseQuotient(v).cwiseSqrt() + Eigen::VectorXd::Constant(2, 1.0) + Eigen::VectorXd::Zero(2);
  v = A.diagonal().array().square().matrix() + v.asDiagonal() * v;
  K.topLeftCorner<3, 3>() = R * Eigen::Matrix3d::Identity() * R.transpose() + p * p.transpose();
  K.block<3, 3>(0, 3) = -R;
  K += K.transpose() * K;
  w.head<3>() += R * w.tail<3>();
  w += K * w - K.transpose() * w;
  q = q * Eigen::Quaterniond(Eigen::AngleAxisd(1.0, p)) * q.conjugate();
  p = q * p + q.toRotationMatrix() * p + q.vec();
  p += R.inverse() * p + R.llt().solve(p);
  return B.squaredNorm() + v.dot(v) + p.norm() + w.norm() + R.determinant() + R.trace() + A.norm() + v.norm() +
         A.sum() + v.lpNorm<Eigen::Infinity>();
}

}  // namespace tisserand::internal
