// Smooth stresses by superconvergent patch recovery: one polynomial around each corner, by least squares through the
// elements' stresses where these are most accurate.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"
#include "reducer/mesh_error/patches.hpp"

namespace tisserand::reducer {

/// Motions of the modes: 6 rows per node [translation; rotation], part axes.
class SmoothStress {
 public:
  /// [ZZ92a]: linear polynomials for first-order elements, quadratic ones for the others; terms that the points of a
  /// patch do not determine (a single layer of elements) are left out. Deterministic whatever the number of threads.
  SmoothStress(const Mesh& mesh, const Eigen::MatrixXd& motion);

  /// Stresses for energy_error(): [N; M; Q] at the corners of a shell in its axes, Q = div M of the polynomials; [xx
  /// yy zz xy yz zx] at all nodes of a solid.
  Eigen::MatrixXd of_shell(int shell) const;
  Eigen::MatrixXd of_solid(int solid) const;
  const ShellSurround& around(int shell) const { return surround_[shell]; }

  /// Stresses at the points from which the smooth ones are made, and the smooth ones there less these; 6 x (points ·
  /// modes), modes within a point. Elements as in StressPatch.
  Eigen::MatrixXd samples(int element) const;
  Eigen::MatrixXd scatter(int element) const;

 private:
  struct Polynomial {
    Eigen::Vector3d origin;
    Eigen::Matrix3d axes;  ///< columns: of shells with the normal last; of solids the part's
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

/// Motions of the nodes of an element, as element_matrices() has them.
Eigen::MatrixXd motion_of(const ShellElement& shell, const Eigen::MatrixXd& motion);
Eigen::MatrixXd motion_of(const SolidElement& solid, const Eigen::MatrixXd& motion);

}  // namespace tisserand::reducer
