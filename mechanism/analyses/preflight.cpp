// SPDX-License-Identifier: GPL-3.0-or-later
// Gaps, groups, null vectors and doubtful masses.
#include "mechanism/analyses/preflight.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "common/text.hpp"
#include "mechanism/equations/tangent.hpp"
#include "mechanism/model/forces.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;

constexpr double shown_gap = 1e-9;
/// Ratio of masses at which round-off of the heavier hides the lighter.
constexpr double largest_ratio = 1e12;
/// Limit of squared singular values (relative). Below it nothing determines the motion.
constexpr double null_tolerance = 1e-13;
/// Smallest component of a null vector that counts.
constexpr double visible = 1e-6;
/// Largest group of connected massless nodes in which null vectors are searched.
constexpr std::size_t most_nodes = 100;

std::string direction_text(Vector3d v) {
  Eigen::Index at = 0;
  v.cwiseAbs().maxCoeff(&at);
  v *= (v[at] < 0.0 ? -1.0 : 1.0) / v.norm();
  const auto clean = [](double x) { return std::abs(x) < 1e-6 ? 0.0 : x; };
  return fmt::format("[{:.3g}, {:.3g}, {:.3g}]", clean(v.x()), clean(v.y()), clean(v.z()));
}

/// Groups of massless nodes that joints, couplings or springs connect.
std::vector<std::vector<int>> massless_groups(const Model& model) {
  const Parts parts = find_parts(model);
  std::vector<std::vector<int>> neighbours(model.nodes.size());
  const auto connect = [&](const Marker& a, const Marker& b) {
    if (a.node < 0 || b.node < 0 || !parts.is_massless(a.node) || !parts.is_massless(b.node)) return;
    neighbours[a.node].push_back(b.node);
    neighbours[b.node].push_back(a.node);
  };
  for (const Joint& joint : model.joints) connect(joint.a, joint.b);
  for (const Coordinate& c : model.coordinates) connect(c.a, c.b);
  for_each_force(model, [&](auto traits, const auto& force) {
    if constexpr (traits.markers.size() == 2) connect(force.*traits.markers[0], force.*traits.markers[1]);
  });
  std::vector<std::vector<int>> groups;
  std::vector<bool> seen(model.nodes.size(), false);
  for (int start = 0; start < std::ssize(model.nodes); ++start) {
    if (seen[start] || !parts.is_massless(start)) continue;
    std::vector<int> group{start};
    seen[start] = true;
    for (std::size_t at = 0; at < group.size(); ++at)
      for (const int next : neighbours[group[at]])
        if (!seen[next]) {
          seen[next] = true;
          group.push_back(next);
        }
    groups.push_back(std::move(group));
  }
  return groups;
}

/// Products CᵀC of the columns of the group in the scaled iteration matrix.
MatrixXd column_products(const Model& model, const std::vector<int>& group, const MatrixValues& matrix) {
  std::map<int, std::vector<std::pair<int, double>>> rows;
  int column = 0;
  for (const int node : group)
    for (int k = 0; k < 6; ++k, ++column) {
      const int j = coordinate_of(model, model.nodes[node], k);
      if (j < 0) {  // a planar model has no such coordinate
        rows[-1 - column].emplace_back(column, 1.0);
        continue;
      }
      model.pattern->for_each_in(j, [&](int i, int slot) {
        const double value = matrix.values[slot] * model.value_scale[slot];
        if (value != 0.0) rows[i].emplace_back(column, value);
      });
    }
  MatrixXd products = MatrixXd::Zero(column, column);
  for (const auto& [row, entries] : rows)
    for (const auto& [i, a] : entries)
      for (const auto& [j, b] : entries) products(i, j) += a * b;
  return products;
}

/// Describes the motions that the columns of Z allow the node (translations, then rotations times the length).
void describe(const std::string& name, const Eigen::Matrix3d& R, const MatrixXd& Z, std::vector<std::string>& motions) {
  if (Z.norm() < visible) return;
  Eigen::JacobiSVD<MatrixXd> whole(Z);
  whole.setThreshold(visible);
  if (whole.rank() == 6) {
    motions.push_back(fmt::format("'{}' moves freely", name));
    return;
  }
  const MatrixXd turning = R * Z.bottomRows<3>(), moving = Z.topRows<3>();
  const bool turns = turning.norm() > visible;
  Eigen::JacobiSVD<MatrixXd> directions(turns ? turning : moving, Eigen::ComputeThinU);
  for (Eigen::Index k = 0; k < directions.singularValues().size() && directions.singularValues()[k] > visible; ++k)
    motions.push_back(fmt::format("'{}' can {} {}", name, turns ? "turn about" : "move along",
                                  direction_text(directions.matrixU().col(k))));
}

void add_mass_doubts(const Model& model, std::vector<std::string>& doubts) {
  const Parts parts = find_parts(model);
  int lightest = -1, heaviest = -1;
  const auto mass = [&parts](int part) { return parts.mass[part]; };
  for (int i = 0; i < parts.count(); ++i) {
    if (mass(i) == 0.0) continue;
    if (lightest < 0 || mass(i) < mass(lightest)) lightest = i;
    if (heaviest < 0 || mass(i) > mass(heaviest)) heaviest = i;
  }
  if (lightest >= 0 && mass(heaviest) > largest_ratio * mass(lightest))
    doubts.push_back(fmt::format("the masses of '{}' ({:.3g}) and '{}' ({:.3g}) differ by more than {:g}",
                                 parts.name[heaviest], mass(heaviest), parts.name[lightest], mass(lightest),
                                 largest_ratio));
}

void add_inertia_doubts(const Model& model, std::vector<std::string>& doubts) {
  for (const RigidBody& body : model.rigid_bodies) {
    const Vector3d principal =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(body.inertia, Eigen::EigenvaluesOnly).eigenvalues();
    if (principal[0] <= 1e-12 * principal[2])
      doubts.push_back(fmt::format("'{}' has no inertia about one of its axes", body.name));
  }
}

std::string groups_text(const std::vector<std::vector<std::string>>& groups) {
  std::vector<std::string> texts;
  for (const std::vector<std::string>& names : groups) texts.push_back(listed(names));
  return fmt::format("{} groups of bodies without a connection between them: {}", groups.size(), listed(texts, " | "));
}

}  // namespace

std::string gaps_text(const std::vector<JointGap>& gaps, const std::string& unit) {
  std::vector<std::string> texts;
  for (const JointGap& gap : gaps)
    texts.push_back(fmt::format("'{}' by {:.3g}{} and {:.3g} rad", gap.joint, gap.length, unit, gap.angle));
  return listed(texts);
}

std::vector<JointGap> marker_gaps(const Model& model, const Evaluation& evaluation) {
  std::vector<JointGap> gaps;
  const auto add = [&](const std::string& name, int first, int size) {
    JointGap gap{name, 0.0, 0.0};
    double square = 0.0;
    for (int row = first; row < first + size; ++row) {
      const double value = evaluation.constraint[row];
      if (model.length_row[row])
        square += value * value;
      else
        gap.angle = std::max(gap.angle, std::abs(value));
    }
    gap.length = std::sqrt(square);
    if (gap.length > shown_gap * model.length || gap.angle > shown_gap) gaps.push_back(std::move(gap));
  };
  for (const Joint& joint : model.joints) add(joint.name, joint.row, joint.size());
  for (const Coupling& coupling : model.couplings) add(coupling.name, coupling.row, 1);
  return gaps;
}

Preflight examine(const Model& model, const Evaluation& evaluation) {
  Preflight preflight;
  preflight.gaps = marker_gaps(model, evaluation);
  preflight.groups = connected_groups(model, find_parts(model));
  add_mass_doubts(model, preflight.doubts);
  add_inertia_doubts(model, preflight.doubts);
  return preflight;
}

std::vector<std::string> undetermined_motions(const Model& model, const State& state, Evaluation& evaluation) {
  std::vector<std::string> motions;
  const std::vector<std::vector<int>> groups = massless_groups(model);
  if (groups.empty()) return motions;
  MatrixValues matrix(model);
  evaluate_tangent(model, state, {{1.0, 1.0, 1.0}, TangentKind::step, {}}, evaluation, matrix);
  for (const std::vector<int>& group : groups) {
    if (group.size() > most_nodes) continue;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(column_products(model, group, matrix));
    const double limit = null_tolerance * std::max(1e-300, eigen.eigenvalues().maxCoeff());
    const Eigen::Index null = (eigen.eigenvalues().array() <= limit).count();
    for (std::size_t i = 0; i < group.size(); ++i)
      describe(model.nodes[group[i]].name, motion_of(evaluation, group[i]).R,
               eigen.eigenvectors().block(6 * static_cast<Eigen::Index>(i), 0, 6, null), motions);
  }
  return motions;
}

std::vector<PreflightLine> preflight_doubts(const Preflight& preflight, const Units& units) {
  std::vector<PreflightLine> lines;
  if (preflight.groups.size() > 1) lines.push_back({"connections", groups_text(preflight.groups)});
  if (!preflight.gaps.empty())
    lines.push_back({"open joints", gaps_text(preflight.gaps, after_number(unit_label(units, 1, 0, 0)))});
  for (const std::string& doubt : preflight.doubts) lines.push_back({"warning", doubt});
  return lines;
}

std::vector<PreflightLine> preflight_table(const Preflight& preflight, const Mobility& mobility, const Units& units) {
  std::vector<PreflightLine> lines;
  lines.push_back({"bodies", fmt::format("{}; with rigid bodies: mobility {}, by Gruebler's count {} · {} - {} = {}",
                                         mobility.parts, mobility.rigid_mobility, mobility.freedoms, mobility.parts,
                                         mobility.constraints, mobility.gruebler())});
  lines.push_back({"redundant", mobility.redundant.empty()
                                    ? "no constraint equation"
                                    : fmt::format("{} of {} constraint equations", mobility.redundant.size(),
                                                  mobility.constraints)});
  if (!mobility.free.empty()) lines.push_back({"free", listed(mobility.free)});
  if (preflight.groups.size() <= 1) lines.push_back({"connections", "all bodies are connected to the ground"});
  if (preflight.gaps.empty()) lines.push_back({"joints", "all are closed at the start"});
  if (preflight.doubts.empty()) lines.push_back({"masses", "plausible"});
  for (PreflightLine& doubt : preflight_doubts(preflight, units)) lines.push_back(std::move(doubt));
  return lines;
}

}  // namespace tisserand::mechanism
