// SPDX-License-Identifier: GPL-3.0-or-later
// Patches of smooth stresses: the elements around each corner that share a property and, for shells, a tangent plane.
#pragma once

#include <vector>

#include "reducer/elements/mesh_error.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Patch of elements around a node. Shells are numbered before solids.
struct StressPatch {
  int node = 0;
  double angle = 0.0;         ///< sum of the angles (shells) or solid angles (solids) of its elements at the node
  std::vector<int> elements;  ///< ascending
  /// Patches whose polynomials are used here: itself, or at edges and faces its neighbours inside, whose polynomials
  /// have elements on both sides.
  std::vector<int> source;
};

struct StressPatches {
  std::vector<StressPatch> patch;
  std::vector<int> first;          ///< elements + 1: index into `of_corner`
  std::vector<int> of_corner;      ///< patch of each corner of each element
  std::vector<ShellEdges> ending;  ///< for shells: edges at which patches end
};

/// Patches of a mesh. Stresses jump, so patches end, where properties or offsets change, three shells share an edge, or
/// normals of shells differ by more than 30 degrees. Shells with opposite normals stay together.
StressPatches stress_patches(const Mesh& mesh);

/// Corners of an element in this numbering, and their nodes.
int corners_of(const Mesh& mesh, int element);
int corner_node(const Mesh& mesh, int element, int corner);

}  // namespace tisserand::reducer
