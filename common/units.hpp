// Units of length, mass and time of a file or scene, as factors to SI with a label.
#pragma once

#include <string>

namespace tisserand {

/// factor = 0 means "consistent and unnamed" (all three are 0 then, or none is).
struct Unit {
  double factor = 0.0;
  std::string label;
};

struct Units {
  Unit length;
  Unit mass;
  Unit time;

  bool named() const { return length.factor > 0.0; }
  static Units si() { return {{1.0, "m"}, {1.0, "kg"}, {1.0, "s"}}; }
  static Units consistent() { return {}; }
};

/// The three factors with which numbers in `from` are multiplied to become numbers in `to`.
struct UnitConversion {
  double length = 1.0;
  double mass = 1.0;
  double time = 1.0;

  double force() const { return mass * length / (time * time); }
};

/// Throws Error if exactly one of the two is unnamed; `where` names the file that is converted.
UnitConversion convert_units(const Units& from, const Units& to, const std::string& where);

/// Units by label: length m mm cm km in ft; mass kg g t (tonne) lb slug; time s ms. Throws Error (with the known
/// labels).
Unit length_unit(const std::string& label);
Unit mass_unit(const std::string& label);
Unit time_unit(const std::string& label);

/// For example "N" for SI, "t mm s^-2" otherwise, "" if unnamed: label of length^l mass^m time^t.
std::string unit_label(const Units& units, int length, int mass, int time);

/// The same of an energy: "J" for SI.
std::string energy_label(const Units& units);

/// A label as it stands after a number: " N", or nothing for units without names.
std::string after_number(const std::string& label);

}  // namespace tisserand
