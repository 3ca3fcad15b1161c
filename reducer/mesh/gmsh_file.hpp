// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh as a gmsh file, for viewing.
#pragma once

#include <string>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Writes the mesh as a gmsh text file of version 4.1. It has one named physical group for each property of beams,
/// shells and solids, for springs, spiders (lines to their nodes), boundary nodes and point masses. The file is
/// complete or does not exist.
void write_gmsh_file(const Mesh& mesh, const std::string& path);

}  // namespace tisserand::reducer
