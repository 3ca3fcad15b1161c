// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes and elements of a beam body from its description in a scene, in the part frame.
#pragma once

#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/bodies/beam/element.hpp"

namespace tisserand::mechanism {

/// Mesh of a beam. Its N + 1 nodes from `from` to `to` are equally spaced in arc length, N = elements ·
/// (nodes_per_element − 1). All nodes have the orientation of the body, so their section triads are the constants D_i
/// of the elements. Either `elements2` or `elements3` is empty.
struct BeamMesh {
  std::vector<Eigen::Vector3d> position;  ///< positions of the nodes, part frame
  std::vector<Eigen::Matrix3d> section;   ///< section triads in part axes; columns x (along the beam), y, z
  /// Elements of two nodes. Their `nodes` are indices into the model: `first_node` of mesh_beam() plus the number in
  /// this mesh.
  std::vector<BeamElement2> elements2;
  std::vector<BeamElement3> elements3;
  double length = 0.0;  ///< arc length of the whole beam
};

/// Meshes the straight line from–to, or the circular arc from–through–to. The section axis x is along the curve, and y
/// is the part of `orientation` that is normal to x. Without `orientation`, the global axis most nearly normal to the
/// curve replaces it, as in part.yaml: its largest |cosine| with the chords of the elements is least. Among equals
/// within 1e-9, y precedes z and z precedes x. Throws Error at spec.where for a line of zero length, coincident points
/// or three on a line, bad sections and element numbers out of range. An orientation along the beam, or one that turns
/// over along the arc, is an error too.
BeamMesh mesh_beam(const formats::BeamBodySpec& spec, int first_node);

}  // namespace tisserand::mechanism
