// SPDX-License-Identifier: GPL-3.0-or-later
// Sixth step of read_abaqus(): elements with their sections become the elements, masses and springs of the mesh.
#pragma once

#include "reducer/decks/abaqus/model.hpp"

namespace tisserand::reducer::abaqus {

/// Sets the nodes of the mesh with their labels, and Deck::node_of_id.
void fill_nodes(Model& model);

/// Adds all elements to the mesh, and faults for elements without a section.
void fill_elements(Model& model);

}  // namespace tisserand::reducer::abaqus
