// SPDX-License-Identifier: GPL-3.0-or-later
// Changes signs of rows, vectors and tensors.
#include "formats/superelement/mirror.hpp"

namespace tisserand::formats {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Mirrored tensor D J D.
Matrix3d mirrored_tensor(const Matrix3d& J, const Vector3d& axes) { return axes.asDiagonal() * J * axes.asDiagonal(); }

/// Mirrors tensors in columns of 9 numbers each.
void mirror_tensors(const Vector3d& axes, Eigen::Ref<Eigen::MatrixXd> columns) {
  for (Index column = 0; column < columns.cols(); ++column)
    for (Index first = 0; first < columns.rows(); first += 9) {
      Eigen::Map<Matrix3d> block(&columns(first, column));
      block = mirrored_tensor(block, axes);
    }
}

void mirror_integrals(const Vector3d& axes, ModalIntegrals& sums) {
  sums.c0 = sums.c0.cwiseProduct(axes);
  sums.C1 = (axes.asDiagonal() * sums.C1).eval();
  sums.P0 = mirrored_tensor(sums.P0, axes);
  mirror_tensors(axes, sums.P1);
  mirror_tensors(axes, sums.P2);
  sums.J_mu = mirrored_tensor(sums.J_mu, axes);
  sums.N_mu = (axes.prod() * axes.asDiagonal() * sums.N_mu).eval();
}

}  // namespace

LoadedSuperelement mirrored(LoadedSuperelement file, const Vector3d& axes) {
  Superelement& element = file.superelement;
  element.node_position = (element.node_position * axes.asDiagonal()).eval();
  Eigen::VectorXd sign = Eigen::VectorXd::Ones(element.size());
  for (Index row = 0; row < element.size(); ++row) {
    const auto at = static_cast<std::size_t>(row);
    const int component = element.dof_component[at];
    if (element.dof_node[at] >= 0) sign[row] = axes[component % 3] * (component < 3 ? 1.0 : axes.prod());
  }
  element.stiffness = (sign.asDiagonal() * element.stiffness * sign.asDiagonal()).eval();
  element.mass = (sign.asDiagonal() * element.mass * sign.asDiagonal()).eval();
  element.content_id = content_id(element);
  RigidProperties& rigid = file.report.rigid;
  rigid.center_of_mass = rigid.center_of_mass.cwiseProduct(axes);
  rigid.inertia = mirrored_tensor(rigid.inertia, axes);
  return file;
}

LoadedModalBody mirrored(LoadedModalBody file, const Vector3d& axes) {
  ModalBody& body = file.body;
  body.frame_position = body.frame_position.cwiseProduct(axes);
  body.frame_orientation.tail<3>() = (axes.prod() * body.frame_orientation.tail<3>().cwiseProduct(axes)).eval();
  body.node_position = (body.node_position * axes.asDiagonal()).eval();
  for (Matrix3d& inertia : body.node_inertia) inertia = mirrored_tensor(inertia, axes);
  Eigen::Matrix<double, 6, 1> sign;
  sign << axes, axes.prod() * axes;
  for (auto& X : body.X) X = (sign.asDiagonal() * X).eval();
  ModalResidual& residual = body.residual;
  Eigen::VectorXd own(static_cast<Eigen::Index>(residual.component.size()));
  for (Eigen::Index k = 0; k < own.size(); ++k) own[k] = sign[residual.component[static_cast<std::size_t>(k)]];
  for (Eigen::MatrixXd* matrix : {&residual.flexibility, &residual.mass})
    *matrix = (own.asDiagonal() * *matrix * own.asDiagonal()).eval();
  if (own.size() > 0) residual.coupling = (sign.asDiagonal() * residual.coupling * own.asDiagonal()).eval();
  mirror_integrals(axes, body.integrals);
  return file;
}

}  // namespace tisserand::formats
