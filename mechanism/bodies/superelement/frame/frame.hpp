// SPDX-License-Identifier: GPL-3.0-or-later
// Floating frame of a superelement body, for any scalar: R₀, ψ, T⁻¹ and U from node poses.
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "common/math/rotation.hpp"
#include "mechanism/bodies/superelement/constants/body.hpp"

namespace tisserand::mechanism {

/// Motion of a node with any scalar S; NodeMotion (mechanism/frames/motion.hpp) explains the fields.
template <class S>
struct NodeMotionOf {
  Vec3<S> x, xd, Omega, xdd, Omegad;
  Mat3<S> R;
};

/// View of the nodes of one body among those of the model: item i is node index[i].
template <class Node>
struct NodeView {
  const Node* nodes;
  const int* index;
  const Node& operator[](std::size_t i) const { return nodes[index[i]]; }
};

/// Pose and rates of one boundary node relative to the floating frame x₀, R₀, in axes of the frame unless stated.
template <class S>
struct LocalNode {
  Mat3<S> E;      ///< R₀ᵀ Rᵢ; may be out of date except with inertia option A
  Vec3<S> psi;    ///< rotation vector log E
  Mat3<S> Tinv;   ///< T⁻¹(ψᵢ); T⁻¹(−ψᵢ) is its transpose
  Mat3<S> U;      ///< ∂Θ₀/∂Θᵢ: δΘ₀ = Σ Uⱼ δΘⱼ + Σ U_xⱼ δxⱼ
  Mat3<S> U_x;    ///< ∂Θ₀/∂xᵢ (world axes); only with FrameAlgorithm::polar
  Vec3<S> xh;     ///< position R₀ᵀ(xᵢ − x₀) = Xᵢ + uᵢ
  Vec3<S> xd;     ///< velocity R₀ᵀ ẋᵢ
  Vec3<S> Omega;  ///< angular rate of THEORY (26): Eᵢ Ωᵢ with option A, else Ωᵢ
};

/// Motion of a superelement body: its floating frame, local coordinates y and their rates, from the motion of the nodes
/// and the internal coordinates.
template <class S>
struct LocalMotion {
  using Vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  Vec3<S> x0 = Vec3<S>::Zero();
  Mat3<S> R0 = Mat3<S>::Identity();
  Vec3<S> Omega0 = Vec3<S>::Zero();  ///< angular velocity U q̇, axes of the frame
  std::vector<LocalNode<S>> node;
  Vector y_B;                         ///< local coordinates [u, ψ] per node
  Vector rate_B;                      ///< P q̇: rates in the kinetic energy, THEORY (26)
  Vector acceleration_B;              ///< P q̈ + V Ω₀, THEORY (29)
  Vector deformation_rate_B;          ///< Υ q̇ = ẏ_B; only with damping, load cases or inertia options M and F
  Vector deformation_acceleration_B;  ///< ÿ_B of the deformation; only with inertia options M and F
  Vec3<S> origin_velocity = Vec3<S>::Zero();      ///< R₀ᵀẋ₀; available when deformation_rate_B is
  Vec3<S> origin_acceleration = Vec3<S>::Zero();  ///< R₀ᵀẍ₀; only with inertia options M and F
  Vec3<S> Omega0d = Vec3<S>::Zero();              ///< Ω̇₀; only with inertia options M and F
  Vec3<S> center = Vec3<S>::Zero();               ///< c = X_cm + Φ_TᵀM̄ y/m; only with inertia option M
  Vec3<S> center_rate = Vec3<S>::Zero();          ///< ċ; only with inertia option M
  Vec3<S> center_velocity = Vec3<S>::Zero();      ///< R₀ᵀẋ_cm; only with inertia option M
  Vec3<S> center_acceleration = Vec3<S>::Zero();  ///< R₀ᵀẍ_cm; only with inertia option M
  Vector y_I, rate_I, acceleration_I;
  int frame_iterations = 0;
  double frame_error = 0.0;  ///< last correction of an iterated frame [rad]
};

template <class S>
LocalMotion<S> make_local_motion(const SuperelementBody& body) {
  using Vector = typename LocalMotion<S>::Vector;
  LocalMotion<S> motion;
  LocalNode<S> zero;
  zero.E.setIdentity();
  zero.Tinv.setIdentity();
  zero.U.setZero();
  zero.U_x.setZero();
  zero.psi.setZero();
  zero.xh.setZero();
  zero.xd.setZero();
  zero.Omega.setZero();
  motion.node.assign(body.node.size(), zero);
  motion.y_B = motion.rate_B = motion.acceleration_B = motion.deformation_rate_B = motion.deformation_acceleration_B =
      Vector::Zero(body.boundary_size);
  motion.y_I = motion.rate_I = motion.acceleration_I = Vector::Zero(body.modes);
  return motion;
}

/// Inverse A⁻¹ by cofactors, for any scalar.
template <class S>
Mat3<S> inverse3(const Mat3<S>& A) {
  const Vec3<S> a = A.col(0), b = A.col(1), c = A.col(2);
  const Vec3<S> bc = cross<S>(b, c);
  const S scale = 1.0 / dot3<S>(a, bc);
  Mat3<S> inverse;
  inverse.row(0) = scale * bc.transpose();
  inverse.row(1) = scale * cross<S>(c, a).transpose();
  inverse.row(2) = scale * cross<S>(a, b).transpose();
  return inverse;
}

namespace frame {

/// Limit of the correction of R₀ [rad] below which the iteration ends. The next iterate would differ by its cube.
inline constexpr double kTolerance = 1e-14;
inline constexpr int kMaxIterations = 30;
/// Least number of iterations. Scalars with derivatives need two after the values have converged.
template <class S>
inline constexpr int kMinIterations = std::is_same_v<S, double> ? 0 : 2;

template <class S>
double size(const Vec3<S>& a) {
  return std::sqrt(real_part(a.x()) * real_part(a.x()) + real_part(a.y()) * real_part(a.y()) +
                   real_part(a.z()) * real_part(a.z()));
}

/// Computes E, ψ and T⁻¹ of every node with rotations for the R₀ in `motion`.
template <class S, class Node>
void local_rotations(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  for (const int j : body.rotation_nodes) {
    LocalNode<S>& local = motion.node[j];
    local.E.noalias() = motion.R0.transpose() * nodes[j].R;
    local.psi = log_so3<S>(local.E);
    local.Tinv = inverse_tangent_so3<S>(local.psi);
  }
}

/// Sets the frame to that of one node: R₀ = R_k, U_k = 1.
template <class S, class Node>
void single_node(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  motion.R0 = nodes[body.frame_node].R;
  local_rotations(body, nodes, motion);
  motion.node[body.frame_node].U.setIdentity();
}

/// Sets U of all nodes to the exact variation of the Karcher mean, THEORY (14): Uⱼ = A⁻¹ αⱼ T⁻¹(ψⱼ), A = Σ αⱼ T⁻¹(−ψⱼ).
template <class S>
void karcher_variation(const SuperelementBody& body, LocalMotion<S>& motion) {
  Mat3<S> A = Mat3<S>::Zero();
  for (const int j : body.rotation_nodes) {
    const auto i = static_cast<std::size_t>(j);
    A += body.node[i].alpha_rotation * motion.node[i].Tinv.transpose();
  }
  const Mat3<S> inverse = inverse3<S>(A);
  for (const int j : body.rotation_nodes) {
    const auto i = static_cast<std::size_t>(j);
    motion.node[i].U = body.node[i].alpha_rotation * (inverse * motion.node[i].Tinv);
  }
}

/// Sets the frame to the Karcher mean of two nodes with rotations, which solves THEORY (12) in closed form. With
/// φ = log(R₁ᵀR₂) it is R₀ = R₁ exp(α₂ φ), and ψ₁ = −α₂ φ, ψ₂ = α₁ φ.
template <class S, class Node>
void pair(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  const auto i1 = static_cast<std::size_t>(body.rotation_nodes[0]),
             i2 = static_cast<std::size_t>(body.rotation_nodes[1]);
  LocalNode<S>&n1 = motion.node[i1], &n2 = motion.node[i2];
  const Mat3<S> relative = nodes[i1].R.transpose() * nodes[i2].R;
  const Vec3<S> phi = log_so3<S>(relative);
  n1.psi = -body.node[i2].alpha_rotation * phi;
  n2.psi = body.node[i1].alpha_rotation * phi;
  n1.E = exp_so3<S>(n1.psi);
  if (body.inertia == formats::InertiaOption::A) n2.E = exp_so3<S>(n2.psi);
  motion.R0.noalias() = nodes[i1].R * n1.E.transpose();
  n1.Tinv = inverse_tangent_so3<S>(n1.psi);
  n2.Tinv = inverse_tangent_so3<S>(n2.psi);
  karcher_variation(body, motion);
}

/// Iterates the frame to the Karcher mean, THEORY (12), from the R₀ in `motion`. Newton's method, THEORY (13),
/// replaces R₀ by R₀ exp(A⁻¹ Σ αⱼ ψⱼ) with A = Σ αⱼ T⁻¹(−ψⱼ), weights αⱼ and rotations ψⱼ of the boundary nodes.
template <class S, class Node>
void karcher(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  for (int iteration = 0;; ++iteration) {
    local_rotations(body, nodes, motion);
    Mat3<S> A = Mat3<S>::Zero();
    Vec3<S> h = Vec3<S>::Zero();
    for (const int j : body.rotation_nodes) {
      const auto i = static_cast<std::size_t>(j);
      A += body.node[i].alpha_rotation * motion.node[i].Tinv.transpose();
      h += body.node[i].alpha_rotation * motion.node[i].psi;
    }
    const Vec3<S> correction = inverse3<S>(A) * h;
    motion.frame_iterations = iteration;
    motion.frame_error = size<S>(correction);
    if ((motion.frame_error < kTolerance && iteration >= kMinIterations<S>) || iteration == kMaxIterations) break;
    motion.R0 = (motion.R0 * exp_so3<S>(correction)).eval();
  }
  karcher_variation(body, motion);
}

/// Sets the frame to the incremental mean, THEORY (15): R₀ = R_ref exp(b₀), b₀ = Σ αⱼ bⱼ, bⱼ = log(R_refᵀRⱼ),
/// Uⱼ = T(b₀) αⱼ T⁻¹(bⱼ). On entry R_ref is the R₀ in `motion`.
template <class S, class Node>
void incremental(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  const Mat3<S> R_ref = motion.R0;
  Vec3<S> b0 = Vec3<S>::Zero();
  for (const int j : body.rotation_nodes) {
    const auto i = static_cast<std::size_t>(j);
    const Vec3<S> b = log_so3<S>(R_ref.transpose() * nodes[i].R);
    b0 += body.node[i].alpha_rotation * b;
    motion.node[i].U = body.node[i].alpha_rotation * inverse_tangent_so3<S>(b);
  }
  motion.R0 = R_ref * exp_so3<S>(b0);
  const Mat3<S> T = tangent_so3<S>(b0);
  for (const int j : body.rotation_nodes) {
    Mat3<S>& U = motion.node[j].U;
    U = (T * U).eval();
  }
  local_rotations(body, nodes, motion);
}

/// Iterates the frame of nodes without rotations, THEORY (16), by Newton's method from the R₀ in `motion`. The
/// condition is Σ wᵢ Xᵢ × x̂ᵢ = 0 with x̂ᵢ = R₀ᵀ(xᵢ − x̄). The exact variation is δΘ₀ = D⁻¹ Σ wᵢ Xᵢ~ R₀ᵀ δxᵢ, D = Σ wᵢ
/// ((Xᵢ·x̂ᵢ) 1 − x̂ᵢ Xᵢᵀ). X counts from its mean with the weights w, as x does from x̄.
template <class S, class Node>
void polar(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  Vec3<S> mean = Vec3<S>::Zero();
  for (const int j : body.translation_nodes) {
    const auto i = static_cast<std::size_t>(j);
    mean += body.node[i].polar_weight * nodes[i].x;
  }
  Mat3<S> inverse;
  for (int iteration = 0;; ++iteration) {
    Mat3<S> D = Mat3<S>::Zero();
    Vec3<S> h = Vec3<S>::Zero();
    for (const int j : body.translation_nodes) {
      const auto i = static_cast<std::size_t>(j);
      const double w = body.node[i].polar_weight;
      const Vec3<S> X = body.node[i].X_polar.template cast<S>();
      const Vec3<S> xh = motion.R0.transpose() * (nodes[i].x - mean);
      h += w * cross<S>(X, xh);
      D += w * (dot3<S>(X, xh) * Mat3<S>::Identity() - xh * X.transpose());
    }
    inverse = inverse3<S>(D);
    const Vec3<S> correction = inverse * h;
    motion.frame_iterations = iteration;
    motion.frame_error = size<S>(correction);
    if ((motion.frame_error < kTolerance && iteration >= kMinIterations<S>) || iteration == kMaxIterations) break;
    motion.R0 = (motion.R0 * exp_so3<S>(correction)).eval();
  }
  for (const int j : body.translation_nodes) {
    const auto i = static_cast<std::size_t>(j);
    const Vec3<S> wX = (body.node[i].polar_weight * body.node[i].X_polar).template cast<S>();
    motion.node[i].U_x = inverse * skew<S>(wX) * motion.R0.transpose();
  }
}

}  // namespace frame

/// Computes the floating frame R₀, and ψ, T⁻¹ and U of the nodes. Requires in motion.R0 a guess for `karcher` and
/// `polar`, and R_ref for `incremental`.
template <class S, class Node>
void floating_frame(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  motion.frame_iterations = 0;
  motion.frame_error = 0.0;
  switch (body.frame) {
    case FrameAlgorithm::single_node:
      frame::single_node(body, nodes, motion);
      break;
    case FrameAlgorithm::pair:
      frame::pair(body, nodes, motion);
      break;
    case FrameAlgorithm::karcher:
      frame::karcher(body, nodes, motion);
      break;
    case FrameAlgorithm::incremental:
      frame::incremental(body, nodes, motion);
      break;
    case FrameAlgorithm::polar:
      frame::polar(body, nodes, motion);
      break;
  }
}

}  // namespace tisserand::mechanism
