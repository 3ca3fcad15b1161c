// SPDX-License-Identifier: GPL-3.0-or-later
// Node of a modal body: its motion as a function of the frame and the modes. Joints and loads act on the body through
// it.
#pragma once

#include <string>

#include <Eigen/Core>

#include "mechanism/bodies/modal/body.hpp"
#include "mechanism/frames/motion.hpp"

namespace tisserand::mechanism {

/// Kinematics: x = r + A b, b = x_k + Xd w; R = A E, E = exp(θ~), θ = Xt w (body axes). Differs from [GA00], which
/// takes 1 + θ~ for E and θ̇ for its rate: that is no rotation, and its rigid joints are not integrable (DECISIONS.md).
struct ModalNode {
  std::string name;
  int body = 0;         ///< index in Model::modal_bodies
  int node = 0;         ///< index in Model::nodes
  bool turns = true;    ///< its rotation is known, from rows of rotations in the file or a reference node
  bool active = false;  ///< a joint, coordinate or load acts on it, so every evaluation needs its motion
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Eigen::Matrix3Xd Xd;
  Eigen::Matrix3Xd Xt;
};

/// Terms of a node at one instant, allocated once.
struct ModalNodeTerms {
  Eigen::Vector3d b, theta, rate;              ///< b, θ, θ̇
  Eigen::Vector3d om;                          ///< ω of the frame, body axes
  Eigen::Matrix3d A, E, L;                     ///< L = T(θ)ᵀ: L θ̇ is the rate of the node relative to the body
  Eigen::Matrix<double, 6, Eigen::Dynamic> T;  ///< [ẋ; Ω] = T [ṙ ω ẇ]
  Eigen::Matrix<double, 6, 1> bias;            ///< Ṫ [ṙ ω ẇ]
};

ModalNodeTerms make_terms(const ModalNode& node);

/// Computes the motion of the node and the terms of its derivatives; `frame` is the motion of the body's frame. With
/// D = 2 (planar bodies) components out of the plane stay as make_terms() sets them.
template <int D>
void update_node(const ModalNode& node, const ModalScratch& body, const NodeMotion& frame, NodeMotion& motion,
                 ModalNodeTerms& terms);

/// Computes Z = ∂(T v)/∂[r Θ w] at the v of the last update_node(), 6 x (6 + m).
void rate_gradient(const ModalNode& node, const ModalScratch& body, const ModalNodeTerms& terms,
                   Eigen::Ref<Eigen::MatrixXd> Z);

/// Adds the tangent of follower forces to K: ∂(Tᵀ F)/∂[r Θ w] at a fixed F = [force world; moment node axes].
void add_geometric_stiffness(const ModalNode& node, const ModalNodeTerms& terms,
                             const Eigen::Matrix<double, 6, 1>& force, Eigen::Ref<Eigen::MatrixXd> K);

}  // namespace tisserand::mechanism
