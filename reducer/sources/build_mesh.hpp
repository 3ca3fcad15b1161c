// From a part to its mesh: what the part file draws and what its mesh file brings.
#pragma once

#include "formats/part/part.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Nodes: patches, named points, mesh file, references of spiders, inner nodes of beams. Points and nodes of patches at
/// the same place are one node; those of the mesh file join only what names them. Throws Error for names that do not
/// exist, groups without property, spiders that grab nothing, boundary places without a node, files that cannot be
/// read.
Mesh build_mesh(const formats::Part& part);

/// The same of a part that is solved as it is and may have no boundary nodes.
Mesh build_mesh_to_solve(const formats::Part& part);

/// A face of the geometry, or of a mesh file that has such, as its number is found.
struct FacePlace {
  std::string name;          ///< "face 12", "face 12 ('top')", or the name of a patch
  Eigen::Vector3d position;  ///< middle of its element nearest to the mean of all of them
};
/// The same to be looked at: boundary nodes may be missing. With the places of faces, the largest by their elements
/// first, `most` at most.
Mesh build_mesh(const formats::Part& part, std::size_t most, std::vector<FacePlace>& faces);

}  // namespace tisserand::reducer
