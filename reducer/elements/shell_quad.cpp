// Stiffness of the four-node shell element: assumed membrane stress with drilling rotations, DKMQ bending and shear.
//
// Membrane forces N are a field of their own (Hellinger-Reissner), curvatures and shear strains follow from rotations
// and deflections:
//   Π = ∮ N n · u ds − ½ ∫ (N − Bκ)ᵀ A⁻¹ (N − Bκ) dA + ½ ∫ [ κᵀ D κ + γᵀ As γ ] dA.
// u on an edge is Allman's: linear along it, quadratic across it by the drilling rotations of its ends ([All84]). N
// fulfils equilibrium, so u is needed on the edges only (as in [Ami92]). Seven linear modes of N give the stiffness;
// two quadratic ones and the mean drilling rotation complete the rank. The quadratic ones carry a small factor:
// drilling rotations that alternate around an element are those of a doubly curved shell in bending, which must not
// stretch it. Nodes and projected corners are tied by rigid arms, so rigid motions give no force, warped or not.
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "reducer/elements/shell_side.hpp"
#include "reducer/elements/shell_stiffness.hpp"

namespace tisserand::reducer {
namespace {

constexpr int modes = 9;
using StressModes = Eigen::Matrix<double, 3, modes>;
using ModeRows = Eigen::Matrix<double, modes, 24>;
using PlateMatrix = Eigen::Matrix<double, 12, 12>;  ///< [w θx θy] per corner

/// Stress [xx yy xy] of the equilibrium modes at p (scaled with the element's size): three constant, four linear (all
/// that are in equilibrium), and two quadratic, of Airy's functions x⁴ − y⁴ and x³y + xy³. They turn into one another
/// under rotation and, up to lower ones, under a shift of the axes, so the element knows no preferred axes.
StressModes stress_modes(const Eigen::Vector2d& p) {
  const double x = p.x(), y = p.y();
  StressModes P;
  P << 1, 0, 0, y, 0, x, 0, -y * y, 2 * x * y,  //
      0, 1, 0, 0, x, 0, y, x * x, 2 * x * y,    //
      0, 0, 1, 0, 0, -y, -x, 0, -(x * x + y * y);
  return P;
}

/// ∮ (P n)ᵀ u ds: work of each mode on the corner displacements; along edge i → j with d = x_j − x_i:
/// u(s) = (1−s) u_i + s u_j + ½ s(1−s) (θ_j − θ_i) [d_y, −d_x] ([All84] (4)), exact with three points.
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

/// θ of the mean − ω of the mean: ∫ θz dA/A − ∮ u · ds/(2A); zero in every rigid motion.
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

/// ξ, η slopes of the shape functions of the rotations Δβ at the middles of the edges ([Kat93] part II, (8)).
Eigen::Matrix<double, 2, 4> bulge_slopes(double xi, double eta) {
  const double a = 0.5 * (1.0 - xi * xi), b = 0.5 * (1.0 - eta * eta);
  Eigen::Matrix<double, 2, 4> slope;
  slope << -xi * (1.0 - eta), b, -xi * (1.0 + eta), -b, -a, -eta * (1.0 + xi), a, -eta * (1.0 - xi);
  return slope;
}

/// The edges with their Δβ and their covariant shear strain γ_s L/2 along +ξ or +η.
struct QuadSides {
  std::array<PlateSide, 4> side;
  Eigen::Matrix<double, 4, 12> bulge;
  Eigen::Matrix<double, 4, 12> shear;
};

QuadSides quad_sides(const Eigen::Matrix<double, 2, 4>& corner, const Eigen::Matrix3d& D, const Eigen::Matrix2d& As) {
  QuadSides sides;
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    PlateSide& side = sides.side[static_cast<std::size_t>(i)];
    side = plate_side(corner.col(j) - corner.col(i), D, As);
    sides.bulge.row(i) = side_bulge<4>(side, i, j);
    const double orientation = i < 2 ? 1.0 : -1.0;  // the third and fourth edge run against ξ and η
    sides.shear.row(i) = -orientation / 3.0 * side.phi * side.length * sides.bulge.row(i);
  }
  return sides;
}

struct PlatePart {
  PlateMatrix K = PlateMatrix::Zero();
  Eigen::Matrix<double, modes, 12> coupling = Eigen::Matrix<double, modes, 12>::Zero();  ///< ∫ Pᵀ A⁻¹ B κ dA
};

/// Bending and transverse shear of DKMQ ([Kat93] part II) with the bending stiffness D − B A⁻¹ B that is left when N is
/// a field of its own; 2 x 2 points.
PlatePart plate_part(const ShellGeometry<4>& geometry, const ShellSection& section, const Eigen::Matrix3d& A_inverse,
                     double size) {
  const Eigen::Matrix<double, 2, 4>& corner = geometry.corner;
  const Eigen::Matrix3d A_inverse_B = A_inverse * section.B;
  const Eigen::Matrix3d D = section.D - section.B * A_inverse_B;
  const QuadSides sides = quad_sides(corner, D, section.As);
  PlatePart part;
  for (const GaussPoint& a : gauss2)
    for (const GaussPoint& b : gauss2) {
      const BilinearShape shape = bilinear_shape(a.at, b.at);
      const Eigen::Matrix2d J = shape.slope * corner.transpose(), J_inverse = J.inverse();
      const double dA = a.weight * b.weight * J.determinant();
      Eigen::Matrix<double, 3, 12> kappa = curvature_rows<4>(J_inverse * shape.slope);
      const Eigen::Matrix<double, 2, 4> g = J_inverse * bulge_slopes(a.at, b.at);
      for (int k = 0; k < 4; ++k)
        kappa.noalias() += side_curvature(sides.side[static_cast<std::size_t>(k)], g.col(k)) * sides.bulge.row(k);
      Eigen::Matrix<double, 2, 12> covariant;  // linear between opposite edges, as in [DB84] (8)
      covariant.row(0) = 0.5 * (1.0 - b.at) * sides.shear.row(0) + 0.5 * (1.0 + b.at) * sides.shear.row(2);
      covariant.row(1) = 0.5 * (1.0 - a.at) * sides.shear.row(3) + 0.5 * (1.0 + a.at) * sides.shear.row(1);
      const Eigen::Matrix<double, 2, 12> gamma = J_inverse * covariant;
      part.K.noalias() += kappa.transpose() * (dA * D * kappa) + gamma.transpose() * (dA * section.As * gamma);
      const StressModes P = stress_modes(corner * shape.N / size);
      part.coupling.noalias() += P.transpose() * (dA * A_inverse_B * kappa);
    }
  return part;
}

}  // namespace

QuadMatrix quad_stiffness(const ShellGeometry<4>& geometry, const ShellSection& section,
                          const DrillingFactors& drilling) {
  const double size = std::sqrt(geometry.area);
  const Eigen::Matrix3d A_inverse = section.A.inverse();
  const PlatePart plate = plate_part(geometry, section, A_inverse, size);
  ModeRows F = edge_work(geometry.corner, size);
  QuadMatrix K = QuadMatrix::Zero();
  for (int i = 0; i < 4; ++i) {
    F.block<modes, 3>(0, 6 * i + 2) += plate.coupling.block<modes, 3>(0, 3 * i);
    for (int j = 0; j < 4; ++j) K.block<3, 3>(6 * i + 2, 6 * j + 2) = plate.K.block<3, 3>(3 * i, 3 * j);
  }
  // With H = L Lᵀ the rows of L⁻¹F belong to modes that are orthonormal in energy, the quadratic ones last.
  const Eigen::LLT<Eigen::Matrix<double, modes, modes>> H(complementary_energy(geometry.corner, size, A_inverse));
  H.matrixL().solveInPlace(F);
  F.bottomRows<2>() *= std::sqrt(drilling.quadratic);
  const Eigen::Matrix<double, 24, 1> spin = mean_drilling(geometry);
  K.noalias() += F.transpose() * F;
  K.noalias() += (drilling.mean * section.A(2, 2) * geometry.area) * spin * spin.transpose();
  return K;
}

}  // namespace tisserand::reducer
