// SPDX-License-Identifier: GPL-3.0-or-later
// Smooth stresses by superconvergent patch recovery: one polynomial around each corner, by least squares through the
// elements' stresses at their most accurate points.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"
#include "reducer/mesh_error/patches.hpp"

namespace tisserand::reducer {

/// Smooth stresses for motions of the modes (6 rows per node [translation; rotation], part axes).
class SmoothStress {
 public:
  /// Fits polynomials [ZZ92a]: linear for first-order elements, quadratic for the others. Terms that the points of a
  /// patch do not determine (single layer of elements) are omitted. The result is the same for any number of threads.
  SmoothStress(const Mesh& mesh, const Eigen::MatrixXd& motion);

  /// Stresses for energy_error(). Shell: [N; M; Q] at the corners in its axes, Q = div M of the polynomials. Solid: [xx
  /// yy zz xy yz zx] at all nodes.
  Eigen::MatrixXd of_shell(int shell) const;
  Eigen::MatrixXd of_solid(int solid) const;
  const ShellSurround& around(int shell) const { return surround_[shell]; }

  /// Stresses at the sample points, and the smooth ones there minus these; 6 x (points · modes), modes within a point.
  /// Elements as in StressPatch.
  Eigen::MatrixXd samples(int element) const;
  Eigen::MatrixXd scatter(int element) const;

 private:
  struct Polynomial {
    Eigen::Vector3d origin;
    Eigen::Matrix3d axes;  ///< columns; shells: normal last; solids: axes of the part
    double size = 1.0;
    Eigen::MatrixXd coefficient;  ///< terms x (6 · modes)
  };
  Polynomial fit(const StressPatch& patch) const;
  Eigen::MatrixXd at(int patch, const Eigen::Vector3d& place) const;

  const Mesh& mesh_;
  Eigen::Index modes_;
  StressPatches patches_;
  std::vector<ShellSurround> surround_;
  std::vector<Eigen::Matrix3d> axes_;  ///< R_PE of shells
  std::vector<Eigen::Matrix3Xd> place_;
  std::vector<Eigen::MatrixXd> sample_;  ///< points x (6 · modes)
  std::vector<Polynomial> polynomial_;
};

/// Motions of the nodes of an element, with the rows of element_matrices().
Eigen::MatrixXd motion_of(const ShellElement& shell, const Eigen::MatrixXd& motion);
Eigen::MatrixXd motion_of(const SolidElement& solid, const Eigen::MatrixXd& motion);

}  // namespace tisserand::reducer
