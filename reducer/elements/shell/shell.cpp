// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness and mass of shell elements in part axes about the nodes, for assembly.
#include <Eigen/Core>

#include "reducer/elements/element_matrices.hpp"
#include "reducer/elements/element_stress.hpp"
#include "reducer/elements/shell/geometry.hpp"
#include "reducer/elements/shell/mass.hpp"
#include "reducer/elements/shell/stiffness.hpp"

namespace tisserand::reducer {
namespace {

/// Moves the coordinates of each corner along the normal. The matrix belongs to points `arm[i]` above the new ones:
/// u_above = u + θ × arm ẑ = u + arm [θy, −θx, 0].
template <int Corners>
void move_along_normal(const Eigen::Matrix<double, Corners, 1>& arm,
                       Eigen::Matrix<double, 6 * Corners, 6 * Corners>& K) {
  for (int i = 0; i < Corners; ++i) {
    K.col(6 * i + 4) += arm[i] * K.col(6 * i);
    K.col(6 * i + 3) -= arm[i] * K.col(6 * i + 1);
  }
  for (int i = 0; i < Corners; ++i) {
    K.row(6 * i + 4) += arm[i] * K.row(6 * i);
    K.row(6 * i + 3) -= arm[i] * K.row(6 * i + 1);
  }
}

/// R K Rᵀ block by block. The upper triangle is computed and copied, so the result is exactly symmetric.
template <int Corners>
void turn(const Eigen::Matrix3d& R_PE, const Eigen::Matrix<double, 6 * Corners, 6 * Corners>& K, Eigen::MatrixXd& out) {
  out.resize(6 * Corners, 6 * Corners);
  for (int i = 0; i < 2 * Corners; ++i)
    for (int j = i; j < 2 * Corners; ++j) {
      const Eigen::Matrix3d half = K.template block<3, 3>(3 * i, 3 * j) * R_PE.transpose();
      out.block<3, 3>(3 * i, 3 * j).noalias() = R_PE * half;
    }
  for (int j = 0; j < 6 * Corners; ++j)
    for (int i = 0; i < j; ++i) out(j, i) = out(i, j);
}

Eigen::Matrix<double, 24, 24> local_stiffness(const ShellGeometry<4>& geometry, const ShellSection& section) {
  return quad_stiffness(geometry, section, usual_drilling);
}
Eigen::Matrix<double, 18, 18> local_stiffness(const ShellGeometry<3>& geometry, const ShellSection& section) {
  return triangle_stiffness(geometry, section);
}

Eigen::Matrix<double, 6, 24> local_resultants(const ShellGeometry<4>& geometry, const ShellSection& section) {
  return quad_resultants(geometry, section, Eigen::Vector2d::Zero());
}
Eigen::Matrix<double, 6, 18> local_resultants(const ShellGeometry<3>& geometry, const ShellSection& section) {
  return triangle_resultants(geometry, section);
}

template <int Corners>
void matrices(const Mesh& mesh, const ShellElement& shell, ElementMatrices& out) {
  using Arms = Eigen::Matrix<double, Corners, 1>;
  const ShellProperty& property = mesh.shell_properties[shell.property];
  const ShellGeometry<Corners> geometry = shell_geometry<Corners>(mesh, shell);
  Eigen::Matrix<double, 6 * Corners, 6 * Corners> K = shell_stiffness<Corners>(geometry, property.section);
  move_along_normal<Corners>(Arms(Arms::Constant(shell.offset) - geometry.height), K);
  turn<Corners>(geometry.R_PE, K, out.S);
  K = property.mass_matrix == formats::MassMatrix::consistent ? consistent_shell_mass(geometry, property.section)
                                                              : lumped_shell_mass(geometry, property.section);
  move_along_normal<Corners>(Arms::Constant(shell.offset), K);
  turn<Corners>(geometry.R_PE, K, out.M);
}

/// Stresses for the motions of the nodes in part axes; matrices() has the same transformations on its right side.
template <int Corners>
Eigen::Matrix<double, 6, Eigen::Dynamic> stress(const Mesh& mesh, const ShellElement& shell) {
  const ShellSection& section = mesh.shell_properties[shell.property].section;
  const ShellGeometry<Corners> geometry = shell_geometry<Corners>(mesh, shell);
  Eigen::Matrix<double, 6, 6 * Corners> rows = local_resultants(geometry, whole_section(section));
  if (section.A.isZero(0.0)) rows.template topRows<3>().setZero();
  if (section.D.isZero(0.0)) rows.template bottomRows<3>().setZero();
  const double t = section.thickness;
  rows.template topRows<3>() *= t > 0.0 ? 1.0 / t : 0.0;
  rows.template bottomRows<3>() *= t > 0.0 ? 6.0 / (t * t) : 0.0;
  for (int i = 0; i < Corners; ++i) {
    const double arm = shell.offset - geometry.height[i];
    rows.col(6 * i + 4) += arm * rows.col(6 * i);
    rows.col(6 * i + 3) -= arm * rows.col(6 * i + 1);
  }
  Eigen::Matrix<double, 6, Eigen::Dynamic> out(6, 6 * Corners);
  for (int k = 0; k < 2 * Corners; ++k)
    out.middleCols<3>(3 * k) = rows.template middleCols<3>(3 * k) * geometry.R_PE.transpose();
  return out;
}

}  // namespace

ShellSection whole_section(ShellSection section) {
  if (section.A.isZero(0.0)) section.A.setIdentity();
  if (section.D.isZero(0.0)) {
    section.D.setIdentity();
    section.As.setIdentity();
  }
  return section;
}

template <int Corners>
Eigen::Matrix<double, 6 * Corners, 6 * Corners> shell_stiffness(const ShellGeometry<Corners>& geometry,
                                                                const ShellSection& section) {
  const bool has_membrane = !section.A.isZero(0.0), has_bending = !section.D.isZero(0.0);
  if (has_membrane && has_bending) return local_stiffness(geometry, section);
  Eigen::Matrix<double, 6 * Corners, 6 * Corners> K = local_stiffness(geometry, whole_section(section));
  for (int i = 0; i < 6 * Corners; ++i) {
    const bool in_plane = i % 6 < 2 || i % 6 == 5;
    if (in_plane ? has_membrane : has_bending) continue;
    K.row(i).setZero();
    K.col(i).setZero();
  }
  return K;
}

template Eigen::Matrix<double, 18, 18> shell_stiffness<3>(const ShellGeometry<3>&, const ShellSection&);
template Eigen::Matrix<double, 24, 24> shell_stiffness<4>(const ShellGeometry<4>&, const ShellSection&);

Eigen::Matrix<double, 6, Eigen::Dynamic> shell_stress(const Mesh& mesh, const ShellElement& shell) {
  return shell.corners() == 3 ? stress<3>(mesh, shell) : stress<4>(mesh, shell);
}

void element_matrices(const Mesh& mesh, const ShellElement& shell, ElementMatrices& out) {
  if (shell.corners() == 3)
    matrices<3>(mesh, shell, out);
  else
    matrices<4>(mesh, shell, out);
}

}  // namespace tisserand::reducer
