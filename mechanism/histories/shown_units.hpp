// SPDX-License-Identifier: GPL-3.0-or-later
// Units that a user requests: "mm", "MPa", "deg", "km/h" instead of those of the files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/histories/series.hpp"

namespace tisserand::mechanism {

/// Dimension of a unit. Energies and moments, and frequencies and rates, have the same powers; the symbols J and Hz
/// distinguish them.
struct Dimension {
  enum class Kind { plain, energy, frequency };
  int length = 0, mass = 0, time = 0, angle = 0;
  Kind kind = Kind::plain;
  bool operator==(const Dimension&) const = default;
};

/// A unit as a factor to SI (angles: to radians) with its dimension.
struct MeasuredUnit {
  double factor = 1.0;
  Dimension dimension;
};

/// Parses units such as "mm", "N mm", "kg m s^-2", "m/s^2", "rad s^-1", "MPa", "deg", "rpm", "%"; empty if unknown.
std::optional<MeasuredUnit> measured_unit(const std::string& text);

/// A requested unit.
struct ShownUnit {
  std::string text;
  MeasuredUnit unit;
};

/// Parses "mm,MPa" or "length=mm,stress=MPa", also in several pieces. Throws Error for an unknown unit (with a list of
/// the known ones), a unit of another quantity, and two units for one quantity.
std::vector<ShownUnit> parse_shown_units(const std::vector<std::string>& pieces);

/// Converts values, abscissae and units of all series to the requested units. A reference without unit counts as having
/// the unit of the first series. Throws Error for a unit that fits no series.
void show_in(const std::vector<ShownUnit>& units, std::vector<Series>& series);

}  // namespace tisserand::mechanism
