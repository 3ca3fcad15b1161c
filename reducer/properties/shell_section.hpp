// SPDX-License-Identifier: GPL-3.0-or-later
// Section of a shell: resultants per unit length from membrane strain, curvature and shear strain.
#pragma once

#include <Eigen/Core>

namespace tisserand::reducer {

/// Section of a shell: stiffness, mass and thickness per area. The resultants per unit length in the axes of the
/// laminate are [N; M; Q] = [A B 0; B D 0; 0 0 As] [ε; κ; γ], with engineering shear strains. z counts from the middle
/// surface along the normal. B is ∫ z C dz with the plane-stress stiffness C of the layers.
struct ShellSection {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();   ///< membrane stiffness: force / length
  Eigen::Matrix3d B = Eigen::Matrix3d::Zero();   ///< coupling of membrane and bending: force
  Eigen::Matrix3d D = Eigen::Matrix3d::Zero();   ///< bending stiffness: force · length
  Eigen::Matrix2d As = Eigen::Matrix2d::Zero();  ///< transverse shear (γxz, γyz), correction included: force / length
  double mass = 0.0;                             ///< mass per area ∫ ρ dz: mass / length²
  double first_moment = 0.0;                     ///< first moment ∫ ρ z dz per area: mass / length
  double rotary_inertia = 0.0;                   ///< rotary inertia ∫ ρ z² dz per area: mass
  double thickness = 0.0;                        ///< thickness, for messages and pictures
};

}  // namespace tisserand::reducer
