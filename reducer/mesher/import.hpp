// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry (.geo, STEP, IGES, BREP) and .msh files as cells, through gmsh in a sandboxed process.
#pragma once

#include <vector>

#include "common/units.hpp"
#include "formats/part/part.hpp"
#include "reducer/mesh/cells.hpp"
#include "reducer/mesher/parcel.hpp"

namespace tisserand::reducer {

/// Request to read or mesh a file with gmsh.
struct ImportRequest {
  const formats::MeshFile& settings;
  const Units& units;  ///< units of the part; STEP and IGES are converted to its length unit
  int dimension = 2;   ///< geometry is meshed up to this dimension
  std::vector<SizedEntity> sizes;
  bool describes_faces = false;  ///< fills CellMesh::geometry of a geometry
};

/// Reads or meshes a file with gmsh and returns its cells up to the requested dimension, each once. The result has
/// entities, labels and physical groups, with coordinates in units of the part. Second-order cells have no nodes
/// inside faces and volumes. Throws Error for files that gmsh does not accept, that crash it, reach a limit or do
/// forbidden things. It also throws for cells of an unknown kind, entities that could not be meshed, and an empty
/// mesh. The call costs the start of a process that loads gmsh (DECISIONS.md).
CellMesh import_with_gmsh(const ImportRequest& request);

}  // namespace tisserand::reducer
