// SPDX-License-Identifier: GPL-3.0-or-later
// *SURFACE, *ORIENTATION and *TRANSFORM: places and directions for sections and constraints.
#pragma once

#include "reducer/decks/abaqus/model.hpp"

namespace tisserand::reducer::abaqus {

void read_surface(Model& model, int scope, const Block& block);
void read_orientation(Model& model, int scope, const Block& block);
void read_transform(Model& model, int scope, const Block& block);
/// Whether the components of the node have known directions. If not, adds a fault at `where`.
bool has_directions(Model& model, int node, const std::string& where);

/// Nodes of a surface with their shares of its area by face_weights(), sorted by node. Each node of a nodal surface
/// has the share 1.
std::map<int, double> surface_weights(const Model& model, const Surface& surface);

}  // namespace tisserand::reducer::abaqus
