// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices of the beam, its reduction by Craig-Bampton and its rearrangements.
#include "tests/support/bodies/beam_superelement.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace tisserand::test_support {

namespace {

using Eigen::Matrix4d;

/// Bending stiffness for (w1, θ1, w2, θ2) with θ = +dw/dx; φ = 12 E I/(G A_s L²): Przemieniecki 1968, section 5.6.
Matrix4d bending_stiffness(double EI, double L, double phi) {
  Matrix4d k;
  k << 12, 6 * L, -12, 6 * L,                               //
      6 * L, (4 + phi) * L * L, -6 * L, (2 - phi) * L * L,  //
      -12, -6 * L, 12, -6 * L,                              //
      6 * L, (2 - phi) * L * L, -6 * L, (4 + phi) * L * L;
  return EI / ((1 + phi) * L * L * L) * k;
}

/// ∫ ρA N Nᵀ + ρI N' N'ᵀ with Hermite cubics, for (w1, θ1, w2, θ2): Przemieniecki 1968, section 11.
Matrix4d bending_mass(double rho_A, double rho_I, double L) {
  Matrix4d translation, rotation;
  translation << 156, 22 * L, 54, -13 * L,    //
      22 * L, 4 * L * L, 13 * L, -3 * L * L,  //
      54, 13 * L, 156, -22 * L,               //
      -13 * L, -3 * L * L, -22 * L, 4 * L * L;
  rotation << 36, 3 * L, -36, 3 * L,     //
      3 * L, 4 * L * L, -3 * L, -L * L,  //
      -36, -3 * L, 36, -3 * L,           //
      3 * L, -L * L, -3 * L, 4 * L * L;
  return rho_A * L / 420 * translation + rho_I / (30 * L) * rotation;
}

}  // namespace

formats::Superelement beam_superelement(const BeamData& beam) {
  const double L = beam.length;
  formats::Superelement e;
  e.name = "beam";
  e.method = "guyan";
  e.producer = "analytic";
  e.units = Units::si();
  e.node_name = {"base", "tip"};
  e.node_position.setZero(2, 3);
  e.node_position(1, 0) = L;
  for (int node = 0; node < 2; ++node)
    for (int component = 0; component < 6; ++component) {
      e.dof_node.push_back(node);
      e.dof_component.push_back(component);
    }
  e.stiffness.setZero(12, 12);
  e.mass.setZero(12, 12);
  const auto phi = [&](double I, double shear_area) {
    return shear_area == 0.0 ? 0.0 : 12 * beam.young * I / (beam.shear_modulus * shear_area * L * L);
  };
  const Eigen::Matrix2d spring = (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
  const Eigen::Matrix2d bar = (Eigen::Matrix2d() << 2, 1, 1, 2).finished() / 6;
  const double polar = beam.density * (beam.Iy + beam.Iz), line = beam.density * beam.area;
  const double rotary = beam.rotary_inertia ? beam.density : 0.0;
  detail::scatter<2>(beam.young * beam.area / L * spring, {0, 6}, {1, 1}, e.stiffness);
  detail::scatter<2>(beam.shear_modulus * beam.J / L * spring, {3, 9}, {1, 1}, e.stiffness);
  detail::scatter<2>(line * L * bar, {0, 6}, {1, 1}, e.mass);
  detail::scatter<2>(polar * L * bar, {3, 9}, {1, 1}, e.mass);
  const std::array<int, 4> xy{1, 5, 7, 11}, xz{2, 4, 8, 10};
  const std::array<double, 4> plus{1, 1, 1, 1}, minus{1, -1, 1, -1};  // ry = −dw/dx
  detail::scatter<4>(bending_stiffness(beam.young * beam.Iz, L, phi(beam.Iz, beam.shear_area_y)), xy, plus,
                     e.stiffness);
  detail::scatter<4>(bending_stiffness(beam.young * beam.Iy, L, phi(beam.Iy, beam.shear_area_z)), xz, minus,
                     e.stiffness);
  detail::scatter<4>(bending_mass(line, rotary * beam.Iz, L), xy, plus, e.mass);
  detail::scatter<4>(bending_mass(line, rotary * beam.Iy, L), xz, minus, e.mass);
  return e;
}

formats::Superelement permute_rows(const formats::Superelement& element, const std::vector<int>& order) {
  formats::Superelement r = element;
  const auto n = static_cast<Eigen::Index>(order.size());
  r.dof_node.resize(order.size());
  r.dof_component.resize(order.size());
  r.stiffness.resize(n, n);
  r.mass.resize(n, n);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    r.dof_node[i] = element.dof_node[order[i]];
    r.dof_component[i] = element.dof_component[order[i]];
    for (std::size_t j = 0; j < order.size(); ++j) {
      const auto column = static_cast<Eigen::Index>(j);
      r.stiffness(row, column) = element.stiffness(order[i], order[j]);
      r.mass(row, column) = element.mass(order[i], order[j]);
    }
  }
  return r;
}

formats::Superelement permute_nodes(const formats::Superelement& element, const std::vector<int>& order) {
  formats::Superelement r = element;
  std::vector<int> new_index(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    new_index[order[i]] = static_cast<int>(i);
    r.node_name[i] = element.node_name[order[i]];
    r.node_position.row(i) = element.node_position.row(order[i]);
  }
  for (int& node : r.dof_node)
    if (node >= 0) node = new_index[node];
  return r;
}

formats::Superelement craig_bampton_beam(const BeamData& beam, int modes) {
  BeamData piece = beam;
  piece.length = beam.length / 4;
  const formats::Superelement element = beam_superelement(piece);
  const std::array<int, 5> first_row{0, 12, 18, 24, 6};  // base, three inner nodes, tip
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(30, 30), M = S;
  for (int k = 0; k < 4; ++k) {
    std::array<int, 12> rows{};
    for (int i = 0; i < 12; ++i) rows[i] = first_row[k + i / 6] + i % 6;
    std::array<double, 12> sign{};
    sign.fill(1.0);
    detail::scatter<12>(element.stiffness, rows, sign, S);
    detail::scatter<12>(element.mass, rows, sign, M);
  }
  const Eigen::MatrixXd S_II = S.bottomRightCorner(18, 18), M_II = M.bottomRightCorner(18, 18);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(S_II, M_II);
  Eigen::MatrixXd Phi = Eigen::MatrixXd::Zero(30, 12 + modes);
  Phi.topLeftCorner(12, 12).setIdentity();
  Phi.bottomLeftCorner(18, 12) = -S_II.ldlt().solve(S.bottomLeftCorner(18, 12));
  Phi.bottomRightCorner(18, modes) = eigen.eigenvectors().leftCols(modes);

  formats::Superelement r = beam_superelement(beam);
  r.method = "craig_bampton";
  for (int i = 0; i < modes; ++i) {
    r.dof_node.push_back(-1);
    r.dof_component.push_back(i);
  }
  r.stiffness = Phi.transpose() * S * Phi;
  r.mass = Phi.transpose() * M * Phi;
  r.stiffness = (0.5 * (r.stiffness + r.stiffness.transpose())).eval();
  r.mass = (0.5 * (r.mass + r.mass.transpose())).eval();
  r.stiffness.bottomLeftCorner(modes, 12).setZero();
  r.stiffness.topRightCorner(12, modes).setZero();
  r.stiffness.bottomRightCorner(modes, modes) = eigen.eigenvalues().head(modes).asDiagonal();
  r.mass.bottomRightCorner(modes, modes).setIdentity();
  return r;
}

}  // namespace tisserand::test_support
