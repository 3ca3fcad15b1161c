// SPDX-License-Identifier: GPL-3.0-or-later
// Coulomb friction in a joint, driven by its own reactions and smooth in the sliding velocity.
#pragma once

#include <Eigen/Core>

#include "mechanism/joints/joint.hpp"

namespace tisserand::mechanism {

/// Friction in a joint, THEORY (60): −N μ(|s|) s/|s| acts along the sliding velocity s of the contact (SlipKind). The
/// normal force is N = |f| + 2|m|/arm of the components of the reaction that press the surfaces together (Pressing). By
/// THEORY (61), μ rises to the static coefficient at |s| = velocity (quadratic), falls to the kinetic one at 3 velocity
/// (cubic) and is constant beyond. A joint that should stick creeps at (1 − √(1 − F/(μ_s N))) velocity.
struct Friction {
  int joint = 0;             ///< index in Model::joints
  double kinetic = 0.0;      ///< coefficient μ
  double stiction = 0.0;     ///< coefficient μ_s ≥ μ
  double velocity = 0.0;     ///< [length/time]
  double radius = 0.0;       ///< radius of the contact surface; unused if the slip has no rotation
  double inverse_arm = 0.0;  ///< 1/distance of the two supports that take reaction moments; 0: moments do not count
  int thread = -1;           ///< for threaded joints: index in Model::couplings of z − lead × angle
  double lead = 0.0;         ///< for threaded joints: advance per radian [length]
};

/// Ratio μ(s)/s of THEORY (61) and its derivative.
struct FrictionLaw {
  double ratio = 0.0;
  double slope = 0.0;
};
FrictionLaw friction_law(const Friction& friction, double speed);

/// A joint with its Jacobian and multipliers at one instant; for threaded joints also those of the thread.
struct LoadedJoint {
  const Joint& joint;
  MarkerPair pair;
  const JointTerms& terms;
  const double* lambda;
  double thread_lambda = 0.0;
};

struct FrictionTerms {
  Eigen::Matrix<double, 12, 1> force = Eigen::Matrix<double, 12, 1>::Zero();  ///< contribution to the residual
  double normal = 0.0;
  double power = 0.0;  ///< dissipated, not negative
};
FrictionTerms evaluate(const Friction& friction, const LoadedJoint& loaded);

/// Tangent A = c_c ∂force/∂v + c_k ∂force/∂q, and ∂force/∂λ (first size() columns) with that of the thread; exact.
struct FrictionTangent {
  Square12 A;
  Eigen::Matrix<double, 12, 6> by_lambda;
  Eigen::Matrix<double, 12, 1> by_thread;
};
void tangent(const Friction& friction, const LoadedJoint& loaded, const TangentCoefficients& coefficients,
             FrictionTangent& result);

}  // namespace tisserand::mechanism
