// SPDX-License-Identifier: GPL-3.0-or-later
// Local coordinates y, ẏ, ÿ of a superelement body from node motions and the floating frame, for any scalar, in space
// and in the plane.
#pragma once

#include <cstddef>

#include "mechanism/bodies/superelement/frame/frame.hpp"
#include "mechanism/bodies/superelement/frame/momentum.hpp"
#include "mechanism/bodies/superelement/frame/planar.hpp"
#include "mechanism/frames/space.hpp"

namespace tisserand::mechanism {

/// Sets the rates of deformation ẏ_B = Υ q̇ and the velocity of x₀, THEORY (23): u̇ᵢ = R₀ᵀ(ẋᵢ − ẋ₀) + x̂ᵢ × Ω₀,
/// ψ̇ᵢ = T⁻¹(ψᵢ) Ωᵢ − T⁻¹(−ψᵢ) Ω₀.
template <int D, class S, class Node>
void deformation_rates_in(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  motion.origin_velocity.setZero();
  for (const int j : body.translation_nodes) {
    const auto i = static_cast<std::size_t>(j);
    motion.origin_velocity += body.node[i].alpha * motion.node[i].xd;
  }
  const auto& x0d = vector_part<D>(motion.origin_velocity);
  const auto& w = turn_part<D>(motion.Omega0);
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    const LocalNode<S>& local = motion.node[i];
    if (node.has_translation())
      motion.deformation_rate_B.template segment<D>(node.translation_row) =
          vector_part<D>(local.xd) - x0d + wedge(vector_part<D>(local.xh), w);
    if (node.has_rotation())
      motion.deformation_rate_B.template segment<Space<D>::turns>(node.rotation_row) =
          turn_part<D>(local.Tinv) * turn_part<D>(nodes[i].Omega) - turn_part<D>(local.Tinv).transpose() * w;
  }
}
template <class S, class Node>
void deformation_rates(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  in_space(body.planar, [&]<int D>() { deformation_rates_in<D>(body, nodes, motion); });
}

/// Computes accelerations ÿ_B of the deformation, Ω̇₀ and the acceleration of x₀, THEORY (24). ü = R₀ᵀ(ẍ − ẍ₀) − 2 Ω₀ ×
/// u̇ − Ω₀ × (Ω₀ × x̂) − Ω̇₀ × x̂, and ψ̈ is the derivative of T⁻¹(ψ) Ω − T⁻¹(−ψ) Ω₀. Requires deformation_rates().
template <int D, class S, class Node>
void deformation_accelerations_in(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  const Mat3<S> R0T = motion.R0.transpose();
  turning_biases<D>(body, nodes, motion);
  turn_part<D>(motion.Omega0d) = frame_acceleration<D>(body, nodes, motion);
  const auto& w = turn_part<D>(motion.Omega0);
  const auto& wd = turn_part<D>(motion.Omega0d);
  const auto& x0dd = vector_part<D>(motion.origin_acceleration);
  motion.origin_acceleration.setZero();
  for (const int j : body.translation_nodes) {
    const auto i = static_cast<std::size_t>(j);
    vector_part<D>(motion.origin_acceleration) +=
        body.node[i].alpha * (vector_part<D>(R0T) * vector_part<D>(nodes[i].xdd));
  }
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    const LocalNode<S>& local = motion.node[i];
    if (node.has_translation()) {
      const auto& xh = vector_part<D>(local.xh);
      const auto rate = motion.deformation_rate_B.template segment<D>(node.translation_row);
      motion.deformation_acceleration_B.template segment<D>(node.translation_row) =
          vector_part<D>(R0T) * vector_part<D>(nodes[i].xdd) - x0dd - 2.0 * wedge(w, rate) - wedge(w, wedge(w, xh)) -
          wedge(wd, xh);
    }
    if (node.has_rotation())
      motion.deformation_acceleration_B.template segment<Space<D>::turns>(node.rotation_row) +=
          turn_part<D>(local.Tinv) * turn_part<D>(nodes[i].Omegad) - turn_part<D>(local.Tinv).transpose() * wd;
  }
}
template <class S, class Node>
void deformation_accelerations(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  in_space(body.planar, [&]<int D>() { deformation_accelerations_in<D>(body, nodes, motion); });
}

/// Computes y_B of THEORY (17), and the rates P q̇ and P q̈ + V Ω₀ of the inertia by THEORY (26) and (29).
template <int D, class S, class Node>
void local_rates(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  constexpr int T = Space<D>::turns;
  const bool option_A = body.inertia == formats::InertiaOption::A;
  const Mat3<S> R0T = motion.R0.transpose();
  const auto& w = turn_part<D>(motion.Omega0);
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    LocalNode<S>& local = motion.node[i];
    if (node.has_translation()) {
      const int row = node.translation_row;
      const auto& xd = vector_part<D>(local.xd);
      vector_part<D>(local.xh).noalias() = vector_part<D>(R0T) * vector_part<D>(nodes[i].x - motion.x0);
      motion.y_B.template segment<D>(row) = vector_part<D>(local.xh) - vector_part<D>(node.X);
      motion.rate_B.template segment<D>(row) = xd;
      motion.acceleration_B.template segment<D>(row) =
          vector_part<D>(R0T) * vector_part<D>(nodes[i].xdd) + wedge(xd, w);
    }
    if (node.has_rotation()) {
      const int row = node.rotation_row;
      const auto& Omega = turn_part<D>(local.Omega);
      const auto& Omegad = turn_part<D>(nodes[i].Omegad);
      motion.y_B.template segment<T>(row) = turn_part<D>(local.psi);
      if (option_A) {
        turn_part<D>(local.Omega) = turn_part<D>(local.E) * turn_part<D>(nodes[i].Omega);
        motion.acceleration_B.template segment<T>(row) = turn_part<D>(local.E) * Omegad + wedge(Omega, w);
      } else {
        local.Omega = nodes[i].Omega;
        motion.acceleration_B.template segment<T>(row) = Omegad;
      }
      motion.rate_B.template segment<T>(row) = Omega;
    }
  }
}

template <int D, class S, class Node>
void local_motion_in(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  if constexpr (D == 2)
    planar::floating_frame(body, nodes, motion);
  else
    floating_frame(body, nodes, motion);
  motion.x0.setZero();
  motion.Omega0.setZero();
  const Mat3<S> R0T = motion.R0.transpose();
  for (const int j : body.translation_nodes) {
    const auto i = static_cast<std::size_t>(j);
    const auto& xd = vector_part<D>(nodes[i].xd);
    motion.x0 += body.node[i].alpha * nodes[i].x;
    vector_part<D>(motion.node[i].xd).noalias() = vector_part<D>(R0T) * xd;
    if (body.frame == FrameAlgorithm::polar)
      turn_part<D>(motion.Omega0) += turns_by_vectors<D>(motion.node[i].U_x) * xd;
  }
  for (const int j : body.rotation_nodes) {
    const auto i = static_cast<std::size_t>(j);
    turn_part<D>(motion.Omega0) += turn_part<D>(motion.node[i].U) * turn_part<D>(nodes[i].Omega);
  }
  local_rates<D>(body, nodes, motion);
}

/// Computes all of LocalMotion except the internal coordinates, which the caller must copy. Requires in motion.R0 the
/// value that floating_frame() requires.
template <class S, class Node>
void local_motion(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  const bool exact_center = body.inertia == formats::InertiaOption::M;
  const bool second_derivatives = exact_center || body.second_order.inertia;
  in_space(body.planar, [&]<int D>() { local_motion_in<D>(body, nodes, motion); });
  if (body.damping.active || second_derivatives || !body.load_cases.empty()) deformation_rates(body, nodes, motion);
  if (second_derivatives) deformation_accelerations(body, nodes, motion);
  if (exact_center) center_of_mass_motion(body, motion);
}

}  // namespace tisserand::mechanism
