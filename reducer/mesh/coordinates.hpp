// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinates of the nodes of a mesh, the basis of assembly.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/math/count.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Coordinates node by node, translations before rotations, part axes. A node has three (translations), or six if
/// something uses its rotations. This is a beam, shell, spring, mass with inertia or offset, spider with this
/// reference, equation with its rotation, or rigid spider that moves a node without elements.
struct Coordinates {
  std::vector<int> first;      ///< nodes + 1: first coordinate of each node
  std::vector<int> node;       ///< of each coordinate
  std::vector<int> component;  ///< of each coordinate, 0-5

  int count() const { return count_of(node); }
  bool rotates(int n) const { return first[n + 1] - first[n] == 6; }
  /// Number of a node's coordinate; the node must have this component.
  int of(int n, int c) const { return first[n] + c; }
};

Coordinates number_coordinates(const Mesh& mesh);

/// Coordinate of the mesh that a boundary node retains, a reference ties or a support holds.
struct OwnedCoordinate {
  int x = 0;
  int owner = 0;  ///< index in Mesh::boundary, ::held or ::supports
};
std::vector<int> coordinates_of(const std::vector<OwnedCoordinate>& owned);

/// Nodes of an element, in the common numbering of elements: beams, shells, solids, springs.
struct ElementNodes {
  std::array<int, 20> node{};
  int count = 0;
  const int* begin() const { return node.data(); }
  const int* end() const { return node.data() + count; }
};
ElementNodes element_nodes(const Mesh& mesh, int element);

/// Throws Error for nodes that nothing uses.
void check_used(const Mesh& mesh, const std::string& where);

/// Throws Error for retained rotations of nodes without rotations.
void check_retained(const Mesh& mesh, const Coordinates& coordinates, const std::string& where);

/// The six rigid motions (coordinates x 6): unit translations, then (e_k × (X_a − point), e_k).
Eigen::MatrixXd rigid_motions(const Mesh& mesh, const Coordinates& coordinates, const Eigen::Vector3d& point);

/// Name of a component: "translation x" ... "rotation z".
std::string component_text(int component);

}  // namespace tisserand::reducer
