// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic forces of stiffening, for any scalar: the terms that the quadratic part of the generalised strains adds to
// S̄ y.
#pragma once

#include "mechanism/bodies/superelement/constants/second_order.hpp"
#include "mechanism/bodies/superelement/forces/products.hpp"
#include "mechanism/bodies/superelement/frame/frame.hpp"

namespace tisserand::mechanism {

/// Terms of stiffening at one y, THEORY (43), (44): h_a = Γ_a y, g_a = ½ y·h_a, e_a = l_a·y + g_a for each row a.
template <class S>
struct StrainTerms {
  using Vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  Vector y;       ///< (N): boundary, then internal coordinates
  FormRows<S> h;  ///< (rows x N)
  Vector g, e;    ///< (rows)
  Vector linear;  ///< (rows): l_a·y
  /// Force ∂V/∂y − S̄ y = Σ (g_a l_a + e_a h_a) (N). add_strain_damping() adds its damping force.
  Vector force;
  S damping_power = S(0.0);  ///< damping power less b ẏᵀ S̄ ẏ
};

template <class S>
StrainTerms<S> make_strain_terms(const Stiffening& stiffening) {
  using Vector = typename StrainTerms<S>::Vector;
  const Eigen::Index rows = stiffening.L.rows(), n = stiffening.L.cols();
  StrainTerms<S> t;
  t.y = t.force = Vector::Zero(n);
  t.g = t.e = t.linear = Vector::Zero(rows);
  t.h = FormRows<S>::Zero(rows, n);
  return t;
}

/// Sets the terms of stiffening `t` at the y of `motion`, THEORY (43), (44).
template <class S>
void strain_terms(const Stiffening& stiffening, const LocalMotion<S>& motion, StrainTerms<S>& t) {
  t.y << motion.y_B, motion.y_I;
  apply_forms<S>(stiffening.Gamma, t.y, t.h);
  t.g.setZero();
  t.linear.setZero();
  t.force.setZero();
  multiply_add(stiffening.L_blocks, t.y, t.linear);
  multiply_add<S>(t.h, t.y, S(0.5), t.g);
  t.e = t.linear + t.g;
  multiply_transposed_add(stiffening.L_blocks, t.g, t.force);
  add_transposed<Eigen::Dynamic, S>(t.h, t.e, t.force);
}

/// Adds to t.force the damping force of THEORY (45) less b S̄ ẏ: b [(L + h)ᵀ(L + h) − LᵀL] ẏ. Requires strain_terms()
/// and deformation_rates(). `b`: stiffness-proportional damping factor (a time).
template <class S>
void add_strain_damping(const Stiffening& stiffening, double b, const LocalMotion<S>& motion, StrainTerms<S>& t) {
  const auto rate = [&motion](Eigen::Index k) {
    const Eigen::Index nb = motion.y_B.size();
    return k < nb ? motion.deformation_rate_B[k] : motion.rate_I[k - nb];
  };
  const Eigen::MatrixXd& L = stiffening.L;
  t.damping_power = S(0.0);
  for (Eigen::Index a = 0; a < L.rows(); ++a) {
    S linear(0.0), bent(0.0);  // l_a·ẏ and h_a·ẏ
    for (Eigen::Index k = 0; k < L.cols(); ++k) {
      linear += L(a, k) * rate(k);
      bent += t.h(a, k) * rate(k);
    }
    for (Eigen::Index k = 0; k < L.cols(); ++k) t.force[k] += b * (L(a, k) * bent + t.h(a, k) * (linear + bent));
    t.damping_power += b * (2.0 * linear + bent) * bent;
  }
}

/// Strain energy of stiffening: V of THEORY (43) less ½ yᵀ S̄ y.
template <class S>
S strain_energy(const StrainTerms<S>& t) {
  S sum(0.0);
  for (Eigen::Index a = 0; a < t.g.size(); ++a) sum += (t.linear[a] + 0.5 * t.g[a]) * t.g[a];
  return sum;
}

}  // namespace tisserand::mechanism
