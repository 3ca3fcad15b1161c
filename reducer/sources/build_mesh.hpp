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

}  // namespace tisserand::reducer
