// SPDX-License-Identifier: GPL-3.0-or-later
// Kinematics of one node at one instant, as every body, joint and load sees it, and the coefficients of tangents.
#pragma once

#include <Eigen/Core>

namespace tisserand::mechanism {

/// Position and orientation with their rates: x, ẋ, ẍ in world axes; R = R_WN; Ω, Ω̇ material (node axes).
struct NodeMotion {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d xd = Eigen::Vector3d::Zero();
  Eigen::Vector3d Omega = Eigen::Vector3d::Zero();
  Eigen::Vector3d xdd = Eigen::Vector3d::Zero();
  Eigen::Vector3d Omegad = Eigen::Vector3d::Zero();
};

/// The combination c_m ∂r/∂v̇ + c_c ∂r/∂v + c_k ∂r/∂q that an analysis asks for (material rotation increments).
struct TangentCoefficients {
  double mass = 0.0;
  double damping = 0.0;
  double stiffness = 0.0;
  bool operator==(const TangentCoefficients&) const = default;
};

/// step: the hand-written tangents of the time step (stiffness without the derivative of the projector);
/// exact: with dual numbers, for statics and linearisation.
enum class TangentKind { step, exact };

}  // namespace tisserand::mechanism
