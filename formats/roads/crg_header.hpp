// SPDX-License-Identifier: GPL-3.0-or-later
// The head of an OpenCRG file: its parameters, and the meaning of the columns of its data.
#pragma once

#include <istream>
#include <map>
#include <string>
#include <vector>

namespace tisserand::formats {

/// Column of an OpenCRG file, as its head defines it.
struct CrgColumn {
  enum class Kind { heading, slope, banking, section };
  Kind kind = Kind::section;
  double position = 0.0;  ///< v of a section, or its number if `numbered`
  bool numbered = false;
  int line = 0;  ///< line in the file
};

/// Head of an OpenCRG file: parameters, columns and the format of numbers.
struct CrgHeader {
  /// Value of a parameter, and the line of the file that gives it.
  struct Parameter {
    double value = 0.0;
    int line = 0;
  };
  std::map<std::string, Parameter> parameters;  ///< parameters of $ROAD_CRG, in lower case
  std::vector<CrgColumn> columns;
  int width = 10;  ///< characters of a number
  int line = 0;    ///< number of the last line of the head
  /// Line in the file of the first modifier that moves the start of the road's line to the origin; 0: none.
  int moved_at = 0;
  double u_start = 0.0;    ///< REFERENCE_LINE_START_U, or the value of the U: line
  double increment = 0.0;  ///< positive

  /// Value of the parameter, or `fallback` if it is absent.
  double value(const std::string& name, double fallback) const;
  bool has(const std::string& name) const { return parameters.contains(name); }
};

/// Reads the head of an OpenCRG file, including the line $$$$. Throws Error with path:line.
CrgHeader read_crg_header(std::istream& stream, const std::string& path);

}  // namespace tisserand::formats
