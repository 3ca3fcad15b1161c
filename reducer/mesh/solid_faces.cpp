// SPDX-License-Identifier: GPL-3.0-or-later
// Faces that belong to one solid only.
#include "reducer/mesh/solid_faces.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace tisserand::reducer {
namespace {

/// Corners of the faces of a solid, counter-clockwise seen from outside, and the two corners of each middle node, in
/// gmsh's numbering.
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

/// Face of a solid as a cell with middle nodes.
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

}  // namespace

Cell as_cell(const SolidElement& solid) {
  constexpr std::array shapes{CellShape::tetrahedron4, CellShape::tetrahedron10, CellShape::hexahedron8,
                              CellShape::hexahedron20, CellShape::prism6,        CellShape::prism15};
  Cell cell;
  cell.shape = shapes[static_cast<int>(solid.shape)];
  cell.nodes = solid.nodes;
  return cell;
}

std::vector<Cell> outer_faces(const Mesh& mesh, const std::function<bool(int node)>& wanted) {
  std::map<std::array<int, 4>, std::pair<Cell, int>> faces;
  for (const SolidElement& solid : mesh.solids) {
    const Cell cell = as_cell(solid);
    for (const std::vector<int>& face : faces_of(form_of(cell.shape).corners).faces) {
      std::array<int, 4> key{-1, -1, -1, -1};
      for (std::size_t k = 0; k < face.size(); ++k) key[k] = cell.nodes[face[k]];
      if (!std::all_of(key.begin(), key.begin() + static_cast<std::ptrdiff_t>(face.size()), wanted)) continue;
      std::ranges::sort(key);
      auto& entry = faces[key];
      entry.first = face_cell(cell, face);
      ++entry.second;
    }
  }
  std::vector<Cell> result;
  for (const auto& [key, face] : faces)
    if (face.second == 1) result.push_back(face.first);
  return result;
}

std::vector<OuterFace> outer_faces_of_solids(const Mesh& mesh) {
  struct Seen {
    std::array<int, 4> key;
    int solid, face;
  };
  std::vector<Seen> seen;
  for (int s = 0; s < std::ssize(mesh.solids); ++s) {
    const auto& faces = faces_of(form_of(as_cell(mesh.solids[s]).shape).corners).faces;
    for (int f = 0; f < std::ssize(faces); ++f) {
      Seen one{{-1, -1, -1, -1}, s, f};
      for (std::size_t k = 0; k < faces[f].size(); ++k) one.key[k] = mesh.solids[s].nodes[faces[f][k]];
      std::ranges::sort(one.key);
      seen.push_back(one);
    }
  }
  std::ranges::sort(seen, {}, [](const Seen& one) { return std::tuple(one.key, one.solid, one.face); });
  std::vector<OuterFace> result;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    if ((k > 0 && seen[k - 1].key == seen[k].key) || (k + 1 < seen.size() && seen[k + 1].key == seen[k].key)) continue;
    const Cell cell = as_cell(mesh.solids[seen[k].solid]);
    result.push_back({seen[k].solid, faces_of(form_of(cell.shape).corners).faces[seen[k].face]});
  }
  return result;
}

}  // namespace tisserand::reducer
