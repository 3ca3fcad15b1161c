// The text that gnuplot reads for a picture of histories.
#pragma once

#include <string>
#include <vector>

#include "mechanism/histories/plot.hpp"

namespace tisserand::mechanism {

/// Series that share a unit, as indices; a reference without unit joins the first panel. Differences have panels of
/// their own.
struct Panel {
  std::string unit;
  bool of_differences = false;
  std::vector<std::size_t> members;
  std::size_t legend_columns = 0;  ///< 0: it has no legend
};

/// Throws Error for more than four units.
std::vector<Panel> panels_of(const std::vector<Series>& series);

/// Whether the panel has more curves than a legend can name.
bool has_too_many_names(const Panel& panel);

/// Which panels have no legend and why, a sentence per line.
std::string missing_legends(const std::vector<Series>& series, const PlotOptions& options);

/// Data in blocks, every text quoted by gnuplot_quoted(), no output set.
std::string gnuplot_script(const std::vector<Series>& series, const PlotOptions& options);

/// "m s^-2" -> "m s⁻²": exponents of unit labels as superscripts.
std::string with_superscripts(const std::string& unit);

bool is_of_modes(const Series& series);

}  // namespace tisserand::mechanism
