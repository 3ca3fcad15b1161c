// Joints between two markers: constraints Φ, their Jacobian B, the bias of Φ̈ and the geometric stiffness of the
// reactions.
#pragma once

#include <string>

#include <Eigen/Core>

#include "formats/scene.hpp"
#include "mechanism/marker.hpp"
#include "mechanism/motion.hpp"

namespace tisserand::mechanism {

/// Equations of a joint from marker A to marker B. Translations (always): Φ = x_B − x_A, world axes. Rotations: Φ = a·b
/// for pairs of unit vectors a of A, b of B that stay normal to each other (revolute 2: x_A·z_B, y_A·z_B; fixed 3:
/// x_A·y_B, y_A·z_B, z_A·x_B).
using formats::JointKind;

struct Joint {
  std::string name;
  JointKind kind = JointKind::spherical;
  Marker a;
  Marker b;
  int row = 0;     ///< first multiplier
  int hinge = -1;  ///< index of the unwrapped angle (revolute)
};

/// Number of equations: 6, 5 or 3.
int joint_size(JointKind kind);

/// Name of one equation for messages, e.g. "translation x" or "z of B normal to x of A".
std::string joint_equation_name(JointKind kind, int equation);

/// Values of one joint; the first joint_size rows count. Columns of B: [x_A Θ_A x_B Θ_B] (material rotations).
struct JointTerms {
  Eigen::Matrix<double, 6, 1> phi;
  Eigen::Matrix<double, 6, 12> B;
  Eigen::Matrix<double, 6, 1> bias;  ///< Ḃ v: Φ̈ = B v̇ + bias
};

/// Φ and B.
void joint_constraints(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms);

/// Ḃ v.
void joint_bias(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms);

/// ∂(B v)/∂(x_A Θ_A x_B Θ_B) at fixed ẋ and Ω; the first joint_size rows count.
void joint_rate_gradient(const Joint& joint, const NodeMotion& a, const NodeMotion& b, Eigen::Matrix<double, 6, 12>& N);

/// ∂(Bᵀλ)/∂(x_A Θ_A x_B Θ_B), not symmetric with material increments.
void joint_stiffness(const Joint& joint, const NodeMotion& a, const NodeMotion& b, const double* lambda,
                     Eigen::Matrix<double, 12, 12>& K);

/// What A's body exerts on B's body, at B's origin, in A's axes.
struct JointReaction {
  Eigen::Vector3d force;
  Eigen::Vector3d moment;
};
JointReaction joint_reaction(const Joint& joint, const NodeMotion& a, const NodeMotion& b, const double* lambda);

/// Angle of B relative to A about z of A, right-handed, in (−π, π], and its rate (revolute).
double hinge_angle(const Joint& joint, const NodeMotion& a, const NodeMotion& b);
double hinge_rate(const Joint& joint, const NodeMotion& a, const NodeMotion& b);

}  // namespace tisserand::mechanism
