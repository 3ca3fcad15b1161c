// SPDX-License-Identifier: GPL-3.0-or-later
// Supports of a part as held coordinates of its mesh.
#pragma once

#include <vector>

#include "reducer/mesh/coordinates.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Coordinates of the mesh that supports hold, each once, ascending, with the first support that holds it. Throws
/// Error for rotations that a node does not have and for nodes that follow a rigid spider.
std::vector<OwnedCoordinate> held_coordinates(const Mesh& mesh, const Coordinates& coordinates);

}  // namespace tisserand::reducer
