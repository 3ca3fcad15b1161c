// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid motion that fits a null vector, and its description in words.
#include "reducer/system/mechanism.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double still = 1e-6;  ///< coordinates below this share of the largest motion are at rest
constexpr double fits = 1e-4;   ///< error of a fitting rigid motion, share of the largest motion

/// Coordinates of the mesh that move, and their motion; rotations are multiplied by the length of the part.
struct Movement {
  std::vector<int> x;
  VectorXd u;
  std::vector<int> nodes;
  double largest = 0.0;
  double length = 1.0;
};

Movement movement_of(const PartitionedPart& part, const VectorXd& v) {
  const System& system = part.system;
  VectorXd q = VectorXd::Zero(system.size());
  q(part.partition.internal) = v;
  const VectorXd x = expand(system.T, q).col(0);
  Movement m;
  m.length = characteristic_length(part.mesh);
  const auto of_length = [&](int k) { return x[k] * (system.coordinates.component[k] < 3 ? 1.0 : m.length); };
  for (int k = 0; k < system.coordinates.count(); ++k) m.largest = std::max(m.largest, std::abs(of_length(k)));
  std::vector<double> u;
  for (int k = 0; k < system.coordinates.count(); ++k) {
    if (!(std::abs(of_length(k)) > still * m.largest)) continue;
    const int node = system.coordinates.node[k];
    if (m.nodes.empty() || m.nodes.back() != node) m.nodes.push_back(node);
    m.x.push_back(k);
    u.push_back(of_length(k));
  }
  m.u = Eigen::Map<const VectorXd>(u.data(), static_cast<Index>(u.size()));
  return m;
}

/// A rigid motion about `center`: u = t + ω × (X − center).
struct RigidFit {
  Vector3d center, t, omega;
};

/// Finds the rigid motion that all moving nodes follow; returns whether there is one. Rotations at rest are omitted,
/// such as those of nodes without rotations.
bool fit_rigid(const Mesh& mesh, const System& system, const Movement& m, RigidFit& fit) {
  fit.center.setZero();
  for (const int node : m.nodes) fit.center += mesh.position.col(node) / static_cast<double>(m.nodes.size());
  std::vector<int> rows;
  for (const int node : m.nodes)
    for (int c = 0; c < 3; ++c) rows.push_back(system.coordinates.of(node, c));
  for (const int x : m.x)
    if (system.coordinates.component[x] >= 3) rows.push_back(x);
  MatrixXd A = MatrixXd::Zero(static_cast<Index>(rows.size()), 6);
  VectorXd b = VectorXd::Zero(A.rows());
  for (Index r = 0; r < A.rows(); ++r) {
    const int x = rows[r], c = system.coordinates.component[x];
    if (c >= 3) {
      A(r, c) = 1.0;
    } else {
      const Vector3d arm = (mesh.position.col(system.coordinates.node[x]) - fit.center) / m.length;
      A(r, c) = 1.0;
      A.block<1, 3>(r, 3) = arm.cross(Vector3d::Unit(c)).transpose();
    }
    const auto found = std::ranges::lower_bound(m.x, x);
    if (found != m.x.end() && *found == x) b[r] = m.u[found - m.x.begin()];
  }
  const VectorXd r = A.completeOrthogonalDecomposition().solve(b);
  fit.t = r.head<3>();
  fit.omega = r.tail<3>() / m.length;
  return (A * r - b).cwiseAbs().maxCoeff() <= fits * m.largest;
}

std::string vector_words(Vector3d v, double least) {
  for (double& x : v)
    if (std::abs(x) < least) x = 0.0;
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", v[0], v[1], v[2]);
}

/// Unit vector along `direction` with its largest entry positive.
Vector3d upright(const Vector3d& direction) {
  Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  return direction.normalized() * (direction[largest] < 0.0 ? -1.0 : 1.0);
}

std::string node_words(const Mesh& mesh, const std::vector<int>& nodes) {
  constexpr std::size_t most = 3;
  std::vector<std::string> names;
  for (const int node : nodes) {
    if (names.size() == most && nodes.size() > most + 1) break;
    names.push_back(mesh.node_label[node]);
  }
  if (names.size() < nodes.size()) names.push_back(fmt::format("{} nodes more", nodes.size() - names.size()));
  if (names.size() == 1) return names[0];
  const std::string last = std::move(names.back());
  names.pop_back();
  return join(names, ", ") + " and " + last;
}

/// "the line through a and b" if two boundary nodes lie on the axis, otherwise "the axis (1, 0, 0) through a".
std::string axis_words(const Mesh& mesh, const Vector3d& point, const Vector3d& direction, double length) {
  constexpr double on_axis = 1e-4;
  std::vector<std::string> names;
  Vector3d first = Vector3d::Zero();
  for (const MeshBoundary& b : mesh.boundary) {
    const Vector3d arm = mesh.position.col(b.node) - point;
    if (arm.cross(direction).norm() > on_axis * length) continue;
    if (names.empty()) first = mesh.position.col(b.node);
    if (names.size() == 1 && (mesh.position.col(b.node) - first).norm() <= on_axis * length) continue;
    if (names.size() < 2) names.push_back(mesh.node_label[b.node]);
  }
  if (names.size() == 2) return fmt::format("the line through {} and {}", names[0], names[1]);
  return fmt::format("the axis {} through {}", vector_words(direction, 1e-4),
                     names.empty() ? vector_words(point, 1e-6 * length) : names[0]);
}

std::string rigid_words(const Mesh& mesh, const Movement& m, const RigidFit& fit) {
  const bool one = m.nodes.size() == 1;
  const std::string who = node_words(mesh, m.nodes);
  double reach = one ? m.length : 0.0;  // a single node that moves and turns defines its axis
  for (const int node : m.nodes) reach = std::max(reach, (mesh.position.col(node) - fit.center).norm());
  const double turn = fit.omega.norm(), slide = fit.t.norm();
  if (turn * std::max(reach, still * m.length) <= fits * slide)
    return fmt::format("{} {} along {}", who, one ? "moves" : "move", vector_words(upright(fit.t), 1e-4));
  const Vector3d direction = fit.omega / turn, point = fit.center + direction.cross(fit.t) / turn;
  const double along = std::abs(direction.dot(fit.t));
  std::string words =
      fmt::format("{} {} about {}", who, one ? "turns" : "turn", axis_words(mesh, point, upright(direction), m.length));
  if (along > fits * std::max(slide, turn * reach)) words += one ? " and moves along it" : " and move along it";
  return words;
}

/// Names of the coordinates that move most.
std::string coordinate_words(const Mesh& mesh, const System& system, const Movement& m) {
  constexpr std::size_t most = 4;
  std::vector<std::string> places;
  for (std::size_t k = 0; k < m.x.size() && places.size() < most; ++k)
    if (std::abs(m.u[static_cast<Index>(k)]) > 0.5 * m.largest) places.push_back(coordinate_name(mesh, system, m.x[k]));
  const std::string words = join(places, ", ");
  return m.nodes.size() == 1 ? words : fmt::format("{} ({} nodes move)", words, m.nodes.size());
}

}  // namespace

std::string motion_words(const PartitionedPart& part, const VectorXd& v) {
  const auto& [mesh, system, p] = part;
  const Movement m = movement_of(part, v);
  if (m.x.size() == 1) return coordinate_name(mesh, system, m.x[0]);
  if (m.x.empty()) {
    Index largest = 0;
    v.cwiseAbs().maxCoeff(&largest);
    return coordinate_name(mesh, system, system.T.source[p.internal[largest]]);
  }
  RigidFit fit;
  return fit_rigid(mesh, system, m, fit) ? rigid_words(mesh, m, fit) : coordinate_words(mesh, system, m);
}

std::string mechanism_words(const PartitionedPart& part, const NullSpace& null) {
  constexpr Index most = 3;
  std::vector<std::string> motions;
  for (Index k = 0; k < std::min(null.vectors.cols(), most); ++k)
    motions.push_back(motion_words(part, null.vectors.col(k)));
  if (null.vectors.cols() > most) motions.push_back(fmt::format("and {} more", null.vectors.cols() - most));
  return join(motions, "; ");
}

HeldState boundary_held() {
  return {"the part", "while its boundary is held",
          "give the elements there stiffness in that direction, hold these nodes at the boundary, or write "
          "mechanism: allow if they are meant to move freely"};
}

void require_stiffness(const NullSpace& null, const Factor& factor, const PartitionedPart& part, const HeldState& state,
                       const std::string& where) {
  if (null.vectors.cols() > 0)
    throw Error(fmt::format("{} has {} motion(s) without stiffness {}: {}", state.who, null.vectors.cols(), state.how,
                            mechanism_words(part, null)),
                where, state.remedy);
  if (null.negative > 0)
    throw Error(fmt::format("the stiffness of {} {} has {} negative eigenvalues", state.who, state.how, null.negative),
                where, "check the sections, materials and springs: some stiffness is negative");
  if (factor.null() > 0 || factor.negative() > 0)
    throw Error(
        fmt::format(
            "{} has a motion {} whose stiffness is only {:.1e} of the stiffness around it, so round-off hides it: {}",
            state.who, state.how, null.least_share,
            null.softest.size() > 0 ? motion_words(part, null.softest) : std::string()),
        where, "make the soft elements stiffer, or the stiff ones softer or rigid (a spider)");
}

std::string softness_doubt(const NullSpace& null, const PartitionedPart& part) {
  if (null.softest.size() == 0 || null.least_share > doubtful_share) return {};
  return fmt::format(
      "the stiffness of a motion is only {:.1e} of the stiffness around it, so round-off changes it by {:.1g} %: {}; "
      "make the soft elements stiffer, or the stiff ones softer or rigid (a spider)",
      null.least_share, 100.0 * std::numeric_limits<double>::epsilon() / null.least_share,
      motion_words(part, null.softest));
}

}  // namespace tisserand::reducer
