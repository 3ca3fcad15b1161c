// SPDX-License-Identifier: GPL-3.0-or-later
// Third step of read_abaqus(): *NODE, *SYSTEM and *ELEMENT of one scope.
#pragma once

#include "reducer/decks/abaqus/model.hpp"

namespace tisserand::reducer::abaqus {

void read_nodes(Model& model, int scope);

/// Reads the elements of a scope. Needs the nodes of all scopes.
void read_elements(Model& model, int scope);

}  // namespace tisserand::reducer::abaqus
