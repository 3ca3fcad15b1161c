// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness of the four-node shell element: assumed membrane stress with drilling rotations, MITC4 plate.
//
// Membrane forces N are an independent field (Hellinger-Reissner). Curvatures and shear strains follow from rotations
// and deflections:
//   Π = ∮ N n · u ds − ½ ∫ (N − Bκ)ᵀ A⁻¹ (N − Bκ) dA + ½ ∫ [ κᵀ D κ + γᵀ As γ ] dA.
// u on an edge is Allman's: linear along it, quadratic across it by the drilling rotations of its ends ([All84]). N is
// in equilibrium, so u is needed on the edges only (as in [Ami92]). Seven linear modes of N give the stiffness; two
// quadratic ones and the mean drilling rotation complete the rank. The quadratic ones have a small factor: alternating
// drilling rotations also occur in bending of a doubly curved shell, which must not stretch it. Rigid arms tie nodes
// and projected corners, so rigid motions give no force, warped or not.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "reducer/elements/gauss.hpp"
#include "reducer/elements/shell/side.hpp"
#include "reducer/elements/shell/stiffness.hpp"

namespace tisserand::reducer {
namespace {

constexpr int modes = 9;
using StressModes = Eigen::Matrix<double, 3, modes>;
using ModeRows = Eigen::Matrix<double, modes, 24>;
using PlateMatrix = Eigen::Matrix<double, 12, 12>;  ///< [w θx θy] per corner

/// Stress [xx yy xy] of the equilibrium modes at p (scaled by the element's size): three constant, four linear (all
/// that are in equilibrium), and two quadratic, of Airy's functions x⁴ − y⁴ and x³y + xy³. Rotations map them to one
/// another, and so do shifts of the axes except for lower modes. So the element has no preferred axes.
StressModes stress_modes(const Eigen::Vector2d& p) {
  const double x = p.x(), y = p.y();
  StressModes P;
  P << 1, 0, 0, y, 0, x, 0, -y * y, 2 * x * y,  //
      0, 1, 0, 0, x, 0, y, x * x, 2 * x * y,    //
      0, 0, 1, 0, 0, -y, -x, 0, -(x * x + y * y);
  return P;
}

/// ∮ (P n)ᵀ u ds: work of each mode on the corner displacements. Along edge i → j with d = x_j − x_i, u(s) = (1−s) u_i
/// + s u_j + ½ s(1−s) (θ_j − θ_i) [d_y, −d_x] ([All84]); three points are exact.
ModeRows edge_work(const Eigen::Matrix<double, 2, 4>& corner, double size) {
  ModeRows G = ModeRows::Zero();
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    const Eigen::Vector2d d = corner.col(j) - corner.col(i);
    const Eigen::Vector2d normal(d.y(), -d.x());
    for (const GaussPoint& g : gauss3) {
      const double s = 0.5 * (1.0 + g.at), weight = 0.5 * g.weight;
      const StressModes P = stress_modes((corner.col(i) + s * d) / size);
      const Eigen::Matrix<double, modes, 1> tx = weight * (P.row(0) * normal.x() + P.row(2) * normal.y()).transpose();
      const Eigen::Matrix<double, modes, 1> ty = weight * (P.row(2) * normal.x() + P.row(1) * normal.y()).transpose();
      G.col(6 * i) += (1.0 - s) * tx;
      G.col(6 * i + 1) += (1.0 - s) * ty;
      G.col(6 * j) += s * tx;
      G.col(6 * j + 1) += s * ty;
      const Eigen::Matrix<double, modes, 1> bulge = 0.5 * s * (1.0 - s) * (normal.x() * tx + normal.y() * ty);
      G.col(6 * i + 5) -= bulge;
      G.col(6 * j + 5) += bulge;
    }
  }
  return G;
}

/// ∫ Pᵀ A⁻¹ P dA, exact with 3 x 3 points.
Eigen::Matrix<double, modes, modes> complementary_energy(const Eigen::Matrix<double, 2, 4>& corner, double size,
                                                         const Eigen::Matrix3d& A_inverse) {
  Eigen::Matrix<double, modes, modes> H = Eigen::Matrix<double, modes, modes>::Zero();
  for (const GaussPoint& a : gauss3)
    for (const GaussPoint& b : gauss3) {
      const BilinearShape shape = bilinear_shape(a.at, b.at);
      const Eigen::Matrix2d J = shape.slope * corner.transpose();
      const StressModes P = stress_modes(corner * shape.N / size);
      H.noalias() += (a.weight * b.weight * J.determinant()) * P.transpose() * (A_inverse * P);
    }
  return H;
}

/// Mean of θ minus rotation of the mean: ∫ θz dA/A − ∮ u · ds/(2A). It is zero in every rigid motion.
Eigen::Matrix<double, 24, 1> mean_drilling(const ShellGeometry<4>& geometry) {
  Eigen::Matrix<double, 24, 1> row = Eigen::Matrix<double, 24, 1>::Zero();
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d chord = geometry.corner.col((i + 1) % 4) - geometry.corner.col((i + 3) % 4);
    row.segment<2>(6 * i) = -chord / (4.0 * geometry.area);
  }
  for (const GaussPoint& a : gauss2)
    for (const GaussPoint& b : gauss2) {
      const BilinearShape shape = bilinear_shape(a.at, b.at);
      const double dA = a.weight * b.weight * (shape.slope * geometry.corner.transpose()).determinant();
      for (int i = 0; i < 4; ++i) row[6 * i + 5] += shape.N[i] * dA / geometry.area;
    }
  return row;
}

/// Covariant shear strains of MITC4 at the middles of the edges, (w_j − w_i)/2 + d/4 · Σ [θy, −θx], along ξ at η = −1
/// and 1, along η at ξ = −1 and 1 ([DB84]). They have the factor √(φ/(φ + 0.35)) with φ = 12 D_ss/(As_ss ℓ²), ℓ the
/// shortest edge. So the sheet's shear stiffness is in series with a residual flexibility of bending ([LSV93]: t²/(t² +
/// α ℓ²); 0.35 is α = 0.1 for isotropic sheets). The change vanishes with the element size, and constant bending has no
/// shear.
Eigen::Matrix<double, 4, 12> edge_shear(const Eigen::Matrix<double, 2, 4>& corner, const Eigen::Matrix3d& D,
                                        const Eigen::Matrix2d& As) {
  constexpr double residual = 0.35;
  constexpr std::array<std::array<int, 2>, 4> edges{{{0, 1}, {3, 2}, {0, 3}, {1, 2}}};
  std::array<PlateSide, 4> sides;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 4; ++k) {
    sides[k] = plate_side(corner.col(edges[k][1]) - corner.col(edges[k][0]), D, As);
    shortest = std::min(shortest, sides[k].length);
  }
  Eigen::Matrix<double, 4, 12> rows = Eigen::Matrix<double, 4, 12>::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const double aspect = sides[k].length / shortest, phi = sides[k].phi * aspect * aspect;
    const double factor = std::sqrt(phi / (phi + residual));
    const Eigen::Vector2d d = 0.25 * factor * sides[k].length * sides[k].direction;
    const auto row = static_cast<Eigen::Index>(k);
    rows(row, 3 * edges[k][0]) = -0.5 * factor;
    rows(row, 3 * edges[k][1]) = 0.5 * factor;
    for (int corner_number : edges[k]) rows.block<1, 2>(row, 3 * corner_number + 1) << -d.y(), d.x();
  }
  return rows;
}

struct PlatePart {
  PlateMatrix K = PlateMatrix::Zero();
  Eigen::Matrix<double, modes, 12> coupling = Eigen::Matrix<double, modes, 12>::Zero();  ///< ∫ Pᵀ A⁻¹ B κ dA
};

/// Bending and assumed transverse shear ([DB84]) by 2 x 2 points. N is an independent field, so the bending stiffness
/// is D − B A⁻¹ B.
PlatePart plate_part(const ShellGeometry<4>& geometry, const ShellSection& section, const Eigen::Matrix3d& A_inverse,
                     double size) {
  const Eigen::Matrix<double, 2, 4>& corner = geometry.corner;
  const Eigen::Matrix3d A_inverse_B = A_inverse * section.B;
  const Eigen::Matrix3d D = section.D - section.B * A_inverse_B;
  const Eigen::Matrix<double, 4, 12> edge = edge_shear(corner, D, section.As);
  PlatePart part;
  for (const GaussPoint& a : gauss2)
    for (const GaussPoint& b : gauss2) {
      const BilinearShape shape = bilinear_shape(a.at, b.at);
      const Eigen::Matrix2d J = shape.slope * corner.transpose(), J_inverse = J.inverse();
      const double dA = a.weight * b.weight * J.determinant();
      const Eigen::Matrix<double, 3, 12> kappa = curvature_rows<4>(J_inverse * shape.slope);
      Eigen::Matrix<double, 2, 12> covariant;
      covariant.row(0) = 0.5 * (1.0 - b.at) * edge.row(0) + 0.5 * (1.0 + b.at) * edge.row(1);
      covariant.row(1) = 0.5 * (1.0 - a.at) * edge.row(2) + 0.5 * (1.0 + a.at) * edge.row(3);
      const Eigen::Matrix<double, 2, 12> gamma = J_inverse * covariant;
      const Eigen::Matrix<double, 3, 12> M = dA * D * kappa;
      const Eigen::Matrix<double, 2, 12> Q = dA * section.As * gamma;
      part.K += kappa.transpose().lazyProduct(M) + gamma.transpose().lazyProduct(Q);
      if (section.B.isZero(0.0)) continue;
      const Eigen::Matrix<double, 3, 12> stretch = dA * A_inverse_B * kappa;
      part.coupling += stress_modes(corner * shape.N / size).transpose().lazyProduct(stretch);
    }
  return part;
}

/// Work of the stress modes on the coordinates: ∫ Pᵀ n ds u, and the coupling with the curvatures.
ModeRows mode_work(const Eigen::Matrix<double, 2, 4>& corner, double size, const PlatePart& plate) {
  ModeRows F = edge_work(corner, size);
  for (int i = 0; i < 4; ++i) F.block<modes, 3>(0, 6 * i + 2) += plate.coupling.block<modes, 3>(0, 3 * i);
  return F;
}

}  // namespace

Eigen::MatrixXd quad_resultants(const ShellGeometry<4>& geometry, const ShellSection& section,
                                const Eigen::Matrix2Xd& natural) {
  constexpr int linear_modes = 7;
  const double size = std::sqrt(geometry.area);
  const Eigen::Matrix3d A_inverse = section.A.inverse();
  const Eigen::Matrix3d B_A_inverse = section.B * A_inverse;
  const Eigen::Matrix3d D = section.D - B_A_inverse * section.B;
  const ModeRows F = mode_work(geometry.corner, size, plate_part(geometry, section, A_inverse, size));
  const Eigen::Matrix<double, linear_modes, linear_modes> H =
      complementary_energy(geometry.corner, size, A_inverse).topLeftCorner<linear_modes, linear_modes>();
  const Eigen::Matrix<double, linear_modes, 24> beta = H.llt().solve(F.topRows<linear_modes>());
  Eigen::MatrixXd rows(6 * natural.cols(), 24);
  for (Eigen::Index k = 0; k < natural.cols(); ++k) {
    const BilinearShape shape = bilinear_shape(natural(0, k), natural(1, k));
    const Eigen::Matrix2d J = shape.slope * geometry.corner.transpose();
    const Eigen::Matrix<double, 3, 12> M = D * curvature_rows<4>(J.inverse() * shape.slope);
    rows.middleRows<3>(6 * k) = stress_modes(geometry.corner * shape.N / size).leftCols<linear_modes>() * beta;
    rows.middleRows<3>(6 * k + 3) = B_A_inverse * rows.middleRows<3>(6 * k);
    for (int i = 0; i < 4; ++i) rows.block<3, 3>(6 * k + 3, 6 * i + 2) += M.block<3, 3>(0, 3 * i);
  }
  return rows;
}

QuadMatrix quad_stiffness(const ShellGeometry<4>& geometry, const ShellSection& section,
                          const DrillingFactors& drilling) {
  const double size = std::sqrt(geometry.area);
  const Eigen::Matrix3d A_inverse = section.A.inverse();
  const PlatePart plate = plate_part(geometry, section, A_inverse, size);
  ModeRows F = mode_work(geometry.corner, size, plate);
  QuadMatrix K = QuadMatrix::Zero();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) K.block<3, 3>(6 * i + 2, 6 * j + 2) = plate.K.block<3, 3>(3 * i, 3 * j);
  // With H = L Lᵀ the rows of L⁻¹F belong to modes that are orthonormal in energy; the quadratic ones are last.
  const Eigen::LLT<Eigen::Matrix<double, modes, modes>> H(complementary_energy(geometry.corner, size, A_inverse));
  H.matrixL().solveInPlace(F);
  F.bottomRows<2>() *= std::sqrt(drilling.quadratic);
  const Eigen::Matrix<double, 24, 1> spin = mean_drilling(geometry);
  K.noalias() += F.transpose() * F;
  K.noalias() += (drilling.mean * section.A(2, 2) * geometry.area) * spin * spin.transpose();
  return K;
}

}  // namespace tisserand::reducer
