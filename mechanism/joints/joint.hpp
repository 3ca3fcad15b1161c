// Joints between two markers: the relations that they hold at zero, with constraints Φ, Jacobian B, the bias of Φ̈ and
// the geometric stiffness of the reactions. What each kind holds stands in joint_laws.cpp.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/scene/scene.hpp"
#include "mechanism/frames/space.hpp"
#include "mechanism/joints/joint_laws.hpp"
#include "mechanism/joints/relation.hpp"

namespace tisserand::mechanism {

/// First, if the joint keeps the origins together, Φ = x_B − x_A in world axes; then the relations, minus `constant`.
struct Joint {
  std::string name;
  JointKind kind = JointKind::spherical;
  Marker a;
  Marker b;
  bool coincident = true;
  bool planar = false;  ///< in planar models: origins kept together in x and y alone
  std::array<Relation, 6> relations{};
  int relation_count = 0;
  double constant = 0.0;  ///< length of a joint that keeps a distance; 0 for all others
  int row = 0;            ///< first multiplier
  int thread = -1;        ///< of screws: index in Model::couplings of z − lead × angle

  int coincident_rows() const { return !coincident ? 0 : planar ? 2 : 3; }
  int size() const { return coincident_rows() + relation_count; }
};

/// Whether equation `k` of the joint is a length (or a number of order one: angles, products of unit vectors).
bool is_length(const Joint& joint, int equation);

/// The axis that both markers keep parallel (−1: none), and whether they keep all three: products of axes are also met
/// by axes that point the other way.
int aligned_axis(const Joint& joint);
bool keeps_orientation(const Joint& joint);

/// Coincidence and relations of the joint from the law of its kind, or from `held` if `hold` says what is held.
void set_relations(JointKind kind, const std::array<bool, 6>& held, Joint& joint);

/// Dependence of the equations of the joint on places and axes, without its coordinates.
Dependence depends_on(const Joint& joint);

/// The part of a displacement of marker B from A (axes of A) that the joint holds: the length by which a shift of one
/// marker by the displacement would violate the joint.
double held_length(const Joint& joint, const Eigen::Vector3d& displacement);

/// Whether the joint keeps a distance: its markers are then apart, and their axes do not matter.
bool keeps_distance(const Joint& joint);

/// The coordinates that the joint leaves free, by the names of formats::JointKindRow.
struct NamedRelation {
  std::string name;
  Relation relation;
};
std::vector<NamedRelation> free_coordinates(const Joint& joint);

/// Name of one equation for messages, e.g. "translation x" or "z axis of B normal to x axis of A".
std::string joint_equation_name(const Joint& joint, int equation);

/// Values of one joint; the first size() rows count. Columns of B: [x_A Θ_A x_B Θ_B] (material rotations).
struct JointTerms {
  Eigen::Matrix<double, 6, 1> phi = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 12> B = Eigen::Matrix<double, 6, 12>::Zero();
  Eigen::Matrix<double, 6, 1> bias = Eigen::Matrix<double, 6, 1>::Zero();  ///< Ḃ v of THEORY (59): Φ̈ = B v̇ + bias
};

using Vector12 = Eigen::Matrix<double, 12, 1>;

/// B d for increments of both carriers; the ground (d = 0) is left out. Rows behind the joint's are zero, so that loops
/// have constant bounds: a joint has no more equations than a carrier has columns.
template <int D>
CarrierVector<D> rows_times(const Joint& joint, const JointTerms& terms, const CarrierVector<D>& a,
                            const CarrierVector<D>& b) {
  constexpr int turns = Space<D>::turns, rows = D + turns;
  CarrierVector<D> product = CarrierVector<D>::Zero();
  const auto add = [&](int first, const CarrierVector<D>& d) {
    product += terms.B.block<rows, D>(0, first).lazyProduct(d.template head<D>());
    product += terms.B.block<rows, turns>(0, first + Space<D>::first_turn).lazyProduct(d.template tail<turns>());
  };
  if (joint.a.node >= 0) add(0, a);
  if (joint.b.node >= 0) add(6, b);
  return product;
}
/// Bᵀ λ of the joint's own rows, of the carrier whose columns begin at `first`: 0 (A) or 6 (B).
template <int D>
CarrierVector<D> transposed_times(const Joint& joint, const JointTerms& terms, const double* lambda, int first) {
  constexpr int turns = Space<D>::turns, rows = D + turns;
  CarrierVector<D> own = CarrierVector<D>::Zero(), product;
  for (int k = 0; k < joint.size(); ++k) own[k] = lambda[k];
  product.template head<D>() = terms.B.block<rows, D>(0, first).transpose().lazyProduct(own);
  product.template tail<turns>() =
      terms.B.block<rows, turns>(0, first + Space<D>::first_turn).transpose().lazyProduct(own);
  return product;
}

/// Φ and B.
void joint_constraints(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms);

/// Ḃ v.
void joint_bias(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms);

/// ∂(B v)/∂(x_A Θ_A x_B Θ_B) at fixed ẋ and Ω, which THEORY (59) and (70) use; the first size() rows count.
void joint_rate_gradient(const Joint& joint, const NodeMotion& a, const NodeMotion& b, Eigen::Matrix<double, 6, 12>& N);

/// ∂(Bᵀλ)/∂(x_A Θ_A x_B Θ_B), not symmetric with material increments.
void joint_stiffness(const Joint& joint, const NodeMotion& a, const NodeMotion& b, const double* lambda, Square12& K);

/// What A's body exerts on B's body, at B's origin, in A's axes.
struct JointReaction {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};
/// The reaction of constraint or applied forces with gradients G (rows of [x_A Θ_A x_B Θ_B]): −Gᵀ λ on B.
JointReaction reaction_of(const Row12& pulled_back, const MarkerPair& pair);
/// Reaction of the joint's own rows, without its thread, which is a coupling.
JointReaction joint_reaction(const Joint& joint, const NodeMotion& a, const NodeMotion& b, const double* lambda);

}  // namespace tisserand::mechanism
