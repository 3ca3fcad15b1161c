// SPDX-License-Identifier: GPL-3.0-or-later
// Mass points of a shell and their motion with the nodes.

#include <Eigen/Cholesky>

#include "common/math/rotation.hpp"
#include "reducer/elements/shell/geometry.hpp"
#include "reducer/elements/shell/mass.hpp"
#include "reducer/elements/shell/turn.hpp"
#include "reducer/elements/turning_mass.hpp"

namespace tisserand::reducer {
namespace {

/// Mass m per area of a section and inertia J about its centre of mass, which lies at c along the normal.
struct SectionMass {
  double mass = 0.0;
  double centre = 0.0;
  double inertia = 0.0;  ///< ∫ρ z² dz minus that of m at c
};

SectionMass section_mass(const ShellSection& section) {
  const double centre = section.mass != 0.0 ? section.first_moment / section.mass : 0.0;
  return {section.mass, centre, section.rotary_inertia - section.first_moment * centre};
}

template <int Corners>
struct ShellFrame {
  ShellGeometry<Corners> geometry;
  Eigen::Matrix3Xd corner;  ///< corners of the middle surface, part axes
  double offset = 0.0;

  Eigen::Vector3d normal() const { return geometry.R_PE.col(2); }
};

/// Mass point at Σ N_i of the corners, with bulges g_i (part axes).
template <int Corners>
MassPoint point_of(const ShellFrame<Corners>& shell, const Eigen::Matrix<double, Corners, 1>& N,
                   const Eigen::Matrix<double, 3, Corners>& bulge) {
  MassPoint point;
  point.displacement.setZero(3, 6 * Corners);
  point.rotation.setZero(3, 6 * Corners);
  for (int i = 0; i < Corners; ++i) {
    const Eigen::Vector3d arm = N[i] * shell.offset * shell.normal();  // u + θ × arm
    point.displacement.template middleCols<3>(6 * i) = N[i] * Eigen::Matrix3d::Identity();
    point.displacement.template middleCols<3>(6 * i + 3) =
        skew<double>(Eigen::Vector3d(bulge.col(i))) - skew<double>(arm);
    point.rotation.template middleCols<3>(6 * i + 3) = N[i] * Eigen::Matrix3d::Identity();
  }
  point.at = shell.corner * N;
  return point;
}

/// Adds J with Σ weight_ij θ_i θ_jᵀ of the corners as a sum of Corners squares.
template <int Corners>
void add_rotary(const Eigen::Matrix3d& J, const Eigen::Matrix<double, Corners, Corners>& weight, MovingMass& moving) {
  const Eigen::Matrix<double, Corners, Corners> L = weight.llt().matrixL();
  for (int q = 0; q < Corners; ++q) {
    ElementRows3 rotation = ElementRows3::Zero(3, 6 * Corners);
    for (int i = q; i < Corners; ++i)
      rotation.template middleCols<3>(6 * i + 3) = L(i, q) * Eigen::Matrix3d::Identity();
    moving.rotary.push_back({J, rotation});
  }
}

template <int Corners>
void add_consistent(const ShellFrame<Corners>& shell, const ShellSection& section, MovingMass& moving) {
  const SectionMass mass = section_mass(section);
  const Eigen::Vector3d z = shell.normal();
  const Eigen::Matrix3d J = mass.inertia * (Eigen::Matrix3d::Identity() - z * z.transpose());
  Eigen::Matrix<double, Corners, Corners> NN = Eigen::Matrix<double, Corners, Corners>::Zero();
  for (const ShellMassPoint<Corners>& from : shell_mass_points(shell.geometry)) {
    MassPoint point = point_of<Corners>(shell, from.N, shell.geometry.R_PE * from.bulge);
    point.mass = from.dA * mass.mass;
    point.centre = mass.centre * z;
    point.inertia = from.dA * J;
    NN += from.dA * from.N * from.N.transpose();
    moving.points.push_back(point);
  }
  add_rotary<Corners>(J, NN, moving);
}

/// Adds equal rotary inertia about all axes at the nodes (lumped_shell_mass()).
template <int Corners>
void add_lumped(const ShellFrame<Corners>& shell, const ShellSection& section, MovingMass& moving) {
  const SectionMass mass = section_mass(section);
  const Eigen::Vector3d z = shell.normal();
  const Eigen::Matrix3d J = section.rotary_inertia * Eigen::Matrix3d::Identity() -
                            (section.rotary_inertia - mass.inertia) * (Eigen::Matrix3d::Identity() - z * z.transpose());
  Eigen::Matrix<double, Corners, 1> share = Eigen::Matrix<double, Corners, 1>::Zero();
  for (const ShellMassPoint<Corners>& from : shell_mass_points(shell.geometry)) share += from.dA * from.N;
  for (int i = 0; i < Corners; ++i) {
    MassPoint point =
        point_of<Corners>(shell, Eigen::Matrix<double, Corners, 1>::Unit(i), Eigen::Matrix<double, 3, Corners>::Zero());
    point.mass = share[i] * mass.mass;
    point.centre = mass.centre * z;
    point.inertia = share[i] * J;
    moving.points.push_back(point);
  }
  add_rotary<Corners>(J, share.asDiagonal(), moving);
}

template <int Corners>
MovingMass mass_of(const Mesh& mesh, const ShellElement& shell) {
  const ShellProperty& property = mesh.shell_properties[shell.property];
  ShellFrame<Corners> frame{shell_geometry<Corners>(mesh, shell), Eigen::Matrix3Xd(3, Corners), shell.offset};
  MovingMass moving;
  moving.coordinates = 6 * Corners;
  moving.nodes.resize(3, Corners);
  for (int i = 0; i < Corners; ++i) moving.nodes.col(i) = mesh.position.col(shell.nodes[i]);
  moving.arms = (shell.offset * frame.normal()).replicate(1, Corners);
  frame.corner = moving.nodes + moving.arms;
  moving.turn = shell_turn<Corners>(frame.geometry, shell.offset);
  if (property.mass_matrix == formats::MassMatrix::consistent)
    add_consistent(frame, property.section, moving);
  else
    add_lumped(frame, property.section, moving);
  return moving;
}

}  // namespace

MovingMass moving_mass(const Mesh& mesh, const ShellElement& shell) {
  return shell.corners() == 3 ? mass_of<3>(mesh, shell) : mass_of<4>(mesh, shell);
}

}  // namespace tisserand::reducer
