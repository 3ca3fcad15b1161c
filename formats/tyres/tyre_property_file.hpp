// SPDX-License-Identifier: GPL-3.0-or-later
// Tyre property files (.tir) of the Magic Formula.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/units.hpp"
#include "formats/tyres/magic_formula.hpp"

namespace tisserand::formats {

/// Data of a tyre property file, in units of a scene.
struct TyreProperties {
  MagicFormula coefficients;
  std::string version;              ///< "205_60R15.tir (MF-Tyre 6.1)"
  std::vector<std::string> unused;  ///< keys whose values have no effect here
};

/// Reads a tyre property file of MF-Tyre 5.2 (PAC2002), 6.1 or 6.2, in the units of its section [UNITS] (default SI).
/// `units`: units of the scene; if they have no names, the numbers stay in units of the file. `scale`: values that
/// replace scaling factors of the file. Throws Error with file and line: no such file, another kind of tyre, lines
/// other than `KEY = value`, numbers that are not finite, duplicate keys, missing coefficients, ranges without zero,
/// angles in degrees, unknown scaling factors.
TyreProperties read_tyre_property_file(const std::string& path, const Units& units,
                                       const std::map<std::string, double>& scale = {});

}  // namespace tisserand::formats
