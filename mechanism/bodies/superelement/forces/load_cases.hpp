// SPDX-License-Identifier: GPL-3.0-or-later
// Load cases of the companion file on a superelement body, for any scalar: distributed loads that turn with the body.
//
// With the factor s a load case does the virtual work of THEORY (42), s [F·R₀ᵀδx₀ + m(y)·δΘ₀ + (f + K y)·δy]. f = Φᵀ f
// are the forces on the coordinates y. F and m(y) are their resultants in axes of the floating frame, m about x₀. To
// first order in y the points of application move with the body: ∂m/∂y = −[f_i~] for displacements and −½[m_i~] for
// rotations of the boundary nodes, + R_θᵀ K. The last term follows from K = −Φᵀ K_G[w_f] Φ: a rotation of the stressed
// body rotates the forces that hold it. K_G[w_f] R_θ e = e × f for forces and ½ e × m for moments. The half arises
// because moments belong to rotation vectors and K_G is symmetric.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/forces/products.hpp"
#include "mechanism/bodies/superelement/frame/frame.hpp"

namespace tisserand::mechanism {

/// Forces of all load cases of a body with their factors, at one y, THEORY (42). Vectors are allocated if the body has
/// load cases.
template <class S>
struct LoadTerms {
  using Vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  Eigen::VectorXd factors;           ///< s: one per load case; the caller sets them
  Vector y;                          ///< (N): boundary, then internal coordinates
  Vector g;                          ///< (N): Σ s (f + K y), the force on y
  Vec3<S> force = Vec3<S>::Zero();   ///< resultant, axes of the frame
  Vec3<S> moment = Vec3<S>::Zero();  ///< resultant moment about x₀
};

template <class S>
LoadTerms<S> make_load_terms(const SuperelementBody& body) {
  using Vector = typename LoadTerms<S>::Vector;
  LoadTerms<S> t;
  if (body.load_cases.empty()) return t;
  const Eigen::Index n = body.boundary_size + body.modes;
  t.factors.setZero(static_cast<Eigen::Index>(body.load_cases.size()));
  t.y = t.g = Vector::Zero(n);
  return t;
}

/// Adds the forces of one load case at the coordinates t.y.
template <class S>
void add_load_case(const BodyLoadCase& load, double factor, LoadTerms<S>& t) {
  for (Eigen::Index k = 0; k < t.y.size(); ++k) {
    t.g[k] += factor * load.force[k];
    for (int i = 0; i < 3; ++i) t.moment[i] += (factor * load.arm(i, k)) * t.y[k];
  }
  for (int i = 0; i < 3; ++i) {
    t.force[i] += factor * load.total[i];
    t.moment[i] += factor * load.moment[i];
  }
  for (Eigen::Index k = 0; k < load.stiffness.cols(); ++k) {
    const S by = factor * t.y[k];
    for (Eigen::Index i = 0; i < t.g.size(); ++i) t.g[i] += load.stiffness(i, k) * by;
  }
}

/// Sets all of `t` except t.factors, at the y of `motion`.
template <class S>
void load_terms(const SuperelementBody& body, const LocalMotion<S>& motion, LoadTerms<S>& t) {
  t.y << motion.y_B, motion.y_I;
  t.g.setZero();
  t.force.setZero();
  t.moment.setZero();
  for (std::size_t i = 0; i < body.load_cases.size(); ++i)
    if (const double s = t.factors[static_cast<Eigen::Index>(i)]; s != 0.0) add_load_case(body.load_cases[i], s, t);
}

/// Power of the load cases with their factors. Requires update_kinematics() and load_terms().
double load_power(const SuperelementBody& body, const LocalMotion<double>& motion, const LoadTerms<double>& t);

}  // namespace tisserand::mechanism
