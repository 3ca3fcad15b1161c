// SPDX-License-Identifier: GPL-3.0-or-later
// Smooth stresses by superconvergent patch recovery: one polynomial around each corner, by least squares through the
// elements' stresses at their most accurate points.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"
#include "reducer/mesh_error/patches.hpp"

namespace tisserand::reducer {

/// Smooth stresses σ* of THEORY (92) for the motions of some modes, by superconvergent patch recovery.
class SmoothStress {
 public:
  /// Fits polynomials to the stresses around each corner [ZZ92a]: linear for first-order elements, quadratic for the
  /// others. Terms that the points of a patch do not determine (single layer of elements) are omitted. The result is
  /// equal for any number of threads. `motion`: modes (6 rows per node [translation; rotation] in part axes, one
  /// column per mode).
  SmoothStress(const Mesh& mesh, const Eigen::MatrixXd& motion);

  /// Smooth stresses of one shell at its corners, for energy_error(): [N; M; Q] in the axes of the shell, where Q is
  /// div M of the polynomials. of_solid() gives those of one solid at all nodes: [xx yy zz xy yz zx].
  Eigen::MatrixXd of_shell(int shell) const;
  Eigen::MatrixXd of_solid(int solid) const;
  const ShellSurround& around(int shell) const { return surround_[shell]; }

  /// Stresses of an element at its sample points (6 x (points · modes), the modes of one point side by side).
  /// scatter() gives the smooth stresses at the points minus the sampled ones. Elements are numbered as in
  /// StressPatch.
  Eigen::MatrixXd samples(int element) const;
  Eigen::MatrixXd scatter(int element) const;

 private:
  struct Polynomial {
    Eigen::Vector3d origin;
    Eigen::Matrix3d axes;  ///< columns; shells: normal last; solids: axes of the part
    double size = 1.0;
    Eigen::MatrixXd coefficient;  ///< coefficients of the polynomials of all stresses: terms x (6 · modes)
  };
  Polynomial fit(const StressPatch& patch) const;
  Eigen::MatrixXd at(int patch, const Eigen::Vector3d& place) const;

  const Mesh& mesh_;
  Eigen::Index modes_;
  StressPatches patches_;
  std::vector<ShellSurround> surround_;
  std::vector<Eigen::Matrix3d> axes_;  ///< axes R_PE of the shells
  std::vector<Eigen::Matrix3Xd> place_;
  std::vector<Eigen::MatrixXd> sample_;  ///< sampled stresses of each element: points x (6 · modes)
  std::vector<Polynomial> polynomial_;
};

/// Motions of the nodes of one element, with the rows of element_matrices(). `motion`: motions of all nodes (6 rows
/// per node).
Eigen::MatrixXd motion_of(const ShellElement& shell, const Eigen::MatrixXd& motion);
Eigen::MatrixXd motion_of(const SolidElement& solid, const Eigen::MatrixXd& motion);

}  // namespace tisserand::reducer
