// SPDX-License-Identifier: GPL-3.0-or-later
// A geometry or mesh file as cells, read inside the sandbox.
#pragma once

#include <functional>

#include "reducer/mesher/parcel.hpp"

namespace tisserand::reducer {

/// Reads a geometry or mesh file as cells, like import_with_gmsh(), in this process. Requires that gmsh has been
/// started. `begin` is called when a phase begins. Throws Error, and std::string if gmsh throws it.
CellMesh read_geometry(const GeometryRequest& request, const std::function<void(MesherPhase)>& begin);

}  // namespace tisserand::reducer
