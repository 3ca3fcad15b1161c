// SPDX-License-Identifier: GPL-3.0-or-later
// Node of a modal body: its motion as a function of the frame and the modes. Joints and loads act on the body through
// it.
#pragma once

#include <string>

#include <Eigen/Core>

#include "mechanism/bodies/modal/body.hpp"
#include "mechanism/frames/motion.hpp"

namespace tisserand::mechanism {

/// Constants of a node of a modal body, and its place in the model. Its motion is x = r + A b with b = x_k + Xd w, and
/// R = A E with E = exp(θ~), θ = Xt w (body axes). r and A are position and axes of the frame, w the m modal
/// coordinates. Differs from [GA00], which takes 1 + θ~ for E and θ̇ for its rate: that is no rotation, and its rigid
/// joints are not integrable (DECISIONS.md).
struct ModalNode {
  std::string name;
  int body = 0;         ///< index in Model::modal_bodies
  int node = 0;         ///< index in Model::nodes
  bool turns = true;    ///< its rotation is known: from the file or as a reference node
  bool active = false;  ///< a joint, coordinate or load acts on it; evaluated every time
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Eigen::Matrix3Xd Xd;
  Eigen::Matrix3Xd Xt;
};

/// Terms of a node of a modal body at one instant, allocated once. ṙ, ω and ẇ are the rates of the body.
struct ModalNodeTerms {
  Eigen::Vector3d b, theta, rate;              ///< b, θ and θ̇ of ModalNode
  Eigen::Vector3d om;                          ///< ω of the frame, body axes
  Eigen::Matrix3d A, E, L;                     ///< L = T(θ)ᵀ: L θ̇ is the rate of the node relative to the body
  Eigen::Matrix<double, 6, Eigen::Dynamic> T;  ///< (6 x (6 + m)): [ẋ; Ω] = T [ṙ ω ẇ]
  Eigen::Matrix<double, 6, 1> bias;            ///< Ṫ [ṙ ω ẇ]: [ẍ; Ω̇] less T times the accelerations
};

ModalNodeTerms make_terms(const ModalNode& node);

/// Computes the motion of the node, and in `terms` the terms of its derivatives. `frame`: motion of the frame of the
/// body. With D = 2 (planar bodies) components out of the plane stay as make_terms() sets them.
template <int D>
void update_node(const ModalNode& node, const ModalScratch& body, const NodeMotion& frame, NodeMotion& motion,
                 ModalNodeTerms& terms);

/// Computes Z = ∂(T v)/∂[r Θ w] (6 x (6 + m)), the derivative of the velocity [ẋ; Ω] = T v of the node by positions. v
/// are the rates at the last update_node().
void rate_gradient(const ModalNode& node, const ModalScratch& body, const ModalNodeTerms& terms,
                   Eigen::Ref<Eigen::MatrixXd> Z);

/// Adds to K the geometric stiffness ∂(Tᵀ F)/∂[r Θ w] of a fixed force F = [force world; moment node axes] on the node.
/// Requires update_node().
void add_geometric_stiffness(const ModalNode& node, const ModalNodeTerms& terms,
                             const Eigen::Matrix<double, 6, 1>& force, Eigen::Ref<Eigen::MatrixXd> K);

}  // namespace tisserand::mechanism
