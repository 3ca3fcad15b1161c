// SPDX-License-Identifier: GPL-3.0-or-later
// Values and derivatives of the relations: products of unit vectors, displacements along axes, distance, and angles as
// functions of products; in space and in the plane of planar models.
#include "mechanism/joints/relation.hpp"

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "mechanism/frames/space.hpp"
#include "mechanism/joints/axis_products.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// First rotation columns of A and B.
template <int D>
constexpr int turn_A = Space<D>::first_turn;
template <int D>
constexpr int turn_B = 6 + Space<D>::first_turn;

double product(const Row12& G, const MarkerPair& p) {
  return G.segment<3>(0).dot(p.node_a.xd) + G.segment<3>(3).dot(p.node_a.Omega) + G.segment<3>(6).dot(p.node_b.xd) +
         G.segment<3>(9).dot(p.node_b.Omega);
}

/// Adds [0, rotation of A, 0, rotation of B], given in world axes, to row.
template <int D>
void add_turns(Row12& row, const MarkerPair& p, const TurnOf<D>& by_A, const TurnOf<D>& by_B) {
  constexpr int n = Space<D>::turns;
  row.segment<n>(turn_A<D>) += Space<D>::material(p.node_a.R, by_A).transpose();
  row.segment<n>(turn_B<D>) += Space<D>::material(p.node_b.R, by_B).transpose();
}

/// Adds `block` to K from row i and column j on, and its transpose from row j and column i on.
template <class Block>
void add_both(Square12& K, int i, int j, const Block& block) {
  constexpr int rows = Block::RowsAtCompileTime, columns = Block::ColsAtCompileTime;
  K.block<rows, columns>(i, j) += block;
  K.block<columns, rows>(j, i) += block.transpose();
}

/// Adds weight times the second derivative of a value a·d by the rotations of A and B to K: a turns with A, and d with
/// A like `of_A`, with B like `of_B`.
template <int D>
void add_turn_stiffness(const VectorOf<D>& a, const VectorOf<D>& of_A, const VectorOf<D>& of_B, const MarkerPair& p,
                        double weight, Square12& K) {
  constexpr int n = Space<D>::turns, A = turn_A<D>, B = turn_B<D>;
  const Matrix3d &R_A = p.node_a.R, &R_B = p.node_b.R;
  add_both(K, A, B, weight * Space<D>::turning_product(R_A, a, R_B, of_B));
  K.block<n, n>(A, A) -= weight * Space<D>::turning_product(R_A, a, of_A);
  K.block<n, n>(B, B) -= weight * Space<D>::turning_product(R_B, of_B, a);
}

// ---- products of axes and angles, which only rotations change -----------------------------------------------------

/// Axes of A and B of a product a·b, world axes.
template <int D>
struct Axes {
  VectorOf<D> a, b;
  Axes(const NormalTerm& term, const MarkerPair& p)
      : a(Space<D>::part(Space<D>::rotated(p.node_a.R, p.a.R.col(term.i)))),
        b(Space<D>::part(Space<D>::rotated(p.node_b.R, p.b.R.col(term.j)))) {}
};

/// THEORY (56): δ value = by·(δΘ_A − δΘ_B) in world axes; a product has by = a × b.
template <int D>
struct TurnTerms {
  double value = 0.0;
  TurnOf<D> by = TurnOf<D>::Zero();
};

template <int D>
TurnTerms<D> terms_of(const NormalSum& sum, const MarkerPair& p) {
  TurnTerms<D> terms;
  for (int k = 0; k < sum.count; ++k) {
    const double sign = sum.term[k].sign;
    const Axes<D> axes(sum.term[k], p);
    terms.value += sign * axes.a.dot(axes.b);
    terms.by += sign * Space<D>::cross(axes.a, axes.b);
  }
  return terms;
}

/// Rate d(by)/dt.
template <int D>
TurnOf<D> rate_of(const NormalSum& sum, const MarkerPair& p) {
  const TurnOf<D> spin_A = Space<D>::spin(p.node_a), spin_B = Space<D>::spin(p.node_b);
  TurnOf<D> rate = TurnOf<D>::Zero();
  for (int k = 0; k < sum.count; ++k) {
    const Axes<D> axes(sum.term[k], p);
    rate += sum.term[k].sign * (Space<D>::cross(Space<D>::across(spin_A, axes.a), axes.b) +
                                Space<D>::cross(axes.a, Space<D>::across(spin_B, axes.b)));
  }
  return rate;
}

template <int D>
void add_stiffness(const NormalSum& sum, const MarkerPair& p, double weight, Square12& K) {
  for (int k = 0; k < sum.count; ++k) {
    const Axes<D> axes(sum.term[k], p);
    add_turn_stiffness<D>(axes.a, axes.b, axes.b, p, weight * sum.term[k].sign, K);
  }
}

/// Angle of THEORY (56): atan2 with its derivatives to second order.
template <int D>
struct ArcTangent {
  TurnTerms<D> s, c;
  double f_s, f_c, f_ss, f_sc;  ///< f_cc = −f_ss
  ArcTangent(const AngleTerms& terms, const MarkerPair& p)
      : s(terms_of<D>(terms.sine, p)), c(terms_of<D>(terms.cosine, p)) {
    const double square = s.value * s.value + c.value * c.value;
    f_s = c.value / square;
    f_c = -s.value / square;
    f_ss = 2.0 * f_s * f_c;
    f_sc = f_c * f_c - f_s * f_s;
  }
  TurnTerms<D> angle() const { return {std::atan2(s.value, c.value), f_s * s.by + f_c * c.by}; }
};

template <int D>
TurnOf<D> rate_of(const AngleTerms& terms, const MarkerPair& p) {
  const ArcTangent<D> t(terms, p);
  const TurnOf<D> spin = Space<D>::spin(p.node_a) - Space<D>::spin(p.node_b);
  const double s = t.s.by.dot(spin), c = t.c.by.dot(spin);
  return t.f_s * rate_of<D>(terms.sine, p) + t.f_c * rate_of<D>(terms.cosine, p) + (t.f_ss * s + t.f_sc * c) * t.s.by +
         (t.f_sc * s - t.f_ss * c) * t.c.by;
}

template <int D>
void add_stiffness(const AngleTerms& terms, const MarkerPair& p, double weight, Square12& K) {
  const ArcTangent<D> t(terms, p);
  add_stiffness<D>(terms.sine, p, weight * t.f_s, K);
  add_stiffness<D>(terms.cosine, p, weight * t.f_c, K);
  Row12 s = Row12::Zero(), c = Row12::Zero();
  add_turns<D>(s, p, t.s.by, -t.s.by);
  add_turns<D>(c, p, t.c.by, -t.c.by);
  K.noalias() += weight * s.transpose() * (t.f_ss * s + t.f_sc * c);
  K.noalias() += weight * c.transpose() * (t.f_sc * s - t.f_ss * c);
}

// ---- displacements from a point of A to one of B -------------------------------------------------------------------

/// Row of a value that changes by x·δd, THEORY (57). d leads from a point of A to one of B, which have these arms from
/// the origins of the carriers (world axes).
template <int D>
Row12 pulled_back(const VectorOf<D>& x, const Vector3d& arm_A, const Vector3d& arm_B, const MarkerPair& p) {
  Row12 row = Row12::Zero();
  row.segment<D>(0) = -x;
  row.segment<3>(3) = -Space<D>::moment(p.node_a.R, arm_A, x);
  row.segment<D>(6) = x;
  row.segment<3>(9) = Space<D>::moment(p.node_b.R, arm_B, x);
  return row;
}

/// a·(X_B − x_A) with X_B the origin of marker B: all of it turns with A. Its arm is d, from the origin of A.
template <int D>
struct Along {
  Vector3d d, arm_B;
  VectorOf<D> a;
  Along(const Relation& r, const MarkerPair& p)
      : arm_B(Space<D>::rotated(p.node_b.R, p.b.p)), a(Space<D>::part(Space<D>::rotated(p.node_a.R, p.a.R.col(r.i)))) {
    d = p.node_b.x - p.node_a.x + arm_B;
  }
};

template <int D>
RelationTerms evaluate_along(const Relation& r, const MarkerPair& p) {
  const Along<D> q(r, p);
  const double place_A = Space<D>::part(p.a.R.col(r.i)).dot(Space<D>::part(p.a.p));
  return {q.a.dot(Space<D>::part(q.d)) - place_A, pulled_back<D>(q.a, q.d, q.arm_B, p)};
}

template <int D>
Row12 rate_gradient_along(const Relation& r, const MarkerPair& p) {
  const Along<D> q(r, p);
  const VectorOf<D> spun_B = Space<D>::across(Space<D>::spin(p.node_b), Space<D>::part(q.arm_B));
  const VectorOf<D> d_dot = Space<D>::part(p.node_b.xd - p.node_a.xd) + spun_B;
  Row12 N = pulled_back<D>(Space<D>::across(Space<D>::spin(p.node_a), q.a), q.d, q.arm_B, p);
  add_turns<D>(N, p, Space<D>::cross(q.a, d_dot), Space<D>::cross(spun_B, q.a));
  return N;
}

template <int D>
void add_stiffness_along(const Relation& r, const MarkerPair& p, double weight, Square12& K) {
  const Along<D> q(r, p);
  const Eigen::Matrix<double, D, Space<D>::turns> turned = weight * Space<D>::turning(p.node_a.R, q.a);
  add_both(K, 0, turn_A<D>, -turned);
  add_both(K, 6, turn_A<D>, turned);
  add_turn_stiffness<D>(q.a, Space<D>::part(q.d), Space<D>::part(q.arm_B), p, weight, K);
}

/// Markers at one point, as before an assembly, have no direction: then n = 0, and nothing is divided by the length.
template <int D>
struct Distance {
  Vector3d arm_A, arm_B;
  VectorOf<D> n;
  double length, inverse;
  explicit Distance(const MarkerPair& p)
      : arm_A(Space<D>::rotated(p.node_a.R, p.a.p)), arm_B(Space<D>::rotated(p.node_b.R, p.b.p)) {
    const VectorOf<D> d = Space<D>::part(p.node_b.x - p.node_a.x + arm_B - arm_A);
    length = d.norm();
    inverse = length > 0.0 ? 1.0 / length : 0.0;
    n = d * inverse;
  }
};

template <int D>
RelationTerms evaluate_distance(const MarkerPair& p) {
  const Distance<D> q(p);
  return {q.length, pulled_back<D>(q.n, q.arm_A, q.arm_B, p)};
}

template <int D>
Row12 rate_gradient_distance(const MarkerPair& p) {
  const Distance<D> q(p);
  const VectorOf<D> spun_A = Space<D>::across(Space<D>::spin(p.node_a), Space<D>::part(q.arm_A));
  const VectorOf<D> spun_B = Space<D>::across(Space<D>::spin(p.node_b), Space<D>::part(q.arm_B));
  const VectorOf<D> d_dot = Space<D>::part(p.node_b.xd - p.node_a.xd) + spun_B - spun_A;
  Row12 N = pulled_back<D>((d_dot - q.n.dot(d_dot) * q.n) * q.inverse, q.arm_A, q.arm_B, p);
  add_turns<D>(N, p, Space<D>::cross(q.n, spun_A), Space<D>::cross(spun_B, q.n));
  return N;
}

/// Adds the stiffness of a distance: d changes by δx_B − δx_A + turned_B δΘ_B − turned_A δΘ_A, normal to n.
template <int D>
void add_stiffness_distance(const MarkerPair& p, double weight, Square12& K) {
  constexpr int n = Space<D>::turns, A = turn_A<D>, B = turn_B<D>;
  const Distance<D> q(p);
  const VectorOf<D> arm_A = Space<D>::part(q.arm_A), arm_B = Space<D>::part(q.arm_B);
  const Matrix3d &R_A = p.node_a.R, &R_B = p.node_b.R;
  const Eigen::Matrix<double, D, n> turned_A = Space<D>::turning(R_A, arm_A), turned_B = Space<D>::turning(R_B, arm_B);
  const Eigen::Matrix<double, D, D> P =
      (weight * q.inverse) * (Eigen::Matrix<double, D, D>::Identity() - q.n * q.n.transpose());
  const Eigen::Matrix<double, D, n> P_A = P * turned_A, P_B = P * turned_B;
  K.block<D, D>(0, 0) += P;
  K.block<D, D>(6, 6) += P;
  add_both(K, 0, 6, -P);
  add_both(K, 0, A, P_A);
  add_both(K, 0, B, -P_B);
  add_both(K, 6, A, -P_A);
  add_both(K, 6, B, P_B);
  add_both(K, A, B, -turned_A.transpose() * P_B);
  K.block<n, n>(A, A) += turned_A.transpose() * P_A + weight * Space<D>::turning_product(R_A, arm_A, q.n);
  K.block<n, n>(B, B) += turned_B.transpose() * P_B - weight * Space<D>::turning_product(R_B, arm_B, q.n);
}

// ---- all relations -----------------------------------------------------------------------------------------------

template <int D>
RelationTerms turned_terms(const TurnTerms<D>& turned, const MarkerPair& p) {
  RelationTerms terms;
  terms.value = turned.value;
  add_turns<D>(terms.G, p, turned.by, -turned.by);
  return terms;
}

template <int D>
Row12 turned_row(const TurnOf<D>& by, const MarkerPair& p) {
  Row12 row = Row12::Zero();
  add_turns<D>(row, p, by, -by);
  return row;
}

template <int D>
RelationTerms evaluate_in(const Relation& r, const MarkerPair& p) {
  switch (r.kind) {
    case RelationKind::along:
      return evaluate_along<D>(r, p);
    case RelationKind::normal:
      return turned_terms<D>(terms_of<D>(normal_sum(r), p), p);
    case RelationKind::twist:
      return turned_terms<D>(terms_of<D>(twist_sum, p), p);
    case RelationKind::distance:
      return evaluate_distance<D>(p);
    case RelationKind::angle:
      return turned_terms<D>(ArcTangent<D>(angle_terms(r), p).angle(), p);
  }
  TISSERAND_ENSURE(false, "relation of kind {}", static_cast<int>(r.kind));
}

template <int D>
Row12 rate_gradient_in(const Relation& r, const MarkerPair& p) {
  switch (r.kind) {
    case RelationKind::along:
      return rate_gradient_along<D>(r, p);
    case RelationKind::normal:
      return turned_row<D>(rate_of<D>(normal_sum(r), p), p);
    case RelationKind::twist:
      return turned_row<D>(rate_of<D>(twist_sum, p), p);
    case RelationKind::distance:
      return rate_gradient_distance<D>(p);
    case RelationKind::angle:
      if constexpr (D == 3) return turned_row<D>(rate_of<D>(angle_terms(r), p), p);
      return Row12::Zero();  // in the plane it is linear in the rotations
  }
  TISSERAND_ENSURE(false, "relation of kind {}", static_cast<int>(r.kind));
}

template <int D>
void add_stiffness_in(const Relation& r, const MarkerPair& p, double weight, Square12& K) {
  switch (r.kind) {
    case RelationKind::along:
      add_stiffness_along<D>(r, p, weight, K);
      return;
    case RelationKind::normal:
      add_stiffness<D>(normal_sum(r), p, weight, K);
      return;
    case RelationKind::twist:
      add_stiffness<D>(twist_sum, p, weight, K);
      return;
    case RelationKind::distance:
      add_stiffness_distance<D>(p, weight, K);
      return;
    case RelationKind::angle:
      if constexpr (D == 3) add_stiffness<D>(angle_terms(r), p, weight, K);
      return;
  }
}

}  // namespace

RelationTerms evaluate(const Relation& r, const MarkerPair& p) {
  return r.planar ? evaluate_in<2>(r, p) : evaluate_in<3>(r, p);
}

Row12 rate_gradient(const Relation& r, const MarkerPair& p) {
  return r.planar ? rate_gradient_in<2>(r, p) : rate_gradient_in<3>(r, p);
}

void add_stiffness(const Relation& r, const MarkerPair& p, double weight, Square12& K) {
  r.planar ? add_stiffness_in<2>(r, p, weight, K) : add_stiffness_in<3>(r, p, weight, K);
}

double bias(const Relation& r, const MarkerPair& p) { return product(rate_gradient(r, p), p); }

bool has_planar_axes(const Relation& r, const Marker& a, const Marker& b) {
  constexpr double share = 1e-10;  // build/planar.cpp neglects smaller couplings too
  const auto lies = [](const Marker& marker, int axis) { return std::abs(marker.R(2, axis)) <= share; };
  const auto all_lie = [&](const NormalSum& sum) {
    return std::all_of(sum.term.begin(), sum.term.begin() + sum.count,
                       [&](const NormalTerm& term) { return lies(a, term.i) && lies(b, term.j); });
  };
  switch (r.kind) {
    case RelationKind::along:
      return lies(a, r.i);
    case RelationKind::normal:
      return all_lie(normal_sum(r));
    case RelationKind::twist:
      return all_lie(twist_sum);
    case RelationKind::distance:
      return true;
    case RelationKind::angle: {
      const AngleTerms terms = angle_terms(r);
      return all_lie(terms.sine) && all_lie(terms.cosine);
    }
  }
  return false;
}

}  // namespace tisserand::mechanism
