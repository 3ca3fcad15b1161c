// SPDX-License-Identifier: GPL-3.0-or-later
// Outward direction of faces that bound volumes.
#pragma once

#include <vector>

#include "reducer/mesh/cells.hpp"

namespace tisserand::reducer {

/// Sign of each cell of dimension 2 in the mesh, which shows its orientation. It is +1 if the corners are
/// counter-clockwise for a viewer outside the volume that the cell bounds, and −1 if they are clockwise. It is 0 if
/// the cell bounds no volume or two, or if the volume is not closed. Volumes are the cells of dimension 3, otherwise
/// those of CellMesh::geometry. Without both, all faces together are one volume if they are closed. If the boundary of
/// a volume has several pieces, the one with the largest box is the outer one. The others are holes.
std::vector<int> outward_signs(const CellMesh& mesh);

}  // namespace tisserand::reducer
