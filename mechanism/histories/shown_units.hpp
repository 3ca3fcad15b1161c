// Units that a user asks for: "mm", "MPa", "deg", "km/h" in place of those of the files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/histories/series.hpp"

namespace tisserand::mechanism {

/// What a unit measures. Energies and moments, and frequencies and rates, have the same powers: the symbols J and Hz
/// tell them apart.
struct Dimension {
  enum class Kind { plain, energy, frequency };
  int length = 0, mass = 0, time = 0, angle = 0;
  Kind kind = Kind::plain;
  bool operator==(const Dimension&) const = default;
};

/// A unit as a factor to SI (angles: to radians) and what it measures.
struct MeasuredUnit {
  double factor = 1.0;
  Dimension dimension;
};

/// Units such as "mm", "N mm", "kg m s^-2", "m/s^2", "rad s^-1", "MPa", "deg", "rpm", "%"; nothing: unknown.
std::optional<MeasuredUnit> measured_unit(const std::string& text);

/// One unit that is asked for.
struct ShownUnit {
  std::string text;
  MeasuredUnit unit;
};

/// "mm,MPa" or "length=mm,stress=MPa", also in several pieces. Throws Error: an unknown unit (with the known ones), a
/// unit that is none of the quantity, two for one quantity.
std::vector<ShownUnit> parse_shown_units(const std::vector<std::string>& pieces);

/// Values, abscissae and units of all series in the units asked for. A reference without unit is taken to be in the
/// unit of the first series. Throws Error for a unit that no series has a quantity for.
void show_in(const std::vector<ShownUnit>& units, std::vector<Series>& series);

}  // namespace tisserand::mechanism
