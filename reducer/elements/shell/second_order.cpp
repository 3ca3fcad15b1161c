// SPDX-License-Identifier: GPL-3.0-or-later
// Second-order strain of shell elements: corotation of the nodal forces, and membrane forces on rotations that vary
// inside the element.
//
// Nodal forces f, m = K_e w contain membrane forces, bending moments and transverse shear. ω is the rotation of the
// mean plane. Without it the second-order deformations are u₂ = −ω × (u − ½ ω × X) and ψ₂ = −½ ω × ψ. So V3 = Σ [ f ·
// u₂ + m · ψ₂ ] is complete for a bent shell that turns. Rotations relative to the element, ψ − mean ψ, are under the
// mean membrane forces like a fibre of a plate under its axial force: ½ N_αβ w,α w,β with w,x = −ψy, w,y = ψx, and ½
// (N_xx + N_yy) ψz² in the plane. This term vanishes for rigid motions, so the invariance stays, and it makes long
// elements as good as their bending is.
#include <array>
#include <cmath>
#include <vector>

#include "common/math/rotation.hpp"
#include "reducer/elements/element_matrices.hpp"
#include "reducer/elements/gauss.hpp"
#include "reducer/elements/second_order.hpp"
#include "reducer/elements/shell/geometry.hpp"
#include "reducer/elements/shell/turn.hpp"

namespace tisserand::reducer {
namespace {

using Turn = ShellTurn;

/// Values of the corners' shape functions at a point, and the root of its share of the area.
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

template <int Corners>
void corotate(const Mesh& mesh, const ShellElement& shell, SecondOrderRows& out) {
  const ShellGeometry<Corners> geometry = shell_geometry<Corners>(mesh, shell);
  const Eigen::Matrix3d& R_PE = geometry.R_PE;
  std::vector<StrainSection> sections{{&turned_point(), Corners}, {&turning_sheet(Corners), 1}};
  if (shell.offset != 0.0) sections.push_back({&turned_point(), Corners});
  out.start(sections, 6 * Corners);
  static thread_local ElementMatrices matrices;
  element_matrices(mesh, shell, matrices);
  Eigen::Matrix3Xd X(3, Corners);
  for (int i = 0; i < Corners; ++i) X.col(i) = mesh.position.col(shell.nodes[i]);
  X.colwise() -= Eigen::Vector3d(X.rowwise().mean());
  const Turn turn = shell_turn<Corners>(geometry, shell.offset);
  add_corotated(matrices.S, X, turn, out);
  // ∫N dA = sym Σ f xᵀ for nodal forces f at x: their work on a constant strain.
  const Eigen::Matrix<double, 3, 2> axes = R_PE.leftCols<2>();
  auto N = out.stress.middleRows<3>(6 * Corners);
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
  if (shell.offset == 0.0) return;
  // Arms r from the nodes to the middle surface turn against the element by φ = ψ − ω, so their ends move by ½ φ × (φ ×
  // r).
  for (int i = 0; i < Corners; ++i) {
    out.stress.template middleRows<3>(6 * Corners + 3 + 6 * i) = matrices.S.middleRows<3>(6 * i);
    Turn beside = -turn;
    beside.template middleCols<3>(6 * i + 3) += Eigen::Matrix3d::Identity();
    out.gradient.template middleRows<3>(row) = beside;
    out.gradient.template middleRows<3>(row + 3) =
        0.5 * skew<double>(Eigen::Vector3d(shell.offset * R_PE.col(2))) * beside;
    row += 9;
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
