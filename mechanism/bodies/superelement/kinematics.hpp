// Local coordinates of a superelement body, for every scalar: from node motions and the floating frame to y, ẏ, ÿ.
#pragma once

#include <cstddef>

#include "mechanism/bodies/superelement/frame.hpp"
#include "mechanism/bodies/superelement/momentum.hpp"
#include "mechanism/bodies/superelement/planar.hpp"

namespace tisserand::mechanism {

/// ẏ_B = Υ q̇: u̇ᵢ = R₀ᵀ(ẋᵢ − ẋ₀) + x̂ᵢ × Ω₀, ψ̇ᵢ = T⁻¹(ψᵢ) Ωᵢ − T⁻¹(−ψᵢ) Ω₀.
template <class S, class Node>
void deformation_rates(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  if (body.planar) {
    planar::deformation_rates(body, nodes, motion);
    return;
  }
  Vec3<S> x0d = Vec3<S>::Zero();
  for (const int j : body.translation_nodes) {
    const auto i = static_cast<std::size_t>(j);
    x0d += body.node[i].alpha * motion.node[i].xd;
  }
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    const LocalNode<S>& local = motion.node[i];
    if (node.has_translation())
      motion.deformation_rate_B.template segment<3>(node.translation_row) =
          local.xd - x0d + cross<S>(local.xh, motion.Omega0);
    if (node.has_rotation())
      motion.deformation_rate_B.template segment<3>(node.rotation_row) =
          local.Tinv * nodes[i].Omega - local.Tinv.transpose() * motion.Omega0;
  }
}

/// y_B and the rates and accelerations of the inertia: ẏ = P q̇, ÿ = P q̈ + V Ω₀ ([Car00] (36)-(41), (52)-(58)).
template <class S, class Node>
void local_rates(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  const bool option_A = body.inertia == formats::InertiaOption::A;
  const Mat3<S> R0T = motion.R0.transpose();
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    LocalNode<S>& local = motion.node[i];
    if (node.has_translation()) {
      const int row = node.translation_row;
      local.xh.noalias() = R0T * (nodes[i].x - motion.x0);
      motion.y_B.template segment<3>(row) = local.xh - node.X;
      motion.rate_B.template segment<3>(row) = local.xd;
      motion.acceleration_B.template segment<3>(row) = R0T * nodes[i].xdd + cross<S>(local.xd, motion.Omega0);
    }
    if (node.has_rotation()) {
      const int row = node.rotation_row;
      motion.y_B.template segment<3>(row) = local.psi;
      if (option_A) {
        local.Omega = local.E * nodes[i].Omega;
        motion.acceleration_B.template segment<3>(row) =
            local.E * nodes[i].Omegad + cross<S>(local.Omega, motion.Omega0);
      } else {
        local.Omega = nodes[i].Omega;
        motion.acceleration_B.template segment<3>(row) = nodes[i].Omegad;
      }
      motion.rate_B.template segment<3>(row) = local.Omega;
    }
  }
}

/// Everything of LocalMotion except the internal coordinates, which the caller copies in. motion.R0 as in
/// floating_frame().
template <class S, class Node>
void local_motion(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  const bool exact_center = body.inertia == formats::InertiaOption::M;
  const bool second_derivatives = exact_center || body.second_order.inertia;
  const bool deformation = body.damping.active || second_derivatives || !body.load_cases.empty();
  if (body.planar) {
    planar::local_motion(body, nodes, deformation, second_derivatives, motion);
    if (exact_center) center_of_mass_motion(body, motion);
    return;
  }
  floating_frame(body, nodes, motion);
  motion.x0.setZero();
  motion.Omega0.setZero();
  const Mat3<S> R0T = motion.R0.transpose();
  for (const int j : body.translation_nodes) {
    const auto i = static_cast<std::size_t>(j);
    motion.x0 += body.node[i].alpha * nodes[i].x;
    motion.node[i].xd.noalias() = R0T * nodes[i].xd;
    if (body.frame == FrameAlgorithm::polar) motion.Omega0 += motion.node[i].U_x * nodes[i].xd;
  }
  for (const int j : body.rotation_nodes) {
    const auto i = static_cast<std::size_t>(j);
    motion.Omega0 += motion.node[i].U * nodes[i].Omega;
  }
  local_rates(body, nodes, motion);
  if (deformation) deformation_rates(body, nodes, motion);
  if (second_derivatives) deformation_accelerations(body, nodes, motion);
  if (exact_center) center_of_mass_motion(body, motion);
}

}  // namespace tisserand::mechanism
