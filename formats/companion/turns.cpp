// SPDX-License-Identifier: GPL-3.0-or-later
// Second order of rotary inertia that companion files of former versions lack.
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "formats/companion/companion.hpp"

namespace tisserand::formats {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Part whose internal coordinates follow statically: S_II y₂ = −½ yᵀ H_i y − S_IB y₂.
struct TurningPart {
  const Companion& companion;
  const Superelement& element;
  MatrixXd R;                   ///< rigid motions about the reference point
  std::vector<Index> internal;  ///< their rows
  Eigen::LDLT<MatrixXd> S_II;
};

TurningPart turning_part(const Companion& c, const Superelement& element) {
  TurningPart part{c, element, rigid_motions(element, c.reference_point), {}, {}};
  for (Index row = 0; row < element.size(); ++row)
    if (element.dof_node[row] < 0) part.internal.push_back(row);
  if (!part.internal.empty()) part.S_II.compute(element.stiffness(part.internal, part.internal));
  return part;
}

/// Second order of the coordinates of the part turned by a unit angle about an axis: ½ θ x (θ x X) at nodes.
VectorXd second_order_of_turn(const TurningPart& part, int axis) {
  const Vector3d theta = Vector3d::Unit(axis);
  const VectorXd y = part.R.col(3 + axis);
  VectorXd second = VectorXd::Zero(y.size());
  for (Index row = 0; row < y.size(); ++row) {
    const int node = part.element.dof_node[row], component = part.element.dof_component[row];
    if (node < 0 || component >= 3) continue;
    const Vector3d X = part.element.node_position.row(node).transpose() - part.companion.reference_point;
    second[row] = 0.5 * theta.cross(theta.cross(X))[component];
  }
  if (part.internal.empty()) return second;
  VectorXd force(static_cast<Index>(part.internal.size()));
  for (std::size_t i = 0; i < part.internal.size(); ++i) {
    const Index row = part.internal[i];
    force[static_cast<Index>(i)] =
        -0.5 * y.dot(part.companion.H[static_cast<std::size_t>(row)] * y) - part.element.stiffness.row(row).dot(second);
  }
  second(part.internal) = VectorXd(part.S_II.solve(force));  // Eigen 3.4 solves wrongly into rows selected by index
  return second;
}

}  // namespace

MissingTurns missing_turns(const Companion& c, const Superelement& element) {
  const TurningPart part = turning_part(c, element);
  const Eigen::Matrix3d J0 = part.R.rightCols<3>().transpose() * element.mass * part.R.rightCols<3>();
  MissingTurns missing;
  for (int axis = 0; axis < 3; ++axis) {
    const VectorXd y = part.R.col(3 + axis), second = second_order_of_turn(part, axis);
    for (int spin = 0; spin < 3; ++spin) {
      if (spin == axis) continue;
      const int pair = axis_pair(spin, spin);
      const Vector3d Omega = Vector3d::Unit(spin), theta = Vector3d::Unit(axis), moved = Omega.cross(theta);
      const double found = 0.5 * y.dot((c.E[pair] + c.T[pair]) * y) + part.R.col(3 + spin).dot(c.C[spin] * second);
      const double exact = 0.5 * moved.dot(J0 * moved) + 0.5 * (J0 * Omega).dot(theta.cross(theta.cross(Omega)));
      missing.inertia[spin] += found - exact;  // half of the missing inertia, about each of two axes
    }
  }
  for (int k = 0; k < 3; ++k) missing.share[k] = J0(k, k) > 0.0 ? missing.inertia[k] / J0(k, k) : 0.0;
  return missing;
}

}  // namespace tisserand::formats
