// SPDX-License-Identifier: GPL-3.0-or-later
// Joints between two markers. The constraints Φ of a joint are zero. This file also has their Jacobian B, the bias of
// Φ̈ and the geometric stiffness of the reactions. joint_laws.cpp lists the constraints of each kind.
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

/// Joint between markers A and B with its equations Φ: x_B − x_A (world axes) if it keeps the origins together, then
/// relations minus `constant`.
struct Joint {
  std::string name;
  JointKind kind = JointKind::spherical;
  Marker a;
  Marker b;
  bool coincident = true;
  bool planar = false;  ///< origins are kept together in x and y alone
  std::array<Relation, 6> relations{};
  int relation_count = 0;
  double constant = 0.0;  ///< length of a joint that keeps a distance; else 0
  int row = 0;            ///< index of its first multiplier
  int thread = -1;        ///< for screws: index in Model::couplings; else −1

  int coincident_rows() const { return !coincident ? 0 : planar ? 2 : 3; }
  int size() const { return coincident_rows() + relation_count; }
};

/// Whether equation `equation` of the joint is a length. Others are of order one: angles and products of unit vectors.
bool is_length(const Joint& joint, int equation);

/// Axis (0 x, 1 y, 2 z) that the joint keeps parallel on both markers, −1 if none. Products of axes also allow opposite
/// axes.
int aligned_axis(const Joint& joint);
/// Whether the joint keeps all three axes of both markers parallel.
bool keeps_orientation(const Joint& joint);

/// Sets coincidence and relations of the joint from the law of its kind, or from `held` if the scene gives `hold`.
void set_relations(JointKind kind, const std::array<bool, 6>& held, Joint& joint);

/// Dependence of the equations of the joint on positions of the markers and on their axes. Free coordinates of the
/// joint do not count.
Dependence depends_on(const Joint& joint);

/// Length of the constrained part of `displacement` of marker B from A (axes of A). It is the violation that a shift of
/// one marker by the displacement causes.
double held_length(const Joint& joint, const Eigen::Vector3d& displacement);

/// Whether the joint keeps a distance. Its markers are then apart, and their axes do not matter.
bool keeps_distance(const Joint& joint);

/// Coordinate that a joint leaves free, with its name from formats::JointKindRow.
struct NamedRelation {
  std::string name;
  Relation relation;
};
std::vector<NamedRelation> free_coordinates(const Joint& joint);

/// Name of one equation for messages, e.g. "translation x" or "z axis of B normal to x axis of A".
std::string joint_equation_name(const Joint& joint, int equation);

/// Constraints of one joint at one instant. `phi` has the values Φ, and B their derivatives. Only the first
/// Joint::size() rows are used. The columns of B are the translation (world axes) and the rotation (axes of the body)
/// of the body of marker A, then the same of marker B, three columns each.
struct JointTerms {
  Eigen::Matrix<double, 6, 1> phi = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 12> B = Eigen::Matrix<double, 6, 12>::Zero();
  Eigen::Matrix<double, 6, 1> bias = Eigen::Matrix<double, 6, 1>::Zero();  ///< Ḃ v of THEORY (59): Φ̈ = B v̇ + bias
};

using Vector12 = Eigen::Matrix<double, 12, 1>;

/// Product B d for increments `a` and `b` of both carriers (nodes of the markers); a carrier that is the ground adds
/// nothing. Rows after those of the joint are zero, so that loops have constant bounds. A joint has no more equations
/// than a carrier has columns.
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
/// Product Bᵀ λ of the joint for one carrier, whose columns in B begin at `first`: 0 for A, 6 for B. The coupling of a
/// thread is not in it.
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

/// Computes Φ and B of the joint in `terms`. `a`, `b`: motion of the nodes of its markers.
void joint_constraints(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms);

/// Computes the bias Ḃ v of the joint in `terms`, THEORY (59). `a`, `b`: motion of the nodes of its markers.
void joint_bias(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms);

/// Computes the derivative N = ∂(B v)/∂(x_A Θ_A x_B Θ_B) at fixed ẋ and Ω, for THEORY (59) and (70). The first size()
/// rows are in use.
void joint_rate_gradient(const Joint& joint, const NodeMotion& a, const NodeMotion& b, Eigen::Matrix<double, 6, 12>& N);

/// Computes the geometric stiffness K = ∂(Bᵀλ)/∂(x_A Θ_A x_B Θ_B) of the reactions. It is not symmetric with material
/// increments.
void joint_stiffness(const Joint& joint, const NodeMotion& a, const NodeMotion& b, const double* lambda, Square12& K);

/// Force and moment that the body of A exerts on the body of B, at the origin of B, in axes of A.
struct JointReaction {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};
/// Reaction of a constraint or an applied force with multipliers λ and gradients G (rows of [x_A Θ_A x_B Θ_B]): the
/// wrench −Gᵀ λ on B. `pulled_back`: λᵀ G.
JointReaction reaction_of(const Row12& pulled_back, const MarkerPair& pair);
/// Reaction of the joint, without that of its thread, which is a coupling.
JointReaction joint_reaction(const Joint& joint, const NodeMotion& a, const NodeMotion& b, const double* lambda);

}  // namespace tisserand::mechanism
