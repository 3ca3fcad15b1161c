// SPDX-License-Identifier: GPL-3.0-or-later
// Stress resultants of beam elements from their strains, for any scalar (double, Dual, complex).
#pragma once

#include <cmath>

#include "common/math/rotation.hpp"
#include "mechanism/bodies/beam/element.hpp"

namespace tisserand::mechanism::beam {

/// Bent length e(Γ) of two nodes with its first and second derivatives (element.hpp). With Q = Σ w_k Γ_k², w = 2β − β²,
/// s = |v| and D = s + v₁ it is e = Q/D + Σ β_k² Γ_k²/10.
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

/// Energy W/L = ½ (E A ε² + C_y Γ_y² + C_z Γ_z² + κ·C_m κ) and its derivatives by Γ and κ.
template <class S>
struct Resultants {
  Vec3<S> force, moment;
  S energy, normal;

  /// `axial` and `J` are ε and ∂ε/∂Γ without the contribution of twist.
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
