// Words of a picture: legends and labels of axes.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "mechanism/histories/plot_script.hpp"

namespace tisserand::mechanism {

/// Counts once what tells the series of a picture apart.
struct CurveNames {
  std::map<std::string, std::size_t> from_source;  ///< series of runs from each file
  bool same_source = true, same_channel = true;
  bool same_reference_channel = true;

  explicit CurveNames(const std::vector<Series>& series);
  /// What tells this series from the others of the picture.
  std::string of(const Series& one) const;
};

/// At most 60 letters of a name, its beginning and its end.
std::string shortened(const std::string& name);

/// "position, velocity [m]": quantities and unit of a panel.
std::string y_label_of(const std::vector<Series>& series, const Panel& panel);

/// "name [m s⁻²]", or the name alone.
std::string with_unit(const std::string& name, const std::string& unit);

}  // namespace tisserand::mechanism
