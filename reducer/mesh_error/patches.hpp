// SPDX-License-Identifier: GPL-3.0-or-later
// Patches of smooth stresses: the elements around each corner that share a property and, for shells, a tangent plane.
#pragma once

#include <vector>

#include "reducer/elements/mesh_error.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Patch of elements around a node, over which stresses are smoothed. Shells are numbered before solids.
struct StressPatch {
  int node = 0;
  double angle = 0.0;         ///< sum of the angles (shells) or solid angles (solids) of its elements at the node
  std::vector<int> elements;  ///< numbers of its elements, ascending
  /// Patches whose polynomials give the smooth stress at the node. It is the patch itself, or at edges and faces its
  /// neighbours inside, whose polynomials have elements on both sides.
  std::vector<int> source;
};

/// Patches of elements around corners, over which stresses are averaged.
struct StressPatches {
  std::vector<StressPatch> patch;
  std::vector<int> first;          ///< elements + 1 numbers: index in `of_corner` of the first corner of each element
  std::vector<int> of_corner;      ///< patch of each corner of each element
  std::vector<ShellEdges> ending;  ///< for each shell: edges at which patches end
};

/// Finds the patches of a mesh. Patches end where stresses jump: where properties or offsets change, where three
/// shells share an edge, or where normals of shells differ by more than 30 degrees. Shells with opposite normals stay
/// in one patch.
StressPatches stress_patches(const Mesh& mesh);

/// Number of corners of an element, numbered as in StressPatch. corner_node() gives the node of a corner.
int corners_of(const Mesh& mesh, int element);
int corner_node(const Mesh& mesh, int element, int corner);

}  // namespace tisserand::reducer
