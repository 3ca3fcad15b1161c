// From part.yaml's lines and arcs to the mesh, through gmsh.
#pragma once

#include <string>

#include "formats/part.hpp"
#include "reducer/mesh.hpp"

namespace tisserand::reducer {

/// Divides every line and arc into equal elements; points with the same name become one node. Throws Error for names
/// that do not exist, elements of zero length, orientation parallel to the axis, boundary points that no beam reaches.
Mesh mesh_part(const formats::Part& part);

/// Writes the mesh of the part as a gmsh file (version 4.1) to look at: one physical group per line, boundary node and
/// point mass. Returns what it has written.
Mesh write_gmsh_file(const formats::Part& part, const std::string& path);

}  // namespace tisserand::reducer
