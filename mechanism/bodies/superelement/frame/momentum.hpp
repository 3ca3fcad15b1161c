// SPDX-License-Identifier: GPL-3.0-or-later
// Exact motion of a superelement's centre of mass, for any scalar. Inertia option M uses it instead of the interpolated
// motion.
#pragma once

#include <cstddef>

#include "mechanism/bodies/superelement/frame/frame.hpp"
#include "mechanism/frames/space.hpp"

namespace tisserand::mechanism {

/// Derivative e' = de/ds of the factor e of T⁻¹(ψ), s = |ψ|², THEORY (5): (1/8 − 3e/2)/s + e²/2. Below s = 0.1 it is a
/// series, because the formula loses digits there.
template <class S>
S inverse_tangent_slope(const S& s, const S& e) {
  return real_part(s) < 0.1
             ? S(1.0 / 720 +
                 s * (1.0 / 15120 + s * (1.0 / 403200 + s * (1.0 / 11975040 + s * (691.0 / 261534873600.0 +
                                                                                   s * (6.0 / 74724249600.0))))))
             : S((0.125 - 1.5 * e) / s + 0.5 * e * e);
}

/// Rate d/dt T⁻¹(ψ) at the rate ψ̇ (`psid`), THEORY (5): ψ̇~/2 + e (ψ̇~ψ~ + ψ~ψ̇~) + 2 e' (ψ·ψ̇) ψ~². e is that of T⁻¹,
/// a function of s = |ψ|², and e' = de/ds.
template <class S>
Mat3<S> inverse_tangent_rate(const Vec3<S>& psi, const Vec3<S>& psid) {
  const S s = dot3<S>(psi, psi);
  const AngleFunctions<S> f(s);
  const S slope = inverse_tangent_slope<S>(s, f.e);
  const Mat3<S> P = skew<S>(psi), Pd = skew<S>(psid);
  return 0.5 * Pd + f.e * (Pd * P + P * Pd) + (2.0 * slope * dot3<S>(psi, psid)) * (P * P);
}

/// Part b = Ṫ⁻¹ Ω − Ṫ⁻ᵀ Ω₀ of ψ̈ without angular accelerations, THEORY (24). Only the first term of Ṫ⁻¹ is skew.
template <class S>
Vec3<S> turning_bias(const Vec3<S>& psi, const Vec3<S>& psid, const Vec3<S>& Omega, const Vec3<S>& Omega0) {
  const S s = dot3<S>(psi, psi);
  const AngleFunctions<S> f(s);
  const Vec3<S> relative = Omega - Omega0, turned = cross<S>(psi, relative);
  const S bend = 2.0 * inverse_tangent_slope<S>(s, f.e) * dot3<S>(psi, psid);
  return 0.5 * cross<S>(psid, Vec3<S>(Omega + Omega0)) +
         f.e * (cross<S>(psid, turned) + cross<S>(psi, cross<S>(psid, relative))) + bend * cross<S>(psi, turned);
}

/// Sets the rotation rows of ÿ_B to turning_bias() alone. In the plane it is zero. Requires deformation_rates().
template <int D, class S, class Node>
void turning_biases(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const int row = body.node[i].rotation_row;
    if (row < 0) continue;
    if constexpr (D == 2)
      motion.deformation_acceleration_B[row] = S(0.0);
    else
      motion.deformation_acceleration_B.template segment<3>(row) =
          turning_bias<S>(motion.node[i].psi, Vec3<S>(motion.deformation_rate_B.template segment<3>(row)),
                          nodes[i].Omega, motion.Omega0);
  }
}

/// Angular acceleration of the frame, Ω̇₀ = U q̈ + U̇ q̇, THEORY (25). By the second derivative of Σ αⱼ ψⱼ = 0, U̇ q̇
/// is Σ Uⱼ T(ψⱼ) (Ṫ⁻¹(ψⱼ) Ωⱼ − Ṫ⁻ᵀ(ψⱼ) Ω₀). For the polar frame U̇ q̇ is Σ U_xⱼ R₀ (−2 Ω₀ × u̇ⱼ − Ω₀ × (Ω₀ × x̂ⱼ)).
/// Requires turning_biases().
template <int D, class S, class Node>
auto frame_acceleration(const SuperelementBody& body, const NodeView<Node>& nodes, const LocalMotion<S>& motion) {
  using Rotation = Eigen::Matrix<S, Space<D>::turns, 1>;
  using Vector = Eigen::Matrix<S, D, 1>;
  Rotation acceleration = Rotation::Zero();
  if (body.frame == FrameAlgorithm::polar) {
    const auto& w = turn_part<D>(motion.Omega0);
    for (const int j : body.translation_nodes) {
      const auto i = static_cast<std::size_t>(j);
      const LocalNode<S>& local = motion.node[i];
      auto rate = motion.deformation_rate_B.template segment<D>(body.node[i].translation_row);
      const Vector bias = 2.0 * wedge(w, rate) + wedge(w, wedge(w, vector_part<D>(local.xh)));
      acceleration +=
          turns_by_vectors<D>(local.U_x) * (vector_part<D>(nodes[i].xdd) - vector_part<D>(motion.R0) * bias);
    }
    return acceleration;
  }
  for (const int j : body.rotation_nodes) {
    const auto i = static_cast<std::size_t>(j);
    const LocalNode<S>& local = motion.node[i];
    if constexpr (D == 2) {
      acceleration += turn_part<D>(local.U) * turn_part<D>(nodes[i].Omegad);
    } else {
      const Vec3<S> bias = motion.deformation_acceleration_B.template segment<3>(body.node[i].rotation_row);
      acceleration += local.U * (nodes[i].Omegad + inverse3<S>(local.Tinv) * bias);
    }
  }
  return acceleration;
}

/// Adds Γ v to `sum`. Planar bodies use the first two of the three rows of Γ.
template <class S>
void add_sum(const SuperelementBody& body, const Eigen::Matrix<double, 3, Eigen::Dynamic>& Gamma,
             const Eigen::Matrix<S, Eigen::Dynamic, 1>& v, Vec3<S>& sum) {
  S x = sum[0], y = sum[1], z = sum[2];
  for (Eigen::Index k = 0; k < v.size(); ++k) {
    x += Gamma(0, k) * v[k];
    y += Gamma(1, k) * v[k];
    if (!body.planar) z += Gamma(2, k) * v[k];
  }
  sum << x, y, z;
}

/// Subtracts Γᵀ g from `f`. Planar bodies use the first two of the three rows of Γ.
template <class S>
void subtract_share(const SuperelementBody& body, const Eigen::Matrix<double, 3, Eigen::Dynamic>& Gamma,
                    const Vec3<S>& g, Eigen::Matrix<S, Eigen::Dynamic, 1>& f) {
  const S x = g[0], y = g[1], z = g[2];
  for (Eigen::Index k = 0; k < f.size(); ++k) {
    S share = Gamma(0, k) * x + Gamma(1, k) * y;
    if (!body.planar) share += Gamma(2, k) * z;
    f[k] -= share;
  }
}

/// Mean displacement or rate of the mass, Φ_TᵀM̄ [boundary; internal] / m, from local coordinates or their rates.
template <class S>
Vec3<S> mean_of(const SuperelementBody& body, const Eigen::Matrix<S, Eigen::Dynamic, 1>& boundary,
                const Eigen::Matrix<S, Eigen::Dynamic, 1>& internal) {
  Vec3<S> sum = Vec3<S>::Zero();
  add_sum<S>(body, body.Gamma_B, boundary, sum);
  add_sum<S>(body, body.Gamma_I, internal, sum);
  return sum / body.mass;
}

/// Computes position, velocity and acceleration of the centre of mass: motion.center, center_rate, center_velocity and
/// center_acceleration. By THEORY (32), x_cm = x₀ + R₀ c with c = X_cm + Φ_TᵀM̄ y/m. In axes of the frame the velocity
/// is ẋ₀ + Ω₀ × c + ċ, and by THEORY (36) the acceleration is ẍ₀ + Ω̇₀ × c + Ω₀ × (Ω₀ × c) + 2 Ω₀ × ċ + c̈. Requires
/// deformation_accelerations().
template <class S>
void center_of_mass_motion(const SuperelementBody& body, LocalMotion<S>& motion) {
  const Vec3<S> w = motion.Omega0, wd = motion.Omega0d;
  const Vec3<S> c = body.center_of_mass.template cast<S>() + mean_of<S>(body, motion.y_B, motion.y_I);
  const Vec3<S> cd = mean_of<S>(body, motion.deformation_rate_B, motion.rate_I);
  const Vec3<S> cdd = mean_of<S>(body, motion.deformation_acceleration_B, motion.acceleration_I);
  motion.center = c;
  motion.center_rate = cd;
  motion.center_velocity = motion.origin_velocity + cross<S>(w, c) + cd;
  motion.center_acceleration =
      motion.origin_acceleration + cross<S>(wd, c) + cross<S>(w, cross<S>(w, c)) + 2.0 * cross<S>(w, cd) + cdd;
}

}  // namespace tisserand::mechanism
