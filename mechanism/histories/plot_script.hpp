// SPDX-License-Identifier: GPL-3.0-or-later
// Script for gnuplot that draws a picture of histories.
#pragma once

#include <string>
#include <vector>

#include "mechanism/histories/plot.hpp"

namespace tisserand::mechanism {

/// Panel of a picture: indices of the series that share a unit. A reference without unit belongs to the first panel.
/// Differences have panels of their own.
struct Panel {
  std::string unit;
  bool of_differences = false;
  std::vector<std::size_t> members;  ///< indices of its series
  std::size_t legend_columns = 0;    ///< number of columns of the legend; 0: no legend
};

/// Distributes the series to panels. Throws Error for more than four units.
std::vector<Panel> panels_of(const std::vector<Series>& series);

/// Whether the panel has more curves than a legend can name.
bool has_too_many_names(const Panel& panel);

/// Notes on panels without legend and the reason, one sentence per line.
std::string missing_legends(const std::vector<Series>& series, const PlotOptions& options);

/// Script for gnuplot that draws the series, with their data in blocks. gnuplot_quoted() quotes every text. The script
/// does not set the output.
std::string gnuplot_script(const std::vector<Series>& series, const PlotOptions& options);

/// Label of a unit with superscripts: "m s^-2" -> "m s⁻²".
std::string with_superscripts(const std::string& unit);

/// Whether the abscissa of the series counts modes.
bool is_of_modes(const Series& series);

}  // namespace tisserand::mechanism
