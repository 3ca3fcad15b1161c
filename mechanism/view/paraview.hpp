// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies in motion for ParaView: one unstructured grid (.vtu) per instant, listed in a collection (.pvd).
#pragma once

#include <string>

#include "mechanism/view/view.hpp"

namespace tisserand::mechanism {

/// Writes the motion of the bodies for ParaView into `folder`: <run>.pvd and <run>/<run>_0.vtu ... per results file.
/// The files hold points in the world, cells (triangles, lines, points) with the number of the body, and displacements
/// by deformation in world axes. The collection .pvd is written last, after its files. Returns the names of the
/// collections, one per line. Throws Error.
std::string write_paraview(const ViewRequest& request, const std::string& folder);

}  // namespace tisserand::mechanism
