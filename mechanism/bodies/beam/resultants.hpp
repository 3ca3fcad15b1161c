// SPDX-License-Identifier: GPL-3.0-or-later
// Stress resultants of beam elements from their strains, for any scalar (double, Dual, complex).
#pragma once

#include <cmath>

#include "common/math/rotation.hpp"
#include "mechanism/bodies/beam/element.hpp"

namespace tisserand::mechanism::beam {

/// Elongation e(Γ) of the bent axis of a two-node element, with first and second derivatives by the strains Γ. e = Q/D
/// + Σ β_k² Γ_k²/10 with Q = Σ (2β_k − β_k²) Γ_k², v = Γ + Γ₀ and D = |v| + v₁. The β_k are BeamElement::bending_share.
template <class S>
struct BentLength {
  S value;
  Vec3<S> gradient;

  BentLength() = default;
  BentLength(const BeamElement2& e, const Vec3<S>& gamma) : gamma_(gamma) {
    using std::sqrt;
    for (int k = 0; k < 3; ++k) {
      const double beta = e.bending_share[k];
      w_[k] = 2.0 * beta - beta * beta;
      b_[k] = 0.1 * beta * beta;
    }
    const Vec3<S> v = gamma + e.initial_gamma[0].template cast<S>();
    s_ = sqrt(dot3(v, v));
    direction_ = v * (1.0 / s_);
    inverse_ = 1.0 / (s_ + v[0]);
    p_ = gamma.cwiseProduct(w_.template cast<S>()) * S(2.0);
    d_ = direction_;
    d_[0] += 1.0;
    q_ = dot3(p_, gamma) * S(0.5);
    const Vec3<S> bent = gamma.cwiseProduct(b_.template cast<S>());
    value = q_ * inverse_ + dot3(bent, gamma);
    gradient = p_ * inverse_ - d_ * (q_ * inverse_ * inverse_) + bent * S(2.0);
  }

  Mat3<S> hessian() const {
    const S square = inverse_ * inverse_, curved = q_ * square / s_;
    const Vec3<S> half = d_ * (q_ * square * inverse_) - p_ * square;
    Mat3<S> H = half * d_.transpose() + d_ * half.transpose() + (direction_ * curved) * direction_.transpose();
    for (int k = 0; k < 3; ++k) H(k, k) += 2.0 * (w_[k] * inverse_ + b_[k]) - curved;
    return H;
  }

 private:
  Vec3<S> gamma_, direction_, p_, d_;
  Eigen::Vector3d w_, b_;
  S s_, inverse_, q_;
};

/// Section forces and strain energy per length, W/L = ½ (E A ε² + C_y Γ_y² + C_z Γ_z² + κ·C_m κ), with the axial strain
/// ε. `force` and `moment` are its derivatives by Γ and κ. `normal` is the normal force E A ε.
template <class S>
struct Resultants {
  Vec3<S> force, moment;
  S energy, normal;

  /// Computes the section forces from the strains `gamma` (Γ) and `kappa` (κ). `axial`: axial strain ε without the
  /// contribution of twist. `J`: derivative of `axial` by Γ.
  template <int N>
  Resultants(const BeamElement<N>& e, const Vec3<S>& gamma, const Vec3<S>& kappa, const S& axial, const Vec3<S>& J)
      : force(e.force_stiffness.template cast<S>().cwiseProduct(gamma)),
        moment(e.moment_stiffness.template cast<S>().cwiseProduct(kappa)) {
    const S strain = axial + kappa[0] * kappa[0] * S(0.5 * e.polar_radius_squared);
    normal = strain * S(e.force_stiffness[0]);
    energy = (normal * strain + force[1] * gamma[1] + force[2] * gamma[2] + dot3(kappa, moment)) * S(0.5);
    force[0] = S(0.0);
    force += J * normal;
    moment[0] += normal * kappa[0] * S(e.polar_radius_squared);
  }
};

}  // namespace tisserand::mechanism::beam
