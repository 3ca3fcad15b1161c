// Joint equations as pairs of coincident points and pairs of normal vectors.
#include "mechanism/joints/joint.hpp"

#include <array>
#include <cmath>

#include "common/rotation.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Columns of the marker orientations that stay normal: column `a` of A to column `b` of B.
struct NormalPair {
  int a;
  int b;
};

constexpr std::array<NormalPair, 2> revolute_pairs{{{0, 2}, {1, 2}}};
constexpr std::array<NormalPair, 3> fixed_pairs{{{0, 1}, {1, 2}, {2, 0}}};

struct Pairs {
  const NormalPair* pair;
  int count;
};

Pairs normal_pairs(JointKind kind) {
  switch (kind) {
    case JointKind::fixed:
      return {fixed_pairs.data(), 3};
    case JointKind::revolute:
      return {revolute_pairs.data(), 2};
    case JointKind::spherical:
      return {nullptr, 0};
  }
  return {nullptr, 0};
}

/// a·b with a = R_A α, b = R_B β: u = R_Aᵀ b, w = R_Bᵀ a, so δ(a·b) = (α × u)·δΘ_A + (β × w)·δΘ_B.
struct Normal {
  Vector3d alpha, beta, u, w;
  Normal(const Joint& joint, NormalPair pair, const NodeMotion& a, const NodeMotion& b)
      : alpha(joint.a.R.col(pair.a)),
        beta(joint.b.R.col(pair.b)),
        u(a.R.transpose() * (b.R * beta)),
        w(b.R.transpose() * (a.R * alpha)) {}
};

}  // namespace

int joint_size(JointKind kind) { return 3 + normal_pairs(kind).count; }

std::string joint_equation_name(JointKind kind, int equation) {
  static const char* const axis[] = {"x", "y", "z"};
  if (equation < 3) return std::string("translation ") + axis[equation];
  const NormalPair pair = normal_pairs(kind).pair[equation - 3];
  return std::string(axis[pair.b]) + " axis of B normal to " + axis[pair.a] + " axis of A";
}

void joint_constraints(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms) {
  terms.phi.head<3>() = marker_position(joint.b, b) - marker_position(joint.a, a);
  terms.B.block<3, 3>(0, 0) = -Matrix3d::Identity();
  terms.B.block<3, 3>(0, 3).noalias() = a.R * skew<double>(joint.a.p);
  terms.B.block<3, 3>(0, 6).setIdentity();
  terms.B.block<3, 3>(0, 9).noalias() = -b.R * skew<double>(joint.b.p);
  const Pairs pairs = normal_pairs(joint.kind);
  for (int k = 0; k < pairs.count; ++k) {
    const Normal n(joint, pairs.pair[k], a, b);
    terms.phi[3 + k] = n.alpha.dot(n.u);
    terms.B.block<1, 3>(3 + k, 0).setZero();
    terms.B.block<1, 3>(3 + k, 3) = n.alpha.cross(n.u).transpose();
    terms.B.block<1, 3>(3 + k, 6).setZero();
    terms.B.block<1, 3>(3 + k, 9) = n.beta.cross(n.w).transpose();
  }
}

void joint_bias(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms) {
  terms.bias.head<3>() = b.R * b.Omega.cross(b.Omega.cross(joint.b.p)) - a.R * a.Omega.cross(a.Omega.cross(joint.a.p));
  const Pairs pairs = normal_pairs(joint.kind);
  for (int k = 0; k < pairs.count; ++k) {
    const Normal n(joint, pairs.pair[k], a, b);
    const Vector3d u_dot = n.u.cross(a.Omega) + a.R.transpose() * (b.R * b.Omega.cross(n.beta));
    const Vector3d w_dot = n.w.cross(b.Omega) + b.R.transpose() * (a.R * a.Omega.cross(n.alpha));
    terms.bias[3 + k] = a.Omega.dot(n.alpha.cross(u_dot)) + b.Omega.dot(n.beta.cross(w_dot));
  }
}

void joint_rate_gradient(const Joint& joint, const NodeMotion& a, const NodeMotion& b,
                         Eigen::Matrix<double, 6, 12>& N) {
  N.setZero();
  N.block<3, 3>(0, 3).noalias() = a.R * skew<double>(a.Omega.cross(joint.a.p));
  N.block<3, 3>(0, 9).noalias() = -b.R * skew<double>(b.Omega.cross(joint.b.p));
  const Pairs pairs = normal_pairs(joint.kind);
  for (int k = 0; k < pairs.count; ++k) {
    const Normal n(joint, pairs.pair[k], a, b);
    const Vector3d alpha_dot = a.Omega.cross(n.alpha), beta_dot = b.Omega.cross(n.beta);
    N.block<1, 3>(3 + k, 3) = (alpha_dot.cross(n.u) + n.alpha.cross(a.R.transpose() * (b.R * beta_dot))).transpose();
    N.block<1, 3>(3 + k, 9) = (beta_dot.cross(n.w) + n.beta.cross(b.R.transpose() * (a.R * alpha_dot))).transpose();
  }
}

void joint_stiffness(const Joint& joint, const NodeMotion& a, const NodeMotion& b, const double* lambda,
                     Eigen::Matrix<double, 12, 12>& K) {
  K.setZero();
  const Eigen::Map<const Vector3d> f(lambda);
  // Rows Θ of Bᵀλ: −p_A~ R_Aᵀ f for A and +p_B~ R_Bᵀ f for B; δ(Rᵀ f) = (Rᵀ f)~ δΘ.
  K.block<3, 3>(3, 3) = -skew<double>(joint.a.p) * skew<double>(a.R.transpose() * f);
  K.block<3, 3>(9, 9) = skew<double>(joint.b.p) * skew<double>(b.R.transpose() * f);
  const Pairs pairs = normal_pairs(joint.kind);
  for (int k = 0; k < pairs.count; ++k) {
    const Normal n(joint, pairs.pair[k], a, b);
    const double m = lambda[3 + k];
    const Matrix3d alpha = skew<double>(n.alpha), beta = skew<double>(n.beta);
    const Matrix3d R_AB = a.R.transpose() * b.R;
    K.block<3, 3>(3, 3) += m * alpha * skew<double>(n.u);
    K.block<3, 3>(3, 9) -= m * alpha * R_AB * beta;
    K.block<3, 3>(9, 9) += m * beta * skew<double>(n.w);
    K.block<3, 3>(9, 3) -= m * beta * R_AB.transpose() * alpha;
  }
}

JointReaction joint_reaction(const Joint& joint, const NodeMotion& a, const NodeMotion& b, const double* lambda) {
  const Matrix3d R_A = marker_rotation(joint.a, a);
  Vector3d moment = Vector3d::Zero();  // on B, axes of node B
  const Pairs pairs = normal_pairs(joint.kind);
  for (int k = 0; k < pairs.count; ++k) {
    const Normal n(joint, pairs.pair[k], a, b);
    moment -= lambda[3 + k] * n.beta.cross(n.w);
  }
  return {-R_A.transpose() * Eigen::Map<const Vector3d>(lambda), R_A.transpose() * (b.R * moment)};
}

double hinge_angle(const Joint& joint, const NodeMotion& a, const NodeMotion& b) {
  const Matrix3d R_AB = marker_rotation(joint.a, a).transpose() * marker_rotation(joint.b, b);
  return std::atan2(R_AB(1, 0) - R_AB(0, 1), R_AB(0, 0) + R_AB(1, 1));
}

double hinge_rate(const Joint& joint, const NodeMotion& a, const NodeMotion& b) {
  const Vector3d axis = marker_rotation(joint.a, a).col(2);
  return axis.dot(b.R * b.Omega - a.R * a.Omega);
}

}  // namespace tisserand::mechanism
