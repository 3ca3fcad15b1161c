// SPDX-License-Identifier: GPL-3.0-or-later
// Scalar relations between two markers, which joints keep at zero or joint coordinates measure.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "mechanism/frames/marker.hpp"
#include "mechanism/frames/motion.hpp"

namespace tisserand::mechanism {

/// Kinds of THEORY (55). d = x_B − x_A between the origins of the markers; a_i, b_j: axes of A and B (0 x, 1 y, 2 z).
enum class RelationKind : std::uint8_t {
  along,     ///< a_i · d: displacement of B along axis i of A
  normal,    ///< a_i · b_j: 0 if the axes are normal to each other
  twist,     ///< x_A · y_B − y_A · x_B: 0 if B turns as much as A (constant velocity)
  distance,  ///< |d|
  angle,     ///< rotation of B about axis i of A, right-handed, in (−π, π]; angle_terms() defines "about"
};

struct Relation {
  RelationKind kind = RelationKind::along;
  std::uint8_t i = 0;
  std::uint8_t j = 0;
  bool planar = false;  ///< in planar models: its axes lie in the plane, and it has the columns of Space<2>
};

/// Whether its value is a length. Others are of order one: an angle or a product of unit vectors.
inline bool is_length(const Relation& relation) {
  return relation.kind == RelationKind::along || relation.kind == RelationKind::distance;
}

/// Dependence of a relation on positions of the origins, axes of marker A, axes of marker B. A marker off its node
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

/// Value and gradient G of a relation, THEORY (56), (57): δ value = G δq, and rate = G v.
struct RelationTerms {
  double value = 0.0;
  Row12 G = Row12::Zero();
};
RelationTerms evaluate(const Relation& relation, const MarkerPair& pair);

/// Whether the axes that the relation uses lie in the plane z = 0 of both carriers.
bool has_planar_axes(const Relation& relation, const Marker& a, const Marker& b);
/// Bias Ġ v of THEORY (59): the second derivative of the value is G v̇ + Ġ v.
double bias(const Relation& relation, const MarkerPair& pair);

/// Derivative ∂(G v)/∂q at fixed ẋ and Ω.
Row12 rate_gradient(const Relation& relation, const MarkerPair& pair);

/// Adds weight ∂(Gᵀ)/∂q to K; not symmetric with material increments.
void add_stiffness(const Relation& relation, const MarkerPair& pair, double weight, Square12& K);

}  // namespace tisserand::mechanism
