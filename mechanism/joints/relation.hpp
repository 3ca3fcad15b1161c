// SPDX-License-Identifier: GPL-3.0-or-later
// Scalar relations between two markers, which joints keep at zero or joint coordinates measure.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "mechanism/frames/marker.hpp"
#include "mechanism/frames/motion.hpp"

namespace tisserand::mechanism {

/// Kinds of relations between markers A and B, THEORY (55). d = x_B − x_A is the distance vector of the origins. a_i
/// and b_j are axes of A and B (0 x, 1 y, 2 z).
enum class RelationKind : std::uint8_t {
  along,     ///< a_i · d: displacement of B along axis i of A
  normal,    ///< a_i · b_j: 0 if the axes are normal to each other
  twist,     ///< x_A · y_B − y_A · x_B: 0 if B turns as much as A (constant velocity)
  distance,  ///< |d|: distance of the origins
  angle,     ///< rotation of B about axis i of A, right-handed, in (−π, π]; angle_terms() defines "about"
};

/// Scalar relation between two markers: its kind and the axes i of A and j of B.
struct Relation {
  RelationKind kind = RelationKind::along;
  std::uint8_t i = 0;
  std::uint8_t j = 0;
  bool planar = false;  ///< its axes lie in the plane of a planar model
};

/// Whether the value of the relation is a length. Other values are of order one: an angle or a product of unit vectors.
inline bool is_length(const Relation& relation) {
  return relation.kind == RelationKind::along || relation.kind == RelationKind::distance;
}

/// Dependence of a relation on positions of the origins, axes of marker A, and axes of marker B. A marker off its node
/// moves with the rotation of the node in any case.
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

/// Markers A and B with the motion of the nodes that carry them.
struct MarkerPair {
  const Marker& a;
  const Marker& b;
  const NodeMotion& node_a;
  const NodeMotion& node_b;
};

/// Row in the columns [x_A Θ_A x_B Θ_B]: world translations and material rotations of the nodes of two markers.
using Row12 = Eigen::Matrix<double, 1, 12>;
/// Matrix in the rows and columns [x_A Θ_A x_B Θ_B].
using Square12 = Eigen::Matrix<double, 12, 12>;

/// Value and gradient G of a relation, THEORY (56), (57): δ value = G δq, and rate = G v.
struct RelationTerms {
  double value = 0.0;
  Row12 G = Row12::Zero();
};
RelationTerms evaluate(const Relation& relation, const MarkerPair& pair);

/// Whether the axes that the relation uses lie in the plane z = 0 of both carriers.
bool has_planar_axes(const Relation& relation, const Marker& a, const Marker& b);
/// Bias Ġ v of a relation with the gradient G, THEORY (59). The second derivative of its value is G v̇ + Ġ v.
double bias(const Relation& relation, const MarkerPair& pair);

/// Derivative ∂(G v)/∂q of the rate of a relation with the gradient G, at fixed ẋ and Ω.
Row12 rate_gradient(const Relation& relation, const MarkerPair& pair);

/// Adds weight · ∂(Gᵀ)/∂q to K, for a relation with the gradient G. It is not symmetric with material increments.
void add_stiffness(const Relation& relation, const MarkerPair& pair, double weight, Square12& K);

}  // namespace tisserand::mechanism
