// SPDX-License-Identifier: GPL-3.0-or-later
// Deflection, wrench and tangent of bushings; translations are the relations `along` the axes of A.
#include "mechanism/forces/bushing.hpp"

#include "common/math/rotation.hpp"
#include "mechanism/forces/relative_turn.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Rows3 = Eigen::Matrix<double, 3, 12>;

/// Rotation R_AB of the markers; relative_increment() gives J of δΘ = J δq of B relative to A, in axes of marker B.
Matrix3d relative_rotation(const MarkerPair& p) {
  return marker_rotation(p.a, p.node_a).transpose() * marker_rotation(p.b, p.node_b);
}
Rows3 relative_increment(const MarkerPair& p, const Matrix3d& R) {
  Rows3 J = Rows3::Zero();
  J.block<3, 3>(0, 3) = -R.transpose() * p.a.R.transpose();
  J.block<3, 3>(0, 9) = p.b.R.transpose();
  return J;
}

constexpr Relation along(int i) { return {RelationKind::along, static_cast<std::uint8_t>(i), 0}; }

}  // namespace

void evaluate(const Bushing& bushing, const MarkerPair& pair, double near, BushingTerms& terms) {
  for (int i = 0; i < 3; ++i) {
    const RelationTerms p = evaluate(along(i), pair);
    terms.deflection[i] = p.value;
    terms.J.row(i) = p.G;
  }
  const Matrix3d R = relative_rotation(pair);
  const RelativeTurn turn(R, bushing.axis, near);
  terms.deflection.tail<3>() = turn.psi();
  terms.J.bottomRows<3>().noalias() = turn.B() * relative_increment(pair, R);
  Vector12d v;
  v << pair.node_a.xd, pair.node_a.Omega, pair.node_b.xd, pair.node_b.Omega;
  const Vector6d rate = terms.J.lazyProduct(v);
  const Vector6d stretch = terms.deflection - bushing.free;
  const Vector6d elastic = bushing.stiffness.lazyProduct(stretch);
  const Vector6d viscous = bushing.damping.lazyProduct(rate);
  const Vector6d symmetric = 0.5 * (elastic + bushing.stiffness.transpose().lazyProduct(stretch));
  terms.w = elastic + viscous - bushing.preload;
  terms.force.noalias() = terms.J.transpose().lazyProduct(terms.w);
  terms.energy = 0.5 * stretch.dot(symmetric) - bushing.preload.dot(stretch);
  terms.dissipated = rate.dot(viscous);
  terms.supplied = -rate.dot(elastic - symmetric);
}

void tangent(const Bushing& bushing, const MarkerPair& pair, const BushingTerms& terms,
             const TangentCoefficients& coefficients, Square12& A) {
  const Matrix3d R = relative_rotation(pair);
  const RelativeTurn turn(R, bushing.axis, bushing.axis < 0 ? 0.0 : terms.deflection[3 + bushing.axis]);
  const Rows3 J = relative_increment(pair, R);
  // ∂ḋ/∂q at fixed v; δ(RᵀΩ_A) = (RᵀΩ_A)~ δΘ.
  Eigen::Matrix<double, 6, 12> N;
  Square12 geometric = Square12::Zero();
  for (int i = 0; i < 3; ++i) {
    N.row(i) = rate_gradient(along(i), pair);
    add_stiffness(along(i), pair, terms.w[i], geometric);
  }
  const Vector3d Omega_A = R.transpose() * (pair.a.R.transpose() * pair.node_a.Omega);
  const Vector3d omega = pair.b.R.transpose() * pair.node_b.Omega - Omega_A;
  N.bottomRows<3>().noalias() = (turn.rate_gradient(omega) - turn.B() * skew<double>(Omega_A)) * J;
  // The moment m = Bᵀ w_ψ in axes of marker B acts on the nodes as +R_MB m on B and −R_MA R m on A.
  const Vector3d w_psi = terms.w.tail<3>();
  const Vector3d m = turn.B().transpose() * w_psi;
  const Matrix3d dm = turn.moment_gradient(w_psi);
  geometric.middleRows<3>(9).noalias() += pair.b.R * dm * J;
  geometric.middleRows<3>(3).noalias() -= pair.a.R * R * (dm - skew<double>(m)) * J;
  const Eigen::Matrix<double, 6, 12> dw = coefficients.stiffness * (bushing.stiffness * terms.J + bushing.damping * N) +
                                          coefficients.damping * (bushing.damping * terms.J);
  A.noalias() = terms.J.transpose() * dw;
  A += coefficients.stiffness * geometric;
}

}  // namespace tisserand::mechanism
