// SPDX-License-Identifier: GPL-3.0-or-later
// Bushing: elastic and damped connection of two markers in all directions, for rotations of any size.
#pragma once

#include <string>

#include <Eigen/Core>

#include "mechanism/joints/relation.hpp"

namespace tisserand::mechanism {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector12d = Eigen::Matrix<double, 12, 1>;

/// Constants of a bushing, an elastic and damped connection of markers A and B. Its deflection is d = [p; ψ], with p =
/// R_Aᵀ(x_B − x_A) and the angles ψ of R_AᵀR_B (relative_turn.hpp), from origins and axes of the markers. The law is w
/// = K (d − free) + D ḋ − preload with K = `stiffness`, D = `damping`. The virtual work of its forces is −w·δd, a
/// moment Bᵀ w_ψ about the axes of B, since δψ = B δΘ_AB. If K = Kᵀ, w derives from V = ½(d − free)ᵀK(d − free) −
/// preload·(d − free). Translations are in axes of A, so A and B can be exchanged only for small rotations.
struct Bushing {
  std::string name;
  Marker a;
  Marker b;
  Matrix6d stiffness = Matrix6d::Zero();
  Matrix6d damping = Matrix6d::Zero();
  Vector6d free = Vector6d::Zero();
  bool free_at_start = false;  ///< `free` is the deflection at the start
  Vector6d preload = Vector6d::Zero();
  int axis = -1;          ///< axis about which turns are counted; −1: |ψ| ≤ π
  int coordinate = -1;    ///< index in Model::coordinates of the angle about `axis`
  bool rotations = true;  ///< false: only p has forces
};

/// Values of a bushing at one instant, for the deflection d and the law w of Bushing. Columns of J and rows of `force`
/// are [x_A Θ_A x_B Θ_B]: world translations and material rotations.
struct BushingTerms {
  Vector6d deflection;
  Eigen::Matrix<double, 6, 12> J;  ///< δd = J δq, ḋ = J v
  Vector6d w;
  Vector12d force;          ///< Jᵀ w: contribution to the residual
  double energy = 0.0;      ///< energy V with the symmetric part of K
  double dissipated = 0.0;  ///< dissipated power ḋᵀD ḋ
  double supplied = 0.0;    ///< power of the antisymmetric part of K: −ḋᵀ ½(K − Kᵀ)(d − free)
};
/// Computes the values of a bushing. `near`: with an axis, an angle from which the turn about it differs by less than
/// half a turn.
void evaluate(const Bushing& bushing, const MarkerPair& pair, double near, BushingTerms& terms);

/// Computes the exact tangent A = c_c ∂(Jᵀw)/∂v + c_k ∂(Jᵀw)/∂q of the force Jᵀw. Requires `terms` at the same state.
void tangent(const Bushing& bushing, const MarkerPair& pair, const BushingTerms& terms,
             const TangentCoefficients& coefficients, Square12& A);

}  // namespace tisserand::mechanism
