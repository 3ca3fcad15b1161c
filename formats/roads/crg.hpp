// SPDX-License-Identifier: GPL-3.0-or-later
// Roads from OpenCRG files in clear text: a grid of heights along a curved reference line.
#pragma once

#include <string>

#include "formats/roads/road_heights.hpp"

namespace tisserand::formats {

/// Reads the heights of a road from a file of ASAM OpenCRG 1.x, of which ROADS.md lists the supported subset, in
/// metres. Coordinate s of the result is u from REFERENCE_LINE_START_U on, t is v (positive left of the line). A height
/// is the sum of the grid, the integrated slope and banking · v. The line is the integral of the headings, with a point
/// at each increment of u. Missing heights are NaN. Throws Error with path:line and keyword for contents that are
/// unsupported, contradictory or damaged.
RoadHeights read_crg(const std::string& path);

}  // namespace tisserand::formats
