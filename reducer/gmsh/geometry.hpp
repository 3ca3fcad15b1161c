// What the kernel knows of edges and faces beyond their mesh: lengths, areas, and points of surfaces with normals.
#pragma once

#include <vector>

#include "reducer/mesh/cells.hpp"

namespace tisserand::reducer {

/// Of each entity of the open model, lengths times `scale`: size and middle where OpenCASCADE tells them, of faces also
/// points on a grid of their parameters, inside of the rectangle that holds them, and the volumes that they bound.
std::vector<EntityGeometry> geometry_of(const std::vector<Entity>& entities, double scale);

}  // namespace tisserand::reducer
