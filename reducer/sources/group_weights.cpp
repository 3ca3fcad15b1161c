// SPDX-License-Identifier: GPL-3.0-or-later
// Shares of the nodes of a group in its length, area or volume.
#include <algorithm>
#include <map>
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

Cell line_cell(int first, int second) {
  Cell cell;
  cell.nodes[0] = first;
  cell.nodes[1] = second;
  return cell;
}

void add_elements(const MeshBuilder& builder, const ElementSet& set, Weights& weights) {
  const Mesh& mesh = builder.mesh;
  for (const int e : set.shells) add_cell(builder, shell_cell(mesh.shells[e]), weights);
  for (const int e : set.solids) add_cell(builder, as_cell(mesh.solids[e]), weights);
  for (const int e : set.beams) {
    const BeamElement& beam = mesh.beams[e];
    add_cell(builder, line_cell(beam.first, beam.second), weights);
  }
}

/// Edges of shells between the nodes, each once.
std::vector<Cell> edges_between(const MeshBuilder& builder, const std::unordered_set<int>& nodes) {
  std::map<std::pair<int, int>, Cell> edges;
  for (const ShellElement& shell : builder.mesh.shells) {
    const int corners = shell.corners();
    for (int k = 0; k < corners; ++k) {
      const int a = shell.nodes[k], b = shell.nodes[(k + 1) % corners];
      if (nodes.contains(a) && nodes.contains(b)) edges[std::minmax(a, b)] = line_cell(a, b);
    }
  }
  std::vector<Cell> cells;
  for (const auto& [key, edge] : edges) cells.push_back(edge);
  return cells;
}

/// Adds shares of nodes that are named individually; each has a positive share.
void add_nodes(const MeshBuilder& builder, const std::vector<int>& named, Weights& weights) {
  std::vector<Cell> between = faces_between(builder, named).cells;
  if (between.empty()) between = edges_between(builder, {named.begin(), named.end()});
  Weights shares;
  for (const Cell& cell : between) add_cell(builder, cell, shares);
  const bool all = std::ranges::all_of(named, [&](int n) { return shares.contains(n); });
  for (const int node : named) weights[node] += all ? shares[node] : 1.0;
}

}  // namespace

Cell shell_cell(const ShellElement& shell) {
  Cell cell;
  cell.shape = shell.corners() == 3 ? CellShape::triangle3 : CellShape::quadrilateral4;
  std::copy_n(shell.nodes.begin(), shell.corners(), cell.nodes.begin());
  return cell;
}

FaceCells faces_between(const MeshBuilder& builder, const std::vector<int>& named) {
  const std::unordered_set<int> nodes(named.begin(), named.end());
  FaceCells faces;
  faces.cells = outer_faces(builder.mesh, [&](int node) { return nodes.contains(node); });
  faces.sign.assign(faces.cells.size(), 1);
  if (!faces.cells.empty()) return faces;
  for (const ShellElement& shell : builder.mesh.shells)
    if (std::ranges::all_of(nodes_of(shell), [&](int node) { return nodes.contains(node); }))
      faces.cells.push_back(shell_cell(shell));
  faces.sign.assign(faces.cells.size(), 0);
  return faces;
}

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
