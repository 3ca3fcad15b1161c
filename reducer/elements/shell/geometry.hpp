// SPDX-License-Identifier: GPL-3.0-or-later
// Plane in which a shell element works: axes, projected corners and warping heights from the nodes of a mesh.
#pragma once

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Geometry of a shell element in its own axes E: axes, projected corners, heights and area. z is normal to both
/// diagonals (of a triangle: to its plane), and x is the projected material direction. The origin is the mean of the
/// corners.
template <int Corners>
struct ShellGeometry {
  Eigen::Matrix3d R_PE = Eigen::Matrix3d::Identity();  ///< columns: x, y, z of the element in part axes
  Eigen::Matrix<double, 2, Corners> corner;            ///< projected corners, counter-clockwise
  /// Heights of the nodes above the mean plane. A warped quadrilateral has +h, -h, +h, -h, because z is normal to its
  /// diagonals.
  Eigen::Matrix<double, Corners, 1> height;
  double area = 0.0;  ///< area of the projection
};

/// Geometry of `shell`. Requires `Corners` (3 or 4) equal to shell.corners(). Collapsed elements give values that are
/// not finite.
template <int Corners>
ShellGeometry<Corners> shell_geometry(const Mesh& mesh, const ShellElement& shell);

/// Shape functions N of the bilinear quadrilateral at a point (ξ, η), and their derivatives. The corners are (-1,-1),
/// (1,-1), (1,1), (-1,1).
struct BilinearShape {
  Eigen::Vector4d N;
  Eigen::Matrix<double, 2, 4> slope;  ///< derivatives of N; rows ∂/∂ξ, ∂/∂η
};
BilinearShape bilinear_shape(double xi, double eta);

}  // namespace tisserand::reducer
