// SPDX-License-Identifier: GPL-3.0-or-later
// Sides of the plate in a shell element: common part of bending and transverse shear of triangles and quadrilaterals.
#pragma once

#include <Eigen/Core>

namespace tisserand::reducer {

/// Side with the ratio of its transverse shear flexibility to its bending flexibility.
struct PlateSide {
  Eigen::Vector2d direction;
  double length = 0.0;
  double phi = 0.0;  ///< 12 D_ss/(As_ss L²): shear flexibility; 0 for a thin plate
};

/// Side with `d` from corner to corner; φ as in [Kat93] with the stiffnesses along the side, which includes laminates.
PlateSide plate_side(const Eigen::Vector2d& d, const Eigen::Matrix3d& D, const Eigen::Matrix2d& As);

/// κ = [θy,x; -θx,y; θy,y - θx,x] for rotations by shape functions N_i, whose slopes are the columns of `slope`.
template <int Corners>
Eigen::Matrix<double, 3, 3 * Corners> curvature_rows(const Eigen::Matrix<double, 2, Corners>& slope) {
  Eigen::Matrix<double, 3, 3 * Corners> rows = Eigen::Matrix<double, 3, 3 * Corners>::Zero();
  for (int i = 0; i < Corners; ++i) {
    rows(0, 3 * i + 2) = slope(0, i);
    rows(1, 3 * i + 1) = -slope(1, i);
    rows(2, 3 * i + 1) = -slope(0, i);
    rows(2, 3 * i + 2) = slope(1, i);
  }
  return rows;
}

}  // namespace tisserand::reducer
