// Node of a modal body: its motion as a function of the frame and the modes, which is how joints and loads reach the
// body.
#pragma once

#include <string>

#include <Eigen/Core>

#include "mechanism/bodies/modal/body.hpp"
#include "mechanism/frames/motion.hpp"

namespace tisserand::mechanism {

/// x = r + A b, b = x_k + Xd w; R = A E, E = exp(θ~), θ = Xt w (body axes). Differs from [GA00], which takes 1 + θ~ for
/// E and θ̇ for its rate: that is no rotation, and its rigid joints are not integrable (DECISIONS.md).
struct ModalNode {
  std::string name;
  int body = 0;         ///< of Model::modal_bodies
  int node = 0;         ///< of Model::nodes
  bool turns = true;    ///< its rotation is known: rows of rotations in the file, or a reference node
  bool active = false;  ///< a joint, coordinate or load acts on it: its motion is needed in every evaluation
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Eigen::Matrix3Xd Xd;
  Eigen::Matrix3Xd Xt;
};

/// Terms of a node at one instant, sized once.
struct ModalNodeTerms {
  Eigen::Vector3d b, theta, rate;              ///< b, θ, θ̇
  Eigen::Vector3d om;                          ///< ω of the frame, body axes
  Eigen::Matrix3d A, E, L;                     ///< L = T(θ)ᵀ: L θ̇ is the rate of the node relative to the body
  Eigen::Matrix<double, 6, Eigen::Dynamic> T;  ///< [ẋ; Ω] = T [ṙ ω ẇ]
  Eigen::Matrix<double, 6, 1> bias;            ///< Ṫ [ṙ ω ẇ]
};

ModalNodeTerms make_terms(const ModalNode& node);

/// Motion of the node and what its derivatives need; `frame` is the motion of the body's frame. In the plane of planar
/// bodies, D = 2, what leaves it stays as make_terms() leaves it.
template <int D>
void update_node(const ModalNode& node, const ModalScratch& body, const NodeMotion& frame, NodeMotion& motion,
                 ModalNodeTerms& terms);

/// Z = ∂(T v)/∂[r Θ w] at the v of the last update_node(), 6 x (6 + m).
void rate_gradient(const ModalNode& node, const ModalScratch& body, const ModalNodeTerms& terms,
                   Eigen::Ref<Eigen::MatrixXd> Z);

/// K += ∂(Tᵀ F)/∂[r Θ w] at a fixed F = [force world; moment node axes]: the tangent of followers at the node.
void add_geometric_stiffness(const ModalNode& node, const ModalNodeTerms& terms,
                             const Eigen::Matrix<double, 6, 1>& force, Eigen::Ref<Eigen::MatrixXd> K);

}  // namespace tisserand::mechanism
