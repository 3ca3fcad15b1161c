// Pictures of histories: the last station of the data flow, drawn by gnuplot as a child process.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/histories/series.hpp"

namespace tisserand::mechanism {

enum class AxisScale { linear, logarithmic };
enum class Mark { line, line_with_points };

struct PlotOptions {
  std::string output;  ///< ends in .png or .svg
  std::string title;
  std::string x_label;                           ///< empty: name and unit of the abscissa
  std::string y_label;                           ///< empty: quantity and unit of the channels
  std::optional<std::array<double, 2>> x_range;  ///< absent: that of the runs
  std::optional<std::array<double, 2>> y_range;
  AxisScale x_scale = AxisScale::linear;
  AxisScale y_scale = AxisScale::linear;
  Mark mark = Mark::line;
};

/// Draws the series over one another, one panel per unit (at most four); references lie beneath, wide and grey. Long
/// histories are thinned to their envelope. The picture appears whole or not at all.
/// Throws Error: no gnuplot, another ending than .png or .svg, nothing to draw, gnuplot's own message.
void plot(const std::vector<Series>& series, const PlotOptions& options);

/// The text that gnuplot reads: data in blocks, every text quoted by gnuplot_quoted().
std::string gnuplot_script(const std::vector<Series>& series, const PlotOptions& options);

/// "m s^-2" -> "m s⁻²": exponents of unit labels as superscripts.
std::string with_superscripts(const std::string& unit);

}  // namespace tisserand::mechanism
