// How the nodes of a group share its length, area or volume.
#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>
#include <unordered_set>

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

Cell as_cell(const SolidElement& solid) {
  constexpr std::array shapes{CellShape::tetrahedron4, CellShape::tetrahedron10, CellShape::hexahedron8,
                              CellShape::hexahedron20, CellShape::prism6,        CellShape::prism15};
  Cell cell;
  cell.shape = shapes[static_cast<int>(solid.shape)];
  cell.nodes = solid.nodes;
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

/// Corners of the faces of solids, and the two corners of each middle node, in gmsh's numbering.
struct SolidFaces {
  std::vector<std::vector<int>> faces;
  std::vector<std::array<int, 2>> edges;
};

const SolidFaces& faces_of(int corners) {
  static const SolidFaces tetrahedron{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {3, 1, 2}},
                                      {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}}};
  static const SolidFaces hexahedron{
      {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}},
      {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}}};
  static const SolidFaces prism{{{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {0, 3, 5, 2}, {1, 2, 5, 4}},
                                {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}}};
  return corners == 4 ? tetrahedron : corners == 8 ? hexahedron : prism;
}

/// The face of a solid as a cell with middle nodes.
Cell face_cell(const Cell& solid, const std::vector<int>& face) {
  const CellForm form = form_of(solid.shape);
  const bool second_order = form.nodes > form.corners;
  Cell cell;
  const std::size_t n = face.size();
  cell.shape = n == 3 ? (second_order ? CellShape::triangle6 : CellShape::triangle3)
                      : (second_order ? CellShape::quadrilateral8 : CellShape::quadrilateral4);
  const auto& edges = faces_of(form.corners).edges;
  for (std::size_t k = 0; k < n; ++k) {
    const int a = face[k], b = face[(k + 1) % n];
    cell.nodes[k] = solid.nodes[a];
    if (!second_order) continue;
    const auto edge = std::ranges::find_if(
        edges, [&](const auto& e) { return (e[0] == a && e[1] == b) || (e[0] == b && e[1] == a); });
    cell.nodes[n + k] = solid.nodes[form.corners + (edge - edges.begin())];
  }
  return cell;
}

/// Faces of solids whose nodes are all in the set and that belong to one solid only.
void add_solid_faces(const MeshBuilder& builder, const std::unordered_set<int>& nodes, Weights& weights) {
  std::map<std::array<int, 4>, std::pair<Cell, int>> faces;
  for (const SolidElement& solid : builder.mesh.solids) {
    const Cell cell = as_cell(solid);
    for (const std::vector<int>& face : faces_of(form_of(cell.shape).corners).faces) {
      std::array<int, 4> key{-1, -1, -1, -1};
      for (std::size_t k = 0; k < face.size(); ++k) key[k] = cell.nodes[face[k]];
      if (!std::all_of(key.begin(), key.begin() + static_cast<std::ptrdiff_t>(face.size()),
                       [&](int n) { return nodes.contains(n); }))
        continue;
      std::ranges::sort(key);
      auto& entry = faces[key];
      entry.first = face_cell(cell, face);
      ++entry.second;
    }
  }
  for (const auto& [key, face] : faces)
    if (face.second == 1) add_cell(builder, face.first, weights);
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
  add_solid_faces(builder, nodes, shares);
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
