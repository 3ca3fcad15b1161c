// SPDX-License-Identifier: GPL-3.0-or-later
// Forces on the nodes of the unreduced part at one instant, whose static answer is the recovered displacement.
#pragma once

#include <Eigen/Core>

#include "reducer/recover/motion.hpp"

namespace tisserand::reducer {

/// [force; moment] of each node.
using NodeForces = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Nodal loads in axes of the part as in its mesh file (also for a mirrored body), units of the recovery file. Their
/// sum is the stiffness of the part times the recovered displacement, so force and moment cancel:
///   boundary     S̄ e of the boundary coordinates, minus the work of the others on the boundary shapes
///   frame        weight and inertia of the moving frame: the twelve loads of RecoveryLoads times their factors
///   deformation  S_II φ (e − share f/ω²): inertia of the deformation, and load cases, as far as internal coordinates
///                represent them
struct NodalLoads {
  NodeForces boundary;            ///< boundary nodes
  NodeForces frame, deformation;  ///< nodes of the mesh
};

/// Loads of one instant. require_nodal_loads() must have accepted the files.
NodalLoads nodal_loads(const formats::RecoveryReader& file, const BodyMotion& motion, Eigen::Index instant);

/// Throws Error with the reason for a modal body, a file before version 1.2 or of method macneal, and results without
/// the motion of the frame.
void require_nodal_loads(const formats::RecoveryReader& file, const MotionReader& motion);

/// Resultants about the origin of the part, and the relative error of their equilibrium.
struct LoadBalance {
  Eigen::Matrix<double, 6, 1> boundary, frame, deformation, sum;  ///< [force; moment]
  double force_error = 0.0,
         moment_error = 0.0;            ///< |sum| over the sum of all |forces|, of all |moments|
  double differs = 0.0, largest = 0.0;  ///< of boundary forces from those of the run; largest of the run
  bool compared = false;                ///< the results contain the forces at the boundary nodes
};

LoadBalance load_balance(const formats::Recovery& recovery, const NodalLoads& loads);

/// Compares forces (not moments) with /superelements/boundary_force of the run. `motion`: instant number `instant` of
/// `reader` only. `compared` stays false if the results lack them.
void compare_with_run(const MotionReader& reader, const BodyMotion& motion, Eigen::Index instant,
                      const NodalLoads& loads, LoadBalance& balance);

}  // namespace tisserand::reducer
