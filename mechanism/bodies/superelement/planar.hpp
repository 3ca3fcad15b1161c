// Superelement bodies that stay in a plane, for every scalar: what is written node by node elsewhere, with two
// translations and one rotation per node. Rotations add up there, T⁻¹ is 1, and inertia options A and B are one.
// Vectors of the frame keep three components, z zero.
#pragma once

#include <cmath>
#include <cstddef>

#include "mechanism/bodies/superelement/frame.hpp"

namespace tisserand::mechanism::planar {

/// R₀ᵀ v of the x-y components.
template <class S>
Vec3<S> in_frame(const Mat3<S>& R0, const Vec3<S>& v) {
  return {R0(0, 0) * v.x() + R0(1, 0) * v.y(), R0(0, 1) * v.x() + R0(1, 1) * v.y(), S(0.0)};
}

/// z of a × b.
template <class S>
S cross_z(const Vec3<S>& a, const Vec3<S>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// w e_z × a.
template <class S>
Vec3<S> turned(const S& w, const Vec3<S>& a) {
  return {-w * a.y(), w * a.x(), S(0.0)};
}

template <class S>
Mat3<S> about_z(const S& cosine, const S& sine) {
  Mat3<S> R = Mat3<S>::Zero();
  R(0, 0) = R(1, 1) = cosine;
  R(1, 0) = sine;
  R(0, 1) = -sine;
  R(2, 2) = S(1.0);
  return R;
}

template <class Vector>
auto vector_at(const Vector& v, int row) {
  using S = typename Vector::Scalar;
  return Vec3<S>(v[row], v[row + 1], S(0.0));
}

/// Rotation nodes: θ₀ = Σ αⱼ θⱼ, angles from the first of them; what all frames of the body are in the plane.
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
  motion.Omega0.setZero();
  for (const int j : body.rotation_nodes) {
    motion.node[j].psi.z() -= mean;
    motion.Omega0.z() += body.node[j].alpha_rotation * nodes[j].Omega.z();
  }
}

/// Nodes without rotations: tan θ₀ = Σ w X × d / Σ w X·d, d = x − x̄; row z of U_x is its variation.
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
    s += cross_z<S>(wX, d);
  }
  const S size = sqrt(c * c + s * s);
  motion.R0 = about_z<S>(c / size, s / size);
  motion.Omega0.setZero();
  for (const int j : body.translation_nodes) {
    const Vec3<S> wX = (body.node[j].polar_weight * body.node[j].X_polar).template cast<S>();
    const Vec3<S> turned_X = motion.R0 * turned<S>(S(1.0) / size, Vec3<S>(wX.x(), wX.y(), S(0.0)));
    motion.node[j].U_x.row(2) = turned_X.transpose();
    motion.Omega0.z() += dot3<S>(turned_X, nodes[j].xd);
  }
}

/// local_rates() of the plane.
template <class S, class Node>
void local_rates(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  const S w = motion.Omega0.z();
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    LocalNode<S>& local = motion.node[i];
    if (const int row = body.node[i].translation_row; row >= 0) {
      local.xh = in_frame<S>(motion.R0, Vec3<S>(nodes[i].x - motion.x0));
      motion.y_B.template segment<2>(row) = (local.xh - body.node[i].X).template head<2>();
      motion.rate_B.template segment<2>(row) = local.xd.template head<2>();
      motion.acceleration_B.template segment<2>(row) =
          (in_frame<S>(motion.R0, nodes[i].xdd) - turned<S>(w, local.xd)).template head<2>();
    }
    if (const int row = body.node[i].rotation_row; row >= 0) {
      local.Omega = nodes[i].Omega;
      motion.y_B[row] = local.psi.z();
      motion.rate_B[row] = nodes[i].Omega.z();
      motion.acceleration_B[row] = nodes[i].Omegad.z();
    }
  }
}

/// ẏ_B = Υ q̇, and the velocity of x₀.
template <class S, class Node>
void deformation_rates(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  const S w = motion.Omega0.z();
  motion.origin_velocity.setZero();
  for (const int j : body.translation_nodes) motion.origin_velocity += body.node[j].alpha * motion.node[j].xd;
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const LocalNode<S>& local = motion.node[i];
    if (const int row = body.node[i].translation_row; row >= 0)
      motion.deformation_rate_B.template segment<2>(row) =
          (local.xd - motion.origin_velocity - turned<S>(w, local.xh)).template head<2>();
    if (const int row = body.node[i].rotation_row; row >= 0) motion.deformation_rate_B[row] = nodes[i].Omega.z() - w;
  }
}

/// Ω̇₀; of places with the bias −2 Ω₀ × x̂' − Ω₀ × (Ω₀ × x̂) as in space.
template <class S, class Node>
S frame_acceleration(const SuperelementBody& body, const NodeView<Node>& nodes, const LocalMotion<S>& motion) {
  const S w = motion.Omega0.z();
  S acceleration(0.0);
  for (const int j : body.rotation_nodes) acceleration += body.node[j].alpha_rotation * nodes[j].Omegad.z();
  if (body.frame != FrameAlgorithm::polar) return acceleration;
  for (const int j : body.translation_nodes) {
    const Vec3<S> rate = vector_at(motion.deformation_rate_B, body.node[j].translation_row);
    const Vec3<S> bias =
        2.0 * turned<S>(w, rate) - (w * w) * Vec3<S>(motion.node[j].xh.x(), motion.node[j].xh.y(), S(0.0));
    const Vec3<S> U = motion.node[j].U_x.row(2).transpose();
    acceleration += dot3<S>(U, Vec3<S>(nodes[j].xdd - motion.R0 * bias));
  }
  return acceleration;
}

/// deformation_accelerations() of the plane.
template <class S, class Node>
void deformation_accelerations(const SuperelementBody& body, const NodeView<Node>& nodes, LocalMotion<S>& motion) {
  const S w = motion.Omega0.z(), wd = planar::frame_acceleration(body, nodes, motion);
  motion.origin_acceleration.setZero();
  for (const int j : body.translation_nodes)
    motion.origin_acceleration += body.node[j].alpha * in_frame<S>(motion.R0, nodes[j].xdd);
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const LocalNode<S>& local = motion.node[i];
    if (const int row = body.node[i].translation_row; row >= 0) {
      const Vec3<S> rate = vector_at(motion.deformation_rate_B, row);
      motion.deformation_acceleration_B.template segment<2>(row) =
          (in_frame<S>(motion.R0, nodes[i].xdd) - motion.origin_acceleration - 2.0 * turned<S>(w, rate) +
           (w * w) * local.xh - turned<S>(wd, local.xh))
              .template head<2>();
    }
    if (const int row = body.node[i].rotation_row; row >= 0)
      motion.deformation_acceleration_B[row] = nodes[i].Omegad.z() - wd;
  }
  motion.Omega0d = Vec3<S>(S(0.0), S(0.0), wd);
}

/// x₀, R₀, Ω₀, y and their rates: local_motion() of the plane but for the centre of mass.
template <class S, class Node>
void local_motion(const SuperelementBody& body, const NodeView<Node>& nodes, bool rates, bool accelerations,
                  LocalMotion<S>& motion) {
  motion.frame_iterations = 0;
  motion.frame_error = 0.0;
  if (body.frame == FrameAlgorithm::polar)
    frame_of_places(body, nodes, motion);
  else
    frame_of_rotations(body, nodes, motion);
  motion.x0.setZero();
  for (const int j : body.translation_nodes) {
    motion.x0 += body.node[j].alpha * nodes[j].x;
    motion.node[j].xd = in_frame<S>(motion.R0, nodes[j].xd);
  }
  planar::local_rates(body, nodes, motion);
  if (rates) planar::deformation_rates(body, nodes, motion);
  if (accelerations) planar::deformation_accelerations(body, nodes, motion);
}

/// Forces on (x₀, Θ₀) and on y as forces on the nodes: `local` f of y on the boundary with `inertia` of the
/// translations added (in axes of the frame), minus α times the total that x₀ takes, and the moment that the frame's
/// rotation passes on.
template <class S, class Vector>
void forces_on_nodes(const SuperelementBody& body, const LocalMotion<S>& motion, const Vec3<S>& total, const S& moment,
                     Vector& r_B) {
  const bool polar = body.frame == FrameAlgorithm::polar;
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    if (node.has_translation()) {
      const Vec3<S> f = vector_at(r_B, node.translation_row) - node.alpha * total;
      Vec3<S> world = motion.R0 * Vec3<S>(f.x(), f.y(), S(0.0));
      if (polar) world += moment * motion.node[i].U_x.row(2).transpose();
      r_B.template segment<2>(node.translation_row) = world.template head<2>();
    }
    if (node.has_rotation() && !polar) r_B[node.rotation_row] += node.alpha_rotation * moment;
  }
}

/// The moment about x₀ of forces `s` on the deformation, with the minus sign of their virtual work by δΘ₀; their sum.
template <class S, class Vector>
S frame_moment(const SuperelementBody& body, const LocalMotion<S>& motion, const Vector& s, Vec3<S>& total) {
  S moment(0.0);
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    if (node.has_translation()) {
      const Vec3<S> f = vector_at(s, node.translation_row);
      total += f;
      moment -= cross_z<S>(motion.node[i].xh, f);
    }
    if (node.has_rotation()) moment -= s[node.rotation_row];
  }
  return moment;
}

}  // namespace tisserand::mechanism::planar
