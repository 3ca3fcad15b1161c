// SPDX-License-Identifier: GPL-3.0-or-later
// Joints between two markers. A joint keeps relations at zero: it has constraints Φ, their Jacobian B, the bias of Φ̈ and
// the geometric stiffness of its reactions. joint_laws.cpp lists the relations of each kind.
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

/// Equations of a joint: Φ = x_B − x_A (world axes) if it keeps the origins together, then relations minus `constant`.
struct Joint {
  std::string name;
  JointKind kind = JointKind::spherical;
  Marker a;
  Marker b;
  bool coincident = true;
  bool planar = false;  ///< in planar models: origins are kept together in x and y alone
  std::array<Relation, 6> relations{};
  int relation_count = 0;
  double constant = 0.0;  ///< length of a joint that keeps a distance; 0 for all others
  int row = 0;            ///< first multiplier
  int thread = -1;        ///< for screws: index in Model::couplings of z − lead × angle

  int coincident_rows() const { return !coincident ? 0 : planar ? 2 : 3; }
  int size() const { return coincident_rows() + relation_count; }
};

/// Whether equation `k` of the joint is a length. Others are of order one: angles, products of unit vectors.
bool is_length(const Joint& joint, int equation);

/// The axis that both markers keep parallel (−1: none), and whether they keep all three. Products of axes also allow
/// opposite axes.
int aligned_axis(const Joint& joint);
bool keeps_orientation(const Joint& joint);

/// Sets coincidence and relations of the joint from the law of its kind, or from `held` if the scene gives `hold`.
void set_relations(JointKind kind, const std::array<bool, 6>& held, Joint& joint);

/// Dependence of the equations of the joint on positions and axes, without its coordinates.
Dependence depends_on(const Joint& joint);

/// Length of the part of a displacement of marker B from A (axes of A) that the joint constrains. It is the violation
/// that a shift of one marker by the displacement causes.
double held_length(const Joint& joint, const Eigen::Vector3d& displacement);

/// Whether the joint keeps a distance. Its markers are then apart, and their axes do not matter.
bool keeps_distance(const Joint& joint);

/// A coordinate that the joint leaves free, with its name from formats::JointKindRow.
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

/// Product B d for increments of both carriers; ground has d = 0. Rows after the joint's are zero, so that loops have
/// constant bounds: a joint has no more equations than a carrier has columns.
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
/// Product Bᵀ λ of the joint's own rows, for the carrier whose columns begin at `first`: 0 (A) or 6 (B).
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

/// Computes Φ and B.
void joint_constraints(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms);

/// Computes the bias Ḃ v.
void joint_bias(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms);

/// Computes ∂(B v)/∂(x_A Θ_A x_B Θ_B) at fixed ẋ and Ω for THEORY (59) and (70); the first size() rows count.
void joint_rate_gradient(const Joint& joint, const NodeMotion& a, const NodeMotion& b, Eigen::Matrix<double, 6, 12>& N);

/// Computes K = ∂(Bᵀλ)/∂(x_A Θ_A x_B Θ_B), not symmetric with material increments.
void joint_stiffness(const Joint& joint, const NodeMotion& a, const NodeMotion& b, const double* lambda, Square12& K);

/// Force and moment of A's body on B's body, at B's origin, in A's axes.
struct JointReaction {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};
/// Reaction of constraint or applied forces with gradients G (rows of [x_A Θ_A x_B Θ_B]): −Gᵀ λ on B.
JointReaction reaction_of(const Row12& pulled_back, const MarkerPair& pair);
/// Reaction of the joint's own rows, without its thread, which is a coupling.
JointReaction joint_reaction(const Joint& joint, const NodeMotion& a, const NodeMotion& b, const double* lambda);

}  // namespace tisserand::mechanism
