// SPDX-License-Identifier: GPL-3.0-or-later
// Springs whose axes matter, rotations of their nodes, and spiders for nodes without rotations.
#include "reducer/ties/spring_turns.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "common/math/rotation.hpp"
#include "reducer/mesh/coordinates.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Whether translational stiffness K changes with a turn of the spring that the displacements of its nodes do not
/// define: about any axis for coincident nodes, about the line between distant ones.
bool has_axes(const Matrix3d& K, const Vector3d& first_to_second) {
  constexpr double equal = 1e-9;  // relative to the stiffness: digits of a deck
  const double length = first_to_second.norm();
  const auto changes = [&](const Vector3d& axis) {
    const Matrix3d turn = skew<double>(axis);
    return (turn * K - K * turn).norm() > equal * K.norm();
  };
  if (length > 0.0) return changes(first_to_second / length);
  return changes(Vector3d::UnitX()) || changes(Vector3d::UnitY()) || changes(Vector3d::UnitZ());
}

/// Nodes with defined rotations about all three axes.
std::vector<bool> turning_nodes(const Mesh& mesh) {
  std::vector<bool> turns(static_cast<std::size_t>(mesh.nodes()), false);
  const auto turn = [&turns](int node) { turns[node] = true; };
  for (const BeamElement& beam : mesh.beams) std::ranges::for_each(nodes_of(beam), turn);
  for (const ShellElement& shell : mesh.shells) std::ranges::for_each(nodes_of(shell), turn);
  for (const NodalMass& mass : mesh.masses)
    if (!mass.inertia.isZero(0.0) || !mass.offset.isZero(0.0)) turn(mass.node);
  for (const Spider& spider : mesh.spiders) {
    const bool rigid = spider.kind == SpiderKind::rigid;
    if (rigid || (spider.reference_components & rotations_only) != 0) turn(spider.reference);
    if (rigid && (spider.node_components & rotations_only) != 0)
      for (const int node : spider.nodes) turn(node);
  }
  for (const TieEquation& equation : mesh.equations)
    for (const TieTerm& term : equation.terms)
      if (term.component >= 3) turn(term.node);
  for (const MeshBoundary& boundary : mesh.boundary)
    if (boundary.rotations) turn(boundary.node);
  for (const Spring& spring : mesh.springs) {  // springs that resist rotations
    if (!spring.stiffness.middleRows<3>(3).isZero(0.0)) turn(spring.first);
    if (!spring.stiffness.bottomRows<3>().isZero(0.0)) turn(spring.second);
  }
  return turns;
}

/// Nodes without rotations that have a spring with axes that matter, and the name of one such spring.
std::map<int, std::string> nodes_to_turn(const Mesh& mesh) {
  std::map<int, std::string> nodes;
  if (mesh.springs.empty()) return nodes;
  const std::vector<bool> turns = turning_nodes(mesh);
  for (const Spring& spring : mesh.springs) {
    const Vector3d arm = mesh.position.col(spring.second) - mesh.position.col(spring.first);
    if (!has_axes(spring.stiffness.topLeftCorner<3, 3>(), arm)) continue;
    for (const int node : {spring.first, spring.second})
      if (!turns[node]) nodes.try_emplace(node, spring.name);
  }
  return nodes;
}

/// Spider that gives `node` the rotation that fits the motion of `others` best.
Spider fitted(int node, const std::vector<int>& others, const std::vector<double>& weight) {
  Spider spider;
  spider.kind = SpiderKind::averaging;
  spider.reference = node;
  spider.nodes = others;
  spider.weight = weight;
  spider.node_components = translations_only;
  spider.reference_components = rotations_only;
  return spider;
}

/// Rotation by the average or the rigid spider that moves the node's translations; empty: no spider does.
std::vector<Spider> turned_by_spider(const Mesh& mesh, int node) {
  for (const Spider& spider : mesh.spiders) {
    if (spider.kind == SpiderKind::averaging && spider.reference == node && spider.nodes.size() > 2)
      return {fitted(node, spider.nodes, spider.weight)};
    if (spider.kind == SpiderKind::rigid && std::ranges::find(spider.nodes, node) != spider.nodes.end()) {
      Spider follower = spider;
      follower.nodes = {node};
      follower.node_components = rotations_only;
      return {follower};
    }
  }
  return {};
}

/// Nodes of the solids at each of `nodes`.
std::map<int, std::set<int>> solid_neighbours(const Mesh& mesh, const std::map<int, std::string>& nodes) {
  std::map<int, std::set<int>> neighbours;
  for (const SolidElement& solid : mesh.solids)
    for (const int node : nodes_of(solid)) {
      if (!nodes.contains(node)) continue;
      for (const int other : nodes_of(solid))
        if (other != node) neighbours[node].insert(other);
    }
  return neighbours;
}

}  // namespace

void turn_springs(Mesh& mesh) {
  const std::map<int, std::string> nodes = nodes_to_turn(mesh);
  if (nodes.empty()) return;
  const std::map<int, std::set<int>> neighbours = solid_neighbours(mesh, nodes);
  std::vector<Spider> spiders;
  for (const auto& [node, spring] : nodes) {
    std::vector<Spider> one = turned_by_spider(mesh, node);
    if (const auto found = neighbours.find(node); one.empty() && found != neighbours.end())
      one = {
          fitted(node, {found->second.begin(), found->second.end()}, std::vector<double>(found->second.size(), 1.0))};
    for (Spider& spider : one) {
      spider.name = fmt::format("axes of spring '{}'", spring);
      spiders.push_back(std::move(spider));
    }
  }
  mesh.spiders.insert(mesh.spiders.end(), spiders.begin(), spiders.end());
}

std::vector<std::string> springs_that_do_not_turn(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const auto& [node, spring] : nodes_to_turn(mesh)) {
    const std::string name = fmt::format("spring '{}'", spring);
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

}  // namespace tisserand::reducer
