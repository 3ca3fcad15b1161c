// SPDX-License-Identifier: GPL-3.0-or-later
// Coulomb friction in a joint, driven by its own reactions and smooth in the sliding velocity.
#pragma once

#include <Eigen/Core>

#include "mechanism/joints/joint.hpp"

namespace tisserand::mechanism {

/// Friction in a joint, THEORY (60): the force −N μ(|s|) s/|s| acts along the sliding velocity s of the contact
/// (SlipKind). The normal force is N = |f| + 2|m|/arm. f and m are the components of the reaction that press the
/// surfaces together (Pressing). By THEORY (61), μ rises to `stiction` at |s| = `velocity` (quadratic), falls to
/// `kinetic` at 3 `velocity` (cubic) and is constant beyond. A joint that should stick under the force F creeps at
/// (1 − √(1 − F/(μ_s N))) `velocity`.
struct Friction {
  int joint = 0;             ///< index in Model::joints
  double kinetic = 0.0;      ///< kinetic coefficient μ_k
  double stiction = 0.0;     ///< static coefficient μ_s ≥ μ_k
  double velocity = 0.0;     ///< friction velocity [length/time]
  double radius = 0.0;       ///< radius of the contact surface; unused if the slip has no rotation
  double inverse_arm = 0.0;  ///< 1/arm of the two supports; 0: moments do not count
  int thread = -1;           ///< for threaded joints: index in Model::couplings of z − lead × angle
  double lead = 0.0;         ///< for threaded joints: advance per radian [length]
};

/// Friction coefficient over sliding speed, μ(s)/s of THEORY (61) (`ratio`), and its derivative by s (`slope`).
struct FrictionLaw {
  double ratio = 0.0;
  double slope = 0.0;
};
FrictionLaw friction_law(const Friction& friction, double speed);

/// Joint with its Jacobian and multipliers at one instant. `thread_lambda`: multiplier of the coupling of a threaded
/// joint.
struct LoadedJoint {
  const Joint& joint;
  MarkerPair pair;
  const JointTerms& terms;
  const double* lambda;
  double thread_lambda = 0.0;
};

/// Friction of one joint at one instant: its force on [x_A Θ_A x_B Θ_B], the normal force N, and the dissipated power.
struct FrictionTerms {
  Eigen::Matrix<double, 12, 1> force = Eigen::Matrix<double, 12, 1>::Zero();  ///< contribution to the residual
  double normal = 0.0;
  double power = 0.0;  ///< dissipated power, not negative
};
FrictionTerms evaluate(const Friction& friction, const LoadedJoint& loaded);

/// Exact tangent of friction: A = c_c ∂force/∂v + c_k ∂force/∂q, and ∂force/∂λ. `by_lambda` has the multipliers of the
/// joint (first size() columns), `by_thread` that of the thread.
struct FrictionTangent {
  Square12 A;
  Eigen::Matrix<double, 12, 6> by_lambda;
  Eigen::Matrix<double, 12, 1> by_thread;
};
void tangent(const Friction& friction, const LoadedJoint& loaded, const TangentCoefficients& coefficients,
             FrictionTangent& result);

}  // namespace tisserand::mechanism
