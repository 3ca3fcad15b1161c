// SPDX-License-Identifier: GPL-3.0-or-later
// Floating frames of planar superelement bodies, for any scalar: rotations add, and T⁻¹ is 1.
#pragma once

#include <cmath>

#include "mechanism/bodies/superelement/frame/frame.hpp"
#include "mechanism/frames/space.hpp"

namespace tisserand::mechanism::planar {

template <class S>
Mat3<S> about_z(const S& cosine, const S& sine) {
  Mat3<S> R = Mat3<S>::Zero();
  R(0, 0) = R(1, 1) = cosine;
  R(1, 0) = sine;
  R(0, 1) = -sine;
  R(2, 2) = S(1.0);
  return R;
}

/// Sets the frame of a planar body from the rotations of its nodes: θ₀ = Σ αⱼ θⱼ, with angles θⱼ from the first of the
/// nodes. In the plane all frames from rotations are equal to this one.
template <class S, class Node>
void frame_of_rotations(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  using std::cos, std::sin;
  const Mat3<S>& first = nodes[body.rotation_nodes.front()].R;
  S mean(0.0);
  for (const int j : body.rotation_nodes) {
    const Mat3<S>& R = nodes[j].R;
    const S c = first(0, 0) * R(0, 0) + first(1, 0) * R(1, 0), s = first(0, 0) * R(1, 0) - first(1, 0) * R(0, 0);
    motion.node[j].psi.z() = atan2_scalar(s, c);
    mean += body.node[j].alpha_rotation * motion.node[j].psi.z();
  }
  const S c = cos(mean), s = sin(mean);
  motion.R0 = about_z<S>(first(0, 0) * c - first(1, 0) * s, first(1, 0) * c + first(0, 0) * s);
  for (const int j : body.rotation_nodes) {
    motion.node[j].psi.z() -= mean;
    motion.node[j].U(2, 2) = S(body.node[j].alpha_rotation);
  }
}

/// Sets the frame of a planar body from the positions of its nodes: tan θ₀ = Σ w X × d / Σ w X·d, d = x − x̄. x̄ is the
/// mean with the weights w of THEORY (16). Row z of U_x is the variation of θ₀.
template <class S, class Node>
void frame_of_places(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  using std::sqrt;
  Vec3<S> mean = Vec3<S>::Zero();
  for (const int j : body.translation_nodes) mean += body.node[j].polar_weight * nodes[j].x;
  S c(0.0), s(0.0);
  for (const int j : body.translation_nodes) {
    const Vec3<S> wX = (body.node[j].polar_weight * body.node[j].X_polar).template cast<S>();
    const Vec3<S> d = nodes[j].x - mean;
    c += wX.x() * d.x() + wX.y() * d.y();
    s += wX.x() * d.y() - wX.y() * d.x();
  }
  const S size = sqrt(c * c + s * s);
  motion.R0 = about_z<S>(c / size, s / size);
  for (const int j : body.translation_nodes) {
    const Vec3<S> wX = (body.node[j].polar_weight * body.node[j].X_polar).template cast<S>();
    motion.node[j].U_x.row(2) = (motion.R0 * Vec3<S>(-wX.y() / size, wX.x() / size, S(0.0))).transpose();
  }
}

/// Computes the floating frame of a planar body: R₀, and ψ, U and U_x of the nodes.
template <class S, class Node>
void floating_frame(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  motion.frame_iterations = 0;
  motion.frame_error = 0.0;
  if (body.frame == FrameAlgorithm::polar)
    frame_of_places(body, nodes, motion);
  else
    frame_of_rotations(body, nodes, motion);
}

}  // namespace tisserand::mechanism::planar
