// SPDX-License-Identifier: GPL-3.0-or-later
// Second step of read_abaqus(): blocks sorted into the assembly, instances of parts and steps, with counts of keywords.
#pragma once

#include "reducer/decks/abaqus/model.hpp"

namespace tisserand::reducer::abaqus {

/// Sorts the blocks of the deck: sets Model::scopes, ::steps, ::unknown and ::skipped.
void sort_into_scopes(Model& model);

}  // namespace tisserand::reducer::abaqus
