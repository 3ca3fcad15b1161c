// SPDX-License-Identifier: GPL-3.0-or-later
// Kernel data of edges and faces in addition to their mesh: lengths, areas, and points of surfaces with normals.
#pragma once

#include <vector>

#include "reducer/mesh/cells.hpp"

namespace tisserand::reducer {

/// Data of each entity of the open model, lengths times `scale`: size and middle if OpenCASCADE has them. Faces also
/// have points on a grid of their parameters, inside their parameter rectangle, and the volumes that they bound.
std::vector<EntityGeometry> geometry_of(const std::vector<Entity>& entities, double scale);

}  // namespace tisserand::reducer
