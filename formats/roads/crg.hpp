// Roads from OpenCRG files in clear text: a grid of heights along a curved reference line.
#pragma once

#include <string>

#include "formats/roads/road_heights.hpp"

namespace tisserand::formats {

/// The subset of ASAM OpenCRG 1.x that ROADS.md lists, in metres: s is u from REFERENCE_LINE_START_U on, t is v (left
/// of the line positive), height the sum of the grid, the integrated slope and banking · v; the line is the integral of
/// the headings, its points one increment of u apart. Missing heights are not-a-number. Throws Error with path:line and
/// the keyword: what is beyond the subset, contradictory or damaged.
RoadHeights read_crg(const std::string& path);

}  // namespace tisserand::formats
