// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of a superelement body, for any scalar: G_iner + G_int + G_damp − gravity from the local motion.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/forces/full_inertia.hpp"
#include "mechanism/bodies/superelement/forces/load_cases.hpp"
#include "mechanism/bodies/superelement/forces/products.hpp"
#include "mechanism/bodies/superelement/forces/strain.hpp"
#include "mechanism/bodies/superelement/frame/kinematics.hpp"
#include "mechanism/frames/space.hpp"

namespace tisserand::mechanism {

/// Forces of a superelement body: r_B on [world translation, material rotation] of each boundary node, and r_I on the
/// canonical internal coordinates.
template <class S>
struct SuperelementForces {
  using Vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  Vector r_B, r_I;
  Vector p_B;  ///< (M̄ ẏ)_B, momenta conjugate to the rates of THEORY (26)
  Vector f_B;  ///< (M̄ ÿ)_B, inertia forces in local coordinates
  Vector s_B;  ///< boundary rows of S̄ y + D ẏ − weight − load cases

  StrainTerms<S> strain;    ///< allocated if the body has stiffening
  InertiaTerms<S> inertia;  ///< allocated if the body has inertia option F
  LoadTerms<S> loads;       ///< allocated with load cases; the caller sets their factors
};

template <class S>
SuperelementForces<S> make_forces(const SuperelementBody& body) {
  using Vector = typename SuperelementForces<S>::Vector;
  SuperelementForces<S> forces;
  forces.r_B = forces.p_B = forces.f_B = forces.s_B = Vector::Zero(body.boundary_size);
  forces.r_I = Vector::Zero(body.modes);
  const SecondOrder& second = body.second_order;
  if (second.stiffening) forces.strain = make_strain_terms<S>(*second.stiffening);
  if (second.inertia) forces.inertia = make_inertia_terms<S>(*second.inertia);
  forces.loads = make_load_terms<S>(body);
  return forces;
}

/// Adds the damping forces D ẏ of THEORY (40) to out.s_B and out.r_I. If the body has stiffening, add_stiffening()
/// corrects the part b S̄ of D.
template <class S>
void add_damping_forces(const SuperelementBody& body, const LocalMotion<S>& motion, SuperelementForces<S>& out) {
  if (!body.damping.active) return;
  const double b = body.damping.stiffness;
  const auto& rate = motion.deformation_rate_B;
  if (b > 0.0)
    for (Eigen::Index k = 0; k < body.boundary_size; ++k)
      for (Eigen::Index i = 0; i < body.boundary_size; ++i) out.s_B[i] += b * body.S_BB(i, k) * rate[k];
  for (Eigen::Index k = 0; k < body.modes; ++k) out.r_I[k] += body.damping.internal[k] * motion.rate_I[k];
  if (!body.damping.is_full()) return;
  multiply_add(body.damping.BB, rate, out.s_B);
  if (body.modes == 0) return;
  multiply_add(body.damping.BI, motion.rate_I, out.s_B);
  multiply_add(body.damping.IB, rate, out.r_I);
  multiply_add(body.damping.II, motion.rate_I, out.r_I);
}

/// Adds the forces of stiffening: to S̄ y those of THEORY (44), and to the damping b S̄ ẏ those of THEORY (45), b
/// [(L + h)ᵀ(L + h) − LᵀL] ẏ.
template <class S>
void add_stiffening(const SuperelementBody& body, const LocalMotion<S>& motion, SuperelementForces<S>& out) {
  if (!body.second_order.stiffening) return;
  const Stiffening& stiffening = *body.second_order.stiffening;
  StrainTerms<S>& t = out.strain;
  strain_terms(stiffening, motion, t);
  if (body.damping.stiffness > 0.0) add_strain_damping(stiffening, body.damping.stiffness, motion, t);
  out.s_B += t.force.head(body.boundary_size);
  out.r_I += t.force.tail(body.modes);
}

/// Computes momenta (M̄ ẏ)_B, inertia forces (M̄ ÿ)_B and (M̄ ÿ)_I, and elastic and damping forces, all in local
/// coordinates.
template <class S>
void local_forces(const SuperelementBody& body, const LocalMotion<S>& motion, SuperelementForces<S>& out) {
  out.p_B.setZero();
  out.f_B.setZero();
  out.s_B.setZero();
  multiply_add(body.M_BB, motion.rate_B, out.p_B);
  multiply_add(body.M_BB, motion.acceleration_B, out.f_B);
  multiply_add(body.S_BB, motion.y_B, out.s_B);
  if (body.modes > 0) {
    multiply_add(body.M_BI, motion.rate_I, out.p_B);
    multiply_add(body.M_BI, motion.acceleration_I, out.f_B);
    out.r_I = motion.acceleration_I;
    for (Eigen::Index k = 0; k < body.modes; ++k) out.r_I[k] += body.S_II[k] * motion.y_I[k];
    multiply_add(body.M_IB, motion.acceleration_B, out.r_I);
  }
  add_damping_forces(body, motion, out);
  add_stiffening(body, motion, out);
}

/// Centre of mass c of the deformed body relative to x₀, in axes of the frame, THEORY (32): X_cm + Φ_TᵀM̄ y / m.
template <class S>
Vec3<S> deformed_center_of_mass(const SuperelementBody& body, const LocalMotion<S>& motion) {
  if (body.inertia == formats::InertiaOption::M) return motion.center;
  return body.center_of_mass.template cast<S>() + mean_of<S>(body, motion.y_B, motion.y_I);
}

/// Replaces M̄ by M̄ − M̄ Φ_T Φ_TᵀM̄/m in the forces of `out`, for inertia option M, THEORY (34). Then the interpolated
/// motion of the centre of mass has no inertia.
template <class S>
void release_center_of_mass(const SuperelementBody& body, const LocalMotion<S>& motion, SuperelementForces<S>& out) {
  const Vec3<S> velocity = mean_of<S>(body, motion.rate_B, motion.rate_I);
  const Vec3<S> acceleration = mean_of<S>(body, motion.acceleration_B, motion.acceleration_I);
  subtract_share<S>(body, body.Gamma_B, velocity, out.p_B);
  subtract_share<S>(body, body.Gamma_B, acceleration, out.f_B);
  subtract_share<S>(body, body.Gamma_I, acceleration, out.r_I);
}

/// Subtracts the weight on y from `out`, THEORY (39), Γᵀ g of s_B and r_I with Γ = Φ_TᵀM̄. Returns the moment m c × g
/// of the weight about x₀. `g`: acceleration of gravity R₀ᵀg in axes of the frame.
template <class S>
Vec3<S> apply_gravity(const SuperelementBody& body, const LocalMotion<S>& motion, const Vec3<S>& g,
                      SuperelementForces<S>& out) {
  subtract_share<S>(body, body.Gamma_B, g, out.s_B);
  subtract_share<S>(body, body.Gamma_I, g, out.r_I);
  return body.mass * cross<S>(deformed_center_of_mass(body, motion), g);
}

/// Subtracts the forces of the load cases on y from s_B and r_I, THEORY (42): Σ s (f + K y). Sets out.loads.
template <class S>
void apply_load_cases(const SuperelementBody& body, const LocalMotion<S>& motion, SuperelementForces<S>& out) {
  load_terms(body, motion, out.loads);
  out.s_B -= out.loads.g.head(body.boundary_size);
  out.r_I -= out.loads.g.tail(body.modes);
}

/// Converts forces on (x₀, Θ₀, y) to forces on the nodes, THEORY (53): boundary rows of A₀ᵀ G_x + Uᵀ G_θ + Υᵀ G_y.
/// Requires G_y in r_B, which receives the result.
template <int D, class S>
void pull_back_in(const SuperelementBody& body, const LocalMotion<S>& motion, const FrameForces<S>& frame,
                  Eigen::Matrix<S, Eigen::Dynamic, 1>& r_B) {
  constexpr int T = Space<D>::turns;
  Eigen::Matrix<S, T, 1> moment = turn_part<D>(frame.G_theta);
  Eigen::Matrix<S, D, 1> total = -vector_part<D>(frame.G_x);
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    if (node.has_translation()) {
      auto f = r_B.template segment<D>(node.translation_row);
      total += f;
      moment -= wedge(vector_part<D>(motion.node[i].xh), f);
    }
    if (node.has_rotation()) moment -= turn_part<D>(motion.node[i].Tinv) * r_B.template segment<T>(node.rotation_row);
  }
  const bool polar = body.frame == FrameAlgorithm::polar;
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    const LocalNode<S>& local = motion.node[i];
    if (node.has_translation()) {
      auto r = r_B.template segment<D>(node.translation_row);
      const Eigen::Matrix<S, D, 1> f = r - node.alpha * total;
      r.noalias() = vector_part<D>(motion.R0) * f;
      if (polar) r += turns_by_vectors<D>(local.U_x).transpose() * moment;
    }
    if (node.has_rotation()) {
      auto r = r_B.template segment<T>(node.rotation_row);
      const Eigen::Matrix<S, T, 1> f = r;
      r = turn_part<D>(local.Tinv).transpose() * f + turn_part<D>(local.U).transpose() * moment;
    }
  }
}
template <class S>
void pull_back(const SuperelementBody& body, const LocalMotion<S>& motion, const FrameForces<S>& frame,
               Eigen::Matrix<S, Eigen::Dynamic, 1>& r_B) {
  in_space(body.planar, [&]<int D>() { pull_back_in<D>(body, motion, frame, r_B); });
}

/// Computes all forces of a body with inertia option F: Lagrange's equations THEORY (51) to (53) with the elastic
/// forces THEORY (44).
template <class S>
void full_inertia_forces(const SuperelementBody& body, const LocalMotion<S>& motion, const Eigen::Vector3d& gravity,
                         SuperelementForces<S>& out) {
  out.p_B.setZero();
  out.s_B.setZero();
  multiply_add(body.S_BB, motion.y_B, out.s_B);
  for (Eigen::Index k = 0; k < body.modes; ++k) out.r_I[k] = body.S_II[k] * motion.y_I[k];
  add_damping_forces(body, motion, out);
  add_stiffening(body, motion, out);
  const Vec3<S> g = motion.R0.transpose() * gravity.template cast<S>();
  FrameForces<S> frame = inertia_forces<S>(body, motion, g, out.inertia);
  out.f_B = out.inertia.G_y.head(body.boundary_size);
  out.r_I += out.inertia.G_y.tail(body.modes);
  if (!body.load_cases.empty()) {
    apply_load_cases(body, motion, out);
    frame.G_x -= out.loads.force;
    frame.G_theta -= out.loads.moment;
  }
  out.r_B = out.f_B + out.s_B;
  pull_back(body, motion, frame, out.r_B);
}

/// Computes out.r_B on the nodes for superelement_forces(), from the local forces. `moment` is conjugate to δΘ₀ and
/// `total` to −δx₀ (axes of the frame); the function adds the sums over the nodes to both.
template <int D, class S>
void forces_on_nodes(const SuperelementBody& body, const LocalMotion<S>& motion,
                     Eigen::Matrix<S, Space<D>::turns, 1> moment, Eigen::Matrix<S, D, 1> total,
                     SuperelementForces<S>& out) {
  constexpr int T = Space<D>::turns;
  const bool option_A = body.inertia == formats::InertiaOption::A;
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    const LocalNode<S>& local = motion.node[i];
    if (node.has_translation()) {
      auto s = out.s_B.template segment<D>(node.translation_row), p = out.p_B.template segment<D>(node.translation_row);
      total += s;
      moment -= wedge(vector_part<D>(local.xh), s) + wedge(p, vector_part<D>(local.xd));
    }
    if (node.has_rotation()) {
      moment.noalias() -= turn_part<D>(local.Tinv) * out.s_B.template segment<T>(node.rotation_row);
      if (option_A) moment -= wedge(out.p_B.template segment<T>(node.rotation_row), turn_part<D>(local.Omega));
    }
  }
  const bool polar = body.frame == FrameAlgorithm::polar;
  const auto& w = turn_part<D>(motion.Omega0);
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    const LocalNode<S>& local = motion.node[i];
    if (node.has_translation()) {
      const int row = node.translation_row;
      auto r = out.r_B.template segment<D>(row), p = out.p_B.template segment<D>(row);
      const Eigen::Matrix<S, D, 1> f =
          out.f_B.template segment<D>(row) + wedge(w, p) + out.s_B.template segment<D>(row) - node.alpha * total;
      r.noalias() = vector_part<D>(motion.R0) * f;
      if (polar) r += turns_by_vectors<D>(local.U_x).transpose() * moment;
    }
    if (node.has_rotation()) {
      const int row = node.rotation_row;
      const auto& Omega = turn_part<D>(local.Omega);
      auto p = out.p_B.template segment<T>(row);
      Eigen::Matrix<S, T, 1> f = out.f_B.template segment<T>(row);
      if (option_A)
        f = (turn_part<D>(local.E).transpose() * (f + wedge(w - Omega, p))).eval();
      else
        f += wedge(Omega, p);
      f.noalias() += turn_part<D>(local.Tinv).transpose() * out.s_B.template segment<T>(row);
      f.noalias() += turn_part<D>(local.U).transpose() * moment;
      out.r_B.template segment<T>(row) = f;
    }
  }
}

/// Computes the residual r = Pᵀ M̄ ÿ + [Pᵀ(O₀ ∓ O_B) − UᵀVᵀ] p + Υᵀ(S̄ y + D ẏ) − gravity, THEORY (30), (20), (40),
/// (39). O_B has − in inertia option A and + in B ([Car00] (45), (60)). The sign of UᵀVᵀ is corrected: the print has +,
/// which contradicts its own derivation and Lagrange's equations. Option M is THEORY (35), in which m Jᵀ ẍ_cm is the
/// force of a gravity −ẍ_cm.
template <class S>
void superelement_forces(const SuperelementBody& body, const LocalMotion<S>& motion, const Eigen::Vector3d& gravity,
                         SuperelementForces<S>& out) {
  if (body.second_order.inertia) {
    full_inertia_forces(body, motion, gravity, out);
    return;
  }
  local_forces(body, motion, out);
  Vec3<S> moment = Vec3<S>::Zero();  // conjugate to δΘ₀
  Vec3<S> total = Vec3<S>::Zero();   // conjugate to −δx₀, axes of the frame
  const bool exact_center = body.inertia == formats::InertiaOption::M;
  if (exact_center) release_center_of_mass(body, motion, out);
  if (exact_center || !gravity.isZero(0.0)) {
    Vec3<S> g = motion.R0.transpose() * gravity.template cast<S>();
    if (exact_center) g -= motion.center_acceleration;
    moment -= apply_gravity(body, motion, g, out);
    total += body.mass * g;
  }
  if (!body.load_cases.empty()) {
    apply_load_cases(body, motion, out);
    moment -= out.loads.moment;
    total += out.loads.force;
  }
  in_space(body.planar,
           [&]<int D>() { forces_on_nodes<D, S>(body, motion, turn_part<D>(moment), vector_part<D>(total), out); });
}

}  // namespace tisserand::mechanism
