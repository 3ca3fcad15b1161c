// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid motions of a superelement, the rigid body of its mass matrix, and the scales of its coordinates.
#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "formats/superelement/scaling.hpp"

namespace tisserand::formats {
namespace {

Eigen::Vector3d mean_of_nodes(const Superelement& element) {
  return element.node_position.colwise().mean().transpose();
}

}  // namespace

Eigen::MatrixXd rigid_motions(const Superelement& element, const Eigen::Vector3d& origin) {
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(element.size(), 6);
  for (Eigen::Index row = 0; row < element.size(); ++row) {
    const int node = element.dof_node[row];
    const int component = element.dof_component[row];
    if (node < 0) continue;
    R(row, component) = 1.0;
    if (component >= 3) continue;
    const Eigen::Vector3d X = element.node_position.row(node).transpose() - origin;
    R.row(row).tail<3>() = -skew<double>(X).row(component);  // e_k × X = −X × e_k
  }
  return R;
}

RigidProperties rigid_properties(const Superelement& element) {
  const Eigen::Vector3d origin = mean_of_nodes(element);
  const Eigen::MatrixXd R = rigid_motions(element, origin);
  const Eigen::Matrix<double, 6, 6> M = R.transpose() * element.mass * R;
  RigidProperties rigid;
  rigid.mass = M.topLeftCorner<3, 3>().trace() / 3.0;
  if (!(rigid.mass > 0.0)) return rigid;
  const Eigen::Matrix3d C = M.topRightCorner<3, 3>();  // Φ_Tᵀ M Φ_R = −m c~
  const Eigen::Vector3d c =
      Eigen::Vector3d(C(1, 2) - C(2, 1), C(2, 0) - C(0, 2), C(0, 1) - C(1, 0)) / (2.0 * rigid.mass);
  rigid.center_of_mass = origin + c;
  const Eigen::Matrix3d c_skew = skew<double>(c);
  const Eigen::Matrix3d I = M.bottomRightCorner<3, 3>() + rigid.mass * c_skew * c_skew;
  rigid.inertia = 0.5 * (I + I.transpose());
  return rigid;
}

double characteristic_length(const Superelement& element) {
  const Eigen::RowVector3d mean = element.node_position.colwise().mean();
  const double length = (element.node_position.rowwise() - mean).rowwise().norm().maxCoeff();
  return length > 0.0 ? length : 1.0;
}

ScaledMatrices scale(const Superelement& element) {
  ScaledMatrices s;
  s.length = characteristic_length(element);
  const Eigen::Index n = element.size();
  s.stiffness_row = s.mass_row = Eigen::VectorXd::Ones(n);
  std::vector<Eigen::Index> boundary;
  for (Eigen::Index row = 0; row < n; ++row) {
    if (element.dof_node[row] < 0) continue;
    boundary.push_back(row);
    if (element.dof_component[row] >= 3) s.stiffness_row[row] = s.mass_row[row] = 1.0 / s.length;
  }
  double largest_S = 0.0, largest_M = 0.0;
  for (const Eigen::Index i : boundary)
    for (const Eigen::Index j : boundary) {
      largest_S = std::max(largest_S, std::abs(s.stiffness_row[i] * element.stiffness(i, j) * s.stiffness_row[j]));
      largest_M = std::max(largest_M, std::abs(s.mass_row[i] * element.mass(i, j) * s.mass_row[j]));
    }
  double softest = 0.0;
  for (Eigen::Index row = 0; row < n; ++row) {
    if (element.dof_node[row] >= 0 || !(element.mass(row, row) > 0.0)) continue;
    const double stiffness = largest_M * element.stiffness(row, row) / element.mass(row, row);
    if (stiffness > 0.0 && (softest == 0.0 || stiffness < softest)) softest = stiffness;
  }
  s.stiffness_scale = std::max(largest_S, softest) > 0.0 ? std::max(largest_S, softest) : 1.0;
  s.mass_scale = largest_M > 0.0 ? largest_M : 1.0;
  for (Eigen::Index row = 0; row < n; ++row) {
    if (element.dof_node[row] >= 0) continue;
    if (element.stiffness(row, row) > 0.0)
      s.stiffness_row[row] = std::sqrt(s.stiffness_scale / element.stiffness(row, row));
    if (element.mass(row, row) > 0.0) s.mass_row[row] = std::sqrt(s.mass_scale / element.mass(row, row));
  }
  return s;
}

Eigen::MatrixXd scaled_rigid_motions(const Superelement& element, const Eigen::VectorXd& row_scale, double length) {
  Eigen::MatrixXd R = rigid_motions(element, mean_of_nodes(element));
  R.rightCols<3>() /= length;
  return row_scale.cwiseInverse().asDiagonal() * R;
}

void filter_rigid_motions(Superelement& element) {
  const ScaledMatrices s = scale(element);
  const Eigen::Index n = element.size();
  const Eigen::MatrixXd R = scaled_rigid_motions(element, s.stiffness_row, s.length);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(R);
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(n, qr.rank());
  Eigen::MatrixXd S = s.stiffness_row.asDiagonal() * element.stiffness * s.stiffness_row.asDiagonal();
  S = (0.5 * (S + S.transpose())).eval();
  // The second pass removes the round-off of the first.
  for (int pass = 0; pass < 2; ++pass) {
    const Eigen::MatrixXd SQ = S * Q;
    const Eigen::MatrixXd QSQ = Q.transpose() * SQ;
    S += Q * QSQ * Q.transpose() - SQ * Q.transpose() - Q * SQ.transpose();
    S = (0.5 * (S + S.transpose())).eval();
  }
  const Eigen::VectorXd back = s.stiffness_row.cwiseInverse();
  element.stiffness = back.asDiagonal() * S * back.asDiagonal();
}

std::string row_text(const Superelement& element, Eigen::Index row) {
  static constexpr const char* components[] = {"translation x", "translation y", "translation z",
                                               "rotation x",    "rotation y",    "rotation z"};
  const int node = element.dof_node[row];
  const int component = element.dof_component[row];
  if (node < 0) return fmt::format("row {} (internal coordinate {})", row, component);
  return fmt::format("row {} (node '{}', {})", row, element.node_name[node], components[component]);
}

}  // namespace tisserand::formats
