// SPDX-License-Identifier: GPL-3.0-or-later
// Exact tangent of a superelement body, by dual numbers.
#include <Eigen/Core>
#include <Eigen/LU>

#include "common/math/dual.hpp"
#include "mechanism/bodies/superelement/tangent/coupling.hpp"
#include "mechanism/bodies/superelement/tangent/tangent.hpp"

namespace tisserand::mechanism {
namespace {

using Node = NodeMotionOf<Dual>;

Vec3<Dual> with_derivative(const Eigen::Vector3d& value, const Eigen::Vector3d& derivative) {
  Vec3<Dual> out;
  for (int i = 0; i < 3; ++i) out[i] = Dual(value[i], derivative[i]);
  return out;
}

Mat3<Dual> with_derivative(const Eigen::Matrix3d& value, const Eigen::Matrix3d& derivative) {
  Mat3<Dual> out;
  for (int i = 0; i < 9; ++i) out(i) = Dual(value(i), derivative(i));
  return out;
}

/// Node motion at v̇ + ε c_m d, v + ε c_c d, q + ε c_k d with the direction d of one node (translation, material
/// rotation).
Node perturbed(const NodeMotion& node, const Eigen::Vector3d& x, const Eigen::Vector3d& theta,
               const TangentCoefficients& c) {
  Node out;
  out.x = with_derivative(node.x, c.stiffness * x);
  out.R = with_derivative(node.R, node.R * skew<double>(c.stiffness * theta));
  out.xd = with_derivative(node.xd, c.damping * x);
  out.Omega = with_derivative(node.Omega, c.damping * theta);
  out.xdd = with_derivative(node.xdd, c.mass * x);
  out.Omegad = with_derivative(node.Omegad, c.mass * theta);
  return out;
}

}  // namespace

// Differentiates (r_B, r_I) column by column. On entry R₀ is the converged one for iterated frames, and for the
// incremental frame the reference that update_kinematics() had.
void whole_exact_tangent(const SuperelementBody& body, const SuperelementScratch& scratch,
                         const NodeView<NodeMotion>& nodes, const Eigen::Vector3d& gravity,
                         const TangentCoefficients& c, Eigen::MatrixXd& A) {
  const int nb = body.boundary_size, n = nb + body.modes;
  A.resize(n, n);
  LocalMotion<Dual> motion = make_local_motion<Dual>(body);
  SuperelementForces<Dual> forces = make_forces<Dual>(body);
  forces.loads.factors = scratch.forces.loads.factors;
  std::vector<Node> moved(body.node.size());
  std::vector<int> index(body.node.size());
  const Eigen::Matrix3d& R0 = body.frame == FrameAlgorithm::incremental ? scratch.R0_reference : scratch.motion.R0;
  for (int column = 0; column < n; ++column) {
    const Eigen::VectorXd direction = Eigen::VectorXd::Unit(n, column);
    for (int i = 0; i < std::ssize(body.node); ++i) {
      const SuperelementNode& node = body.node[i];
      Eigen::Vector3d x = Eigen::Vector3d::Zero(), theta = x;
      if (node.has_translation())
        x.head(body.translations()) = direction.segment(node.translation_row, body.translations());
      if (node.has_rotation()) theta.tail(body.rotations()) = direction.segment(node.rotation_row, body.rotations());
      moved[i] = perturbed(nodes[i], x, theta, c);
      index[i] = i;
    }
    for (int k = 0; k < body.modes; ++k) {
      const double d = direction[nb + k];
      motion.y_I[k] = Dual(scratch.motion.y_I[k], c.stiffness * d);
      motion.rate_I[k] = Dual(scratch.motion.rate_I[k], c.damping * d);
      motion.acceleration_I[k] = Dual(scratch.motion.acceleration_I[k], c.mass * d);
    }
    motion.R0 = R0.cast<Dual>();
    local_motion<Dual>(body, NodeView<Node>{moved.data(), index.data()}, motion);
    superelement_forces(body, motion, gravity, forces);
    for (int i = 0; i < nb; ++i) A(i, column) = forces.r_B[i].derivative;
    for (int k = 0; k < body.modes; ++k) A(nb + k, column) = forces.r_I[k].derivative;
  }
}

void exact_tangent(const SuperelementBody& body, const NodeView<NodeMotion>& nodes, const Eigen::Vector3d& gravity,
                   const TangentCoefficients& coefficients, SuperelementScratch& scratch, SuperelementWork& work) {
  const Eigen::Index nb = body.boundary_size, m = body.modes;
  SuperelementTangent& frozen = scratch.tangent;
  Eigen::MatrixXd A;
  whole_exact_tangent(body, scratch, nodes, gravity, coefficients, A);
  frozen.dense_coupling = true;
  frozen.A_BI = A.topRightCorner(nb, m);
  frozen.A_IB = A.bottomLeftCorner(m, nb);
  work.A_BB = A.topLeftCorner(nb, nb);
  if (m == 0) return;
  frozen.internal.factor(A.bottomRightCorner(m, m));
  eliminate_internal(frozen, work);
}

}  // namespace tisserand::mechanism
