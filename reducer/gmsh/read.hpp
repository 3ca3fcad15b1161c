// SPDX-License-Identifier: GPL-3.0-or-later
// A geometry or mesh file as cells, read inside the sandbox.
#pragma once

#include <functional>

#include "reducer/mesher/parcel.hpp"

namespace tisserand::reducer {

/// Cells as from import_with_gmsh(); `begin` is called when a phase begins. gmsh must have been started. Throws Error,
/// and std::string if gmsh does.
CellMesh read_geometry(const GeometryRequest& request, const std::function<void(MesherPhase)>& begin);

}  // namespace tisserand::reducer
