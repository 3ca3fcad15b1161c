// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of histories, the end of the data flow, drawn by gnuplot as a child process.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/histories/picture_format.hpp"
#include "mechanism/histories/series.hpp"

namespace tisserand::mechanism {

/// Scale of an axis of a picture.
enum class AxisScale { linear, logarithmic };
/// Drawing of a curve: line, or line with its points.
enum class Mark { line, line_with_points };
/// Colours of an .svg in a page: light, or like those of the page.
enum class Appearance { light, follows_page };

/// Options of plot().
struct PlotOptions {
  std::string output;  ///< path of the picture, which ends in .png, .svg, .pdf or .eps
  std::string title;
  std::string x_label;                           ///< label of the abscissa; empty: name and unit of the abscissa
  std::string y_label;                           ///< label of the ordinate; empty: quantity and unit of the channels
  std::optional<std::array<double, 2>> x_range;  ///< range of the abscissa; absent: the range of the runs
  std::optional<std::array<double, 2>> y_range;
  AxisScale x_scale = AxisScale::linear;
  AxisScale y_scale = AxisScale::linear;
  Mark mark = Mark::line;
  std::optional<PictureSize> size;
  PictureFont font;
};

/// Draws the series with gnuplot to the picture file of the options. There is one panel per unit (at most four), plus
/// one for the differences of each unit. References lie beneath, wide and grey. All lines are solid. A few marks, at
/// different abscissae per curve, distinguish the lines without colour. Long histories are reduced to their envelope.
/// The picture file appears complete or not at all. Returns notes for the user, one sentence per line: differences with
/// their norms, omitted legends. Throws Error if gnuplot is missing or reports an error, for another ending, and if
/// there is nothing to draw.
std::string plot(const std::vector<Series>& series, const PlotOptions& options);

}  // namespace tisserand::mechanism
