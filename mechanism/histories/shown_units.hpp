// SPDX-License-Identifier: GPL-3.0-or-later
// Units that a user requests: "mm", "MPa", "deg", "km/h" instead of those of the files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/histories/series.hpp"

namespace tisserand::mechanism {

/// Dimension of a unit: powers of length, mass, time and angle. Energies and moments have the same powers, and so have
/// frequencies and rates. `kind` distinguishes them by the symbols J and Hz.
struct Dimension {
  enum class Kind { plain, energy, frequency };
  int length = 0, mass = 0, time = 0, angle = 0;
  Kind kind = Kind::plain;
  bool operator==(const Dimension&) const = default;
};

/// Unit as a factor to SI (angles: to radians) with its dimension.
struct MeasuredUnit {
  double factor = 1.0;
  Dimension dimension;
};

/// Parses a unit such as "mm", "N mm", "kg m s^-2", "m/s^2", "rad s^-1", "MPa", "deg", "rpm", "%". Absent: unknown.
std::optional<MeasuredUnit> measured_unit(const std::string& text);

/// Unit that the user requests, as text and as factor with dimension.
struct ShownUnit {
  std::string text;
  MeasuredUnit unit;
};

/// Parses the units that the user requests: "mm,MPa" or "length=mm,stress=MPa", also in several pieces. Throws Error
/// for an unknown unit (with a list of the known ones), a unit of another quantity, and two units for one quantity.
std::vector<ShownUnit> parse_shown_units(const std::vector<std::string>& pieces);

/// Converts values, abscissae and units of all series to the requested units. A reference without unit counts as having
/// the unit of the first series. Throws Error for a unit that fits no series.
void show_in(const std::vector<ShownUnit>& units, std::vector<Series>& series);

}  // namespace tisserand::mechanism
