// Tyre property files (.tir) of the Magic Formula.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/units.hpp"
#include "formats/tyres/magic_formula.hpp"

namespace tisserand::formats {

/// What is read of a file, in the units of a scene.
struct TyreProperties {
  MagicFormula coefficients;
  std::string version;              ///< "205_60R15.tir (MF-Tyre 6.1)"
  std::vector<std::string> unused;  ///< keys with a value that has no effect here
};

/// Reads a file of MF-Tyre 5.2 (PAC2002), 6.1 or 6.2 in the units that its section [UNITS] names (SI where it has
/// none); `scale`: values that replace scaling factors of the file. Units of the scene that have no names take those of
/// the file. Throws Error with file and line: no such file, another kind of tyre, lines that are no `KEY = value`,
/// numbers that are not finite, keys twice, missing coefficients, ranges that do not enclose zero, angles in degrees,
/// scaling factors that do not exist.
TyreProperties read_tyre_property_file(const std::string& path, const Units& units,
                                       const std::map<std::string, double>& scale = {});

}  // namespace tisserand::formats
