// SPDX-License-Identifier: GPL-3.0-or-later
// Positions of nodes from a file of their own: a deck of another program or a small table.
#pragma once

#include <string>

#include "reducer/exchange/reduced_matrices.hpp"

namespace tisserand::reducer {
struct NastranModel;
}

namespace tisserand::reducer::exchange {

/// Places from Abaqus or CalculiX input with *NODE, or Nastran bulk data with GRID. Any other file is a table of lines
/// "number, x, y, z" or "number, x, y, z, name" (# begins a comment; a first line of words is skipped). Throws Error.
Places read_places(const std::string& path);

/// Reads the cards of a deck and sorts them by name. Throws Error for faults of single lines.
void read_cards(const std::string& path, NastranModel& model);

/// Places from GRID and coordinate systems of cards that have been read, with axes from CD. Throws Error.
Places places_of(NastranModel& model);

}  // namespace tisserand::reducer::exchange
