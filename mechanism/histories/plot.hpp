// Pictures of histories: the last station of the data flow, drawn by gnuplot as a child process.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/histories/picture_format.hpp"
#include "mechanism/histories/series.hpp"

namespace tisserand::mechanism {

enum class AxisScale { linear, logarithmic };
enum class Mark { line, line_with_points };
enum class Appearance { light, follows_page };  ///< of an .svg in a page: light or dark as the reader's

struct PlotOptions {
  std::string output;  ///< ends in .png, .svg, .pdf or .eps
  std::string title;
  std::string x_label;                           ///< empty: name and unit of the abscissa
  std::string y_label;                           ///< empty: quantity and unit of the channels
  std::optional<std::array<double, 2>> x_range;  ///< absent: that of the runs
  std::optional<std::array<double, 2>> y_range;
  AxisScale x_scale = AxisScale::linear;
  AxisScale y_scale = AxisScale::linear;
  Mark mark = Mark::line;
  std::optional<PictureSize> size;
  PictureFont font;
};

/// Draws the series over one another, one panel per unit (at most four) and one more for the differences of each unit;
/// references lie beneath, wide and grey. All lines are solid: what tells them apart without colour are some marks on
/// each, at places of its own. Long histories are thinned to their envelope. The picture appears whole or not at all.
/// Returns what a user should know, a sentence per line: differences with their norms, a legend that is left out.
/// Throws Error: no gnuplot, another ending, nothing to draw, gnuplot's own message.
std::string plot(const std::vector<Series>& series, const PlotOptions& options);

}  // namespace tisserand::mechanism
