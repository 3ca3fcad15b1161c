// Second-order strain of shell elements: corotation of the nodal forces, and membrane forces on rotations that vary
// inside the element.
//
// Nodal forces f, m = K_e w hold membrane forces, bending moments and transverse shear alike, so with the rotation ω of
// the element taken out, V3 = Σ [ f · u₂ + m · ψ₂ ] with the second-order deformations u₂ = −ω × (u − ½ ω × X),
// ψ₂ = −½ ω × ψ misses nothing of a bent shell that turns. ω: of the mean plane. What the element does not turn as a
// whole, ψ − mean ψ, is worked on by the mean membrane forces as a fibre of a plate is by its axial force,
// ½ N_αβ w,α w,β with w,x = −ψy, w,y = ψx, and by the rotation in the plane, ½ (N_xx + N_yy) ψz². It vanishes for rigid
// motions, so it leaves the invariance as it is, and makes long elements as good as their bending is.
#include <array>
#include <cmath>

#include "reducer/elements/element_matrices.hpp"
#include "reducer/elements/gauss.hpp"
#include "reducer/elements/second_order.hpp"
#include "reducer/elements/shell/geometry.hpp"

namespace tisserand::reducer {
namespace {

using Turn = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// ∂/∂x, ∂/∂y (rows) of interpolated values of the corners: mean over the element.
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

/// ω = [w,y; −w,x; ½ (v,x − u,y)] of the middle surface, in element axes [u v w θx θy θz]: a rigid rotation gives
/// itself for nodes at heights h, since ψ × h ẑ of their arms is taken off.
template <int Corners>
Turn turn_of_plane(const ShellGeometry<Corners>& geometry) {
  const Eigen::Matrix<double, 2, Corners> slope = mean_slope(geometry);
  Turn turn = Turn::Zero(3, 6 * Corners);
  for (int i = 0; i < Corners; ++i) {
    turn(0, 6 * i + 2) = slope(1, i);
    turn(1, 6 * i + 2) = -slope(0, i);
    turn(2, 6 * i) = -0.5 * slope(1, i);
    turn(2, 6 * i + 1) = 0.5 * slope(0, i);
    // In-plane displacement of the middle surface below a corner at height h: u − θ × h ẑ.
    turn(2, 6 * i + 3) = 0.5 * slope(0, i) * geometry.height[i];
    turn(2, 6 * i + 4) = 0.5 * slope(1, i) * geometry.height[i];
  }
  return turn;
}

/// Values of the corners' shape functions at the points, and the root of their share of the area.
template <int Corners>
struct SheetPoint {
  Eigen::Matrix<double, Corners, 1> N;
  double root = 0.0;
};

std::array<SheetPoint<3>, 3> sheet_points(const ShellGeometry<3>&) {
  std::array<SheetPoint<3>, 3> points;
  for (int p = 0; p < 3; ++p) {
    points[p].N.setConstant(1.0 / 6.0);
    points[p].N[p] = 2.0 / 3.0;
    points[p].root = std::sqrt(1.0 / 3.0);
  }
  return points;
}
std::array<SheetPoint<4>, 4> sheet_points(const ShellGeometry<4>& geometry) {
  std::array<SheetPoint<4>, 4> points;
  std::size_t p = 0;
  for (const GaussPoint& a : gauss2)
    for (const GaussPoint& b : gauss2) {
      const BilinearShape shape = bilinear_shape(a.at, b.at);
      const double dA = a.weight * b.weight * (shape.slope * geometry.corner.transpose()).determinant();
      points[p].N = shape.N;
      points[p++].root = std::sqrt(dA / geometry.area);
    }
  return points;
}

/// Coordinates of the mesh in element axes: left factor for rows that are in element axes.
Eigen::MatrixXd turned_columns(const Eigen::MatrixXd& rows, const Eigen::Matrix3d& R_PE) {
  Eigen::MatrixXd result(rows.rows(), rows.cols());
  for (Eigen::Index k = 0; k < rows.cols(); k += 3)
    result.middleCols<3>(k).noalias() = rows.middleCols<3>(k) * R_PE.transpose();
  return result;
}

template <int Corners>
void corotate(const Mesh& mesh, const ShellElement& shell, SecondOrderRows& out) {
  const ShellGeometry<Corners> geometry = shell_geometry<Corners>(mesh, shell);
  const Eigen::Matrix3d& R_PE = geometry.R_PE;
  out.start({{&turned_point(), Corners}, {&turning_sheet(Corners), 1}}, 6 * Corners);
  static thread_local ElementMatrices matrices;
  element_matrices(mesh, shell, matrices);
  Eigen::Matrix3Xd X(3, Corners);
  for (int i = 0; i < Corners; ++i) X.col(i) = mesh.position.col(shell.nodes[i]);
  X.colwise() -= Eigen::Vector3d(X.rowwise().mean());
  const Turn turn = R_PE * turned_columns(turn_of_plane<Corners>(geometry), R_PE);
  add_corotated(matrices.S, X, turn, out);
  // ∫N dA = sym Σ f xᵀ for nodal forces f at x: their work on a constant strain.
  const Eigen::Matrix<double, 3, 2> axes = R_PE.leftCols<2>();
  auto N = out.stress.bottomRows<3>();
  for (int i = 0; i < Corners; ++i) {
    const Eigen::MatrixXd f = axes.transpose() * matrices.S.middleRows<3>(6 * i);
    N.row(0) += geometry.corner(0, i) * f.row(0);
    N.row(1) += geometry.corner(1, i) * f.row(1);
    N.row(2) += 0.5 * (geometry.corner(1, i) * f.row(0) + geometry.corner(0, i) * f.row(1));
  }
  Eigen::Index row = 9 * Corners;
  for (const SheetPoint<Corners>& point : sheet_points(geometry)) {
    for (int i = 0; i < Corners; ++i)
      out.gradient.template block<3, 3>(row, 6 * i + 3) = point.root * (point.N[i] - 1.0 / Corners) * R_PE.transpose();
    row += 3;
  }
}

}  // namespace

void second_order(const Mesh& mesh, const ShellElement& shell, SecondOrderRows& out) {
  if (shell.corners() == 3)
    corotate<3>(mesh, shell, out);
  else
    corotate<4>(mesh, shell, out);
}

}  // namespace tisserand::reducer
