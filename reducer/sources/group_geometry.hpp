// SPDX-License-Identifier: GPL-3.0-or-later
// Groups by position: entities inside a box, on the wall of a bore, or nearest to a point.
#pragma once

#include <utility>
#include <vector>

#include "reducer/sources/mesh_builder.hpp"
#include "reducer/sources/places.hpp"

namespace tisserand::reducer {

/// Entities (indices in CellMesh::entities) or nodes of the kind of `group` that lie inside its box or on its
/// cylinder. The default tolerance is 1e-6 of the extent of all nodes for boxes, and 1e-3 of the radius for cylinders.
std::pair<std::vector<int>, std::vector<int>> inside(const MeshBuilder& builder, const formats::GroupDefinition& group);

/// Index of the entity of the kind of `group` that is nearest to the point of the group. Throws Error if it is farther
/// than the tolerance of the group (default: a tenth of the extent of all nodes), or if two entities are equally near.
int nearest_entity(const MeshBuilder& builder, const formats::GroupDefinition& group, const User& user);

}  // namespace tisserand::reducer
