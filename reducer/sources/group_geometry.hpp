// SPDX-License-Identifier: GPL-3.0-or-later
// Groups by position: entities inside a box, on the wall of a bore, or nearest to a point.
#pragma once

#include <utility>
#include <vector>

#include "reducer/sources/mesh_builder.hpp"
#include "reducer/sources/places.hpp"

namespace tisserand::reducer {

/// Entities (indices) or nodes of the group's kind inside its box or on its cylinder. Default tolerance: 1e-6 of the
/// extent of all nodes for boxes, 1e-3 of the radius for cylinders.
std::pair<std::vector<int>, std::vector<int>> inside(const MeshBuilder& builder, const formats::GroupDefinition& group);

/// Entity of the group's kind nearest to its point. Throws Error if it is farther than the tolerance (absent: a tenth
/// of the extent), or if two are equally near.
int nearest_entity(const MeshBuilder& builder, const formats::GroupDefinition& group, const User& user);

}  // namespace tisserand::reducer
