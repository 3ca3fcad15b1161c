// SPDX-License-Identifier: GPL-3.0-or-later
// Sides of the plate in a shell element.
#include "reducer/elements/shell/side.hpp"

namespace tisserand::reducer {

PlateSide plate_side(const Eigen::Vector2d& d, const Eigen::Matrix3d& D, const Eigen::Matrix2d& As) {
  PlateSide side;
  side.length = d.norm();
  side.direction = d / side.length;
  const double c = side.direction.x(), s = side.direction.y();
  const Eigen::Vector3d bend(c * c, s * s, 2.0 * c * s);  // curvatures of a unit κ_ss
  side.phi = 12.0 * bend.dot(D * bend) / (side.direction.dot(As * side.direction) * side.length * side.length);
  return side;
}

}  // namespace tisserand::reducer
