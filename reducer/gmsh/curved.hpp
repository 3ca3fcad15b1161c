// SPDX-License-Identifier: GPL-3.0-or-later
// Second-order cells that curved faces have folded: detection in the current model of gmsh, and unfolding.
#pragma once

#include <cstddef>

namespace tisserand::reducer {

/// Number of volume cells of the current model with a Jacobian determinant of 0 or less at one of their nodes.
std::size_t folded_cells();

/// Numbers of folded cells before and after the optimisation of curved cells.
struct Unfolding {
  std::size_t before = 0;
  std::size_t after = 0;
};

/// Runs gmsh's optimisation of curved cells if any cell is folded, and returns the number of folded cells before and
/// after. Otherwise nothing is moved. The optimisation sums in an order that changes from run to run, so the last
/// digits of its meshes differ.
Unfolding unfold_cells();

}  // namespace tisserand::reducer
