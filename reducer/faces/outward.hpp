// Which way is out of the volumes that faces bound.
#pragma once

#include <vector>

#include "reducer/mesh/cells.hpp"

namespace tisserand::reducer {

/// Of each cell of dimension 2: +1 if its corners are counter-clockwise seen from outside of the one volume that it
/// bounds, -1 if clockwise, 0 if it bounds none or two or the volume is open. By the cells of dimension 3 where there
/// are some, else by the volumes of CellMesh::geometry, else of all faces together if they are closed. Of a volume the
/// part of its boundary with the largest box is outside, all others are holes.
std::vector<int> outward_signs(const CellMesh& mesh);

}  // namespace tisserand::reducer
