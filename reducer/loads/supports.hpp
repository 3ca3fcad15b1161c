// Supports of a part as coordinates of its mesh that are held.
#pragma once

#include <vector>

#include "reducer/mesh/coordinates.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

struct HeldCoordinate {
  int x = 0;        ///< of the mesh
  int support = 0;  ///< row of Mesh::supports; the first that holds it
};

/// Each coordinate once, ascending. Throws Error for rotations that a node does not have and for nodes that follow a
/// rigid spider.
std::vector<HeldCoordinate> held_coordinates(const Mesh& mesh, const Coordinates& coordinates);

}  // namespace tisserand::reducer
