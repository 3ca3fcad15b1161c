// SPDX-License-Identifier: GPL-3.0-or-later
// Inertia option F of a superelement body, for any scalar: the kinetic energy THEORY (48) of all its mass, with the
// second-order displacement of the interior. Letters are those of docs/THEORY.md, section 8; R in the code is Φ₀ there.
#pragma once

#include <type_traits>

#include "mechanism/bodies/superelement/forces/products.hpp"
#include "mechanism/bodies/superelement/frame/momentum.hpp"

namespace tisserand::mechanism {

/// Symmetric matrix (3 x 3) from its six entries in the order xx yy zz yz xz xy.
template <class S>
Mat3<S> symmetric3(const Eigen::Ref<const Eigen::Matrix<S, 6, 1>>& a) {
  Mat3<S> A;
  A << a[0], a[5], a[4], a[5], a[1], a[3], a[4], a[3], a[2];
  return A;
}

/// Factors of six symmetric matrices A_jk in the sum Σ_jk aⱼ b_k A_jk, in the order xx yy zz yz xz xy.
template <class S>
Eigen::Matrix<S, 6, 1> pair_factors(const Vec3<S>& a, const Vec3<S>& b) {
  Eigen::Matrix<S, 6, 1> out;
  out << a[0] * b[0], a[1] * b[1], a[2] * b[2], a[1] * b[2] + a[2] * b[1], a[0] * b[2] + a[2] * b[0],
      a[0] * b[1] + a[1] * b[0];
  return out;
}

/// Terms of the inertia forces of option F at one motion, THEORY (46) to (52), in axes of the frame. N is the number of
/// coordinates y. Vectors of size 3N are padded to full blocks.
template <class S>
struct InertiaTerms {
  using Vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using Six = Eigen::Matrix<S, 6, 1>;
  Vector y, yd, ydd;
  /// Products of the matrices of FullInertia::forms with y (count x N): [N_a y], [T_jk y], [E_jk y], or only [E_jk y].
  FormRows<S> forms_y;
  Vector Cy, Cyd;  ///< (3N): C_x y, C_y y, C_z y; then with ẏ
  Vector Wy, Wyd;  ///< (3N): W_x y, W_y y, W_z y; then with ẏ; zero without W
  Vector xi, p, xid, pd;
  Vector quadratic;  ///< (12): ẏᵀ N_a ẏ, ẏᵀ T_jk ẏ
  Vector G_y;        ///< THEORY (52) without the elastic force f
  Vector turned;     ///< (3N): scratch
  Vec3<S> sigma = Vec3<S>::Zero(), nu = Vec3<S>::Zero();
  Mat3<S> TT = Mat3<S>::Zero(), JJ = Mat3<S>::Zero(), JJd = Mat3<S>::Zero();
  Vec3<S> pi_v = Vec3<S>::Zero(), pi_O = Vec3<S>::Zero();  ///< π_v, π_Ω: momentum; angular momentum about x₀
  S kinetic = S(0.0);
};

template <class S>
InertiaTerms<S> make_inertia_terms(const FullInertia& inertia) {
  using Vector = typename InertiaTerms<S>::Vector;
  const Eigen::Index n = inertia.M.rows();
  InertiaTerms<S> t;
  t.y = t.yd = t.ydd = t.xi = t.p = t.xid = t.pd = t.G_y = Vector::Zero(n);
  t.Cy = t.Cyd = t.Wy = t.Wyd = t.turned = Vector::Zero(inertia.C.rows);
  t.forms_y = FormRows<S>::Zero(inertia.forms.count, n);
  t.quadratic = Vector::Zero(12);
  return t;
}

/// Product of the first `Rows` rows of the matrix `rows` with x.
template <int Rows, class S>
Eigen::Matrix<S, Rows, 1> rows_times(const FormRows<S>& rows, const Eigen::Matrix<S, Eigen::Dynamic, 1>& x) {
  Eigen::Matrix<S, Rows, 1> out = Eigen::Matrix<S, Rows, 1>::Zero();
  for (Eigen::Index k = 0; k < x.size(); ++k)
    out += Eigen::Map<const Eigen::Matrix<S, Rows, 1>>(rows.data() + k * rows.rows()) * x[k];
  return out;
}

/// Product Rᵀ x with the rigid motions R of the body ((N x 6), Φ₀ in THEORY).
template <class S>
Eigen::Matrix<S, 6, 1> rigid_part(const FullInertia& inertia, const Eigen::Matrix<S, Eigen::Dynamic, 1>& x) {
  const Eigen::Index nb = inertia.boundary_size;  // R is zero for internal coordinates
  Eigen::Matrix<S, 6, 1> out;
  for (int a = 0; a < 6; ++a) out[a] = inner_product<S>(inertia.R.col(a).head(nb), x.head(nb));
  return out;
}

/// Vector [xᵀ C_k y]_k, k = 1..3, from the three vectors C_k y one below the other in `stack`.
template <class S>
Vec3<S> turning_part(const Eigen::Matrix<S, Eigen::Dynamic, 1>& x, const Eigen::Matrix<S, Eigen::Dynamic, 1>& stack) {
  Vec3<S> out;
  for (int k = 0; k < 3; ++k) out[k] = inner_product<S>(x, stack.segment(k * x.size(), x.size()));
  return out;
}

/// Adds Σ_k a_k (C_k y) to `out`, with the three vectors C_k y one below the other in `stack`.
template <class S>
void add_turned(const Vec3<S>& a, const Eigen::Matrix<S, Eigen::Dynamic, 1>& stack,
                Eigen::Matrix<S, Eigen::Dynamic, 1>& out) {
  for (int k = 0; k < 3; ++k) out += a[k] * stack.segment(k * out.size(), out.size());
}

/// Product J₀⁻¹ a with the rigid inertia J₀ = RᵀM̄R (6 x 6).
template <class S>
Eigen::Matrix<S, 6, 1> solve_rigid(const FullInertia& inertia, const Eigen::Matrix<S, 6, 1>& a) {
  if constexpr (std::is_same_v<S, double>) {
    return inertia.J0_inverse * a;
  } else {
    Eigen::Matrix<S, 6, 1> out = Eigen::Matrix<S, 6, 1>::Zero();
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 6; ++i) out[i] += inertia.J0_inverse(i, j) * a[j];
    return out;
  }
}

/// Computes the motion x = R a + rate and its momenta Mx = M̄ x. R are the rigid motions and a their six amplitudes.
template <class S>
void true_motion(const FullInertia& inertia, const Eigen::Matrix<S, 6, 1>& a,
                 const Eigen::Matrix<S, Eigen::Dynamic, 1>& rate, Eigen::Matrix<S, Eigen::Dynamic, 1>& x,
                 Eigen::Matrix<S, Eigen::Dynamic, 1>& Mx) {
  const Eigen::Index nb = inertia.boundary_size, m = x.size() - nb;
  x = rate;  // R is zero for internal coordinates
  for (int j = 0; j < 6; ++j)
    for (Eigen::Index i = 0; i < nb; ++i) x[i] += inertia.R(i, j) * a[j];
  Mx.head(nb).setZero();
  Mx.tail(m) = x.tail(m);
  if constexpr (std::is_same_v<S, double>) {
    Mx.noalias() += inertia.M.leftCols(nb) * x.head(nb);
    Mx.head(nb).noalias() += inertia.M.topRightCorner(nb, m) * x.tail(m);
  } else {
    for (Eigen::Index k = 0; k < x.size(); ++k)
      for (Eigen::Index i = 0; i < (k < nb ? x.size() : nb); ++i) Mx[i] += inertia.M(i, k) * x[k];
  }
}

/// Quantities of the second-order displacement, THEORY (46): σ, ν and 𝒯 (`T`) with first and second derivatives. They
/// are zero without N and T. `turn` is [ẏᵀ W_j y], the momentum of second-order relative angular velocities, and
/// `turn_d` is its rate [ÿᵀ W_j y].
template <class S>
struct Foreshortened {
  Vec3<S> turn = Vec3<S>::Zero(), turn_d = Vec3<S>::Zero();
  Vec3<S> sigma = Vec3<S>::Zero(), nu = Vec3<S>::Zero(), sigma_d = Vec3<S>::Zero(), nu_d = Vec3<S>::Zero(),
          sigma_dd = Vec3<S>::Zero(), nu_dd = Vec3<S>::Zero();
  Mat3<S> T = Mat3<S>::Zero(), Td = Mat3<S>::Zero();
};

/// Sets t.JJ (𝒥 of THEORY (46)) and its rate from the products E y. Returns the second-order displacement, which is
/// zero unless Count includes N and T.
template <int Count, class S>
Foreshortened<S> set_form_products(const FullInertia& inertia, InertiaTerms<S>& t) {
  using Rows = Eigen::Matrix<S, Count, 1>;
  using Six = Eigen::Matrix<S, 6, 1>;
  constexpr bool all = Count == FullInertia::all;
  constexpr int E = all ? 12 : 0;
  apply_pairs<Count, E, S>(inertia.forms, t.y, t.yd, t.forms_y, t.quadratic);
  const Rows at_y = rows_times<Count, S>(t.forms_y, t.y), rate = rows_times<Count, S>(t.forms_y, t.yd);
  t.JJ = symmetric3<S>(Six(at_y.template segment<6>(E)));
  t.JJd = symmetric3<S>(Six(2.0 * rate.template segment<6>(E)));
  Foreshortened<S> w;
  if constexpr (all) {
    const Eigen::Matrix<S, 6, 1> second = rows_times<6, S>(t.forms_y, t.ydd);
    w.sigma = 0.5 * at_y.template head<3>();
    w.nu = 0.5 * at_y.template segment<3>(3);
    w.T = symmetric3<S>(Six(0.5 * at_y.template segment<6>(6)));
    w.sigma_d = rate.template head<3>();
    w.nu_d = rate.template segment<3>(3);
    w.Td = symmetric3<S>(Six(rate.template segment<6>(6)));
    w.sigma_dd = second.template head<3>() + t.quadratic.template head<3>();
    w.nu_dd = second.template segment<3>(3) + t.quadratic.template segment<3>(3);
  }
  return w;
}

/// Whether the body has the matrices W, the rotary inertia of second order.
inline bool turns_nodes(const FullInertia& inertia) { return !inertia.W.runs.empty(); }

/// Sets y, ẏ, ÿ in `t` and the products of the arrays with y and ẏ: E y, C y, C ẏ, N y, T y, W y, W ẏ. Returns the
/// second-order displacement.
template <class S>
Foreshortened<S> set_products(const FullInertia& inertia, const LocalMotion<S>& motion, InertiaTerms<S>& t) {
  t.y << motion.y_B, motion.y_I;
  t.yd << motion.deformation_rate_B, motion.rate_I;
  t.ydd << motion.deformation_acceleration_B, motion.acceleration_I;
  t.Cy.setZero();
  t.Cyd.setZero();
  multiply_add(inertia.C, t.y, t.Cy, t.yd, t.Cyd);
  Foreshortened<S> w = inertia.foreshortening ? set_form_products<FullInertia::all, S>(inertia, t)
                                              : set_form_products<FullInertia::E_alone, S>(inertia, t);
  if (turns_nodes(inertia)) {
    t.Wy.setZero();
    t.Wyd.setZero();
    multiply_add(inertia.W, t.y, t.Wy, t.yd, t.Wyd);
    w.turn = turning_part<S>(t.yd, t.Wy);
    w.turn_d = turning_part<S>(t.ydd, t.Wy);
  }
  t.sigma = w.sigma;
  t.nu = w.nu;
  t.TT = w.T;
  return w;
}

/// Sets ξ = R (η + J₀⁻¹ n₂) + ẏ of THEORY (48), p = M̄ ξ + Ω_k C_k y of THEORY (49), their rates, and the kinetic
/// energy ½ ξᵀM̄ξ. n₂ is the momentum of THEORY (47).
template <class S>
void set_momenta(const FullInertia& inertia, const LocalMotion<S>& motion, const Foreshortened<S>& w,
                 InertiaTerms<S>& t) {
  using Six = Eigen::Matrix<S, 6, 1>;
  const Vec3<S>&Om = motion.Omega0, &Omd = motion.Omega0d, &v = motion.origin_velocity;
  Six n2, n2d, nu, nud;
  n2 << w.sigma_d + cross<S>(Om, w.sigma), w.nu_d + w.turn + 0.5 * cross<S>(Om, w.nu) + w.T * Om;
  n2d << w.sigma_dd + cross<S>(Omd, w.sigma) + cross<S>(Om, w.sigma_d),
      w.nu_dd + w.turn_d + 0.5 * cross<S>(Omd, w.nu) + 0.5 * cross<S>(Om, w.nu_d) + w.Td * Om + w.T * Omd;
  nu << v, Om;
  nud << motion.origin_acceleration - cross<S>(Om, v), Omd;
  true_motion<S>(inertia, nu + solve_rigid<S>(inertia, n2), t.yd, t.xi, t.p);
  t.kinetic = 0.5 * (t.xi.transpose() * t.p)(0, 0);
  add_turned<S>(Om, t.Cy, t.p);
  true_motion<S>(inertia, nud + solve_rigid<S>(inertia, n2d), t.ydd, t.xid, t.pd);
  add_turned<S>(Omd, t.Cy, t.pd);
  add_turned<S>(Om, t.Cyd, t.pd);
}

/// Rigid part r = J₀⁻¹Rᵀp of the true velocity, THEORY (49), and its rate: `v` and `O` are r_v and r_Ω.
template <class S>
struct RigidVelocity {
  Vec3<S> v, O, vd, Od;
};

/// Sets t.G_y, the force of inertia and weight on y: THEORY (52) without f. `Om`: Ω₀. `g`: acceleration of gravity in
/// axes of the frame.
template <class S>
void set_shape_forces(const SuperelementBody& body, const RigidVelocity<S>& r, const Vec3<S>& Om, const Vec3<S>& g,
                      InertiaTerms<S>& t) {
  const FullInertia& inertia = *body.second_order.inertia;
  const Eigen::Index n = t.y.size();
  for (int k = 0; k < 3; ++k) t.turned.segment(k * n, n) = -Om[k] * t.xi;
  t.G_y = t.pd;
  multiply_transposed_add(inertia.C, t.turned, t.G_y);
  const Eigen::Matrix<S, 6, 1> centrifugal = -pair_factors<S>(Om, Om);
  if (inertia.foreshortening) {
    Eigen::Matrix<S, FullInertia::all, 1> factor;
    factor << r.vd - cross<S>(r.v, Om) - g, r.Od - 0.5 * cross<S>(r.O, Om), -pair_factors<S>(r.O, Om), centrifugal,
        S(0.0), S(0.0);
    add_transposed<FullInertia::all, S>(t.forms_y, factor, t.G_y);
    if (turns_nodes(inertia)) {
      add_turned<S>(r.Od, t.Wy, t.G_y);
      add_turned<S>(2.0 * r.O, t.Wyd, t.G_y);
    }
  } else {
    Eigen::Matrix<S, FullInertia::E_alone, 1> factor;
    factor << centrifugal, S(0.0), S(0.0);
    add_transposed<FullInertia::E_alone, S>(t.forms_y, factor, t.G_y);
  }
  for (Eigen::Index k = 0; k < body.boundary_size; ++k)
    for (int i = 0; i < 3; ++i) t.G_y[k] -= body.Gamma_B(i, k) * g[i];
  for (Eigen::Index k = 0; k < body.modes; ++k)
    for (int i = 0; i < 3; ++i) t.G_y[body.boundary_size + k] -= body.Gamma_I(i, k) * g[i];
}

/// Forces of inertia and weight on the floating frame, THEORY (51): G_x on x₀ (axes of the frame) and G_Θ on the
/// rotation.
template <class S>
struct FrameForces {
  Vec3<S> G_x, G_theta;
};

/// Computes the forces of inertia and weight in the coordinates (x₀, Θ₀, y): G_x and G_Θ of THEORY (51), and G_y of
/// THEORY (52) in t.G_y. It also sets the momenta of THEORY (50) in `t`. `g`: acceleration of gravity in axes of the
/// frame. Requires deformation_accelerations().
template <class S>
FrameForces<S> inertia_forces(const SuperelementBody& body, const LocalMotion<S>& motion, const Vec3<S>& g,
                              InertiaTerms<S>& t) {
  using Six = Eigen::Matrix<S, 6, 1>;
  const FullInertia& inertia = *body.second_order.inertia;
  const Vec3<S>&Om = motion.Omega0, &Omd = motion.Omega0d;
  const Foreshortened<S> w = set_products(inertia, motion, t);
  set_momenta(inertia, motion, w, t);
  const Six P = rigid_part<S>(inertia, t.p), Pd = rigid_part<S>(inertia, t.pd);
  const Six velocity = solve_rigid<S>(inertia, P), rate = solve_rigid<S>(inertia, Pd);
  const RigidVelocity<S> r{velocity.template head<3>(), velocity.template tail<3>(), rate.template head<3>(),
                           rate.template tail<3>()};
  const Vec3<S> turning = turning_part<S>(t.xi, t.Cy);
  t.kinetic += dot3<S>(Om, turning) + 0.5 * dot3<S>(Om, Vec3<S>(t.JJ * Om));
  t.pi_v = P.template head<3>();
  t.pi_O = P.template tail<3>() + turning + t.JJ * Om + cross<S>(w.sigma, r.v) + 0.5 * cross<S>(w.nu, r.O) + w.T * r.O;
  const Vec3<S> pi_vd = Pd.template head<3>();
  const Vec3<S> pi_Od = Pd.template tail<3>() + turning_part<S>(t.xid, t.Cy) + turning_part<S>(t.xi, t.Cyd) +
                        t.JJd * Om + t.JJ * Omd + cross<S>(w.sigma_d, r.v) + cross<S>(w.sigma, r.vd) +
                        0.5 * cross<S>(w.nu_d, r.O) + 0.5 * cross<S>(w.nu, r.Od) + w.Td * r.O + w.T * r.Od;
  set_shape_forces(body, r, Om, g, t);
  const Vec3<S> s =
      body.mass * (body.center_of_mass.template cast<S>() + mean_of<S>(body, motion.y_B, motion.y_I)) + w.sigma;
  return {pi_vd + cross<S>(Om, t.pi_v) - body.mass * g,
          pi_Od + cross<S>(Om, t.pi_O) + cross<S>(motion.origin_velocity, t.pi_v) - cross<S>(s, g)};
}

}  // namespace tisserand::mechanism
