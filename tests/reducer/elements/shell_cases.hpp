// SPDX-License-Identifier: GPL-3.0-or-later
// Single shell elements, patches and rigid motions that the laws of the shell elements are tried on.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/math/rotation.hpp"
#include "reducer/properties/laminate.hpp"
#include "tests/support/meshes/shell_grids.hpp"

namespace tisserand::reducer {

/// Four plies without any symmetry: A, B and D are full.
inline ShellSection skew_laminate() {
  const Ply ply{140e9, 10e9, 0.3, 5e9, 5e9, 3.5e9, 1600.0, 0.01, 0.0};
  std::vector<Ply> plies(4, ply);
  plies[1].angle = 0.5;
  plies[2].angle = 1.2;
  plies[3].angle = -0.3;
  plies[3].density = 2500.0;
  return laminate(plies, -0.02);
}

inline ShellSection steel(double thickness) { return isotropic_shell(2.1e11, 0.3, 7850.0, thickness, 5.0 / 6.0); }

/// One element with the given corners (columns).
inline Mesh one_shell(const Eigen::Matrix3Xd& corners, const ShellSection& section) {
  Mesh mesh;
  mesh.position = corners;
  mesh.shell_properties.push_back({section, formats::MassMatrix::consistent, "shell"});
  ShellElement shell;
  for (int i = 0; i < corners.cols(); ++i) shell.nodes[i] = i;
  mesh.shells.push_back(shell);
  for (int i = 0; i < corners.cols(); ++i) mesh.node_label.push_back("node " + std::to_string(i + 1));
  return mesh;
}

inline Eigen::Matrix3Xd square() {
  Eigen::Matrix3Xd X(3, 4);
  X << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  return X;
}
inline Eigen::Matrix3Xd distorted_quad() {
  Eigen::Matrix3Xd X(3, 4);
  X << 0.1, 1.2, 0.9, -0.1, -0.2, 0.1, 0.8, 1.1, 0, 0, 0, 0;
  return X;
}
inline Eigen::Matrix3Xd warped_quad() {
  Eigen::Matrix3Xd X = distorted_quad();
  X.row(2) << 0.1, -0.1, 0.15, -0.05;
  return X;
}
inline Eigen::Matrix3Xd triangle() {
  Eigen::Matrix3Xd X(3, 3);
  X << 0, 1.1, 0.3, 0.1, 0, 0.9, 0, 0, 0;
  return X;
}

/// Turned and moved so that nothing lies along an axis.
inline Eigen::Matrix3Xd somewhere(const Eigen::Matrix3Xd& X) {
  const Eigen::Matrix3d R = exp_so3<double>(Eigen::Vector3d(0.4, -0.9, 1.3));
  return (R * X).colwise() + Eigen::Vector3d(0.3, -0.2, 0.5);
}

/// Columns: unit translations, then rotations about the origin, six rows per node.
inline Eigen::MatrixXd rigid_motions(const Mesh& mesh) {
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(6 * mesh.nodes(), 6);
  for (int i = 0; i < mesh.nodes(); ++i) {
    R.block<6, 6>(6 * i, 0).setIdentity();
    R.block<3, 3>(6 * i, 3) = -skew<double>(Eigen::Vector3d(mesh.position.col(i)));
  }
  return R;
}

}  // namespace tisserand::reducer
