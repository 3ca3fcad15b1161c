// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of a picture: legends and labels of axes.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "mechanism/histories/plot_script.hpp"

namespace tisserand::mechanism {

/// Names of the series of a picture, from counts of the properties that distinguish them. The counts are computed once.
struct CurveNames {
  std::map<std::string, std::size_t> from_source;  ///< number of series of runs from each file
  bool same_source = true, same_channel = true;
  bool same_reference_channel = true;

  explicit CurveNames(const std::vector<Series>& series);
  /// Name that distinguishes the series `one` from the others of the picture.
  std::string of(const Series& one) const;
};

/// Name of at most 60 letters. A longer name keeps its beginning and its end.
std::string shortened(const std::string& name);

/// Label of the vertical axis of a panel: "position, velocity [m]", its quantities and unit.
std::string y_label_of(const std::vector<Series>& series, const Panel& panel);

/// Text "name [m s⁻²]", or the name alone.
std::string with_unit(const std::string& name, const std::string& unit);

}  // namespace tisserand::mechanism
