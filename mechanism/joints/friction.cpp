// SPDX-License-Identifier: GPL-3.0-or-later
// Sliding velocities and normal forces of joints, with their derivatives.
#include "mechanism/joints/friction.hpp"

#include <array>

#include "common/error.hpp"
#include "common/math/rotation.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Rows3 = Eigen::Matrix<double, 3, 12>;

/// Sliding velocity s = S v; unused rows are zero.
struct Slip {
  Rows3 S = Rows3::Zero();
  Vector3d s = Vector3d::Zero();
};

/// Derivatives of a slip: ∂(S v)/∂q and ∂(Sᵀ weight)/∂q.
struct SlipGradient {
  Rows3 rate = Rows3::Zero();
  Square12 geometric = Square12::Zero();
};

constexpr Relation turn{RelationKind::angle, 2, 0};
constexpr Relation shift_z{RelationKind::along, 2, 0};

/// Whether the slip is that of a ball, a rotation in any direction.
bool slips_like_a_ball(JointKind kind) { return joint_law(kind).slip == SlipKind::ball; }

/// Relation and factor of each row, for joints whose slip consists of joint coordinates; factor 0: no row.
struct SlipRow {
  Relation relation;
  double factor = 0.0;
};
std::array<SlipRow, 3> slip_rows(const Friction& friction, JointKind kind) {
  const JointLaw& law = joint_law(kind);
  TISSERAND_ENSURE(law.slip == SlipKind::coordinates, "friction in a joint of kind {}", static_cast<int>(kind));
  std::array<SlipRow, 3> rows;
  for (int k = 0; k < law.coordinates.count; ++k) {
    const Relation& coordinate = law.coordinates.list[k];
    rows[k] = {coordinate, is_length(coordinate) ? 1.0 : friction.radius};
  }
  return rows;
}

Slip slip_of(const Friction& friction, const LoadedJoint& loaded) {
  const MarkerPair& p = loaded.pair;
  Slip slip;
  if (slips_like_a_ball(loaded.joint.kind)) {  // r (Ω_B − R_BᵀR_A Ω_A)
    slip.S.block<3, 3>(0, 3) = -friction.radius * (p.node_b.R.transpose() * p.node_a.R);
    slip.S.block<3, 3>(0, 9) = friction.radius * Matrix3d::Identity();
  } else {
    const std::array<SlipRow, 3> rows = slip_rows(friction, loaded.joint.kind);
    for (int k = 0; k < 3; ++k)
      if (const SlipRow& row = rows[k]; row.factor != 0.0) slip.S.row(k) = row.factor * evaluate(row.relation, p).G;
  }
  Vector12 v;
  v << p.node_a.xd, p.node_a.Omega, p.node_b.xd, p.node_b.Omega;
  slip.s = slip.S.lazyProduct(v);
  return slip;
}

SlipGradient slip_gradient(const Friction& friction, const LoadedJoint& loaded, const Vector3d& weight) {
  const MarkerPair& p = loaded.pair;
  SlipGradient gradient;
  if (slips_like_a_ball(loaded.joint.kind)) {
    const double r = friction.radius;
    const Matrix3d R_BA = p.node_b.R.transpose() * p.node_a.R;
    const Vector3d carried = R_BA.transpose() * weight;
    gradient.rate.block<3, 3>(0, 3) = r * R_BA * skew<double>(p.node_a.Omega);
    gradient.rate.block<3, 3>(0, 9) = -r * skew<double>(R_BA * p.node_a.Omega);
    gradient.geometric.block<3, 3>(3, 3) = -r * skew<double>(carried);
    gradient.geometric.block<3, 3>(3, 9) = r * R_BA.transpose() * skew<double>(weight);
    return gradient;
  }
  const std::array<SlipRow, 3> rows = slip_rows(friction, loaded.joint.kind);
  for (int k = 0; k < 3; ++k) {
    const SlipRow& row = rows[k];
    if (row.factor == 0.0) continue;
    gradient.rate.row(k) = row.factor * rate_gradient(row.relation, p);
    add_stiffness(row.relation, p, row.factor * weight[k], gradient.geometric);
  }
  return gradient;
}

/// Normal force N and its derivatives by force and moment.
struct ContactForce {
  double N = 0.0;
  Vector3d by_force = Vector3d::Zero();
  Vector3d by_moment = Vector3d::Zero();
};
ContactForce normal_of(const Friction& friction, JointKind kind, const JointReaction& reaction) {
  const Pressing& pressing = joint_law(kind).pressing;
  const Eigen::Map<const Vector3d> by_force(pressing.force.data()), by_moment(pressing.moment.data());
  const Vector3d f = by_force.cwiseProduct(reaction.force), m = by_moment.cwiseProduct(reaction.moment);
  const double force = f.norm(), moment = m.norm(), factor = 2.0 * friction.inverse_arm;
  ContactForce normal;
  normal.N = force + factor * moment;
  if (force > 0.0) normal.by_force = f / force;
  if (moment > 0.0) normal.by_moment = factor * m / moment;
  return normal;
}

/// Gradient of z − lead × angle; zero without a thread.
Row12 thread_row(const Friction& friction, const MarkerPair& pair) {
  if (friction.thread < 0) return Row12::Zero();
  return evaluate(shift_z, pair).G - friction.lead * evaluate(turn, pair).G;
}

Row12 pulled_back(const LoadedJoint& loaded, const Row12& thread) {
  Row12 sum = loaded.thread_lambda * thread;
  for (int k = 0; k < loaded.joint.size(); ++k) sum += loaded.lambda[k] * loaded.terms.B.row(k);
  return sum;
}

/// Row ∂N/∂q at fixed multipliers from that of g = Bᵀλ: f = R_MᵀR_Aᵀ(−g_x), m likewise of R_B(−g_Θ − p_B × R_Bᵀ(−g_x)).
Row12 normal_gradient(const Friction& friction, const LoadedJoint& loaded, const Row12& g, const ContactForce& normal) {
  const MarkerPair& p = loaded.pair;
  Square12 K;
  joint_stiffness(loaded.joint, p.node_a, p.node_b, loaded.lambda, K);
  if (friction.thread >= 0) {
    add_stiffness(shift_z, p, loaded.thread_lambda, K);
    add_stiffness(turn, p, -friction.lead * loaded.thread_lambda, K);
  }
  const Vector3d f_W = -g.segment<3>(6).transpose(), f_B = p.node_b.R.transpose() * f_W;
  const Vector3d m_B = -g.segment<3>(9).transpose() - p.b.p.cross(f_B), m_W = p.node_b.R * m_B;
  const Rows3 df_W = -K.middleRows<3>(6);
  Rows3 df_B = p.node_b.R.transpose() * df_W;
  df_B.block<3, 3>(0, 9) += skew<double>(f_B);
  Rows3 dm_B = -K.middleRows<3>(9);
  dm_B.noalias() -= skew<double>(p.b.p) * df_B;
  Rows3 dm_W = p.node_b.R * dm_B;
  dm_W.block<3, 3>(0, 9) -= p.node_b.R * skew<double>(m_B);
  const Matrix3d to_A = p.node_a.R.transpose();
  Rows3 df = to_A * df_W, dm = to_A * dm_W;  // in axes of node A
  df.block<3, 3>(0, 3) += skew<double>(to_A * f_W);
  dm.block<3, 3>(0, 3) += skew<double>(to_A * m_W);
  return (p.a.R * normal.by_force).transpose() * df + (p.a.R * normal.by_moment).transpose() * dm;
}

}  // namespace

FrictionLaw friction_law(const Friction& friction, double speed) {
  const double v = friction.velocity;
  if (speed <= v) return {friction.stiction * (2.0 - speed / v) / v, -friction.stiction / (v * v)};
  double mu = friction.kinetic, slope = 0.0;
  if (speed < 3.0 * v) {
    const double t = (speed - v) / (2.0 * v), drop = friction.stiction - friction.kinetic;
    mu = friction.stiction - drop * t * t * (3.0 - 2.0 * t);
    slope = -drop * 6.0 * t * (1.0 - t) / (2.0 * v);
  }
  return {mu / speed, (slope - mu / speed) / speed};
}

FrictionTerms evaluate(const Friction& friction, const LoadedJoint& loaded) {
  const Slip slip = slip_of(friction, loaded);
  const JointReaction reaction = reaction_of(pulled_back(loaded, thread_row(friction, loaded.pair)), loaded.pair);
  FrictionTerms terms;
  terms.normal = normal_of(friction, loaded.joint.kind, reaction).N;
  const double factor = terms.normal * friction_law(friction, slip.s.norm()).ratio;
  terms.force.noalias() = slip.S.transpose().lazyProduct(factor * slip.s);
  terms.power = factor * slip.s.squaredNorm();
  return terms;
}

void tangent(const Friction& friction, const LoadedJoint& loaded, const TangentCoefficients& coefficients,
             FrictionTangent& result) {
  const Slip slip = slip_of(friction, loaded);
  const Row12 thread = thread_row(friction, loaded.pair), g = pulled_back(loaded, thread);
  const ContactForce normal = normal_of(friction, loaded.joint.kind, reaction_of(g, loaded.pair));
  const double speed = slip.s.norm();
  const FrictionLaw law = friction_law(friction, speed);
  Matrix3d by_slip = law.ratio * Matrix3d::Identity();  // derivative of μ(|s|) s/|s|
  if (speed > 0.0) by_slip += (law.slope / speed) * slip.s * slip.s.transpose();
  const Vector3d pull = law.ratio * slip.s;
  const SlipGradient gradient = slip_gradient(friction, loaded, pull);
  const Rows3 ds = coefficients.damping * slip.S + coefficients.stiffness * gradient.rate;
  const Vector12 direction = slip.S.transpose() * pull;
  result.A.noalias() = slip.S.transpose() * (normal.N * by_slip * ds);
  result.A += (coefficients.stiffness * normal.N) * gradient.geometric;
  result.A.noalias() += coefficients.stiffness * direction * normal_gradient(friction, loaded, g, normal);
  const auto by_row = [&](const Row12& row) -> Vector12 {
    const JointReaction unit = reaction_of(row, loaded.pair);
    return (normal.by_force.dot(unit.force) + normal.by_moment.dot(unit.moment)) * direction;
  };
  result.by_lambda.setZero();
  for (int k = 0; k < loaded.joint.size(); ++k) result.by_lambda.col(k) = by_row(loaded.terms.B.row(k));
  result.by_thread = by_row(thread);
}

}  // namespace tisserand::mechanism
