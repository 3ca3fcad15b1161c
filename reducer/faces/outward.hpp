// SPDX-License-Identifier: GPL-3.0-or-later
// Outward direction of faces that bound volumes.
#pragma once

#include <vector>

#include "reducer/mesh/cells.hpp"

namespace tisserand::reducer {

/// Sign of each cell of dimension 2. Seen from outside of the one volume that it bounds, its corners are
/// counter-clockwise (+1) or clockwise (-1). It is 0 if the cell bounds none or two or the volume is open. Volumes are
/// cells of dimension 3, else those of CellMesh::geometry, else all faces together if they are closed. The part of a
/// boundary with the largest box is the outer one, all others are holes.
std::vector<int> outward_signs(const CellMesh& mesh);

}  // namespace tisserand::reducer
