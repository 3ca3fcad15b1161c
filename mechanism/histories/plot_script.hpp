// SPDX-License-Identifier: GPL-3.0-or-later
// Script for gnuplot that draws a picture of histories.
#pragma once

#include <string>
#include <vector>

#include "mechanism/histories/plot.hpp"

namespace tisserand::mechanism {

/// Indices of the series that share a unit. A reference without unit belongs to the first panel. Differences have their
/// own panels.
struct Panel {
  std::string unit;
  bool of_differences = false;
  std::vector<std::size_t> members;
  std::size_t legend_columns = 0;  ///< 0: no legend
};

/// Panels of the series. Throws Error for more than four units.
std::vector<Panel> panels_of(const std::vector<Series>& series);

/// Whether the panel has more curves than a legend can name.
bool has_too_many_names(const Panel& panel);

/// Notes on panels without legend and the reason, one sentence per line.
std::string missing_legends(const std::vector<Series>& series, const PlotOptions& options);

/// Script with data in blocks. gnuplot_quoted() quotes every text; no output is set.
std::string gnuplot_script(const std::vector<Series>& series, const PlotOptions& options);

/// Unit label with superscripts: "m s^-2" -> "m s⁻²".
std::string with_superscripts(const std::string& unit);

bool is_of_modes(const Series& series);

}  // namespace tisserand::mechanism
