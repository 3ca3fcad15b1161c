// Values and derivatives of the relations: products of unit vectors, displacements along axes, distance, and angles as
// functions of products.
#include "mechanism/joints/relation.hpp"

#include <array>
#include <cmath>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "mechanism/joints/axis_products.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void assign(Row12& row, const Vector3d& x_A, const Vector3d& Theta_A, const Vector3d& x_B, const Vector3d& Theta_B) {
  row.segment<3>(0) = x_A;
  row.segment<3>(3) = Theta_A;
  row.segment<3>(6) = x_B;
  row.segment<3>(9) = Theta_B;
}

double product(const Row12& G, const MarkerPair& p) {
  return G.segment<3>(0).dot(p.node_a.xd) + G.segment<3>(3).dot(p.node_a.Omega) + G.segment<3>(6).dot(p.node_b.xd) +
         G.segment<3>(9).dot(p.node_b.Omega);
}

// ---- products of axes --------------------------------------------------------------------------------------------

/// a·b with a = R_A α, b = R_B β: u = R_Aᵀ b, w = R_Bᵀ a, so δ(a·b) = (α × u)·δΘ_A + (β × w)·δΘ_B.
struct Normal {
  Vector3d alpha, beta, u, w;
  Normal(const NormalTerm& term, const MarkerPair& p)
      : alpha(p.a.R.col(term.i)),
        beta(p.b.R.col(term.j)),
        u(p.node_a.R.transpose() * (p.node_b.R * beta)),
        w(p.node_b.R.transpose() * (p.node_a.R * alpha)) {}
};

RelationTerms evaluate(const NormalSum& sum, const MarkerPair& p) {
  RelationTerms terms;
  for (int k = 0; k < sum.count; ++k) {
    const NormalTerm& term = sum.term[k];
    const Normal n(term, p);
    terms.value += term.sign * n.alpha.dot(n.u);
    terms.G.segment<3>(3) += term.sign * n.alpha.cross(n.u).transpose();
    terms.G.segment<3>(9) += term.sign * n.beta.cross(n.w).transpose();
  }
  return terms;
}

double bias(const NormalSum& sum, const MarkerPair& p) {
  double value = 0.0;
  for (int k = 0; k < sum.count; ++k) {
    const NormalTerm& term = sum.term[k];
    const Normal n(term, p);
    const Vector3d &Omega_A = p.node_a.Omega, &Omega_B = p.node_b.Omega;
    const Vector3d u_dot = n.u.cross(Omega_A) + p.node_a.R.transpose() * (p.node_b.R * Omega_B.cross(n.beta));
    const Vector3d w_dot = n.w.cross(Omega_B) + p.node_b.R.transpose() * (p.node_a.R * Omega_A.cross(n.alpha));
    value += term.sign * (Omega_A.dot(n.alpha.cross(u_dot)) + Omega_B.dot(n.beta.cross(w_dot)));
  }
  return value;
}

Row12 rate_gradient(const NormalSum& sum, const MarkerPair& p) {
  Row12 N = Row12::Zero();
  for (int k = 0; k < sum.count; ++k) {
    const NormalTerm& term = sum.term[k];
    const Normal n(term, p);
    const Vector3d alpha_dot = p.node_a.Omega.cross(n.alpha), beta_dot = p.node_b.Omega.cross(n.beta);
    N.segment<3>(3) +=
        term.sign *
        (alpha_dot.cross(n.u) + n.alpha.cross(p.node_a.R.transpose() * (p.node_b.R * beta_dot))).transpose();
    N.segment<3>(9) +=
        term.sign * (beta_dot.cross(n.w) + n.beta.cross(p.node_b.R.transpose() * (p.node_a.R * alpha_dot))).transpose();
  }
  return N;
}

void add_stiffness(const NormalSum& sum, const MarkerPair& p, double weight, Square12& K) {
  const Matrix3d R_AB = p.node_a.R.transpose() * p.node_b.R;
  for (int k = 0; k < sum.count; ++k) {
    const NormalTerm& term = sum.term[k];
    const Normal n(term, p);
    const Matrix3d alpha = weight * term.sign * skew<double>(n.alpha), beta = skew<double>(n.beta);
    K.block<3, 3>(3, 3) += alpha * skew<double>(n.u);
    K.block<3, 3>(3, 9) -= alpha * R_AB * beta;
    K.block<3, 3>(9, 9) += weight * term.sign * beta * skew<double>(n.w);
    K.block<3, 3>(9, 3) -= beta * R_AB.transpose() * alpha;
  }
}

// ---- angles ------------------------------------------------------------------------------------------------------

/// atan2 and its derivatives to second order.
struct ArcTangent {
  RelationTerms s, c;
  double f_s, f_c, f_ss, f_sc;  ///< f_cc = −f_ss
  ArcTangent(const AngleTerms& terms, const MarkerPair& p) : s(evaluate(terms.sine, p)), c(evaluate(terms.cosine, p)) {
    const double square = s.value * s.value + c.value * c.value;
    f_s = c.value / square;
    f_c = -s.value / square;
    f_ss = 2.0 * f_s * f_c;
    f_sc = f_c * f_c - f_s * f_s;
  }
};

// ---- displacement along an axis ----------------------------------------------------------------------------------

/// a = R_A α; e = R_Aᵀ (X_B − x_A), f = R_Bᵀ a, with X_B the origin of marker B: the value is α·(e − p_A).
struct Along {
  Vector3d alpha, a, e, f;
  Along(const Relation& r, const MarkerPair& p)
      : alpha(p.a.R.col(r.i)),
        a(p.node_a.R * alpha),
        e(p.node_a.R.transpose() * (marker_position(p.b, p.node_b) - p.node_a.x)),
        f(p.node_b.R.transpose() * a) {}
};

RelationTerms evaluate_along(const Relation& r, const MarkerPair& p) {
  const Along q(r, p);
  RelationTerms terms;
  terms.value = q.alpha.dot(q.e - p.a.p);
  assign(terms.G, -q.a, q.alpha.cross(q.e), q.a, p.b.p.cross(q.f));
  return terms;
}

double bias_along(const Relation& r, const MarkerPair& p) {
  const Along q(r, p);
  const Vector3d V = marker_velocity(p.b, p.node_b) - p.node_a.xd;
  const Vector3d e_dot = p.node_a.R.transpose() * V - p.node_a.Omega.cross(q.e);
  return (p.node_a.R * p.node_a.Omega.cross(q.alpha)).dot(V) +
         q.f.dot(p.node_b.Omega.cross(p.node_b.Omega.cross(p.b.p))) + q.alpha.cross(e_dot).dot(p.node_a.Omega);
}

Row12 rate_gradient_along(const Relation& r, const MarkerPair& p) {
  const Along q(r, p);
  const Vector3d V = marker_velocity(p.b, p.node_b) - p.node_a.xd;
  const Vector3d alpha_dot = p.node_a.Omega.cross(q.alpha);
  const Vector3d a_dot = p.node_a.R * alpha_dot;
  Row12 N;
  assign(N, -a_dot, q.alpha.cross(p.node_a.R.transpose() * V) + alpha_dot.cross(q.e), a_dot,
         p.node_b.Omega.cross(p.b.p).cross(q.f) + p.b.p.cross(p.node_b.R.transpose() * a_dot));
  return N;
}

void add_stiffness_along(const Relation& r, const MarkerPair& p, double weight, Square12& K) {
  const Along q(r, p);
  const Matrix3d alpha = weight * skew<double>(q.alpha), arm = skew<double>(p.b.p);
  const Matrix3d R_AB = p.node_a.R.transpose() * p.node_b.R;
  const Matrix3d turned = p.node_a.R * alpha;
  K.block<3, 3>(0, 3) += turned;
  K.block<3, 3>(6, 3) -= turned;
  K.block<3, 3>(3, 0) += turned.transpose();
  K.block<3, 3>(3, 6) -= turned.transpose();
  K.block<3, 3>(3, 3) += alpha * skew<double>(q.e);
  K.block<3, 3>(3, 9) -= alpha * R_AB * arm;
  K.block<3, 3>(9, 9) += weight * arm * skew<double>(q.f);
  K.block<3, 3>(9, 3) -= arm * R_AB.transpose() * alpha;
}

// ---- distance ----------------------------------------------------------------------------------------------------

/// Markers at one place, as in a start that is to be assembled, have no direction: n = 0, and nothing is divided by it.
struct Distance {
  Vector3d d, n;
  double length, inverse;
  explicit Distance(const MarkerPair& p)
      : d(marker_position(p.b, p.node_b) - marker_position(p.a, p.node_a)), length(d.norm()) {
    inverse = length > 0.0 ? 1.0 / length : 0.0;
    n = d * inverse;
  }
};

/// J_dᵀ n of a vector n (world) that d is multiplied with: d moves by J_d δq.
Row12 pulled_back(const Vector3d& n, const MarkerPair& p) {
  Row12 row;
  assign(row, -n, -p.a.p.cross(p.node_a.R.transpose() * n), n, p.b.p.cross(p.node_b.R.transpose() * n));
  return row;
}

double bias_distance(const MarkerPair& p) {
  const Distance q(p);
  const Vector3d V = marker_velocity(p.b, p.node_b) - marker_velocity(p.a, p.node_a);
  const auto centripetal = [](const Marker& m, const NodeMotion& node) {
    return Vector3d(node.R * node.Omega.cross(node.Omega.cross(m.p)));
  };
  const double rate = q.n.dot(V);
  return (V.squaredNorm() - rate * rate) * q.inverse + q.n.dot(centripetal(p.b, p.node_b) - centripetal(p.a, p.node_a));
}

Row12 rate_gradient_distance(const MarkerPair& p) {
  const Distance q(p);
  const Vector3d V = marker_velocity(p.b, p.node_b) - marker_velocity(p.a, p.node_a);
  Row12 N = pulled_back((V - q.n.dot(V) * q.n) * q.inverse, p);
  N.segment<3>(3) -= p.node_a.Omega.cross(p.a.p).cross(p.node_a.R.transpose() * q.n).transpose();
  N.segment<3>(9) += p.node_b.Omega.cross(p.b.p).cross(p.node_b.R.transpose() * q.n).transpose();
  return N;
}

void add_stiffness_distance(const MarkerPair& p, double weight, Square12& K) {
  const Distance q(p);
  Eigen::Matrix<double, 3, 12> J;
  J << -Matrix3d::Identity(), p.node_a.R * skew<double>(p.a.p), Matrix3d::Identity(), -p.node_b.R * skew<double>(p.b.p);
  const Eigen::Matrix<double, 3, 12> PJ = (J - q.n * (q.n.transpose() * J)) * q.inverse;
  K.noalias() += weight * J.transpose() * PJ;
  K.block<3, 3>(3, 3) -= weight * skew<double>(p.a.p) * skew<double>(p.node_a.R.transpose() * q.n);
  K.block<3, 3>(9, 9) += weight * skew<double>(p.b.p) * skew<double>(p.node_b.R.transpose() * q.n);
}

}  // namespace

RelationTerms evaluate(const Relation& r, const MarkerPair& p) {
  switch (r.kind) {
    case RelationKind::along:
      return evaluate_along(r, p);
    case RelationKind::normal:
      return evaluate(normal_sum(r), p);
    case RelationKind::twist:
      return evaluate(twist_sum, p);
    case RelationKind::distance: {
      const Distance q(p);
      return {q.length, pulled_back(q.n, p)};
    }
    case RelationKind::angle: {
      const ArcTangent t(angle_terms(r), p);
      return {std::atan2(t.s.value, t.c.value), t.f_s * t.s.G + t.f_c * t.c.G};
    }
  }
  TISSERAND_ENSURE(false, "relation of kind {}", static_cast<int>(r.kind));
}

double bias(const Relation& r, const MarkerPair& p) {
  switch (r.kind) {
    case RelationKind::along:
      return bias_along(r, p);
    case RelationKind::normal:
      return bias(normal_sum(r), p);
    case RelationKind::twist:
      return bias(twist_sum, p);
    case RelationKind::distance:
      return bias_distance(p);
    case RelationKind::angle: {
      const AngleTerms terms = angle_terms(r);
      const ArcTangent t(terms, p);
      const double s = product(t.s.G, p), c = product(t.c.G, p);
      return t.f_s * bias(terms.sine, p) + t.f_c * bias(terms.cosine, p) + t.f_ss * (s * s - c * c) +
             2.0 * t.f_sc * s * c;
    }
  }
  TISSERAND_ENSURE(false, "relation of kind {}", static_cast<int>(r.kind));
}

Row12 rate_gradient(const Relation& r, const MarkerPair& p) {
  switch (r.kind) {
    case RelationKind::along:
      return rate_gradient_along(r, p);
    case RelationKind::normal:
      return rate_gradient(normal_sum(r), p);
    case RelationKind::twist:
      return rate_gradient(twist_sum, p);
    case RelationKind::distance:
      return rate_gradient_distance(p);
    case RelationKind::angle: {
      const AngleTerms terms = angle_terms(r);
      const ArcTangent t(terms, p);
      const double s = product(t.s.G, p), c = product(t.c.G, p);
      return t.f_s * rate_gradient(terms.sine, p) + t.f_c * rate_gradient(terms.cosine, p) +
             (t.f_ss * s + t.f_sc * c) * t.s.G + (t.f_sc * s - t.f_ss * c) * t.c.G;
    }
  }
  TISSERAND_ENSURE(false, "relation of kind {}", static_cast<int>(r.kind));
}

void add_stiffness(const Relation& r, const MarkerPair& p, double weight, Square12& K) {
  switch (r.kind) {
    case RelationKind::along:
      add_stiffness_along(r, p, weight, K);
      return;
    case RelationKind::normal:
      add_stiffness(normal_sum(r), p, weight, K);
      return;
    case RelationKind::twist:
      add_stiffness(twist_sum, p, weight, K);
      return;
    case RelationKind::distance:
      add_stiffness_distance(p, weight, K);
      return;
    case RelationKind::angle: {
      const AngleTerms terms = angle_terms(r);
      const ArcTangent t(terms, p);
      add_stiffness(terms.sine, p, weight * t.f_s, K);
      add_stiffness(terms.cosine, p, weight * t.f_c, K);
      K.noalias() += weight * t.s.G.transpose() * (t.f_ss * t.s.G + t.f_sc * t.c.G);
      K.noalias() += weight * t.c.G.transpose() * (t.f_sc * t.s.G - t.f_ss * t.c.G);
      return;
    }
  }
}

}  // namespace tisserand::mechanism
