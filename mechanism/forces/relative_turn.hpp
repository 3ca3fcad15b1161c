// SPDX-License-Identifier: GPL-3.0-or-later
// Rotation of one marker relative to another in three angles by two laws, with the gradients that bushings need.
#pragma once

#include <Eigen/Core>

namespace tisserand::mechanism {

/// Angles ψ of the rotation R = R_AB and their rates ψ̇ = B ω, ω in axes of B.
/// Rotation vector (axis −1): ψ = log R, B = T(ψ)⁻¹. It ends at half a turn.
/// Swing and twist about marker axis k: R = exp(τ/2 e_k) exp(σ) exp(τ/2 e_k) with σ ⟂ e_k, ψ = σ + τ e_k. As quaternion
/// [w, v]: τ = 2 atan2(v_k, w), |σ| = 2 asin |v − v_k e_k|. τ is unbounded; the swing ends at half a turn.
/// Both laws give σ the direction of v − v_k e_k, treat A and B alike, and differ in terms of third order.
class RelativeTurn {
 public:
  /// `near`: an angle from which τ differs by less than half a turn.
  RelativeTurn(const Eigen::Matrix3d& R, int axis, double near);

  const Eigen::Vector3d& psi() const { return psi_; }
  const Eigen::Matrix3d& B() const { return B_; }
  /// Derivative ∂(B ω)/∂Θ at fixed ω, Θ material in axes of B.
  Eigen::Matrix3d rate_gradient(const Eigen::Vector3d& omega) const;
  /// Derivative ∂(Bᵀ w)/∂Θ at fixed w.
  Eigen::Matrix3d moment_gradient(const Eigen::Vector3d& w) const;

 private:
  int axis_;
  Eigen::Vector4d q_;  ///< [w, v] of R, with the sign of cos(τ/2), sin(τ/2); swing and twist only
  Eigen::Vector3d psi_;
  Eigen::Matrix3d B_;
};

}  // namespace tisserand::mechanism
