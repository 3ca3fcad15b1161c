// How the nodes of a group share its length, area or volume.
#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>
#include <unordered_set>

#include "reducer/mesh/solid_faces.hpp"
#include "reducer/sources/selection.hpp"

namespace tisserand::reducer {
namespace {

using Weights = std::map<int, double>;

void add_cell(const MeshBuilder& builder, const Cell& cell, Weights& weights) {
  const NodeShares shares = node_shares(cell, builder.cells.position);
  for (int k = 0; k < form_of(cell.shape).nodes; ++k) weights[cell.nodes[k]] += shares.size * shares.share[k];
}

Cell as_cell(const ShellElement& shell) {
  Cell cell;
  cell.shape = shell.corners() == 3 ? CellShape::triangle3 : CellShape::quadrilateral4;
  std::copy_n(shell.nodes.begin(), shell.corners(), cell.nodes.begin());
  return cell;
}

Cell line_cell(int first, int second) {
  Cell cell;
  cell.nodes[0] = first;
  cell.nodes[1] = second;
  return cell;
}

void add_elements(const MeshBuilder& builder, const ElementSet& set, Weights& weights) {
  const Mesh& mesh = builder.mesh;
  for (const int e : set.shells) add_cell(builder, as_cell(mesh.shells[e]), weights);
  for (const int e : set.solids) add_cell(builder, as_cell(mesh.solids[e]), weights);
  for (const int e : set.beams) {
    const BeamElement& beam = mesh.beams[e];
    add_cell(builder, line_cell(beam.first, beam.second), weights);
  }
}

/// Shells between the nodes; without any, edges of shells between them, each once.
void add_shells_between(const MeshBuilder& builder, const std::unordered_set<int>& nodes, Weights& weights) {
  std::map<std::pair<int, int>, Cell> edges;
  for (const ShellElement& shell : builder.mesh.shells) {
    const int corners = shell.corners();
    int inside = 0;
    for (int k = 0; k < corners; ++k) {
      const int a = shell.nodes[k], b = shell.nodes[(k + 1) % corners];
      inside += nodes.contains(a) ? 1 : 0;
      if (nodes.contains(a) && nodes.contains(b)) edges[std::minmax(a, b)] = line_cell(a, b);
    }
    if (inside == corners) add_cell(builder, as_cell(shell), weights);
  }
  if (!weights.empty()) return;
  for (const auto& [key, edge] : edges) add_cell(builder, edge, weights);
}

/// Shares of nodes that are named themselves; every one of them has a positive share.
void add_nodes(const MeshBuilder& builder, const std::vector<int>& named, Weights& weights) {
  const std::unordered_set<int> nodes(named.begin(), named.end());
  Weights shares;
  for (const Cell& face : outer_faces(builder.mesh, [&](int node) { return nodes.contains(node); }))
    add_cell(builder, face, shares);
  if (shares.empty()) add_shells_between(builder, nodes, shares);
  const bool all = std::ranges::all_of(named, [&](int n) { return shares.contains(n); });
  for (const int node : named) weights[node] += all ? shares[node] : 1.0;
}

}  // namespace

std::vector<std::pair<int, double>> node_weights(const MeshBuilder& builder, const Selection& selection) {
  Weights weights;
  for (const int e : selection.entities) {
    const Entity& entity = builder.cells.entities[e];
    const auto& cells = builder.cells.cells[entity.dimension];
    for (std::size_t c = entity.first; c < entity.first + entity.count; ++c) add_cell(builder, cells[c], weights);
  }
  add_elements(builder, selection.elements, weights);
  if (!selection.nodes.empty()) add_nodes(builder, selection.nodes, weights);
  return {weights.begin(), weights.end()};
}

}  // namespace tisserand::reducer
