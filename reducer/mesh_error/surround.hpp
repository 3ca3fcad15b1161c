// SPDX-License-Identifier: GPL-3.0-or-later
// Curved surface and edges on which the nodes of shells lie, from the turns between neighbours.
#pragma once

#include <vector>

#include "reducer/elements/mesh_error.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/mesh_error/patches.hpp"

namespace tisserand::reducer {

/// Finds the slopes of the curved surface and the bows of free edges around each shell. The normal at a corner is the
/// mean of the normals of its patch, weighted by their angles. At borders, where a patch has one side only, curvature
/// continues as inside. A free edge is curved if it turns by less than 30 degrees into the next one. Its bow is a
/// twelfth of its length times its mean turn.
std::vector<ShellSurround> surroundings(const Mesh& mesh, const StressPatches& patches);

}  // namespace tisserand::reducer
