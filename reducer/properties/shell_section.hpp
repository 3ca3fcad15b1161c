// SPDX-License-Identifier: GPL-3.0-or-later
// Section of a shell: resultants per unit length from membrane strain, curvature and shear strain.
#pragma once

#include <Eigen/Core>

namespace tisserand::reducer {

/// [N; M; Q] = [A B 0; B D 0; 0 0 As] [ε; κ; γ] in the axes of the laminate, per unit length, with engineering shear
/// strains. z counts from the middle surface along the normal; B = ∫ z Q dz.
struct ShellSection {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();   ///< force / length
  Eigen::Matrix3d B = Eigen::Matrix3d::Zero();   ///< force
  Eigen::Matrix3d D = Eigen::Matrix3d::Zero();   ///< force · length
  Eigen::Matrix2d As = Eigen::Matrix2d::Zero();  ///< transverse shear (γxz, γyz), correction included: force / length
  double mass = 0.0;                             ///< ∫ ρ dz: mass / length²
  double first_moment = 0.0;                     ///< ∫ ρ z dz: mass / length
  double rotary_inertia = 0.0;                   ///< ∫ ρ z² dz: mass
  double thickness = 0.0;                        ///< for messages and pictures
};

}  // namespace tisserand::reducer
