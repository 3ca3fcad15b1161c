// SPDX-License-Identifier: GPL-3.0-or-later
// Third step of read_abaqus(): *NODE, *SYSTEM and *ELEMENT of one scope.
#pragma once

#include "reducer/decks/abaqus/model.hpp"

namespace tisserand::reducer::abaqus {

void read_nodes(Model& model, int scope);

/// Reads *ELEMENT of a scope. Requires that the nodes of all scopes have been read.
void read_elements(Model& model, int scope);

}  // namespace tisserand::reducer::abaqus
