// The same bodies in motion for ParaView: one unstructured grid (.vtu) per instant, listed in a collection (.pvd).
#pragma once

#include <string>

#include "mechanism/view/view.hpp"

namespace tisserand::mechanism {

/// Writes into `folder` <run>.pvd and <run>/<run>_0.vtu ... per results file: points in the world, triangles, lines and
/// points as cells, the number of the body at each cell and the displacement by deformation (world axes) at each point.
/// The collection comes last, so that what it lists is whole. Returns its names, one per line. Throws Error.
std::string write_paraview(const ViewRequest& request, const std::string& folder);

}  // namespace tisserand::mechanism
