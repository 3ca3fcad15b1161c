// Deflection, wrench and tangent of bushings; translations are the relations `along` the axes of A.
#include "mechanism/forces/bushing.hpp"

#include "common/math/rotation.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Rows3 = Eigen::Matrix<double, 3, 12>;

/// Turn of marker B against marker A: R = R_AB of the markers, ψ = log R, δΘ = J δq (axes of marker B).
struct RelativeTurn {
  Matrix3d R;
  Vector3d psi;
  Rows3 J = Rows3::Zero();
  explicit RelativeTurn(const MarkerPair& p)
      : R(marker_rotation(p.a, p.node_a).transpose() * marker_rotation(p.b, p.node_b)), psi(log_so3<double>(R)) {
    J.block<3, 3>(0, 3) = -R.transpose() * p.a.R.transpose();
    J.block<3, 3>(0, 9) = p.b.R.transpose();
  }
};

/// ∂(w + s/2 ψ × w + e ψ × (ψ × w))/∂ψ: of T(ψ)⁻¹ w for s = 1, of T(ψ)⁻ᵀ w for s = −1.
Matrix3d inverse_tangent_gradient(const Vector3d& psi, const Vector3d& w, double s) {
  const AngleFunctions<Dual> f(Dual(psi.squaredNorm(), 1.0));  // e and its derivative by |ψ|²
  const double along = psi.dot(w);
  const Vector3d twice = psi * along - w * psi.squaredNorm();
  Matrix3d G = -0.5 * s * skew<double>(w);
  G += f.e.value * (along * Matrix3d::Identity() + psi * w.transpose() - 2.0 * w * psi.transpose());
  G += 2.0 * f.e.derivative * twice * psi.transpose();
  return G;
}

constexpr Relation along(int i) { return {RelationKind::along, static_cast<std::uint8_t>(i), 0}; }

}  // namespace

void evaluate(const Bushing& bushing, const MarkerPair& pair, BushingTerms& terms) {
  for (int i = 0; i < 3; ++i) {
    const RelationTerms p = evaluate(along(i), pair);
    terms.deflection[i] = p.value;
    terms.J.row(i) = p.G;
  }
  const RelativeTurn turn(pair);
  terms.deflection.tail<3>() = turn.psi;
  terms.J.bottomRows<3>().noalias() = inverse_tangent_so3<double>(turn.psi) * turn.J;
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
  const RelativeTurn turn(pair);
  // ∂ḋ/∂q at fixed v; δ(RᵀΩ_A) = (RᵀΩ_A)~ δΘ.
  Eigen::Matrix<double, 6, 12> N;
  Square12 geometric = Square12::Zero();
  for (int i = 0; i < 3; ++i) {
    N.row(i) = rate_gradient(along(i), pair);
    add_stiffness(along(i), pair, terms.w[i], geometric);
  }
  const Vector3d Omega_A = turn.R.transpose() * (pair.a.R.transpose() * pair.node_a.Omega);
  const Vector3d omega = pair.b.R.transpose() * pair.node_b.Omega - Omega_A;
  const Rows3 J_psi = terms.J.bottomRows<3>();
  N.bottomRows<3>().noalias() = inverse_tangent_gradient(turn.psi, omega, 1.0) * J_psi -
                                inverse_tangent_so3<double>(turn.psi) * skew<double>(Omega_A) * turn.J;
  // The moment m = T⁻ᵀ w_ψ in axes of marker B, turned to the nodes: +R_MB m on B, −R_MA R m on A.
  const Vector3d w_psi = terms.w.tail<3>();
  const Vector3d m = inverse_tangent_so3<double>(turn.psi).transpose() * w_psi;
  const Rows3 dm = inverse_tangent_gradient(turn.psi, w_psi, -1.0) * J_psi;
  geometric.middleRows<3>(9).noalias() += pair.b.R * dm;
  geometric.middleRows<3>(3).noalias() -= pair.a.R * turn.R * (dm - skew<double>(m) * turn.J);
  const Eigen::Matrix<double, 6, 12> dw = coefficients.stiffness * (bushing.stiffness * terms.J + bushing.damping * N) +
                                          coefficients.damping * (bushing.damping * terms.J);
  A.noalias() = terms.J.transpose() * dw;
  A += coefficients.stiffness * geometric;
}

}  // namespace tisserand::mechanism
