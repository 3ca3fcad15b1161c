// SPDX-License-Identifier: GPL-3.0-or-later
// Mass matrix of a point mass whose centre of mass may be away from its node.
#include "common/math/rotation.hpp"
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer {

/// Mass by the velocity v + ω × c of the centre of mass: [m 1, −m skew(c); m skew(c), J_c − m skew(c)²].
Eigen::Matrix<double, 6, 6> nodal_mass_matrix(const NodalMass& mass) {
  const Eigen::Matrix3d c = skew<double>(mass.offset);
  const Eigen::Matrix3d about_node = mass.inertia - mass.mass * c * c;
  Eigen::Matrix<double, 6, 6> M;
  M << mass.mass * Eigen::Matrix3d::Identity(), -mass.mass * c, mass.mass * c,
      0.5 * (about_node + about_node.transpose());
  return M;
}

}  // namespace tisserand::reducer
