// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinates of the nodes of a mesh, the basis of assembly.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/math/count.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Numbering of the coordinates of a mesh: node by node, translations before rotations, in part axes. A node has three
/// coordinates (translations), or six if something uses its rotations. Users of rotations are beams, shells, springs,
/// masses with inertia or offset, and equations with rotations. Spiders use the rotations of their reference, and
/// rigid spiders those of a node without elements.
struct Coordinates {
  std::vector<int> first;      ///< nodes + 1 numbers: first coordinate of each node, then the number of all
  std::vector<int> node;       ///< node of each coordinate
  std::vector<int> component;  ///< component of each coordinate, 0 to 5

  int count() const { return count_of(node); }
  bool rotates(int n) const { return first[n + 1] - first[n] == 6; }
  /// Number of the coordinate with component `c` of node `n`. Requires that the node has this component.
  int of(int n, int c) const { return first[n] + c; }
};

Coordinates number_coordinates(const Mesh& mesh);

/// Coordinate `x` of the mesh that a boundary node retains, that defines the frame of a modal body, or that a support
/// holds.
struct OwnedCoordinate {
  int x = 0;
  int owner = 0;  ///< index of its owner in Mesh::boundary, Mesh::held or Mesh::supports
};
std::vector<int> coordinates_of(const std::vector<OwnedCoordinate>& owned);

/// Nodes of one element. element_nodes() finds the element by its number, which counts beams, shells, solids, then
/// springs.
struct ElementNodes {
  std::array<int, 20> node{};
  int count = 0;
  const int* begin() const { return node.data(); }
  const int* end() const { return node.data() + count; }
};
ElementNodes element_nodes(const Mesh& mesh, int element);

/// Throws Error if the mesh has nodes that no element, mass or tie uses.
void check_used(const Mesh& mesh, const std::string& where);

/// Throws Error if the boundary retains rotations of nodes that have no rotations.
void check_retained(const Mesh& mesh, const Coordinates& coordinates, const std::string& where);

/// Six rigid motions of the mesh (coordinates x 6): unit translations, then unit rotations about `point`. The rotation
/// about axis e_k moves node a at X_a by (e_k × (X_a − point), e_k).
Eigen::MatrixXd rigid_motions(const Mesh& mesh, const Coordinates& coordinates, const Eigen::Vector3d& point);

/// Name of a component, 0 to 5: "translation x" to "rotation z".
std::string component_text(int component);

}  // namespace tisserand::reducer
