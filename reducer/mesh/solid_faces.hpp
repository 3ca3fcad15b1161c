// SPDX-License-Identifier: GPL-3.0-or-later
// Faces of solid elements as cells.
#pragma once

#include <functional>
#include <vector>

#include "reducer/mesh/cells.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// A solid as the cell from which it was made.
Cell as_cell(const SolidElement& solid);

/// Faces of the mesh whose corners are all `wanted` and that belong to one solid only: corners counter-clockwise seen
/// from outside, then the middles of their edges.
std::vector<Cell> outer_faces(const Mesh& mesh, const std::function<bool(int node)>& wanted);

/// Face that belongs to one solid only, by the numbers of its three or four corners in that solid.
struct OuterFace {
  int solid = 0;
  std::vector<int> corners;  ///< counter-clockwise seen from outside
};
std::vector<OuterFace> outer_faces_of_solids(const Mesh& mesh);

}  // namespace tisserand::reducer
