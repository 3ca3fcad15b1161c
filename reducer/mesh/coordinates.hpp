// Which coordinates the nodes of a mesh have: between the mesh and assembly.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/math/count.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// A node has three coordinates (translations), or six if something at it uses rotations: a beam, a shell, a spring, a
/// mass with inertia or offset, a spider that has it as reference, an equation with its rotation, or a rigid spider
/// that moves a node without elements. Node by node, translations before rotations, part axes.
struct Coordinates {
  std::vector<int> first;      ///< nodes + 1: number of the node's first coordinate
  std::vector<int> node;       ///< of each coordinate
  std::vector<int> component;  ///< of each coordinate, 0-5

  int count() const { return count_of(node); }
  bool rotates(int n) const { return first[n + 1] - first[n] == 6; }
  /// Number of a node's coordinate; only if it has that component.
  int of(int n, int c) const { return first[n] + c; }
};

Coordinates number_coordinates(const Mesh& mesh);

/// A coordinate of the mesh that a boundary node retains, a reference ties or a support holds.
struct OwnedCoordinate {
  int x = 0;
  int owner = 0;  ///< row of Mesh::boundary, ::held or ::supports
};
std::vector<int> coordinates_of(const std::vector<OwnedCoordinate>& owned);

/// Nodes of the mesh's elements, in one numbering of all of them: beams, shells, solids, springs.
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

/// "translation x" ... "rotation z".
std::string component_text(int component);

}  // namespace tisserand::reducer
