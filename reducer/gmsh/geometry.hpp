// SPDX-License-Identifier: GPL-3.0-or-later
// Kernel data of edges and faces in addition to their mesh: lengths, areas, and points of surfaces with normals.
#pragma once

#include <vector>

#include "reducer/mesh/cells.hpp"

namespace tisserand::reducer {

/// Geometry of each entity of the open model, with lengths times `scale`: size and middle if OpenCASCADE has them.
/// Faces also have the volumes that they bound, and points on a grid inside the rectangle of their parameters.
std::vector<EntityGeometry> geometry_of(const std::vector<Entity>& entities, double scale);

}  // namespace tisserand::reducer
