// SPDX-License-Identifier: GPL-3.0-or-later
// Rotation of one marker relative to another in three angles by two laws, with the gradients that bushings need.
#pragma once

#include <Eigen/Core>

namespace tisserand::mechanism {

/// Three angles ψ of the rotation R = R_AB of one marker relative to another, by one of two laws. The rates are ψ̇ = B
/// ω with the relative angular velocity ω in axes of marker B.
/// Rotation vector (axis −1): ψ = log R, B = T⁻¹(ψ) of THEORY (4). It ends at half a turn.
/// Swing and twist about marker axis k: R = exp(τ/2 e_k) exp(σ) exp(τ/2 e_k) with σ ⟂ e_k, ψ = σ + τ e_k. With the
/// quaternion [w, v] of R, τ = 2 atan2(v_k, w), |σ| = 2 asin |v − v_k e_k|. τ is unbounded; the swing σ ends at half a
/// turn.
/// Both laws give the swing the direction of v − v_k e_k, treat markers A and B alike, and differ in terms of third
/// order.
class RelativeTurn {
 public:
  /// Computes the angles of R. `axis`: k, or −1 for the rotation vector. `near`: an angle from which the twist τ
  /// differs by less than half a turn.
  RelativeTurn(const Eigen::Matrix3d& R, int axis, double near);

  const Eigen::Vector3d& psi() const { return psi_; }
  /// Matrix B of ψ̇ = B ω.
  const Eigen::Matrix3d& B() const { return B_; }
  /// Derivative ∂(B ω)/∂Θ at fixed ω, with the material rotation Θ in axes of marker B.
  Eigen::Matrix3d rate_gradient(const Eigen::Vector3d& omega) const;
  /// Derivative ∂(Bᵀ w)/∂Θ at fixed w, with the material rotation Θ in axes of marker B.
  Eigen::Matrix3d moment_gradient(const Eigen::Vector3d& w) const;

 private:
  int axis_;
  Eigen::Vector4d q_;  ///< [w, v] of R, with the sign of cos(τ/2), sin(τ/2); swing and twist only
  Eigen::Vector3d psi_;
  Eigen::Matrix3d B_;
};

}  // namespace tisserand::mechanism
