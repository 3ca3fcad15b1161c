// SPDX-License-Identifier: GPL-3.0-or-later
// Units of length, mass and time of a file or scene, as factors to SI with a label.
#pragma once

#include <string>

namespace tisserand {

/// Unit of a quantity: a factor to SI with a label. A factor of 0 means "consistent and unnamed": all three units of
/// Units are so, or none.
struct Unit {
  double factor = 0.0;
  std::string label;
};

/// Units of length, mass and time.
struct Units {
  Unit length;
  Unit mass;
  Unit time;

  bool named() const { return length.factor > 0.0; }
  static Units si() { return {{1.0, "m"}, {1.0, "kg"}, {1.0, "s"}}; }
  static Units consistent() { return {}; }
};

/// Factors that convert lengths, masses and times from units `from` to units `to`.
struct UnitConversion {
  double length = 1.0;
  double mass = 1.0;
  double time = 1.0;

  double force() const { return mass * length / (time * time); }
};

/// Conversion between two systems of units. Throws Error if exactly one is unnamed; `where` names the converted file.
UnitConversion convert_units(const Units& from, const Units& to, const std::string& where);

/// Unit of length, mass or time by its label: length m mm cm km in ft, mass kg g t (tonne) lb slug, time s ms. Throws
/// Error that lists the known labels.
Unit length_unit(const std::string& label);
Unit mass_unit(const std::string& label);
Unit time_unit(const std::string& label);

/// Label of the unit length^l mass^m time^t with the given exponents, for example "N" for SI and "t mm s^-2" otherwise.
/// Empty if the units are unnamed.
std::string unit_label(const Units& units, int length, int mass, int time);

/// Label of the unit of energy, for example "J" for SI. Empty if the units are unnamed.
std::string energy_label(const Units& units);

/// Label of a unit as written after a number, for example " N". Empty for unnamed units.
std::string after_number(const std::string& label);
/// Label of the unit of time as written after a number, for example " s". Empty if the units are unnamed.
std::string after_time(const Units& units);

/// Label of the unit of angular velocity, for example "rad/s", or "rad per unit of time" if the units are unnamed.
std::string turn_rate_label(const Units& units);

}  // namespace tisserand
