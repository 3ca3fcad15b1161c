// Geometry (.geo, STEP, IGES, BREP) and .msh files as cells, through gmsh.
#pragma once

#include <string>
#include <vector>

#include "common/units.hpp"
#include "formats/part/part.hpp"
#include "reducer/mesh/cells.hpp"

namespace tisserand::reducer {

/// The size wanted on an entity of a geometry.
struct SizedEntity {
  int dimension = 0;
  int number = 0;
  double size = 0.0;
};

struct ImportRequest {
  const formats::MeshFile& settings;
  const Units& units;  ///< of the part: STEP and IGES are converted to its length
  int dimension = 2;   ///< geometry is meshed up to this dimension
  std::vector<SizedEntity> sizes;
};

/// Cells of all dimensions up to the request's, each once, with entities, labels and physical groups; coordinates in
/// units of the part. Second order means cells without nodes inside faces and volumes. Throws Error for files that gmsh
/// does not accept, cells of an unknown kind, entities that could not be meshed, and an empty mesh.
CellMesh import_with_gmsh(const ImportRequest& request);

}  // namespace tisserand::reducer
