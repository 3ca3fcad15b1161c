// SPDX-License-Identifier: GPL-3.0-or-later
// *SURFACE, *ORIENTATION and *TRANSFORM: places and directions for sections and constraints.
#pragma once

#include "reducer/decks/abaqus/model.hpp"

namespace tisserand::reducer::abaqus {

void read_surface(Model& model, int scope, const Block& block);
void read_orientation(Model& model, int scope, const Block& block);
void read_transform(Model& model, int scope, const Block& block);
/// Whether components of the node have directions; if not, adds a fault at `where`.
bool has_directions(Model& model, int node, const std::string& where);

/// Nodes of a surface with their shares of its area (face_weights); nodal surfaces: 1 each. Sorted by node.
std::map<int, double> surface_weights(const Model& model, const Surface& surface);

}  // namespace tisserand::reducer::abaqus
