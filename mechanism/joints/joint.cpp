// The table of joints, and sums over their relations.
#include "mechanism/joints/joint.hpp"

#include <initializer_list>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/math/rotation.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr Relation along(int i) { return {RelationKind::along, static_cast<std::uint8_t>(i), 0}; }
constexpr Relation normal(int i, int j) {
  return {RelationKind::normal, static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j)};
}
constexpr Relation angle(int i) { return {RelationKind::angle, static_cast<std::uint8_t>(i), 0}; }
constexpr Relation twist{RelationKind::twist, 0, 0};
constexpr Relation distance{RelationKind::distance, 0, 0};

void hold(Joint& joint, std::initializer_list<Relation> relations) {
  for (const Relation& relation : relations) joint.relations[joint.relation_count++] = relation;
}

/// No turn: x_A ⟂ y_B, y_A ⟂ z_B, z_A ⟂ x_B.
void hold_orientation(Joint& joint) { hold(joint, {normal(0, 1), normal(1, 2), normal(2, 0)}); }

/// The axis `k` of B stays along that of A.
void hold_axis(Joint& joint, int k) { hold(joint, {normal((k + 1) % 3, k), normal((k + 2) % 3, k)}); }

void hold_chosen(const std::array<bool, 6>& held, Joint& joint) {
  joint.coincident = held[0] && held[1] && held[2];
  for (int i = 0; i < 3 && !joint.coincident; ++i)
    if (held[i]) hold(joint, {along(i)});
  const int turns = held[3] + held[4] + held[5];
  if (turns == 3) hold_orientation(joint);
  for (int k = 0; k < 3; ++k) {
    const bool this_one = held[3 + k];
    if (turns == 2 && !this_one) hold_axis(joint, k);
    if (turns == 1 && this_one) hold(joint, {normal((k + 1) % 3, (k + 2) % 3)});
  }
}

const Relation& relation_of(const Joint& joint, int equation) {
  return joint.relations[equation - (joint.coincident ? 3 : 0)];
}

constexpr std::array<const char*, 3> axis_name{"x", "y", "z"};

}  // namespace

bool is_length(const Joint& joint, int equation) {
  return (joint.coincident && equation < 3) || is_length(relation_of(joint, equation));
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

void set_relations(JointKind kind, const std::array<bool, 6>& held, Joint& joint) {
  joint.kind = kind;
  joint.relation_count = 0;
  joint.coincident = false;
  switch (kind) {
    case JointKind::fixed:
      joint.coincident = true;
      hold_orientation(joint);
      return;
    case JointKind::revolute:
      joint.coincident = true;
      hold_axis(joint, 2);
      return;
    case JointKind::spherical:
      joint.coincident = true;
      return;
    case JointKind::universal:
      joint.coincident = true;
      hold(joint, {normal(0, 1)});
      return;
    case JointKind::constant_velocity:
      joint.coincident = true;
      hold(joint, {twist});
      return;
    case JointKind::cylindrical:
    case JointKind::screw:
      hold(joint, {along(0), along(1)});
      hold_axis(joint, 2);
      return;
    case JointKind::prismatic:
      hold(joint, {along(0), along(1)});
      hold_orientation(joint);
      return;
    case JointKind::planar:
      hold(joint, {along(2)});
      hold_axis(joint, 2);
      return;
    case JointKind::point_on_line:
      hold(joint, {along(0), along(1)});
      return;
    case JointKind::point_on_plane:
      hold(joint, {along(2)});
      return;
    case JointKind::distance:
      hold(joint, {distance});
      return;
    case JointKind::constant_orientation:
      hold_orientation(joint);
      return;
    case JointKind::parallel_axes:
      hold_axis(joint, 2);
      return;
    case JointKind::generic:
      hold_chosen(held, joint);
      return;
  }
  TISSERAND_ENSURE(false, "joint of kind {}", static_cast<int>(kind));
}

std::vector<NamedRelation> free_coordinates(const Joint& joint) {
  switch (joint.kind) {
    case JointKind::revolute:
      return {{"angle", angle(2)}};
    case JointKind::cylindrical:
    case JointKind::screw:
      return {{"angle", angle(2)}, {"z", along(2)}};
    case JointKind::prismatic:
    case JointKind::point_on_line:
      return {{"z", along(2)}};
    case JointKind::planar:
      return {{"x", along(0)}, {"y", along(1)}, {"angle", angle(2)}};
    case JointKind::universal:
      return {{"angle_x", angle(0)}, {"angle_y", angle(1)}};
    case JointKind::point_on_plane:
      return {{"x", along(0)}, {"y", along(1)}};
    case JointKind::constant_orientation:
      return {{"x", along(0)}, {"y", along(1)}, {"z", along(2)}};
    case JointKind::parallel_axes:
      return {{"x", along(0)}, {"y", along(1)}, {"z", along(2)}, {"angle", angle(2)}};
    case JointKind::generic: {
      std::vector<NamedRelation> free;
      for (int i = 0; i < 3 && !joint.coincident; ++i) {
        bool held = false;
        for (int k = 0; k < joint.relation_count; ++k) {
          const Relation& r = joint.relations[k];
          held = held || (r.kind == RelationKind::along && r.i == i);
        }
        if (!held) free.push_back({axis_name[i], along(i)});
      }
      int normals = 0, axis = 0;
      for (int k = 0; k < joint.relation_count; ++k)
        if (const Relation& r = joint.relations[k]; r.kind == RelationKind::normal) ++normals, axis = r.j;
      if (normals == 2 && axis == 2) free.push_back({"angle", angle(2)});
      return free;
    }
    case JointKind::fixed:
    case JointKind::spherical:
    case JointKind::constant_velocity:
    case JointKind::distance:
      return {};
  }
  return {};
}

std::string joint_equation_name(const Joint& joint, int equation) {
  if (joint.coincident && equation < 3) return std::string("translation ") + axis_name[equation];
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

void joint_constraints(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms) {
  int row = 0;
  if (joint.coincident) {
    terms.phi.head<3>() = marker_position(joint.b, b) - marker_position(joint.a, a);
    terms.B.block<3, 3>(0, 0) = -Matrix3d::Identity();
    terms.B.block<3, 3>(0, 3).noalias() = a.R * skew<double>(joint.a.p);
    terms.B.block<3, 3>(0, 6).setIdentity();
    terms.B.block<3, 3>(0, 9).noalias() = -b.R * skew<double>(joint.b.p);
    row = 3;
  }
  const MarkerPair pair{joint.a, joint.b, a, b};
  for (int k = 0; k < joint.relation_count; ++k, ++row) {
    const RelationTerms relation = evaluate(joint.relations[k], pair);
    terms.phi[row] = relation.value - joint.constant;
    terms.B.row(row) = relation.G;
  }
}

void joint_bias(const Joint& joint, const NodeMotion& a, const NodeMotion& b, JointTerms& terms) {
  int row = 0;
  if (joint.coincident) {
    terms.bias.head<3>() =
        b.R * b.Omega.cross(b.Omega.cross(joint.b.p)) - a.R * a.Omega.cross(a.Omega.cross(joint.a.p));
    row = 3;
  }
  const MarkerPair pair{joint.a, joint.b, a, b};
  for (int k = 0; k < joint.relation_count; ++k, ++row) terms.bias[row] = bias(joint.relations[k], pair);
}

void joint_rate_gradient(const Joint& joint, const NodeMotion& a, const NodeMotion& b,
                         Eigen::Matrix<double, 6, 12>& N) {
  N.setZero();
  int row = 0;
  if (joint.coincident) {
    N.block<3, 3>(0, 3).noalias() = a.R * skew<double>(a.Omega.cross(joint.a.p));
    N.block<3, 3>(0, 9).noalias() = -b.R * skew<double>(b.Omega.cross(joint.b.p));
    row = 3;
  }
  const MarkerPair pair{joint.a, joint.b, a, b};
  for (int k = 0; k < joint.relation_count; ++k, ++row) N.row(row) = rate_gradient(joint.relations[k], pair);
}

void joint_stiffness(const Joint& joint, const NodeMotion& a, const NodeMotion& b, const double* lambda, Square12& K) {
  K.setZero();
  int row = 0;
  if (joint.coincident) {
    const Eigen::Map<const Vector3d> f(lambda);
    // Rows Θ of Bᵀλ: −p_A~ R_Aᵀ f for A and +p_B~ R_Bᵀ f for B; δ(Rᵀ f) = (Rᵀ f)~ δΘ.
    K.block<3, 3>(3, 3) = -skew<double>(joint.a.p) * skew<double>(a.R.transpose() * f);
    K.block<3, 3>(9, 9) = skew<double>(joint.b.p) * skew<double>(b.R.transpose() * f);
    row = 3;
  }
  const MarkerPair pair{joint.a, joint.b, a, b};
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
