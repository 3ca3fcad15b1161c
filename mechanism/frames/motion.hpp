// SPDX-License-Identifier: GPL-3.0-or-later
// Kinematics of one node at one instant, as every body, joint and load sees it, and the coefficients of tangents.
#pragma once

#include <Eigen/Core>

namespace tisserand::mechanism {

/// Motion of a node at one instant: x, ẋ, ẍ in world axes, the orientation R = R_WN, and material Ω, Ω̇ (axes of the
/// node).
struct NodeMotion {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d xd = Eigen::Vector3d::Zero();
  Eigen::Vector3d Omega = Eigen::Vector3d::Zero();
  Eigen::Vector3d xdd = Eigen::Vector3d::Zero();
  Eigen::Vector3d Omegad = Eigen::Vector3d::Zero();
};

/// Coefficients c_m (`mass`), c_c (`damping`) and c_k (`stiffness`) of the tangent c_m ∂r/∂v̇ + c_c ∂r/∂v + c_k ∂r/∂q
/// that an analysis needs, with material rotation increments.
struct TangentCoefficients {
  double mass = 0.0;
  double damping = 0.0;
  double stiffness = 0.0;
  bool operator==(const TangentCoefficients&) const = default;
};

/// Kind of tangent. `step`: hand-written for the time step, stiffness without the derivative of Υ, THEORY (20).
/// `exact`: by dual numbers, for statics and linearisation.
enum class TangentKind { step, exact };

}  // namespace tisserand::mechanism
