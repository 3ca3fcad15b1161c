// SPDX-License-Identifier: GPL-3.0-or-later
// Mean rotation of the middle surface, from the slopes of the displacements of the corners.
#include "reducer/elements/shell/turn.hpp"

namespace tisserand::reducer {
namespace {

/// Mean over the element of ∂/∂x, ∂/∂y (rows) of values interpolated between the corners.
Eigen::Matrix<double, 2, 3> mean_slope(const ShellGeometry<3>& geometry) {
  Eigen::Matrix<double, 2, 3> slope;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d d = geometry.corner.col((i + 2) % 3) - geometry.corner.col((i + 1) % 3);
    slope.col(i) = Eigen::Vector2d(-d.y(), d.x()) / (2.0 * geometry.area);
  }
  return slope;
}
Eigen::Matrix<double, 2, 4> mean_slope(const ShellGeometry<4>& geometry) {
  Eigen::Matrix<double, 2, 4> slope;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d d = geometry.corner.col((i + 3) % 4) - geometry.corner.col((i + 1) % 4);
    slope.col(i) = Eigen::Vector2d(-d.y(), d.x()) / (2.0 * geometry.area);
  }
  return slope;
}

/// ω = [w,y; −w,x; ½ (v,x − u,y)] of the middle surface, in element axes [u v w θx θy θz]. ψ × (h − offset) ẑ, the
/// motion of the arms of nodes at height h − offset above that surface, is removed. So a rigid rotation gives itself.
template <int Corners>
ShellTurn turn_of_plane(const ShellGeometry<Corners>& geometry, double offset) {
  const Eigen::Matrix<double, 2, Corners> slope = mean_slope(geometry);
  ShellTurn turn = ShellTurn::Zero(3, 6 * Corners);
  for (int i = 0; i < Corners; ++i) {
    turn(0, 6 * i + 2) = slope(1, i);
    turn(1, 6 * i + 2) = -slope(0, i);
    turn(2, 6 * i) = -0.5 * slope(1, i);
    turn(2, 6 * i + 1) = 0.5 * slope(0, i);
    turn(2, 6 * i + 3) = 0.5 * slope(0, i) * (geometry.height[i] - offset);
    turn(2, 6 * i + 4) = 0.5 * slope(1, i) * (geometry.height[i] - offset);
  }
  return turn;
}

/// Columns for coordinates of the mesh in part axes, from columns in element axes; `rows` are in element axes.
Eigen::MatrixXd turned_columns(const Eigen::MatrixXd& rows, const Eigen::Matrix3d& R_PE) {
  Eigen::MatrixXd result(rows.rows(), rows.cols());
  for (Eigen::Index k = 0; k < rows.cols(); k += 3)
    result.middleCols<3>(k).noalias() = rows.middleCols<3>(k) * R_PE.transpose();
  return result;
}

}  // namespace

template <int Corners>
ShellTurn shell_turn(const ShellGeometry<Corners>& geometry, double offset) {
  return geometry.R_PE * turned_columns(turn_of_plane<Corners>(geometry, offset), geometry.R_PE);
}

template ShellTurn shell_turn<3>(const ShellGeometry<3>&, double);
template ShellTurn shell_turn<4>(const ShellGeometry<4>&, double);

}  // namespace tisserand::reducer
