// SPDX-License-Identifier: GPL-3.0-or-later
// Positions of nodes from a file of their own: a deck of another program or a small table.
#pragma once

#include <string>

#include "reducer/exchange/reduced_matrices.hpp"

namespace tisserand::reducer {
struct NastranModel;
}

namespace tisserand::reducer::exchange {

/// Reads places of nodes from Abaqus or CalculiX input with *NODE, or from Nastran bulk data with GRID. Any other file
/// is a table of lines "number, x, y, z" or "number, x, y, z, name". In a table # begins a comment, and a first line
/// of words is skipped. Throws Error.
Places read_places(const std::string& path);

/// Reads the cards of a Nastran deck into `model` and sorts them by name. Throws Error for faults of single lines.
void read_cards(const std::string& path, NastranModel& model);

/// Places of nodes from the GRID cards and coordinate systems of a deck that read_cards() has read. Their axes are
/// those of CD. Throws Error.
Places places_of(NastranModel& model);

}  // namespace tisserand::reducer::exchange
