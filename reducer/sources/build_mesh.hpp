// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh of a part from the drawing in the part file and from its mesh file.
#pragma once

#include "formats/part/part.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Builds the mesh of a part from the drawing in the part file and from its mesh file. Nodes come from patches, named
/// points, the mesh file, references of spiders, and the interior of beams. Points and nodes of patches at the same
/// place become one node. Nodes of the mesh file are joined only by name. Throws Error for names that do not exist,
/// groups without property, spiders without nodes, boundary places without a node, and files that cannot be read.
Mesh build_mesh(const formats::Part& part);

/// Builds the mesh of a part that is solved in full, as build_mesh() does. It may have no boundary nodes.
Mesh build_mesh_to_solve(const formats::Part& part);

/// Name and place of the number of a face, for faces of a geometry or of a mesh file with faces.
struct FacePlace {
  std::string name;          ///< "face 12", "face 12 ('top')", or the name of a patch
  Eigen::Vector3d position;  ///< middle of that element of the face which is nearest to the mean of all of them
};
/// Builds the mesh of a part for viewing; boundary nodes may be missing. `faces` receives the places of at most `most`
/// faces, those with most elements first.
Mesh build_mesh(const formats::Part& part, std::size_t most, std::vector<FacePlace>& faces);

}  // namespace tisserand::reducer
