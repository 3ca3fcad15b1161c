// Sums over the relations of a joint.
#include "mechanism/joints/joint.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/math/rotation.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

const Relation& relation_of(const Joint& joint, int equation) {
  return joint.relations[equation - joint.coincident_rows()];
}

constexpr std::array<const char*, 3> axis_name{"x", "y", "z"};

}  // namespace

bool is_length(const Joint& joint, int equation) {
  return equation < joint.coincident_rows() || is_length(relation_of(joint, equation));
}

namespace {
int count_normals(const Joint& joint, int column) {
  int count = 0;
  for (int k = 0; k < joint.relation_count; ++k) {
    const Relation& r = joint.relations[k];
    count += r.kind == RelationKind::normal && (column < 0 || r.j == column);
  }
  return count;
}
}  // namespace

int aligned_axis(const Joint& joint) {
  for (int k = 0; k < 3; ++k)
    if (count_normals(joint, k) == 2) return k;
  return -1;
}
bool keeps_orientation(const Joint& joint) { return count_normals(joint, -1) == 3; }

namespace {
/// Whether what `hold` chose leaves a displacement along an axis free, or the turn about it alone.
bool is_free(const Joint& joint, const Relation& coordinate) {
  if (coordinate.kind == RelationKind::angle) return aligned_axis(joint) == coordinate.i;
  const Relation* end = joint.relations.data() + joint.relation_count;
  return !joint.coincident && std::none_of(joint.relations.data(), end, [&](const Relation& held) {
    return held.kind == RelationKind::along && held.i == coordinate.i;
  });
}
}  // namespace

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
      return "equal turn of A and B";
    case RelationKind::distance:
      return "distance";
    case RelationKind::angle:
      return fmt::format("turn about {} of A", axis_name[r.i]);
  }
  return {};
}

namespace {
/// Φ in x and y, and what of B is not zero; two rows at a time, as they are read soon after (a load of two numbers waits
/// for two stores of one).
void coincidence_in_plane(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms) {
  const Vector2d arm_a = in_plane(a.R, joint.a.p), arm_b = in_plane(b.R, joint.b.p);
  terms.phi.head<2>() = (b.x - a.x).head<2>() + arm_b - arm_a;
  const auto column = [&terms](int c) { return terms.B.col(c).head<2>(); };
  column(0) = -Vector2d::UnitX();
  column(1) = -Vector2d::UnitY();
  column(5) = Vector2d(arm_a.y(), -arm_a.x());
  column(6) = Vector2d::UnitX();
  column(7) = Vector2d::UnitY();
  column(11) = Vector2d(-arm_b.y(), arm_b.x());
  if (joint.a.p.z() == 0.0 && joint.b.p.z() == 0.0) return;
  for (int k = 0; k < 2; ++k) {
    terms.B.row(k).segment<2>(3).setZero();
    terms.B.row(k).segment<2>(9).setZero();
    add_height(terms.B.row(k).segment<2>(3), a.R, joint.a.p.z(), -Vector2d::Unit(k));
    add_height(terms.B.row(k).segment<2>(9), b.R, joint.b.p.z(), Vector2d::Unit(k));
  }
}
}  // namespace

void joint_constraints(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms) {
  const MarkerPair pair{joint.a, joint.b, a, b};
  int row = 0;
  if (joint.planar) {
    if (joint.coincident) coincidence_in_plane(joint, a, b, terms);
    row = joint.coincident_rows();
    for (int k = 0; k < joint.relation_count; ++k, ++row) {
      const RelationTerms relation = evaluate_in_plane(joint.relations[k], pair);
      terms.phi[row] = relation.value - joint.constant;
      terms.B.row(row) = relation.G;
    }
    return;
  }
  if (joint.coincident) {
    terms.phi.head<3>() = marker_position(joint.b, b) - marker_position(joint.a, a);
    terms.B.block<3, 3>(0, 0) = -Matrix3d::Identity();
    terms.B.block<3, 3>(0, 3).noalias() = a.R * skew<double>(joint.a.p);
    terms.B.block<3, 3>(0, 6).setIdentity();
    terms.B.block<3, 3>(0, 9).noalias() = -b.R * skew<double>(joint.b.p);
    row = joint.coincident_rows();
  }
  for (int k = 0; k < joint.relation_count; ++k, ++row) {
    const RelationTerms relation = evaluate(joint.relations[k], pair);
    terms.phi[row] = relation.value - joint.constant;
    terms.B.row(row) = relation.G;
  }
}

Eigen::Matrix<double, 6, 1> rows_times(const JointTerms& terms, const Vector12& d) { return terms.B.lazyProduct(d); }

Vector12 transposed_times(const Joint& joint, const JointTerms& terms, const double* lambda) {
  Eigen::Matrix<double, 6, 1> own = Eigen::Matrix<double, 6, 1>::Zero();
  for (int k = 0; k < joint.size(); ++k) own[k] = lambda[k];
  return terms.B.transpose().lazyProduct(own);
}

void joint_bias(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms) {
  int row = 0;
  if (joint.coincident) {
    terms.bias.head<3>() =
        b.R * b.Omega.cross(b.Omega.cross(joint.b.p)) - a.R * a.Omega.cross(a.Omega.cross(joint.a.p));
    row = joint.coincident_rows();
  }
  const MarkerPair pair{joint.a, joint.b, a, b};
  for (int k = 0; k < joint.relation_count; ++k, ++row) terms.bias[row] = bias(joint.relations[k], pair);
}

void joint_rate_gradient(const Joint& joint, const NodeMotion& a, const NodeMotion& b,
                         Eigen::Matrix<double, 6, 12>& N) {
  N.setZero();
  int row = 0;
  if (joint.coincident && joint.planar) {
    N.block<2, 1>(0, 5) = a.Omega.z() * in_plane(a.R, joint.a.p);
    N.block<2, 1>(0, 11) = -b.Omega.z() * in_plane(b.R, joint.b.p);
    row = joint.coincident_rows();
  } else if (joint.coincident) {
    N.block<3, 3>(0, 3).noalias() = a.R * skew<double>(a.Omega.cross(joint.a.p));
    N.block<3, 3>(0, 9).noalias() = -b.R * skew<double>(b.Omega.cross(joint.b.p));
    row = joint.coincident_rows();
  }
  const MarkerPair pair{joint.a, joint.b, a, b};
  for (int k = 0; k < joint.relation_count; ++k, ++row)
    N.row(row) =
        joint.planar ? rate_gradient_in_plane(joint.relations[k], pair) : rate_gradient(joint.relations[k], pair);
}

void joint_stiffness(const Joint& joint, const NodeMotion& a, const NodeMotion& b, const double* lambda, Square12& K) {
  K.setZero();
  int row = 0;
  if (joint.coincident) row = joint.coincident_rows();
  if (joint.coincident && joint.planar) {
    const Vector2d f(lambda[0], lambda[1]);
    K(5, 5) = in_plane(a.R, joint.a.p).dot(f);
    K(11, 11) = -in_plane(b.R, joint.b.p).dot(f);
  } else if (joint.coincident) {
    const Vector3d f(lambda[0], lambda[1], lambda[2]);
    // Rows Θ of Bᵀλ: −p_A~ R_Aᵀ f for A and +p_B~ R_Bᵀ f for B; δ(Rᵀ f) = (Rᵀ f)~ δΘ.
    K.block<3, 3>(3, 3) = -skew<double>(joint.a.p) * skew<double>(a.R.transpose() * f);
    K.block<3, 3>(9, 9) = skew<double>(joint.b.p) * skew<double>(b.R.transpose() * f);
  }
  const MarkerPair pair{joint.a, joint.b, a, b};
  for (int k = 0; k < joint.relation_count; ++k, ++row)
    joint.planar ? add_stiffness_in_plane(joint.relations[k], pair, lambda[row], K)
                 : add_stiffness(joint.relations[k], pair, lambda[row], K);
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
