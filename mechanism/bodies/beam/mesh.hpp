// From the description of a beam body in a scene to its nodes and elements, in the part frame.
#pragma once

#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/bodies/beam/element.hpp"

namespace tisserand::mechanism {

/// Nodes 0 .. N in order from `from` to `to`, equally spaced in arc length; N = elements·(nodes_per_element − 1).
/// Nodes carry the orientation of the body (R_WN = R_W,part in the reference configuration), so that their section
/// triads are the constants D_i of the elements. One of elements2, elements3 is empty.
struct BeamMesh {
  std::vector<Eigen::Vector3d> position;  ///< part frame
  std::vector<Eigen::Matrix3d> section;   ///< section triads in part axes; columns x (along the beam), y, z
  std::vector<BeamElement2> elements2;    ///< element.nodes are first_node + the node's number
  std::vector<BeamElement3> elements3;
  double length = 0.0;  ///< arc length of the whole beam
};

/// Meshes the straight line from–to, or the circular arc from–through–to.
///
/// Section axes: x along the curve; y is the part of `orientation` that is normal to x. Without `orientation` it is the
/// global axis most nearly normal to the curve (the one whose largest |cosine| with the chords of the elements is
/// least; among equals, within 1e-9, y before z before x): the rule of part.yaml. Throws Error (place: spec.where) for
/// a line of zero length, three points on a line or coinciding, an orientation along the beam or one that turns over
/// along the arc, element numbers out of range, and bad sections.
BeamMesh mesh_beam(const formats::BeamBodySpec& spec, int first_node);

}  // namespace tisserand::mechanism
