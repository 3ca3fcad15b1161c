// SPDX-License-Identifier: GPL-3.0-or-later
// Sums of [GA00] (8) and (12) over the constants of a body, at one instant.
#include "mechanism/bodies/modal/body.hpp"

#include "mechanism/frames/space.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Index;
using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Terms of a sum P = Σ a bᵀ in rotations.
template <int D>
struct Sum;

template <>
struct Sum<3> {
  using Block = Matrix3d;

  static Block of(const Matrix3d& P) { return P; }
  template <class P>
  static auto transposed(const P& block) {
    return block.transpose();
  }
  /// The vector Σ a × b.
  template <class P>
  static Vector3d spin(const P& block) {
    return {block(1, 2) - block(2, 1), block(2, 0) - block(0, 2), block(0, 1) - block(1, 0)};
  }
  /// Vector Σ a × (ω × b), the same with a and b exchanged, and the matrix of the first.
  template <class P>
  static Vector3d turned(const P& block, const Vector3d& omega) {
    return block.trace() * omega - block.transpose() * omega;
  }
  template <class P>
  static Vector3d turned_back(const P& block, const Vector3d& omega) {
    return block.trace() * omega - block * omega;
  }
  template <class P>
  static Matrix3d turning(const P& block) {
    return block.trace() * Matrix3d::Identity() - block.transpose();
  }
  /// Weights V and W with Σ_kl P_kl V_kl = spin(P)·e and Σ_kl P_kl W_kl = ω·turned(P, ω).
  static Block spin_weights(const Vector3d& e) { return -skew<double>(e); }
  static Block turn_weights(const Vector3d& omega) {
    return omega.squaredNorm() * Matrix3d::Identity() - omega * omega.transpose();
  }
};

/// In the plane a block holds its trace and its spin, xy − yx.
template <>
struct Sum<2> {
  using Block = Vector2d;
  using Turn = TurnOf<2>;

  static Block of(const Matrix3d& P) { return {P(0, 0) + P(1, 1), P(0, 1) - P(1, 0)}; }
  static Block transposed(const Block& block) { return {block[0], -block[1]}; }
  static Turn spin(const Block& block) { return Turn(block[1]); }
  static Turn turned(const Block& block, const Turn& omega) { return block[0] * omega; }
  static Turn turned_back(const Block& block, const Turn& omega) { return block[0] * omega; }
  static Turn turning(const Block& block) { return Turn(block[0]); }
  static Block spin_weights(const Turn& e) { return {0.0, e.x()}; }
  static Block turn_weights(const Turn& omega) { return {omega.x() * omega.x(), 0.0}; }
};

template <int D>
constexpr int sum_size = Sum<D>::Block::SizeAtCompileTime;

/// Block j of a vector of blocks.
template <int D>
Map<const typename Sum<D>::Block> block(const VectorXd& blocks, Index j) {
  return Map<const typename Sum<D>::Block>(blocks.data() + sum_size<D> * j);
}

/// Parts of the scratch that a model in D dimensions has.
template <int D>
struct Parts {
  VectorOf<D> c, cd, ga;
  TurnOf<D> om, omd;
  Eigen::Matrix<double, D, D> A;
  explicit Parts(const ModalScratch& s)
      : c(s.c.head<D>()),
        cd(s.cd.head<D>()),
        ga(s.ga.head<D>()),
        om(Space<D>::turn_part(s.om)),
        omd(Space<D>::turn_part(s.omd)),
        A(s.A.topLeftCorner<D, D>()) {}
  /// Centripetal term ω × (ω × v).
  VectorOf<D> centripetal(const VectorOf<D>& v) const { return Space<D>::across(om, Space<D>::across(om, v)); }
};

/// Linear combination Σ_j C.col(j) w_j.
template <int D>
VectorOf<D> sum_of(const Eigen::Matrix3Xd& C, const VectorXd& w) {
  VectorOf<D> sum = VectorOf<D>::Zero();
  for (Index j = 0; j < w.size(); ++j) sum += C.col(j).head<D>() * w[j];
  return sum;
}

/// Sum of mass times acceleration in axes of the frame, without the acceleration of its origin.
template <int D>
VectorOf<D> pull_of(const ModalBody& body, const ModalScratch& s, const Parts<D>& p) {
  return Space<D>::across(p.omd, p.c) + sum_of<D>(body.C1, s.wdd) + p.centripetal(p.c) +
         2.0 * Space<D>::across(p.om, p.cd);
}

/// Adds weights : P2_ij to entry (j, i).
template <int D, class Target>
void add_contraction(const ModalBody& body, const typename Sum<D>::Block& weights, Target&& target) {
  constexpr int n = sum_size<D>;
  const Map<const Eigen::Matrix<double, n, 1>> flat(weights.data());
  for (Index i = 0; i < body.modes; ++i) {
    const Map<const Eigen::Matrix<double, n, Eigen::Dynamic>> column(body.P2.col(i).data(), n, body.modes);
    target.col(i).noalias() += column.transpose().lazyProduct(flat);
  }
}

template <int D>
void add_mass(const ModalBody& body, double factor, ModalScratch& s) {
  constexpr int turns = Space<D>::turns, turn = Space<D>::first_turn;
  const Parts<D> p(s);
  auto& K = s.tangent;
  const Index m = body.modes;
  K.diagonal().head<D>().array() += factor * body.mass;
  const Eigen::Matrix<double, D, turns> coupling = factor * p.A * Space<D>::turning(p.c);
  K.block<D, turns>(0, turn) += coupling;
  K.block<turns, D>(turn, 0) += coupling.transpose();
  K.block<turns, turns>(turn, turn) += factor * s.J.bottomRightCorner<turns, turns>();
  K.diagonal().tail(m).array() += factor;
  for (Index j = 0; j < m; ++j) {
    const VectorOf<D> translation = factor * (p.A * body.C1.col(j).head<D>());
    const TurnOf<D> rotation = factor * s.N.col(j).tail<turns>();
    K.col(6 + j).segment<D>(0) += translation;
    K.col(6 + j).segment<turns>(turn) += rotation;
    K.row(6 + j).segment<D>(0) += translation.transpose();
    K.row(6 + j).segment<turns>(turn) += rotation.transpose();
  }
}

/// Adds −∂s/∂v and the damping of the modes.
template <int D>
void add_damping(const ModalBody& body, double factor, ModalScratch& s) {
  constexpr int turns = Space<D>::turns, turn = Space<D>::first_turn;
  const Parts<D> p(s);
  auto& K = s.tangent;
  const Index m = body.modes;
  K.block<D, turns>(0, turn) +=
      factor * p.A *
      (Space<D>::turning(Space<D>::across(p.om, p.c) + 2.0 * p.cd) + Space<D>::across(p.om) * Space<D>::turning(p.c));
  K.block<turns, turns>(turn, turn) += 2.0 * factor * Sum<D>::turning(block<D>(s.D, 0));
  if constexpr (D == 3)
    K.block<3, 3>(3, 3) +=
        factor * (skew<double>(s.om) * s.J - skew<double>(s.J * s.om) - skew<double>(body.N_mu.lazyProduct(s.wd)));
  for (Index j = 0; j < m; ++j) {
    const auto S = block<D>(s.S, j);
    const TurnOf<D> turned = Sum<D>::turned(S, p.om);
    K.col(6 + j).segment<D>(0) += (2.0 * factor) * (p.A * Space<D>::across(p.om, body.C1.col(j).head<D>()));
    K.col(6 + j).segment<turns>(turn) += 2.0 * factor * turned;
    if constexpr (D == 3) K.col(6 + j).segment<3>(3) += factor * s.om.cross(body.N_mu.col(j));
    K.row(6 + j).segment<turns>(turn) +=
        factor * (2.0 * Sum<D>::spin(block<D>(s.Sd, j)) - turned - Sum<D>::turned_back(S, p.om)).transpose();
  }
  add_contraction<D>(body, 2.0 * factor * Sum<D>::spin_weights(p.om), K.bottomRightCorner(m, m));
  K.diagonal().tail(m) += factor * body.damping;
}

/// Adds ∂(M v̇ − s − g)/∂q at fixed velocities and accelerations, and the stiffness of the modes.
template <int D>
void add_stiffness(const ModalBody& body, double factor, ModalScratch& s) {
  constexpr int turns = Space<D>::turns, turn = Space<D>::first_turn;
  const Parts<D> p(s);
  auto& K = s.tangent;
  const Index m = body.modes;
  K.block<D, turns>(0, turn) += factor * p.A * Space<D>::turning(pull_of<D>(body, s, p));
  K.block<turns, turns>(turn, turn) -= factor * Space<D>::turning_product(p.c, p.ga);
  for (Index i = 0; i < m; ++i) {
    const auto S = block<D>(s.S, i);
    const VectorOf<D> Ci = body.C1.col(i).head<D>();
    const TurnOf<D> pull = factor * Space<D>::cross(Ci, p.ga);
    K.col(6 + i).segment<D>(0) += factor * (p.A * (Space<D>::across(p.omd, Ci) + p.centripetal(Ci)));
    // ∂J/∂w_i ω̇; Σ_j ẇ_j P2_ij = Sd_iᵀ, Σ_j a_ij ẅ_j = −spin(Sdd_i)
    K.col(6 + i).segment<turns>(turn) +=
        pull + factor * (Sum<D>::turned(S, p.omd) + Sum<D>::turned_back(S, p.omd) - Sum<D>::spin(block<D>(s.Sdd, i)) +
                         2.0 * Sum<D>::turned_back(block<D>(s.Sd, i), p.om));
    if constexpr (D == 3)
      K.col(6 + i).segment<3>(3) += factor * s.om.cross(Sum<3>::turned(S, s.om) + Sum<3>::turned_back(S, s.om));
    K.row(6 + i).segment<turns>(turn) += pull.transpose();
  }
  add_contraction<D>(body, factor * (Sum<D>::spin_weights(p.omd) - Sum<D>::turn_weights(p.om)),
                     K.bottomRightCorner(m, m));
  K.diagonal().tail(m) += factor * body.stiffness;
}

template <int D>
void update_in(const ModalBody& body, const NodeMotion& frame, const ModalCoordinates& modes, const Vector3d& gravity,
               ModalScratch& s) {
  constexpr int turns = Space<D>::turns;
  const Index m = body.modes;
  s.A = frame.R;
  s.om.tail<turns>() = frame.Omega.tail<turns>();
  s.omd.tail<turns>() = frame.Omegad.tail<turns>();
  s.ga.head<D>() = s.A.topLeftCorner<D, D>().transpose() * Space<D>::part(frame.xdd - gravity);
  s.w = Map<const VectorXd>(modes.w, m);
  s.wd = Map<const VectorXd>(modes.wd, m);
  s.wdd = Map<const VectorXd>(modes.wdd, m);
  s.c.head<D>() = body.c0.head<D>() + sum_of<D>(body.C1, s.w);
  s.cd.head<D>() = sum_of<D>(body.C1, s.wd);
  s.S = body.P1;
  s.S.noalias() += body.P2 * s.w;
  s.Sd.noalias() = body.P2 * s.wd;
  typename Sum<D>::Block P = Sum<D>::of(body.P0), velocity = Sum<D>::Block::Zero();  // Σ m b bᵀ, Σ ẇ_j S_j
  for (Index j = 0; j < m; ++j) {
    const auto S = block<D>(s.S, j);
    P += s.w[j] * (S + Sum<D>::transposed(block<D>(body.P1, j)));
    velocity += s.wd[j] * S;
    s.N.col(j).tail<turns>() = Sum<D>::spin(S) + body.N_mu.col(j).tail<turns>();
  }
  s.D = velocity.reshaped();
  s.J.bottomRightCorner<turns, turns>() = Sum<D>::turning(P) + body.J_mu.bottomRightCorner<turns, turns>();
}

template <int D>
void residual_in(const ModalBody& body, ModalScratch& s) {
  constexpr int turns = Space<D>::turns, turn = Space<D>::first_turn;
  const Parts<D> p(s);
  s.r.head<D>() = p.A * (body.mass * p.ga + pull_of<D>(body, s, p));
  s.r.segment<turns>(turn) = Space<D>::cross(p.c, p.ga) + s.J.bottomRightCorner<turns, turns>() * p.omd +
                             s.N.bottomRows<turns>().lazyProduct(s.wdd) + 2.0 * Sum<D>::turned(block<D>(s.D, 0), p.om);
  if constexpr (D == 3) s.r.segment<3>(3) += s.om.cross(s.J * s.om + body.N_mu.lazyProduct(s.wd));
  for (Index j = 0; j < body.modes; ++j)
    s.r[6 + j] = body.C1.col(j).head<D>().dot(p.ga) + s.N.col(j).tail<turns>().dot(p.omd) + s.wdd[j] -
                 p.om.dot(Sum<D>::turned(block<D>(s.S, j), p.om)) + 2.0 * p.om.dot(Sum<D>::spin(block<D>(s.Sd, j))) +
                 body.stiffness[j] * s.w[j] + body.damping[j] * s.wd[j];
}

template <int D>
void tangent_in(const ModalBody& body, const TangentCoefficients& coefficients, ModalScratch& s) {
  s.tangent.setZero();
  s.Sdd.noalias() = body.P2 * s.wdd;
  if (coefficients.mass != 0.0) add_mass<D>(body, coefficients.mass, s);
  if (coefficients.damping != 0.0) add_damping<D>(body, coefficients.damping, s);
  if (coefficients.stiffness != 0.0) add_stiffness<D>(body, coefficients.stiffness, s);
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
  s.D.setZero(body.planar ? sum_size<2> : sum_size<3>);
  s.N.setZero(3, m);
  for (Eigen::VectorXd* modal : {&s.w, &s.wd, &s.wdd}) modal->setZero(m);
  for (Eigen::VectorXd* blocks : {&s.S, &s.Sd, &s.Sdd}) blocks->setZero(body.P1.size());
  s.r.setZero(6 + m);
  s.tangent.setZero(6 + m, 6 + m);
  return s;
}

void update_kinematics(const ModalBody& body, const NodeMotion& frame, const ModalCoordinates& modes,
                       const Vector3d& gravity, ModalScratch& s) {
  in_space(body.planar, [&]<int D>() { update_in<D>(body, frame, modes, gravity, s); });
}

void residual(const ModalBody& body, ModalScratch& s) {
  in_space(body.planar, [&]<int D>() { residual_in<D>(body, s); });
}

void tangent(const ModalBody& body, const TangentCoefficients& coefficients, ModalScratch& s) {
  in_space(body.planar, [&]<int D>() { tangent_in<D>(body, coefficients, s); });
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
