// Heights over a rectangular grid from a text table.
#pragma once

#include <optional>
#include <string>

#include "formats/roads/road_heights.hpp"

namespace tisserand::formats {

/// Where the heights of a table stand that has no axes of its own.
struct RegularGrid {
  double x_start = 0.0, y_start = 0.0, spacing = 0.0;
};

/// Cells are separated by commas, semicolons, tabs or blanks, the first of these that the first line has; # begins a
/// comment line. Without `regular`, the first line holds a word or an empty cell and then the y of the columns, each
/// further line x and then the heights at the y; with it, all cells are heights, a line for each x. Axes ascend, each
/// has two values or more. Throws Error with path:line and the column: a cell that is no finite number (a hole), lines
/// of different lengths, an empty line between others, an axis that does not ascend, more than most_road_heights.
RoadHeights read_height_grid(const std::string& path, const std::optional<RegularGrid>& regular);

}  // namespace tisserand::formats
