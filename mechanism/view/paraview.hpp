// Bodies in motion for ParaView: one unstructured grid (.vtu) per instant, listed in a collection (.pvd).
#pragma once

#include <string>

#include "mechanism/view/view.hpp"

namespace tisserand::mechanism {

/// Writes <run>.pvd and <run>/<run>_0.vtu ... per results file into `folder`: points in the world, triangles, lines and
/// points as cells, the number of the body per cell, and the displacement by deformation (world axes) per point. The
/// collection is written last, after all files that it lists. Returns its names, one per line. Throws Error.
std::string write_paraview(const ViewRequest& request, const std::string& folder);

}  // namespace tisserand::mechanism
