// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness of the three-node shell element: Felippa's optimal membrane with drilling rotations, Katili's DKMT plate.
//
// The membrane strain of the basic part is constant and passes every patch test; the higher part of the drilling
// rotations is orthogonal to it in energy ([Fel03]), so B couples the basic strain with the curvatures of the plate
// only.
#include <algorithm>
#include <array>

#include <Eigen/LU>

#include "reducer/elements/shell/side.hpp"
#include "reducer/elements/shell/stiffness.hpp"

namespace tisserand::reducer {
namespace {

using Corners = Eigen::Matrix<double, 2, 3>;
using MembraneRows = Eigen::Matrix<double, 3, 9>;  ///< coordinates [u v θz] per corner
using PlateRows = Eigen::Matrix<double, 3, 9>;     ///< coordinates [w θx θy] per corner

/// Mean strain Lᵀ/V of the basic part, with the factor 3/2 of the drilling rotations ([Fel03], basic stiffness).
MembraneRows basic_strain(const Corners& corner, double area) {
  constexpr double alpha = 1.5;
  MembraneRows rows;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Eigen::Vector2d a = corner.col(j) - corner.col(k);  // opposite edge: x_jk, y_jk
    const Eigen::Vector2d b = corner.col(i) - corner.col(k), c = corner.col(j) - corner.col(i);
    const double y_jk = a.y(), x_kj = -a.x();
    rows.col(3 * i) << y_jk, 0.0, x_kj;
    rows.col(3 * i + 1) << 0.0, x_kj, y_jk;
    rows.col(3 * i + 2) << alpha / 6.0 * y_jk * (b.y() - c.y()), alpha / 6.0 * x_kj * (c.x() - b.x()),
        alpha / 3.0 * (c.x() * c.y() - b.x() * b.y());
  }
  return rows / (2.0 * area);
}

/// U4/U1 of the membrane stiffness: Poisson's ratio of the isotropic sheet with the same invariants.
double mean_poisson_ratio(const Eigen::Matrix3d& A) {
  const double sum = A(0, 0) + A(1, 1);
  return (sum + 6.0 * A(0, 1) - 4.0 * A(2, 2)) / (3.0 * sum + 2.0 * A(0, 1) + 4.0 * A(2, 2));
}

/// Natural strains along the edges 2-1, 3-2, 1-3 at corner 1, for unit deviations of the drilling rotations from the
/// mean rotation, with the optimal β of [Fel03]. Corners 2 and 3 follow by cyclic exchange.
std::array<Eigen::Matrix3d, 3> natural_rows(const Eigen::Vector3d& length2, double area) {
  Eigen::Matrix3d Q1, Q2, Q3;
  Q1 << 1, 2, 1, 0, 1, -1, -1, -1, -2;
  Q2 << -2, -1, -1, 1, 1, 2, -1, 0, 1;
  Q3 << 1, -1, 0, -1, -2, -1, 2, 1, 1;
  const Eigen::Vector3d factor = 2.0 * area / 3.0 * length2.cwiseInverse();
  return {factor.asDiagonal() * Q1, factor.asDiagonal() * Q2, factor.asDiagonal() * Q3};
}

/// Stiffness of the higher part: ¾ β₀ Tᵀ K_θ T ([Fel03], higher-order stiffness), integrated at the middles of the
/// edges.
Eigen::Matrix<double, 9, 9> higher_stiffness(const Corners& corner, double area, const Eigen::Matrix3d& A) {
  const double nu = mean_poisson_ratio(A);
  const double beta = std::max(0.5 * (1.0 - 4.0 * nu * nu), 0.01);
  std::array<Eigen::Vector2d, 3> edge;  // 2-1, 3-2, 1-3
  Eigen::Vector3d length2;
  for (int k = 0; k < 3; ++k) {
    edge[k] = corner.col((k + 1) % 3) - corner.col(k);
    length2[k] = edge[k].squaredNorm();
  }
  Eigen::Matrix3d to_natural;  // natural strains from Cartesian ones
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2d& d = edge[k];
    to_natural.row(k) << d.x() * d.x(), d.y() * d.y(), d.x() * d.y();
    to_natural.row(k) /= length2[k];
  }
  const Eigen::Matrix3d Te = to_natural.inverse();
  const std::array<Eigen::Matrix3d, 3> Q = natural_rows(length2, area);
  Eigen::Matrix3d K_theta = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Matrix3d strain = Te * (0.5 * (Q[k] + Q[(k + 1) % 3]));
    K_theta += area * strain.transpose() * A * strain;
  }
  Eigen::Matrix<double, 3, 9> T = Eigen::Matrix<double, 3, 9>::Zero();  // θ_i − mean rotation of the plane
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d opposite = corner.col((i + 2) % 3) - corner.col((i + 1) % 3);  // x_kj, y_kj
    T.col(3 * i).setConstant(opposite.x() / (4.0 * area));
    T.col(3 * i + 1).setConstant(opposite.y() / (4.0 * area));
    T(i, 3 * i + 2) = 1.0;
  }
  return 0.75 * beta * T.transpose() * K_theta * T;
}

/// Rotation at the middle of side i → j minus the linear one: Δβ_s = −3/(2 L (1 + φ)) [w_j − w_i + L/2 (β_si + β_sj)]
/// with β = [θy, −θx] ([Kat93]). By equilibrium the shear strain along the side is γ_s = −⅔ φ Δβ_s. The mean of w,s +
/// β_s is γ_s.
Eigen::Matrix<double, 1, 9> side_bulge(const PlateSide& side, int i, int j) {
  const double factor = -1.5 / (side.length * (1.0 + side.phi));
  const Eigen::Vector2d half = 0.5 * factor * side.length * side.direction;
  Eigen::Matrix<double, 1, 9> row = Eigen::Matrix<double, 1, 9>::Zero();
  row[3 * i] = -factor;
  row[3 * j] = factor;
  row[3 * i + 1] = row[3 * j + 1] = -half.y();
  row[3 * i + 2] = row[3 * j + 2] = half.x();
  return row;
}

struct TriangleSides {
  std::array<PlateSide, 3> side;
  std::array<Eigen::Matrix<double, 1, 9>, 3> bulge;
};

TriangleSides triangle_sides(const Corners& corner, const ShellSection& section) {
  const Eigen::Matrix3d D = section.D - section.B * section.A.inverse() * section.B;
  TriangleSides sides;
  for (int i = 0; i < 3; ++i) {
    sides.side[i] = plate_side(corner.col((i + 1) % 3) - corner.col(i), D, section.As);
    sides.bulge[i] = side_bulge(sides.side[i], i, (i + 1) % 3);
  }
  return sides;
}

/// Shear strains at the corners from those along the two sides of each corner, −⅔ φ Δβ_s ([Kat93]).
std::array<Eigen::Matrix<double, 2, 9>, 3> corner_shear(const TriangleSides& sides) {
  std::array<Eigen::Matrix<double, 2, 9>, 3> gamma;
  for (std::size_t after = 0; after < 3; ++after) {
    const std::size_t before = (after + 2) % 3;
    Eigen::Matrix2d directions;
    directions << sides.side[after].direction.transpose(), sides.side[before].direction.transpose();
    Eigen::Matrix<double, 2, 9> along;
    along << -2.0 / 3.0 * sides.side[after].phi * sides.bulge[after],
        -2.0 / 3.0 * sides.side[before].phi * sides.bulge[before];
    gamma[after] = directions.inverse() * along;
  }
  return gamma;
}

/// κ of a unit Δβ_s with a shape function of slope g.
Eigen::Vector3d side_curvature(const PlateSide& side, const Eigen::Vector2d& g) {
  const Eigen::Vector2d& s = side.direction;
  return {g.x() * s.x(), g.y() * s.y(), g.y() * s.x() + g.x() * s.y()};
}

/// κ of β = Σ λ_i β_i + Σ 4 λ_i λ_j Δβ_s s at area coordinates λ.
PlateRows curvature(const Eigen::Matrix<double, 2, 3>& slope, const TriangleSides& sides,
                    const Eigen::Vector3d& lambda) {
  PlateRows rows = curvature_rows<3>(slope);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Eigen::Vector2d g = 4.0 * (lambda[i] * slope.col(j) + lambda[j] * slope.col(i));
    rows.noalias() += side_curvature(sides.side[i], g) * sides.bulge[i];
  }
  return rows;
}

Eigen::Matrix<double, 2, 3> area_coordinate_slopes(const Corners& corner, double area) {
  Eigen::Matrix<double, 2, 3> slope;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d d = corner.col((i + 2) % 3) - corner.col((i + 1) % 3);
    slope.col(i) = Eigen::Vector2d(-d.y(), d.x()) / (2.0 * area);
  }
  return slope;
}

constexpr std::array<int, 9> in_plane{0, 1, 5, 6, 7, 11, 12, 13, 17}, across{2, 3, 4, 8, 9, 10, 14, 15, 16};

}  // namespace

Eigen::Matrix<double, 6, 18> triangle_resultants(const ShellGeometry<3>& geometry, const ShellSection& section) {
  const TriangleSides sides = triangle_sides(geometry.corner, section);
  const Eigen::Matrix<double, 2, 3> slope = area_coordinate_slopes(geometry.corner, geometry.area);
  const MembraneRows epsilon = basic_strain(geometry.corner, geometry.area);
  const PlateRows kappa = curvature(slope, sides, Eigen::Vector3d::Constant(1.0 / 3.0));
  Eigen::Matrix<double, 6, 18> rows;
  rows(Eigen::seqN(0, 3), in_plane) = section.A * epsilon;
  rows(Eigen::seqN(3, 3), in_plane) = section.B * epsilon;
  rows(Eigen::seqN(0, 3), across) = section.B * kappa;
  rows(Eigen::seqN(3, 3), across) = section.D * kappa;
  return rows;
}

TriangleMatrix triangle_stiffness(const ShellGeometry<3>& geometry, const ShellSection& section) {
  const Corners& corner = geometry.corner;
  const double area = geometry.area;
  const TriangleSides sides = triangle_sides(corner, section);
  const std::array<Eigen::Matrix<double, 2, 9>, 3> shear = corner_shear(sides);
  const Eigen::Matrix<double, 2, 3> slope = area_coordinate_slopes(corner, area);
  const MembraneRows epsilon = basic_strain(corner, area);
  Eigen::Matrix<double, 9, 9> membrane = higher_stiffness(corner, area, section.A);
  membrane.noalias() += epsilon.transpose() * (area * section.A * epsilon);
  Eigen::Matrix<double, 9, 9> plate = Eigen::Matrix<double, 9, 9>::Zero(), coupling = plate;
  for (int point = 0; point < 3; ++point) {  // degree 2: exact for the curvatures
    Eigen::Vector3d lambda = Eigen::Vector3d::Constant(1.0 / 6.0);
    lambda[point] = 2.0 / 3.0;
    const PlateRows kappa = curvature(slope, sides, lambda);
    const Eigen::Matrix<double, 2, 9> gamma = lambda[0] * shear[0] + lambda[1] * shear[1] + lambda[2] * shear[2];
    const double dA = area / 3.0;
    plate.noalias() += kappa.transpose() * (dA * section.D * kappa) + gamma.transpose() * (dA * section.As * gamma);
    coupling.noalias() += epsilon.transpose() * (dA * section.B * kappa);
  }
  TriangleMatrix K;
  K(in_plane, in_plane) = membrane;
  K(across, across) = plate;
  K(in_plane, across) = coupling;
  K(across, in_plane) = coupling.transpose();
  return K;
}

}  // namespace tisserand::reducer
