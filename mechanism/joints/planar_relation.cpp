// Relations of planar models: carriers turn about z alone, so that rotations add up.
#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "mechanism/joints/axis_products.hpp"
#include "mechanism/joints/relation.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double cross_z(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Of a value that grows along x (world) with what B displaces from A, at `place_A` and `place_B` seen from the
/// carriers' origins (world).
void assign(Row12& row, const Vector2d& x, const Vector2d& place_A, const Vector2d& place_B) {
  row[0] = -x.x();
  row[1] = -x.y();
  row[5] = -cross_z(place_A, x);
  row[6] = x.x();
  row[7] = x.y();
  row[11] = cross_z(place_B, x);
}

/// a·b of the sum, and its derivative by the turn of A: minus that by the turn of B.
struct PlanarSum {
  double value = 0.0;
  double by_A = 0.0;
  PlanarSum(const NormalSum& sum, const MarkerPair& p) {
    for (int k = 0; k < sum.count; ++k) {
      const NormalTerm& term = sum.term[k];
      const Vector2d a = in_plane(p.node_a.R, p.a.R.col(term.i)), b = in_plane(p.node_b.R, p.b.R.col(term.j));
      value += term.sign * a.dot(b);
      by_A += term.sign * cross_z(a, b);
    }
  }
};

RelationTerms planar_along(const Relation& r, const MarkerPair& p) {
  const Vector3d alpha = p.a.R.col(r.i);
  const Vector2d a = in_plane(p.node_a.R, alpha), arm_B = in_plane(p.node_b.R, p.b.p);
  const Vector2d from_A = (p.node_b.x - p.node_a.x).head<2>() + arm_B;
  RelationTerms terms;
  terms.value = a.dot(from_A) - alpha.head<2>().dot(p.a.p.head<2>());
  assign(terms.G, a, from_A, arm_B);
  const double height = p.node_b.x.z() + p.b.p.z() - p.node_a.x.z();
  add_height(terms.G.segment<2>(3), p.node_a.R, height, -a);
  add_height(terms.G.segment<2>(9), p.node_b.R, p.b.p.z(), a);
  return terms;
}

RelationTerms planar_distance(const MarkerPair& p) {
  const Vector2d arm_A = in_plane(p.node_a.R, p.a.p), arm_B = in_plane(p.node_b.R, p.b.p);
  const Vector2d d = (p.node_b.x - p.node_a.x).head<2>() + arm_B - arm_A;
  RelationTerms terms;
  terms.value = d.norm();
  const Vector2d n = terms.value > 0.0 ? Vector2d(d / terms.value) : Vector2d::Zero();
  assign(terms.G, n, arm_A, arm_B);
  add_height(terms.G.segment<2>(3), p.node_a.R, p.a.p.z(), -n);
  add_height(terms.G.segment<2>(9), p.node_b.R, p.b.p.z(), n);
  return terms;
}

/// K += ∂G/∂q: `x` of the translations from row `first` by the turn of A, and back.
void add_symmetric(int first, const Vector2d& x, Square12& K) {
  for (int k = 0; k < 2; ++k) {
    K(first + k, 5) += x[k];
    K(5, first + k) += x[k];
  }
}

/// Of the turns of A and B.
void add_turns(double AA, double AB, double BB, Square12& K) {
  K(5, 5) += AA;
  K(5, 11) += AB;
  K(11, 5) += AB;
  K(11, 11) += BB;
}

RelationTerms planar_turn(double value, double by_A) {
  RelationTerms terms;
  terms.value = value;
  terms.G[5] = by_A;
  terms.G[11] = -by_A;
  return terms;
}

}  // namespace

bool has_planar_axes(const Relation& r, const Marker& a, const Marker& b) {
  constexpr double share = 1e-10;  // as of couplings that count as none (build/planar.cpp)
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

RelationTerms evaluate_in_plane(const Relation& r, const MarkerPair& p) {
  switch (r.kind) {
    case RelationKind::along:
      return planar_along(r, p);
    case RelationKind::distance:
      return planar_distance(p);
    case RelationKind::normal:
    case RelationKind::twist: {
      const PlanarSum sum(r.kind == RelationKind::normal ? normal_sum(r) : twist_sum, p);
      return planar_turn(sum.value, sum.by_A);
    }
    case RelationKind::angle: {
      const AngleTerms terms = angle_terms(r);
      const PlanarSum s(terms.sine, p), c(terms.cosine, p);
      const double square = s.value * s.value + c.value * c.value;
      return planar_turn(std::atan2(s.value, c.value), (c.value * s.by_A - s.value * c.by_A) / square);
    }
  }
  TISSERAND_ENSURE(false, "relation of kind {}", static_cast<int>(r.kind));
}

void add_stiffness_in_plane(const Relation& r, const MarkerPair& p, double weight, Square12& K) {
  switch (r.kind) {
    case RelationKind::along: {
      const Vector2d a = weight * in_plane(p.node_a.R, p.a.R.col(r.i)), turned(-a.y(), a.x());
      const Vector2d arm_B = in_plane(p.node_b.R, p.b.p);
      const double of_B = arm_B.dot(a), of_A = of_B + (p.node_b.x - p.node_a.x).head<2>().dot(a);
      add_symmetric(0, -turned, K);
      add_symmetric(6, turned, K);
      add_turns(-of_A, of_B, -of_B, K);
      return;
    }
    case RelationKind::distance: {
      const Vector2d arm_A = in_plane(p.node_a.R, p.a.p), arm_B = in_plane(p.node_b.R, p.b.p);
      const Vector2d d = (p.node_b.x - p.node_a.x).head<2>() + arm_B - arm_A;
      const double length = d.norm();
      if (length == 0.0) return;
      const Vector2d n = d / length;
      Row12 across = Row12::Zero();
      assign(across, Vector2d(-n.y(), n.x()), arm_A, arm_B);
      for (const int i : planar_columns)
        for (const int j : planar_columns) K(i, j) += weight / length * across[i] * across[j];
      add_turns(weight * n.dot(arm_A), 0.0, -weight * n.dot(arm_B), K);
      return;
    }
    case RelationKind::normal:
    case RelationKind::twist: {
      const double value = weight * PlanarSum(r.kind == RelationKind::normal ? normal_sum(r) : twist_sum, p).value;
      add_turns(-value, value, -value, K);
      return;
    }
    case RelationKind::angle:
      return;  // linear in the turns
  }
}

Row12 rate_gradient_in_plane(const Relation& r, const MarkerPair& p) {
  if (r.kind == RelationKind::angle) return Row12::Zero();
  Square12 H = Square12::Zero();
  add_stiffness_in_plane(r, p, 1.0, H);
  const std::array<double, 6> v{p.node_a.xd.x(), p.node_a.xd.y(), p.node_a.Omega.z(),
                                p.node_b.xd.x(), p.node_b.xd.y(), p.node_b.Omega.z()};
  Row12 N = Row12::Zero();
  for (const int j : planar_columns)
    for (int i = 0; i < 6; ++i) N[j] += v[i] * H(planar_columns[i], j);
  return N;
}

}  // namespace tisserand::mechanism
