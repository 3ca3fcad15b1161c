// SPDX-License-Identifier: GPL-3.0-or-later
// Ranks of the constraint Jacobian, free motions and locked joints.
#include "mechanism/equations/mobility.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/format.h>
#include <Eigen/QR>
#include <Eigen/SparseCore>

#include "common/math/rotation.hpp"
#include "common/stable_sort.hpp"
#include "mechanism/equations/constraint_rows.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/round_off.hpp"
#include "mechanism/solver/matrix_rank.hpp"

namespace tisserand::mechanism {
namespace {

/// Largest size of a constraint Jacobian with a dense decomposition.
constexpr int dense_rank_limit = 150;

using Triplets = std::vector<Eigen::Triplet<double>>;

double row_scale(const Model& model, int row) { return model.length_row[row] ? 1.0 : model.length; }

Eigen::SparseMatrix<double> compressed(int rows, int columns, const Triplets& entries) {
  Eigen::SparseMatrix<double> B(rows, columns);
  B.setFromTriplets(entries.begin(), entries.end());
  B.makeCompressed();
  return B;
}

/// Matrix Bᵀ with rotation rows divided by the characteristic length and angle columns multiplied by it.
Eigen::SparseMatrix<double> scaled_jacobian(const Model& model, const Evaluation& evaluation) {
  Triplets entries;
  for_each_row(model, evaluation, [&](int row, const ElementMap& map, const auto&, const Row12& values) {
    for_each_entry(model, map, values, evaluation, [&](int j, double value) {
      if (value != 0.0) entries.emplace_back(j, row, value * (model.equation_scale[j] * row_scale(model, row)));
    });
  });
  return compressed(model.sizes.boundary, model.sizes.constraints, entries);
}

using Row6 = Eigen::Matrix<double, 1, 6>;

/// Row for the rigid motion [velocity of the first node; angular velocity, world] of a part, from that for [ẋ Ω] of a
/// node. Rotations are divided by the characteristic length. A node at x has ẋ = v − (x − x_0)~ ω, Ω = Rᵀ ω.
Row6 rigid_row(const Model& model, const Parts& parts, const Evaluation& evaluation, int carrier, const Row6& values) {
  const NodeMotion& node = motion_of(evaluation, carrier);
  const Eigen::Vector3d arm = node.x - motion_of(evaluation, parts.first_node[parts.of_node[carrier]]).x;
  Row6 rigid;
  rigid.head<3>() = values.head<3>();
  rigid.tail<3>() = (values.tail<3>() * node.R.transpose() - values.head<3>() * skew<double>(arm)) / model.length;
  return rigid;
}

/// Scaled Jacobian for rigid motions of the parts. In planar models further columns hold the motions out of the plane.
Eigen::SparseMatrix<double> rigid_jacobian(const Model& model, const Parts& parts, const Evaluation& evaluation) {
  Triplets entries;
  const auto add = [&](int row, const Marker& marker, const Row6& values) {
    if (marker.node < 0) return;
    const Row6 rigid = rigid_row(model, parts, evaluation, marker.node, values);
    for (int j = 0; j < 6; ++j)
      if (rigid[j] != 0.0)
        entries.emplace_back(6 * parts.of_node[marker.node] + j, row, rigid[j] * row_scale(model, row));
  };
  for_each_row(model, evaluation, [&](int row, const ElementMap&, const auto& pair, const Row12& values) {
    add(row, pair.a, values.head<6>());
    add(row, pair.b, values.tail<6>());
  });
  int columns = model.sizes.constraints;
  for (int part = 0; part < parts.count() && model.planar; ++part)
    for (int j = 2; j < 5; ++j) entries.emplace_back(6 * part + j, columns++, 1.0);
  return compressed(6 * parts.count(), columns, entries);
}

/// Rank by the Gram-Schmidt method. The next column is the first whose component normal to the chosen ones is longer
/// than 0.9 of the longest such component. Among nearly equal columns the order of the file decides, not round-off.
ColumnRank dense_rank(Eigen::MatrixXd A, double tolerance) {
  constexpr double equal = 0.9;
  ColumnRank rank;
  std::vector<bool> taken(static_cast<std::size_t>(A.cols()), false);
  double first = 0.0;
  for (;; ++rank.rank) {
    Eigen::VectorXd across = A.colwise().norm();
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      if (taken[j]) across[j] = 0.0;
    const double longest = across.maxCoeff();
    first = std::max(first, longest);
    if (!(longest > tolerance * first)) break;
    Eigen::Index next = 0;
    while (!(across[next] >= equal * longest)) ++next;
    taken[next] = true;
    const Eigen::VectorXd q = A.col(next) / across[next];
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      if (!taken[j]) A.col(j) -= q * q.dot(A.col(j));
  }
  for (int j = 0; j < std::ssize(taken); ++j)
    if (!taken[j]) rank.dependent.push_back(j);
  return rank;
}

/// Tolerance of the rank. Redundant rows repeat others only if the constraints are closed. If these are open by Φ
/// (relative), a redundant row differs by the size of Φ. Inactive rows stay open by the errors of their integration.
double tolerance_at(const Model& model, const Evaluation& evaluation) {
  constexpr double per_violation = 100.0, most = 1e-6;
  const double open = largest_violation(model, evaluation.constraint).value;
  return std::clamp(per_violation * open, rank_tolerance, most);
}

ColumnRank rank_of(const Eigen::SparseMatrix<double>& A, double tolerance) {
  ColumnRank rank;
  if (A.cols() == 0) return rank;
  if (A.cols() <= dense_rank_limit) {
    rank = dense_rank(Eigen::MatrixXd(A), tolerance);
  } else {
    const double largest = A.nonZeros() > 0 ? A.coeffs().cwiseAbs().maxCoeff() : 0.0;
    rank = column_rank(A, tolerance * std::max(1.0, largest));
  }
  std::sort(rank.dependent.begin(), rank.dependent.end());
  return rank;
}

/// Motions of rigid parts, one per column, to be named one after the other. Each name removes one motion, and the
/// remaining ones no longer change the named coordinate.
struct OpenMotions {
  Eigen::MatrixXd Z;
  double least = 1e-9;  ///< smallest change that counts as a motion, relative to the largest entry of Z

  /// Whether some motion changes the row. If so, that motion is removed.
  bool take(const Eigen::RowVectorXd& row) {
    if (Z.cols() == 0) return false;
    const Eigen::RowVectorXd change = row * Z;
    Eigen::Index at = 0;
    if (!(change.cwiseAbs().maxCoeff(&at) > least * row.norm() * Z.cwiseAbs().maxCoeff())) return false;
    const Eigen::VectorXd taken = Z.col(at);
    for (Eigen::Index j = 0; j < Z.cols(); ++j)
      if (j != at) Z.col(j) -= taken * (change[j] / change[at]);
    Z.col(at) = Z.rightCols<1>();
    Z.conservativeResize(Eigen::NoChange, Z.cols() - 1);
    return true;
  }
};

/// Row of a joint coordinate, or of a rotation in a joint, in the motions of the parts.
template <class Pair>
Eigen::RowVectorXd part_row(const Model& model, const Parts& parts, const Evaluation& evaluation, const Pair& pair,
                            const Row12& values) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(6 * parts.count());
  for (const auto& [node, half] :
       {std::pair{pair.a.node, Row6(values.head<6>())}, std::pair{pair.b.node, Row6(values.tail<6>())}})
    if (node >= 0) row.segment<6>(6 * parts.of_node[node]) += rigid_row(model, parts, evaluation, node, half);
  return row;
}

/// Motions of the rigid parts that joints and held drives allow.
Eigen::MatrixXd open_motions(const Model& model, const Parts& parts, const Evaluation& evaluation, bool drives_hold) {
  Eigen::MatrixXd B = Eigen::MatrixXd(rigid_jacobian(model, parts, evaluation));
  for (const Coupling& coupling : model.couplings)
    if (coupling.motion >= 0 && !drives_hold) B.col(coupling.row).setZero();
  if (B.cols() == 0) return Eigen::MatrixXd::Identity(B.rows(), B.rows());
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(rank_tolerance);
  qr.compute(B);
  const Eigen::MatrixXd Q = qr.householderQ();
  return Q.rightCols(B.rows() - qr.rank());
}

void name_turns(const Model& model, const Parts& parts, const Evaluation& evaluation, OpenMotions& open,
                std::vector<std::string>& names) {
  for (const auto& joint : model.joints)
    for (int axis = 0; axis < 3; ++axis) {
      Row12 turn = Row12::Zero();  // world angular velocity of B less that of A, as Ω of the nodes
      if (joint.a.node >= 0) turn.segment<3>(3) = -motion_of(evaluation, joint.a.node).R.row(axis);
      if (joint.b.node >= 0) turn.segment<3>(9) = motion_of(evaluation, joint.b.node).R.row(axis);
      if (open.take(part_row(model, parts, evaluation, joint, turn)))
        names.push_back(fmt::format("a rotation in '{}'", joint.name));
    }
}

/// Names remaining motions, which move no joint: groups of bodies as a whole, named after their heaviest.
void name_bodies(const Parts& parts, OpenMotions& open, std::vector<std::string>& names) {
  std::vector<int> order(static_cast<std::size_t>(parts.count()));
  for (int p = 0; p < parts.count(); ++p) order[p] = p;
  sort_stably(order, std::greater{}, [&](int p) { return parts.mass[p]; });
  for (const int part : order) {
    int ways = 0;
    for (int j = 0; j < 6; ++j)
      if (open.take(Eigen::RowVectorXd::Unit(6 * parts.count(), 6 * part + j))) ++ways;
    if (ways > 0) names.push_back(fmt::format("'{}' in {} direction{}", parts.name[part], ways, ways == 1 ? "" : "s"));
  }
}

/// A joint between parts without relative motion, and these parts (ground is the last).
struct LockedJoint {
  int joint = 0;
  int a = 0;
  int b = 0;
};

std::vector<LockedJoint> locked_joints(const Model& model, const Parts& parts, const Evaluation& evaluation) {
  const Eigen::MatrixXd Z = open_motions(model, parts, evaluation, false);
  const int ground = parts.count();
  // Motion of a part at `point`, rotations times the characteristic length.
  const auto motion = [&](int part, const Eigen::Vector3d& point) {
    Eigen::MatrixXd at = Eigen::MatrixXd::Zero(6, Z.cols());
    if (part == ground) return at;
    at = Z.middleRows<6>(6 * part);
    const Eigen::Vector3d arm = point - motion_of(evaluation, parts.first_node[part]).x;
    at.topRows<3>() -= skew<double>(arm) * at.bottomRows<3>() / model.length;
    return at;
  };
  std::vector<LockedJoint> locked;
  for (int i = 0; i < std::ssize(model.joints); ++i) {
    const Marker &a = model.joints[i].a, &b = model.joints[i].b;
    const LockedJoint joint{i, a.node < 0 ? ground : parts.of_node[a.node],
                            b.node < 0 ? ground : parts.of_node[b.node]};
    const Eigen::Vector3d point = motion_of(evaluation, a.node < 0 ? b.node : a.node).x;
    const Eigen::MatrixXd relative = motion(joint.b, point) - motion(joint.a, point);
    if (joint.a != joint.b && (Z.cols() == 0 || relative.cwiseAbs().maxCoeff() < 1e-9)) locked.push_back(joint);
  }
  return locked;
}

/// Names the locked joints in loops. A single joint may just be in a singular position, as at the dead centre of a
/// slider-crank. Loops of fewer than two rigid bodies with mass contain flexible ones, which deform.
void name_locked(const Model& model, const Parts& parts, const Evaluation& evaluation,
                 std::vector<std::string>& names) {
  std::vector<LockedJoint> locked = locked_joints(model, parts, evaluation);
  for (std::size_t before = locked.size() + 1; locked.size() < before;) {
    before = locked.size();
    std::vector<int> ends(static_cast<std::size_t>(parts.count()) + 1, 0);
    for (const LockedJoint& joint : locked) ++ends[joint.a], ++ends[joint.b];
    std::erase_if(locked, [&](const LockedJoint& joint) { return ends[joint.a] < 2 || ends[joint.b] < 2; });
  }
  int rigid = 0;
  for (const RigidBody& body : model.rigid_bodies)
    if (std::ranges::any_of(locked, [&](const LockedJoint& joint) {
          return parts.of_node[body.node] == joint.a || parts.of_node[body.node] == joint.b;
        }))
      ++rigid;
  if (rigid < 2) return;
  for (const LockedJoint& joint : locked)
    if (model.joints[joint.joint].size() < 6) names.push_back(fmt::format("'{}'", model.joints[joint.joint].name));
}

}  // namespace

void find_freedoms(const Model& model, const State& state, Evaluation& evaluation, Mobility& mobility) {
  constexpr int most_parts = 50;
  const Parts parts = find_parts(model);
  mobility.free.clear();
  mobility.locked.clear();
  if (parts.count() > most_parts) return;
  evaluate(model, state, evaluation);
  evaluate_coordinates(model, state, evaluation);
  OpenMotions open{open_motions(model, parts, evaluation, true)};
  for (std::size_t i = 0; i < model.coordinates.size(); ++i) {
    const Coordinate& coordinate = model.coordinates[i];
    const Eigen::RowVectorXd row = part_row(model, parts, evaluation, coordinate, evaluation.coordinates[i].G);
    if (open.take(row)) mobility.free.push_back(fmt::format("'{}'", coordinate.name));
  }
  name_turns(model, parts, evaluation, open, mobility.free);
  name_bodies(parts, open, mobility.free);
  name_locked(model, parts, evaluation, mobility.locked);
}

Mobility count_mobility(const Model& model, const State& state, Evaluation& evaluation) {
  evaluate(model, state, evaluation);
  const Parts parts = find_parts(model);
  Mobility mobility;
  mobility.coordinates = model.sizes.velocities();
  for (const Tyre& tyre : model.tyres)
    if (tyre.relaxes()) mobility.coordinates -= 2;  // deflections of treads follow their wheels
  mobility.constraints = model.sizes.constraints;
  mobility.parts = parts.count();
  const double tolerance = tolerance_at(model, evaluation);
  ColumnRank rank = rank_of(scaled_jacobian(model, evaluation), tolerance);
  mobility.rank = rank.rank;
  mobility.redundant = std::move(rank.dependent);
  mobility.degrees_of_freedom = mobility.coordinates - mobility.rank;
  mobility.freedoms = model.planar ? 3 : 6;
  const bool all_rigid = !model.planar && 6 * mobility.parts == mobility.coordinates;
  const int rigid_rank = all_rigid ? mobility.rank : rank_of(rigid_jacobian(model, parts, evaluation), tolerance).rank;
  mobility.rigid_mobility = 6 * mobility.parts - rigid_rank;
  return mobility;
}

}  // namespace tisserand::mechanism
