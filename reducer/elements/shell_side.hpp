// Sides of the plate in a shell element: what bending and transverse shear of triangles and quadrilaterals have in
// common.
#pragma once

#include <Eigen/Core>

namespace tisserand::reducer {

/// The discrete Mindlin side of [Kat93]: along it the rotation β_s is quadratic, Δβ_s at the middle beyond linear, and
/// the shear strain is constant, γ_s = -2/3 φ Δβ_s, as the equilibrium of the side demands.
struct PlateSide {
  Eigen::Vector2d direction;
  double length = 0.0;
  double phi = 0.0;  ///< 12 D_ss/(As_ss L²): shear flexibility; 0 for a thin plate
};

/// `d` from corner to corner. Differs from [Kat93] (18): bending and shear stiffness are those along the side, so that
/// laminates are included.
PlateSide plate_side(const Eigen::Vector2d& d, const Eigen::Matrix3d& D, const Eigen::Matrix2d& As);

/// Δβ_s = -3/(2 L (1 + φ)) [w_j - w_i + L/2 (β_si + β_sj)] with β = [θy, -θx], in the coordinates [w θx θy] per corner
/// ([Kat93] (17)): the mean of w,s + β_s is γ_s.
template <int Corners>
Eigen::Matrix<double, 1, 3 * Corners> side_bulge(const PlateSide& side, int i, int j) {
  const double factor = -1.5 / (side.length * (1.0 + side.phi));
  const Eigen::Vector2d half = 0.5 * factor * side.length * side.direction;
  Eigen::Matrix<double, 1, 3 * Corners> row = Eigen::Matrix<double, 1, 3 * Corners>::Zero();
  row[3 * i] = -factor;
  row[3 * j] = factor;
  row[3 * i + 1] = row[3 * j + 1] = -half.y();
  row[3 * i + 2] = row[3 * j + 2] = half.x();
  return row;
}

/// κ = [θy,x; -θx,y; θy,y - θx,x] of rotations with the shape functions N_i, whose slopes are the columns of `slope`.
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

/// κ of a unit Δβ_s whose shape function has the slope g.
inline Eigen::Vector3d side_curvature(const PlateSide& side, const Eigen::Vector2d& g) {
  const Eigen::Vector2d& s = side.direction;
  return {g.x() * s.x(), g.y() * s.y(), g.y() * s.x() + g.x() * s.y()};
}

}  // namespace tisserand::reducer
