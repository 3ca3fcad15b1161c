// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over the relations of a joint.
#include "mechanism/joints/joint.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/error.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const Relation& relation_of(const Joint& joint, int equation) {
  return joint.relations[equation - joint.coincident_rows()];
}

constexpr std::array<const char*, 3> axis_name{"x", "y", "z"};

int count_normals(const Joint& joint, int column) {
  int count = 0;
  for (int k = 0; k < joint.relation_count; ++k) {
    const Relation& r = joint.relations[k];
    count += r.kind == RelationKind::normal && (column < 0 || r.j == column);
  }
  return count;
}

/// Whether the directions that `hold` chose leave a displacement along an axis free, or only the rotation about it.
bool is_free(const Joint& joint, const Relation& coordinate) {
  if (coordinate.kind == RelationKind::angle) return aligned_axis(joint) == coordinate.i;
  const Relation* end = joint.relations.data() + joint.relation_count;
  return !joint.coincident && std::none_of(joint.relations.data(), end, [&](const Relation& held) {
    return held.kind == RelationKind::along && held.i == coordinate.i;
  });
}

/// Computes Φ = X_B − X_A and B of origins that are kept together.
template <int D>
void keep_together(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms) {
  constexpr int turns = Space<D>::turns, first = Space<D>::first_turn;
  const Vector3d arm_a = Space<D>::rotated(a.R, joint.a.p), arm_b = Space<D>::rotated(b.R, joint.b.p);
  terms.phi.head<D>() = Space<D>::part(b.x + arm_b - a.x - arm_a);
  terms.B.block<D, D>(0, 0) = -Eigen::Matrix<double, D, D>::Identity();
  terms.B.block<D, turns>(0, first) = -Space<D>::turning(a.R, Space<D>::part(arm_a));
  terms.B.block<D, D>(0, 6).setIdentity();
  terms.B.block<D, turns>(0, 6 + first) = Space<D>::turning(b.R, Space<D>::part(arm_b));
  if (D == 3 || (arm_a.z() == 0.0 && arm_b.z() == 0.0)) return;
  for (int k = 0; k < D; ++k) {
    terms.B.row(k).segment<3>(3) = -Space<D>::moment(a.R, arm_a, VectorOf<D>::Unit(k));
    terms.B.row(k).segment<3>(9) = Space<D>::moment(b.R, arm_b, VectorOf<D>::Unit(k));
  }
}

/// Computes ∂(B v)/∂q of these equations.
template <int D>
void keep_together_rate(const Joint& joint, const NodeMotion& a, const NodeMotion& b, Eigen::Matrix<double, 6, 12>& N) {
  constexpr int turns = Space<D>::turns, first = Space<D>::first_turn;
  const VectorOf<D> arm_a = Space<D>::part(Space<D>::rotated(a.R, joint.a.p));
  const VectorOf<D> arm_b = Space<D>::part(Space<D>::rotated(b.R, joint.b.p));
  N.block<D, turns>(0, first) = -Space<D>::turning(a.R, Space<D>::across(Space<D>::spin(a), arm_a));
  N.block<D, turns>(0, 6 + first) = Space<D>::turning(b.R, Space<D>::across(Space<D>::spin(b), arm_b));
}

/// Adds ∂(Bᵀλ)/∂q of these equations.
template <int D>
void keep_together_stiffness(const Joint& joint, const NodeMotion& a, const NodeMotion& b, const double* lambda,
                             Square12& K) {
  constexpr int turns = Space<D>::turns, first = Space<D>::first_turn;
  const VectorOf<D> force = Eigen::Map<const VectorOf<D>>(lambda);
  const VectorOf<D> arm_a = Space<D>::part(Space<D>::rotated(a.R, joint.a.p));
  const VectorOf<D> arm_b = Space<D>::part(Space<D>::rotated(b.R, joint.b.p));
  K.block<turns, turns>(first, first) = Space<D>::turning_product(a.R, arm_a, force);
  K.block<turns, turns>(6 + first, 6 + first) = -Space<D>::turning_product(b.R, arm_b, force);
}

}  // namespace

bool is_length(const Joint& joint, int equation) {
  return equation < joint.coincident_rows() || is_length(relation_of(joint, equation));
}

int aligned_axis(const Joint& joint) {
  for (int k = 0; k < 3; ++k)
    if (count_normals(joint, k) == 2) return k;
  return -1;
}
bool keeps_orientation(const Joint& joint) { return count_normals(joint, -1) == 3; }

bool keeps_distance(const Joint& joint) {
  for (int k = 0; k < joint.relation_count; ++k)
    if (joint.relations[k].kind == RelationKind::distance) return true;
  return false;
}

Dependence depends_on(const Joint& joint) {
  Dependence all{.places = joint.coincident};
  for (int k = 0; k < joint.relation_count; ++k) all |= depends_on(joint.relations[k]);
  return all;
}

double held_length(const Joint& joint, const Vector3d& displacement) {
  if (joint.coincident) return displacement.norm();
  double square = 0.0;
  for (int k = 0; k < joint.relation_count; ++k)
    if (const Relation& held = joint.relations[k]; held.kind == RelationKind::along)
      square += displacement[held.i] * displacement[held.i];
  return std::sqrt(square);
}

void set_relations(JointKind kind, const std::array<bool, 6>& held, Joint& joint) {
  const JointLaw& law = joint_law(kind);
  const Held holds = law.chosen ? held_directions(held) : law.holds;
  joint.kind = kind;
  joint.coincident = holds.coincident;
  joint.relation_count = holds.relations.count;
  joint.relations = holds.relations.list;
}

std::vector<NamedRelation> free_coordinates(const Joint& joint) {
  const JointLaw& law = joint_law(joint.kind);
  const formats::CoordinateNames& names = formats::joint_kind(joint.kind).coordinates;
  TISSERAND_ENSURE(names.count == law.coordinates.count, "{} names of {} coordinates", names.count,
                   law.coordinates.count);
  std::vector<NamedRelation> free;
  for (int k = 0; k < names.count; ++k)
    if (const Relation& coordinate = law.coordinates.list[k]; !law.chosen || is_free(joint, coordinate))
      free.push_back({std::string(names.names[k]), coordinate});
  return free;
}

std::string joint_equation_name(const Joint& joint, int equation) {
  if (equation < joint.coincident_rows()) return std::string("translation ") + axis_name[equation];
  const Relation& r = relation_of(joint, equation);
  switch (r.kind) {
    case RelationKind::along:
      return fmt::format("translation along {} of A", axis_name[r.i]);
    case RelationKind::normal:
      return fmt::format("{} axis of B normal to {} axis of A", axis_name[r.j], axis_name[r.i]);
    case RelationKind::twist:
      return "equal rotation of A and B";
    case RelationKind::distance:
      return "distance";
    case RelationKind::angle:
      return fmt::format("rotation about {} of A", axis_name[r.i]);
  }
  return {};
}

void joint_constraints(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms) {
  if (joint.coincident) joint.planar ? keep_together<2>(joint, a, b, terms) : keep_together<3>(joint, a, b, terms);
  const MarkerPair pair{joint.a, joint.b, a, b};
  int row = joint.coincident_rows();
  for (int k = 0; k < joint.relation_count; ++k, ++row) {
    const RelationTerms relation = evaluate(joint.relations[k], pair);
    terms.phi[row] = relation.value - joint.constant;
    terms.B.row(row) = relation.G;
  }
}

void joint_bias(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms) {
  Eigen::Matrix<double, 6, 12> N;
  joint_rate_gradient(joint, a, b, N);
  terms.bias = N.leftCols<6>() * velocity_of<3>(a) + N.rightCols<6>() * velocity_of<3>(b);
}

void joint_rate_gradient(const Joint& joint, const NodeMotion& a, const NodeMotion& b,
                         Eigen::Matrix<double, 6, 12>& N) {
  N.setZero();
  if (joint.coincident) joint.planar ? keep_together_rate<2>(joint, a, b, N) : keep_together_rate<3>(joint, a, b, N);
  const MarkerPair pair{joint.a, joint.b, a, b};
  int row = joint.coincident_rows();
  for (int k = 0; k < joint.relation_count; ++k, ++row) N.row(row) = rate_gradient(joint.relations[k], pair);
}

void joint_stiffness(const Joint& joint, const NodeMotion& a, const NodeMotion& b, const double* lambda, Square12& K) {
  K.setZero();
  if (joint.coincident)
    joint.planar ? keep_together_stiffness<2>(joint, a, b, lambda, K)
                 : keep_together_stiffness<3>(joint, a, b, lambda, K);
  const MarkerPair pair{joint.a, joint.b, a, b};
  int row = joint.coincident_rows();
  for (int k = 0; k < joint.relation_count; ++k, ++row) add_stiffness(joint.relations[k], pair, lambda[row], K);
}

JointReaction reaction_of(const Row12& pulled_back, const MarkerPair& pair) {
  const Vector3d force = -pulled_back.segment<3>(6).transpose();                           // on B, world
  const Vector3d about_node = -pulled_back.segment<3>(9).transpose();                      // axes of node B
  const Vector3d moment = about_node - pair.b.p.cross(pair.node_b.R.transpose() * force);  // about marker B
  const Matrix3d to_A = marker_rotation(pair.a, pair.node_a).transpose();
  return {to_A * force, to_A * (pair.node_b.R * moment)};
}

JointReaction joint_reaction(const Joint& joint, const NodeMotion& a, const NodeMotion& b, const double* lambda) {
  JointTerms terms;
  joint_constraints(joint, a, b, terms);
  Row12 sum = Row12::Zero();
  for (int k = 0; k < joint.size(); ++k) sum += lambda[k] * terms.B.row(k);
  return reaction_of(sum, {joint.a, joint.b, a, b});
}

}  // namespace tisserand::mechanism
