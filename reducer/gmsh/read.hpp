// A geometry or mesh file as cells: inside the process that may do nothing else.
#pragma once

#include <functional>

#include "reducer/mesher/parcel.hpp"

namespace tisserand::reducer {

/// As import_with_gmsh; `begin` is called when a phase begins. gmsh has been started. Throws Error, and std::string
/// where gmsh does.
CellMesh read_geometry(const GeometryRequest& request, const std::function<void(MesherPhase)>& begin);

}  // namespace tisserand::reducer
