// A mesh as a gmsh file, to look at.
#pragma once

#include <string>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Text of version 4.1; one physical group for each property of beams, shells and solids, springs, spiders (lines to
/// their legs), boundary nodes and point masses, with their names. The file appears whole or not at all.
void write_gmsh_file(const Mesh& mesh, const std::string& path);

}  // namespace tisserand::reducer
