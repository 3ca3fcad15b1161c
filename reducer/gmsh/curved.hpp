// Cells of second order that curved faces have folded: found in the current model of gmsh, and unfolded.
#pragma once

#include <cstddef>

namespace tisserand::reducer {

/// Volume cells of the current model that have a Jacobian determinant of 0 or less at one of their nodes.
std::size_t folded_cells();

struct Unfolding {
  std::size_t before = 0;
  std::size_t after = 0;
};

/// gmsh's optimisation of curved cells, where any is folded. Without folded ones nothing moves: the optimisation sums
/// in an order that changes from run to run, so that its meshes differ in their last digits.
Unfolding unfold_cells();

}  // namespace tisserand::reducer
