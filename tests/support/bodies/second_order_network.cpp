// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays of the second order by their definitions, dense.
#include "tests/support/bodies/second_order_network.hpp"

#include <Eigen/Geometry>

namespace tisserand::test_support {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// K_G for the forces that w strains the springs with.
MatrixXd geometric_stiffness(const FullModel& model, const VectorXd& w) {
  MatrixXd K = MatrixXd::Zero(model.S.rows(), model.S.cols());
  for (Index i = 0; i < model.position.rows(); ++i)
    for (Index j = 0; j < i; ++j) {
      const Vector3d arm = (model.position.row(i) - model.position.row(j)).transpose();
      const Vector3d e = arm.normalized();
      const Vector3d stretch = w.segment<3>(3 * i) - w.segment<3>(3 * j);
      const double force = e.dot(-model.S.block<3, 3>(3 * i, 3 * j) * stretch);
      const Matrix3d block = force / arm.norm() * (Matrix3d::Identity() - e * e.transpose());
      K.block<3, 3>(3 * i, 3 * i) += block;
      K.block<3, 3>(3 * j, 3 * j) += block;
      K.block<3, 3>(3 * i, 3 * j) -= block;
      K.block<3, 3>(3 * j, 3 * i) -= block;
    }
  return K;
}

}  // namespace

SecondOrderBody second_order_network(const FullModel& model, const std::vector<Keep>& keep, int modes,
                                     const VectorXd& weights) {
  const auto stiffness = [&model](const VectorXd& w) { return geometric_stiffness(model, w); };
  return second_order_by_definition(model, stiffness, keep, modes, weights);
}

SecondOrderBody second_order_network(int modes, const Eigen::Vector4d& weights) {
  using enum Keep;
  return second_order_network(spring_network(), {all, all, all, all, nothing, nothing}, modes, weights);
}

void add_load_case(const std::string& name, const VectorXd& load, SecondOrderBody& body) {
  using enum Keep;
  const FullModel model = spring_network();
  const auto stiffness = [&model](const VectorXd& w) { return geometric_stiffness(model, w); };
  add_load_case(model, stiffness, {all, all, all, all, nothing, nothing}, name, load, body);
}

FullModel mirrored_network(const Vector3d& axes) {
  FullModel model = spring_network();
  const Eigen::VectorXd sign = axes.replicate(model.position.rows(), 1);
  model.position = (model.position * axes.asDiagonal()).eval();
  model.S = (sign.asDiagonal() * model.S * sign.asDiagonal()).eval();
  return model;
}

void add_trapped_stress(SecondOrderBody& body) {
  const Eigen::MatrixXd& S = body.element.stiffness;
  const Eigen::MatrixXd square = S * S / S.norm();
  body.companion.Lambda.emplace_back(0.5 * (square + square.transpose()));
}

}  // namespace tisserand::test_support
