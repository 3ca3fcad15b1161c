// SPDX-License-Identifier: GPL-3.0-or-later
// Angles between shells and between free edges.
#include "reducer/mesh_error/shell_form.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "reducer/elements/mesh_error.hpp"
#include "reducer/mesh_error/patches.hpp"
#include "reducer/mesh_error/surround.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double coarse_turn = 25.0 * degree;  ///< above: too coarse for a curve
constexpr double corner_turn = 75.0 * degree;  ///< above: a corner, no curve
constexpr double fold_turn = 30.0 * degree;    ///< where patches of stresses end
constexpr double least_double = 1.5 * degree;

bool coarse_curve(double turn) { return turn > coarse_turn && turn < corner_turn; }

struct ShellEdge {
  int shell = 0;
  int corner = 0;  ///< first corner of the edge
};

using EdgeMap = std::map<std::pair<int, int>, std::vector<ShellEdge>>;

EdgeMap edges_of(const Mesh& mesh) {
  EdgeMap edges;
  for (int s = 0; s < std::ssize(mesh.shells); ++s) {
    const ShellElement& shell = mesh.shells[s];
    for (int k = 0; k < shell.corners(); ++k)
      edges[std::minmax({shell.nodes[k], shell.nodes[(k + 1) % shell.corners()]})].push_back({s, k});
  }
  return edges;
}

double angle_between(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Angle between two shells, independent of the sides of their normals.
double turn_between(const Mesh& mesh, int a, int b) {
  const double angle = angle_between(normal_of(mesh, mesh.shells[a]), normal_of(mesh, mesh.shells[b]));
  return std::min(angle, std::numbers::pi - angle);
}

void mark_turned(const Mesh& mesh, const EdgeMap& edges, std::vector<ShellForm>& forms) {
  std::vector<int> turns(mesh.shells.size(), 0);
  std::map<int, std::vector<std::pair<ShellEdge, Vector3d>>> free_at;  // key: node; edges and their directions from it
  for (const auto& [nodes, shells] : edges) {
    if (shells.size() == 2 && coarse_curve(turn_between(mesh, shells[0].shell, shells[1].shell)))
      for (const ShellEdge& edge : shells) ++turns[edge.shell];
    if (shells.size() != 1) continue;
    const Vector3d along = (mesh.position.col(nodes.second) - mesh.position.col(nodes.first)).normalized();
    free_at[nodes.first].emplace_back(shells[0], along);
    free_at[nodes.second].emplace_back(shells[0], -along);
  }
  std::map<std::pair<int, int>, int> ends;  // number of ends at which free edges turn
  for (const auto& [node, two] : free_at)
    if (two.size() == 2 && coarse_curve(std::numbers::pi - angle_between(two[0].second, two[1].second)))
      for (const auto& [edge, along] : two) ++ends[{edge.shell, edge.corner}];
  for (const auto& [edge, count] : ends)
    if (count == 2) forms[edge.first].turned = true;
  for (std::size_t s = 0; s < forms.size(); ++s) forms[s].turned = forms[s].turned || turns[s] >= 2;
}

void mark_few_across(const Mesh& mesh, const EdgeMap& edges, std::vector<ShellForm>& forms) {
  std::vector<bool> fold(static_cast<std::size_t>(mesh.nodes()), false);
  for (const auto& [nodes, shells] : edges)
    if (shells.size() > 2 || (shells.size() == 2 && turn_between(mesh, shells[0].shell, shells[1].shell) > fold_turn))
      fold[nodes.first] = fold[nodes.second] = true;
  std::vector<bool> touches(mesh.shells.size(), false);
  std::vector<bool> beside_free(static_cast<std::size_t>(mesh.nodes()), false);  // nodes of shells off all folds
  for (std::size_t s = 0; s < mesh.shells.size(); ++s) {
    const ShellElement& shell = mesh.shells[s];
    touches[s] = std::ranges::any_of(nodes_of(shell), [&](int n) { return fold[n]; });
    if (touches[s]) continue;
    for (const int n : nodes_of(shell)) beside_free[n] = true;
  }
  for (std::size_t s = 0; s < mesh.shells.size(); ++s) {
    const ShellElement& shell = mesh.shells[s];
    forms[s].few_across = touches[s] && std::ranges::none_of(nodes_of(shell), [&](int n) { return beside_free[n]; });
  }
}

void mark_double_curvature(const Mesh& mesh, std::vector<ShellForm>& forms) {
  const std::vector<ShellSurround> around = surroundings(mesh, stress_patches(mesh));
  for (std::size_t s = 0; s < forms.size(); ++s) {
    const Eigen::Matrix2d turn = around[s].turn;
    const Eigen::Vector2d both = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(turn).eigenvalues().cwiseAbs();
    forms[s].double_curvature = both.minCoeff() > least_double && both.minCoeff() > 0.2 * both.maxCoeff();
  }
}

}  // namespace

std::vector<ShellForm> shell_forms(const Mesh& mesh) {
  std::vector<ShellForm> forms(mesh.shells.size());
  if (forms.empty()) return forms;
  const EdgeMap edges = edges_of(mesh);
  mark_turned(mesh, edges, forms);
  mark_few_across(mesh, edges, forms);
  mark_double_curvature(mesh, forms);
  return forms;
}

}  // namespace tisserand::reducer
