// SPDX-License-Identifier: GPL-3.0-or-later
// Heights over a rectangular grid from a text table.
#pragma once

#include <optional>
#include <string>

#include "formats/roads/road_heights.hpp"

namespace tisserand::formats {

/// Positions of the heights of a table without axes: start of x and y, and the spacing in both directions.
struct RegularGrid {
  double x_start = 0.0, y_start = 0.0, spacing = 0.0;
};

/// Reads road heights from a text table. The separator is the first of comma, semicolon and tab that the first line
/// has, else blanks. # begins a comment line. Without `regular`, the first line holds a word or an empty cell and the y
/// of the columns, further lines x and heights. With `regular`, all cells are heights, one line per x. Axes ascend and
/// have two or more values. Throws Error with path:line and column: a cell that is no finite number, lines of different
/// lengths, an empty line in between, an axis that does not ascend, more than most_road_heights.
RoadHeights read_height_grid(const std::string& path, const std::optional<RegularGrid>& regular);

}  // namespace tisserand::formats
