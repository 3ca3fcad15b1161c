// Scalar relations between two markers: what joints hold at zero, and what joint coordinates measure.
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "mechanism/frames/marker.hpp"
#include "mechanism/frames/motion.hpp"

namespace tisserand::mechanism {

/// d = x_B − x_A between the origins of the markers; a_i, b_j: axes of A and B (0 x, 1 y, 2 z).
enum class RelationKind : std::uint8_t {
  along,     ///< a_i · d: displacement of B along axis i of A
  normal,    ///< a_i · b_j: 0 while the axes are normal to each other
  twist,     ///< x_A · y_B − y_A · x_B: 0 while B turns as much as A (constant velocity)
  distance,  ///< |d|
  angle,     ///< turn of B about axis i of A, right-handed, in (−π, π]; see angle_terms() for what "about" means
};

struct Relation {
  RelationKind kind = RelationKind::along;
  std::uint8_t i = 0;
  std::uint8_t j = 0;
};

/// Whether its value is a length (or a number of order one: an angle or a product of unit vectors).
inline bool is_length(const Relation& relation) {
  return relation.kind == RelationKind::along || relation.kind == RelationKind::distance;
}

/// What a relation depends on. Axes: those of a marker, beyond the place of its origin; a marker away from its node
/// feels the rotation of the node in any case.
struct Dependence {
  bool places = false;
  bool axes_a = false;
  bool axes_b = false;

  constexpr Dependence& operator|=(const Dependence& other) {
    places |= other.places;
    axes_a |= other.axes_a;
    axes_b |= other.axes_b;
    return *this;
  }
};
constexpr Dependence depends_on(const Relation& relation) {
  switch (relation.kind) {
    case RelationKind::along:
      return {true, true, false};
    case RelationKind::distance:
      return {true, false, false};
    case RelationKind::normal:
    case RelationKind::twist:
    case RelationKind::angle:
      return {false, true, true};
  }
  return {};
}

/// Both markers with the motion of their carriers.
struct MarkerPair {
  const Marker& a;
  const Marker& b;
  const NodeMotion& node_a;
  const NodeMotion& node_b;
};

/// Columns [x_A Θ_A x_B Θ_B]: world translations and material rotations of the two carriers.
using Row12 = Eigen::Matrix<double, 1, 12>;
using Square12 = Eigen::Matrix<double, 12, 12>;

/// Value and gradient G: δ value = G δq, and rate = G v.
struct RelationTerms {
  double value = 0.0;
  Row12 G = Row12::Zero();
};
RelationTerms evaluate(const Relation& relation, const MarkerPair& pair);

/// The columns [x y θ] of both carriers that planar models have.
constexpr std::array<int, 6> planar_columns{0, 1, 5, 6, 7, 11};
/// Of a row those of the carrier whose columns begin there at `carrier`: 0 (A) or 3 (B).
inline Eigen::Vector3d in_plane(const Row12& row, int carrier) {
  return {row[planar_columns[carrier]], row[planar_columns[carrier + 1]], row[planar_columns[carrier + 2]]};
}
/// Whether the axes that the relation uses lie in the plane z = 0 of both carriers.
bool has_planar_axes(const Relation& relation, const Marker& a, const Marker& b);
/// Adds the moment across z, material axes, of a force `x` (world) that acts `height` along z from the carrier's
/// origin: what a carrier in the plane does not feel, but what is reported of the ground.
template <class Moment>
void add_height(Moment&& moment, const Eigen::Matrix3d& R, double height, const Eigen::Vector2d& x) {
  if (height == 0.0) return;
  moment[0] -= height * (R(0, 1) * x.x() + R(1, 1) * x.y());
  moment[1] += height * (R(0, 0) * x.x() + R(1, 0) * x.y());
}
/// evaluate() where carriers turn about z alone, of a relation with planar axes.
RelationTerms evaluate_in_plane(const Relation& relation, const MarkerPair& pair);
/// K += weight ∂²(value)/∂q², columns and rows planar_columns: symmetric, since turns about one axis add up.
void add_stiffness_in_plane(const Relation& relation, const MarkerPair& pair, double weight, Square12& K);
/// ∂(G v)/∂q = vᵀ ∂²(value)/∂q².
Row12 rate_gradient_in_plane(const Relation& relation, const MarkerPair& pair);

/// Ġ v: the second derivative of the value is G v̇ + Ġ v.
double bias(const Relation& relation, const MarkerPair& pair);

/// ∂(G v)/∂q at fixed ẋ and Ω.
Row12 rate_gradient(const Relation& relation, const MarkerPair& pair);

/// K += weight ∂(Gᵀ)/∂q; not symmetric with material increments.
void add_stiffness(const Relation& relation, const MarkerPair& pair, double weight, Square12& K);

}  // namespace tisserand::mechanism
