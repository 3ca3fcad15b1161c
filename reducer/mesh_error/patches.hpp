// Patches of smooth stresses: the elements around each corner that share a property and, for shells, a tangent plane.
#pragma once

#include <vector>

#include "reducer/elements/mesh_error.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Elements are numbered shells first, then solids.
struct StressPatch {
  int node = 0;
  double angle = 0.0;         ///< sum over its elements at the node: angle of shells, solid angle of solids
  std::vector<int> elements;  ///< ascending
  /// Patches whose polynomials are used here: itself, or at edges and faces its neighbours inside, whose polynomials
  /// have elements on both sides.
  std::vector<int> source;
};

struct StressPatches {
  std::vector<StressPatch> patch;
  std::vector<int> first;          ///< elements + 1: into `of_corner`
  std::vector<int> of_corner;      ///< patch of each corner of each element
  std::vector<ShellEdges> ending;  ///< of shells: edges at which patches end
};

/// Patches end where properties or offsets change, where three shells share an edge, and at edges where the normals of
/// shells differ by more than 30 degrees: stresses jump there. Shells whose normal is turned round belong together.
StressPatches stress_patches(const Mesh& mesh);

/// Corners of an element in that numbering, and their nodes.
int corners_of(const Mesh& mesh, int element);
int corner_node(const Mesh& mesh, int element, int corner);

}  // namespace tisserand::reducer
