// SPDX-License-Identifier: GPL-3.0-or-later
// Consistent and lumped mass of shell elements.
#include "reducer/elements/shell/mass.hpp"

#include <array>
#include <cmath>

#include <Eigen/LU>

#include "common/math/rotation.hpp"
#include "reducer/elements/gauss.hpp"

namespace tisserand::reducer {
namespace {

/// Adds the bulge ½ b d × (θ_j − θ_i) of edge i → j, d = x_j − x_i; b is s(1−s) on the edge and zero on the others.
template <int Corners>
void add_bulge(const ShellGeometry<Corners>& geometry, int i, double b, ShellMassPoint<Corners>& point) {
  const int j = (i + 1) % Corners;
  Eigen::Vector3d d;
  d << geometry.corner.col(j) - geometry.corner.col(i), geometry.height[j] - geometry.height[i];
  point.bulge.col(i) -= 0.5 * b * d;
  point.bulge.col(j) += 0.5 * b * d;
}

}  // namespace

/// Mass points of quadrilaterals: 3 x 3, degree 5 in either direction.
std::array<ShellMassPoint<4>, 9> shell_mass_points(const ShellGeometry<4>& geometry) {
  std::array<ShellMassPoint<4>, 9> points;
  Eigen::Matrix<double, 3, 4> X;
  X << geometry.corner, geometry.height.transpose();
  std::size_t k = 0;
  for (const GaussPoint& a : gauss3)
    for (const GaussPoint& b : gauss3) {
      ShellMassPoint<4>& point = points[k++];
      const BilinearShape shape = bilinear_shape(a.at, b.at);
      const Eigen::Matrix<double, 2, 3> tangent = shape.slope * X.transpose();
      point.N = shape.N;
      point.dA = a.weight * b.weight * std::sqrt((tangent * tangent.transpose()).determinant());
      const double along_xi = 0.25 * (1.0 - a.at * a.at), along_eta = 0.25 * (1.0 - b.at * b.at);
      add_bulge<4>(geometry, 0, along_xi * 0.5 * (1.0 - b.at), point);
      add_bulge<4>(geometry, 1, along_eta * 0.5 * (1.0 + a.at), point);
      add_bulge<4>(geometry, 2, along_xi * 0.5 * (1.0 + b.at), point);
      add_bulge<4>(geometry, 3, along_eta * 0.5 * (1.0 - a.at), point);
    }
  return points;
}

/// Mass points of triangles: six, exact to degree 4 ([Cow73]).
std::array<ShellMassPoint<3>, 6> shell_mass_points(const ShellGeometry<3>& geometry) {
  struct Orbit {
    double weight, near, far;
  };
  constexpr std::array<Orbit, 2> orbits{{{0.223381589678011, 0.445948490915965, 0.108103018168070},
                                         {0.109951743655322, 0.091576213509771, 0.816847572980459}}};
  std::array<ShellMassPoint<3>, 6> points;
  std::size_t k = 0;
  for (const Orbit& orbit : orbits)
    for (int corner = 0; corner < 3; ++corner) {
      ShellMassPoint<3>& point = points[k++];
      point.N.setConstant(orbit.near);
      point.N[corner] = orbit.far;
      point.dA = orbit.weight * geometry.area;
      for (int i = 0; i < 3; ++i) add_bulge<3>(geometry, i, point.N[i] * point.N[(i + 1) % 3], point);
    }
  return points;
}

/// v = Σ N_i u_i + a_i × θ_i with the arm a_i = g_i − z N_i ẑ. So the blocks of corners i, j are ∫ρ [N_i N_j, N_i a_j×;
/// (N_j a_i×)ᵀ, (a_i·a_j) 1 − a_j a_iᵀ].
template <int Corners>
Eigen::Matrix<double, 6 * Corners, 6 * Corners> consistent_shell_mass(const ShellGeometry<Corners>& geometry,
                                                                      const ShellSection& section) {
  using Row = Eigen::Matrix<double, 1, 3 * Corners>;
  const double m0 = section.mass, m1 = section.first_moment, m2 = section.rotary_inertia;
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  Eigen::Matrix<double, Corners, Corners> NN = Eigen::Matrix<double, Corners, Corners>::Zero();
  Eigen::Matrix<double, Corners, 3 * Corners> Ng = Eigen::Matrix<double, Corners, 3 * Corners>::Zero();
  Eigen::Matrix<double, 3 * Corners, 3 * Corners> gg = Eigen::Matrix<double, 3 * Corners, 3 * Corners>::Zero();
  for (const ShellMassPoint<Corners>& point : shell_mass_points(geometry)) {
    const Row g = Eigen::Map<const Row>(point.bulge.data());
    NN.noalias() += (point.dA * point.N) * point.N.transpose();
    Ng.noalias() += (point.dA * point.N) * g;
    gg.noalias() += (point.dA * g.transpose()) * g;
  }
  Eigen::Matrix<double, 6 * Corners, 6 * Corners> M = Eigen::Matrix<double, 6 * Corners, 6 * Corners>::Zero();
  for (int i = 0; i < Corners; ++i)
    for (int j = 0; j < Corners; ++j) {
      const Eigen::Vector3d Ni_gj = Ng.template block<1, 3>(i, 3 * j).transpose();
      const Eigen::Vector3d Nj_gi = Ng.template block<1, 3>(j, 3 * i).transpose();
      const Eigen::Matrix3d a_j_a_i = m0 * gg.template block<3, 3>(3 * j, 3 * i) -
                                      m1 * (Ni_gj * z.transpose() + z * Nj_gi.transpose()) +
                                      m2 * NN(i, j) * z * z.transpose();
      M.template block<3, 3>(6 * i, 6 * j).diagonal().setConstant(m0 * NN(i, j));
      M.template block<3, 3>(6 * i, 6 * j + 3) = skew<double>(m0 * Ni_gj - m1 * NN(i, j) * z);
      M.template block<3, 3>(6 * i + 3, 6 * j) = skew<double>(m0 * Nj_gi - m1 * NN(i, j) * z).transpose();
      M.template block<3, 3>(6 * i + 3, 6 * j + 3) = a_j_a_i.trace() * Eigen::Matrix3d::Identity() - a_j_a_i;
    }
  return M;
}

template <int Corners>
Eigen::Matrix<double, 6 * Corners, 6 * Corners> lumped_shell_mass(const ShellGeometry<Corners>& geometry,
                                                                  const ShellSection& section) {
  Eigen::Matrix<double, Corners, 1> share = Eigen::Matrix<double, Corners, 1>::Zero();
  for (const ShellMassPoint<Corners>& point : shell_mass_points(geometry)) share += point.dA * point.N;
  Eigen::Matrix<double, 6 * Corners, 6 * Corners> M = Eigen::Matrix<double, 6 * Corners, 6 * Corners>::Zero();
  for (int i = 0; i < Corners; ++i) {
    auto block = M.template block<6, 6>(6 * i, 6 * i);
    block.diagonal().template head<3>().setConstant(share[i] * section.mass);
    block.diagonal().template tail<3>().setConstant(share[i] * section.rotary_inertia);
    block(0, 4) = block(4, 0) = share[i] * section.first_moment;
    block(1, 3) = block(3, 1) = -share[i] * section.first_moment;
  }
  return M;
}

template Eigen::Matrix<double, 18, 18> consistent_shell_mass<3>(const ShellGeometry<3>&, const ShellSection&);
template Eigen::Matrix<double, 24, 24> consistent_shell_mass<4>(const ShellGeometry<4>&, const ShellSection&);
template Eigen::Matrix<double, 18, 18> lumped_shell_mass<3>(const ShellGeometry<3>&, const ShellSection&);
template Eigen::Matrix<double, 24, 24> lumped_shell_mass<4>(const ShellGeometry<4>&, const ShellSection&);

}  // namespace tisserand::reducer
