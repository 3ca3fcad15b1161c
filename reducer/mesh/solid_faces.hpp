// SPDX-License-Identifier: GPL-3.0-or-later
// Faces of solid elements as cells.
#pragma once

#include <functional>
#include <vector>

#include "reducer/mesh/cells.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Cell with the shape and nodes of a solid.
Cell as_cell(const SolidElement& solid);

/// Outer faces of the solids whose corners are all `wanted`. A face is outer if it belongs to one solid only. The
/// nodes of a face are its corners, counter-clockwise seen from outside, then the middles of its edges.
std::vector<Cell> outer_faces(const Mesh& mesh, const std::function<bool(int node)>& wanted);

/// Outer face of a solid: a face that belongs to one solid only. `corners` are the numbers of its three or four
/// corners in that solid.
struct OuterFace {
  int solid = 0;
  std::vector<int> corners;  ///< counter-clockwise seen from outside
};
std::vector<OuterFace> outer_faces_of_solids(const Mesh& mesh);

}  // namespace tisserand::reducer
