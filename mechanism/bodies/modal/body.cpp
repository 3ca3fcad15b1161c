// Sums of [GA00] (8) and (12) over constants of the body, at one instant.
#include "mechanism/bodies/modal/body.hpp"

#include "common/math/rotation.hpp"
#include "mechanism/bodies/modal/in_plane.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Σ a × b of P = Σ a bᵀ.
template <class Matrix>
Vector3d vee(const Matrix& P) {
  return {P(1, 2) - P(2, 1), P(2, 0) - P(0, 2), P(0, 1) - P(1, 0)};
}

/// The matrix V with vee(P)·e = Σ_kl P_kl V_kl.
Matrix3d vee_weights(const Vector3d& e) { return -skew<double>(e); }

Eigen::Map<const Matrix3d> block(const Eigen::VectorXd& blocks, Index j) {
  return Eigen::Map<const Matrix3d>(blocks.data() + 9 * j);
}

/// tr(P) 1 − P: inertia of Σ m a aᵀ = P.
Matrix3d inertia_of(const Matrix3d& P) { return P.trace() * Matrix3d::Identity() - P; }

/// Entry (j, i) += weights : P2_ij.
template <class Block>
void add_contraction(const ModalBody& body, const Matrix3d& weights, Block&& target) {
  const Eigen::Map<const Eigen::Matrix<double, 9, 1>> flat(weights.data());
  for (Index i = 0; i < body.modes; ++i) {
    const Eigen::Map<const Eigen::Matrix<double, 9, Eigen::Dynamic>> column(body.P2.col(i).data(), 9, body.modes);
    target.col(i).noalias() += column.transpose().lazyProduct(flat);
  }
}

void add_mass(const ModalBody& body, double factor, ModalScratch& s) {
  auto& K = s.tangent;
  const Index m = body.modes;
  K.diagonal().head<3>().array() += factor * body.mass;
  const Matrix3d coupling = -factor * s.A * skew<double>(s.c);
  K.block<3, 3>(0, 3) += coupling;
  K.block<3, 3>(3, 0) += coupling.transpose();
  K.block<3, 3>(3, 3) += factor * s.J;
  K.diagonal().tail(m).array() += factor;
  for (Index j = 0; j < m; ++j) {
    const Vector3d translation = factor * (s.A * body.C1.col(j)), rotation = factor * s.N.col(j);
    K.col(6 + j).segment<3>(0) += translation;
    K.col(6 + j).segment<3>(3) += rotation;
    K.row(6 + j).segment<3>(0) += translation.transpose();
    K.row(6 + j).segment<3>(3) += rotation.transpose();
  }
}

/// −∂s/∂v and the damping of the modes.
void add_damping(const ModalBody& body, double factor, ModalScratch& s) {
  auto& K = s.tangent;
  const Index m = body.modes;
  const Matrix3d turn = skew<double>(s.om);
  K.block<3, 3>(0, 3) +=
      factor * s.A * (-skew<double>(s.om.cross(s.c)) - turn * skew<double>(s.c) - 2.0 * skew<double>(s.cd));
  K.block<3, 3>(3, 3) +=
      factor * (turn * s.J - skew<double>(s.J * s.om) + 2.0 * (s.D.trace() * Matrix3d::Identity() - s.D.transpose()) -
                skew<double>(body.N_mu.lazyProduct(s.wd)));
  for (Index j = 0; j < m; ++j) {
    const auto S = block(s.S, j);
    const double trace = S.trace();
    const Vector3d Nj = body.N_mu.col(j);
    K.col(6 + j).segment<3>(0) += (2.0 * factor) * (s.A * s.om.cross(body.C1.col(j)));
    K.col(6 + j).segment<3>(3) += factor * (2.0 * (trace * s.om - S.transpose() * s.om) + s.om.cross(Nj));
    K.row(6 + j).segment<3>(3) +=
        factor * (S * s.om + S.transpose() * s.om - 2.0 * trace * s.om + 2.0 * vee(block(s.Sd, j))).transpose();
  }
  add_contraction(body, 2.0 * factor * vee_weights(s.om), K.bottomRightCorner(m, m));
  K.diagonal().tail(m) += factor * body.damping;
}

/// ∂(M v̇ − s − g)/∂q at fixed velocities and accelerations, and the stiffness of the modes.
void add_stiffness(const ModalBody& body, double factor, ModalScratch& s) {
  auto& K = s.tangent;
  const Index m = body.modes;
  const Vector3d z =
      s.omd.cross(s.c) + body.C1.lazyProduct(s.wdd) + s.om.cross(s.om.cross(s.c)) + 2.0 * s.om.cross(s.cd);
  const Matrix3d ga = skew<double>(s.ga), turn = skew<double>(s.om);
  K.block<3, 3>(0, 3) -= factor * s.A * skew<double>(z);
  K.block<3, 3>(3, 3) += factor * skew<double>(s.c) * ga;
  for (Index i = 0; i < m; ++i) {
    const auto S = block(s.S, i), Sd = block(s.Sd, i);
    const Vector3d Ci = body.C1.col(i);
    const Matrix3d Ji = inertia_of(S + S.transpose());  // ∂J/∂w_i
    K.col(6 + i).segment<3>(0) += factor * (s.A * (s.omd.cross(Ci) + s.om.cross(s.om.cross(Ci))));
    // Σ_j ẇ_j P2_ij = Sd_iᵀ, Σ_j a_ij ẅ_j = −vee(Sdd_i)
    K.col(6 + i).segment<3>(3) += factor * (Ci.cross(s.ga) + Ji * s.omd - vee(block(s.Sdd, i)) + turn * (Ji * s.om) +
                                            2.0 * (Sd.trace() * s.om - Sd * s.om));
    K.row(6 + i).segment<3>(3) += factor * Ci.cross(s.ga).transpose();
  }
  const Matrix3d weights = vee_weights(s.omd) + s.om * s.om.transpose() - s.om.squaredNorm() * Matrix3d::Identity();
  add_contraction(body, factor * weights, K.bottomRightCorner(m, m));
  K.diagonal().tail(m) += factor * body.stiffness;
}

}  // namespace

ModalScratch make_scratch(const ModalBody& body) {
  const Index m = body.modes;
  ModalScratch s;
  s.om.setZero();
  s.omd.setZero();
  s.ga.setZero();
  s.c.setZero();
  s.cd.setZero();
  s.A.setIdentity();
  s.J.setZero();
  s.D.setZero();
  s.N.setZero(3, m);
  for (Eigen::VectorXd* modal : {&s.w, &s.wd, &s.wdd}) modal->setZero(m);
  for (Eigen::VectorXd* blocks : {&s.S, &s.Sd, &s.Sdd}) blocks->setZero(body.P1.size());
  s.r.setZero(6 + m);
  s.tangent.setZero(6 + m, 6 + m);
  return s;
}

void update_kinematics(const ModalBody& body, const NodeMotion& frame, const ModalCoordinates& modes,
                       const Vector3d& gravity, ModalScratch& s) {
  if (body.planar) return update_kinematics_in_plane(body, frame, modes, gravity, s);
  const Index m = body.modes;
  s.A = frame.R;
  s.om = frame.Omega;
  s.omd = frame.Omegad;
  s.ga = frame.R.transpose() * (frame.xdd - gravity);
  s.w = Eigen::Map<const Eigen::VectorXd>(modes.w, m);
  s.wd = Eigen::Map<const Eigen::VectorXd>(modes.wd, m);
  s.wdd = Eigen::Map<const Eigen::VectorXd>(modes.wdd, m);
  s.c = body.c0;
  s.c.noalias() += body.C1.lazyProduct(s.w);
  s.cd.noalias() = body.C1.lazyProduct(s.wd);
  s.S = body.P1;
  s.S.noalias() += body.P2 * s.w;
  s.Sd.noalias() = body.P2 * s.wd;
  s.D.setZero();
  Matrix3d P = body.P0;  // Σ m b bᵀ
  for (Index j = 0; j < m; ++j) {
    const auto S = block(s.S, j);
    P += s.w[j] * (S + block(body.P1, j).transpose());
    s.D += s.wd[j] * S;
    s.N.col(j) = vee(S) + body.N_mu.col(j);
  }
  s.J = inertia_of(P) + body.J_mu;
}

void residual(const ModalBody& body, ModalScratch& s) {
  if (body.planar) return residual_in_plane(body, s);
  const Index m = body.modes;
  const Vector3d inner = body.mass * s.ga + s.omd.cross(s.c) + body.C1.lazyProduct(s.wdd) +
                         s.om.cross(s.om.cross(s.c)) + 2.0 * s.om.cross(s.cd);
  s.r.head<3>() = s.A * inner;
  s.r.segment<3>(3) = s.c.cross(s.ga) + s.J * s.omd + s.N.lazyProduct(s.wdd) + s.om.cross(s.J * s.om) +
                      2.0 * (s.D.trace() * s.om - s.D.transpose() * s.om) +
                      s.om.cross(body.N_mu.lazyProduct(s.wd).eval());
  const double square = s.om.squaredNorm();
  for (Index j = 0; j < m; ++j) {
    const auto S = block(s.S, j);
    s.r[6 + j] = body.C1.col(j).dot(s.ga) + s.N.col(j).dot(s.omd) + s.wdd[j] + s.om.dot(S * s.om) - square * S.trace() +
                 2.0 * s.om.dot(vee(block(s.Sd, j))) + body.stiffness[j] * s.w[j] + body.damping[j] * s.wd[j];
  }
}

void tangent(const ModalBody& body, const TangentCoefficients& coefficients, ModalScratch& s) {
  if (body.planar) return tangent_in_plane(body, coefficients, s);
  s.tangent.setZero();
  s.Sdd.noalias() = body.P2 * s.wdd;
  if (coefficients.mass != 0.0) add_mass(body, coefficients.mass, s);
  if (coefficients.damping != 0.0) add_damping(body, coefficients.damping, s);
  if (coefficients.stiffness != 0.0) add_stiffness(body, coefficients.stiffness, s);
}

ModalEnergy energy(const ModalBody& body, const NodeMotion& frame, const Vector3d& gravity, const ModalScratch& s) {
  ModalEnergy e;
  const Vector3d velocity = s.A.transpose() * frame.xd;
  e.kinetic = 0.5 * (body.mass * velocity.squaredNorm() + s.om.dot(s.J * s.om) + s.wd.squaredNorm()) +
              velocity.dot(s.om.cross(s.c) + s.cd) + s.om.dot(s.N.lazyProduct(s.wd).eval());
  e.strain = 0.5 * body.stiffness.dot(s.w.cwiseAbs2());
  e.potential = -gravity.dot(body.mass * frame.x + s.A * s.c);
  return e;
}

}  // namespace tisserand::mechanism
