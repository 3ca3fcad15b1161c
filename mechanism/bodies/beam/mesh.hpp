// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes and elements of a beam body from its description in a scene, in the part frame.
#pragma once

#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/bodies/beam/element.hpp"

namespace tisserand::mechanism {

/// Mesh of a beam. Nodes 0 .. N from `from` to `to` are equally spaced in arc length; N = elements·(nodes_per_element −
/// 1). Nodes have the orientation of the body (R_WN = R_W,part in the reference configuration), so that their section
/// triads are the constants D_i of the elements. One of elements2 and elements3 is empty.
struct BeamMesh {
  std::vector<Eigen::Vector3d> position;  ///< part frame
  std::vector<Eigen::Matrix3d> section;   ///< section triads in part axes; columns x (along the beam), y, z
  std::vector<BeamElement2> elements2;    ///< element.nodes are first_node plus the number of the node
  std::vector<BeamElement3> elements3;
  double length = 0.0;  ///< arc length of the whole beam
};

/// Meshes the straight line from–to, or the circular arc from–through–to.
///
/// Section axes: x along the curve; y is the part of `orientation` that is normal to x. Without `orientation` it is the
/// global axis most nearly normal to the curve, as in part.yaml: its largest |cosine| with the chords of the elements
/// is least. Among equals within 1e-9, y precedes z and z precedes x. Throws Error (place: spec.where) for a line of
/// zero length, coincident points or three on a line, bad sections and element numbers out of range. An orientation
/// along the beam or one that turns over along the arc is an error too.
BeamMesh mesh_beam(const formats::BeamBodySpec& spec, int first_node);

}  // namespace tisserand::mechanism
