// SPDX-License-Identifier: GPL-3.0-or-later
// Sides of the plate in a shell element: common part of bending and transverse shear of triangles and quadrilaterals.
#pragma once

#include <Eigen/Core>

namespace tisserand::reducer {

/// Side of a plate element: direction, length, and the ratio of its transverse shear flexibility to its bending
/// flexibility.
struct PlateSide {
  Eigen::Vector2d direction;
  double length = 0.0;
  double phi = 0.0;  ///< 12 D_ss/(As_ss L²) with bending and shear stiffness along the side; 0 for a thin plate
};

/// Side of a plate element along the vector `d` from corner to corner. `D`, `As`: bending and transverse shear
/// stiffness of the section, whose components along the side give φ as in [Kat93]. This includes laminates.
PlateSide plate_side(const Eigen::Vector2d& d, const Eigen::Matrix3d& D, const Eigen::Matrix2d& As);

/// Rows that give the curvature κ = [θy,x; -θx,y; θy,y - θx,x] for the corner values [w θx θy] (3 x (3 corners)).
/// `slope`: derivatives of the shape functions of the rotations by x and y (2 x corners).
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
