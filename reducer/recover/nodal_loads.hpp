// SPDX-License-Identifier: GPL-3.0-or-later
// Forces on the nodes of the unreduced part at one instant, whose static answer is the recovered displacement.
#pragma once

#include <Eigen/Core>

#include "reducer/recover/motion.hpp"

namespace tisserand::reducer {

/// [force; moment] of each node (6 x nodes).
using NodeForces = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Forces on the nodes of the unreduced part whose static answer is the recovered displacement. They are in axes of
/// the part as in its mesh file, also for a mirrored body, and in units of the recovery file. Their sum is the
/// stiffness of the part times the recovered displacement, so force and moment cancel. With e the coordinates
/// BodyMotion::y_strain and f the load factors, the three contributions are
///
///     boundary     S̄ e of the boundary coordinates, minus the work of the others on the boundary shapes
///     frame        weight and inertia of the moving frame: the loads of RecoveryLoads times f
///     deformation  S_II φ (e − share f/ω²): inertia of the deformation, and load cases, as far as internal
///                  coordinates represent them
struct NodalLoads {
  NodeForces boundary;            ///< forces on the boundary nodes (6 x boundary nodes)
  NodeForces frame, deformation;  ///< forces on the nodes of the mesh (6 x nodes)
};

/// Nodal loads of the instant `instant` of `motion`. Requires that require_nodal_loads() has accepted the files.
NodalLoads nodal_loads(const formats::RecoveryReader& file, const BodyMotion& motion, Eigen::Index instant);

/// Throws Error if nodal loads cannot be computed. The body must not be modal, and the results must hold the motion of
/// the floating frame. The recovery file must hold forces on nodes, which files before version 1.2 and of method
/// macneal lack.
void require_nodal_loads(const formats::RecoveryReader& file, const MotionReader& motion);

/// Balance of the nodal loads: resultants about the origin of the part, the relative error of their equilibrium, and
/// the comparison with the boundary forces of the run.
struct LoadBalance {
  Eigen::Matrix<double, 6, 1> boundary, frame, deformation,
      sum;  ///< resultant [force; moment] of each contribution, and of all
  double force_error = 0.0,
         moment_error = 0.0;  ///< |sum| of forces over the sum of all |forces|, and |sum| of moments over the sum of
                              ///< all |moments|
  /// Largest difference of boundary forces from those of the run; largest boundary force of the run.
  double differs = 0.0, largest = 0.0;
  bool compared = false;  ///< true if the results contain the forces at the boundary nodes
};

LoadBalance load_balance(const formats::Recovery& recovery, const NodalLoads& loads);

/// Compares the boundary forces of `loads` (not moments) with /superelements/boundary_force of the run, and sets
/// `differs`, `largest` and `compared` of `balance`. `motion`: motion at the one instant `instant` of `reader`.
/// `compared` stays false if the results lack these forces.
void compare_with_run(const MotionReader& reader, const BodyMotion& motion, Eigen::Index instant,
                      const NodalLoads& loads, LoadBalance& balance);

}  // namespace tisserand::reducer
