// SPDX-License-Identifier: GPL-3.0-or-later
// Usual ranges of structural materials, and the units in which a number would lie in them.
#include "formats/sections/substance.hpp"

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "common/text.hpp"

namespace tisserand::formats {
namespace {

struct NamedUnit {
  const char* name;
  double factor;  ///< to SI
};
/// Units in which a property is given, and the range of common structural materials.
struct Usual {
  std::vector<NamedUnit> units;
  double least = 0.0, most = 0.0;  ///< in SI
};
const Usual usual_density{
    {{"kg/m^3", 1.0}, {"t/mm^3", 1e12}, {"g/cm^3", 1e3}, {"kg/mm^3", 1e9}, {"lb/in^3", 27679.905}}, 100.0, 23000.0};
const Usual usual_modulus{{{"Pa", 1.0}, {"MPa", 1e6}, {"GPa", 1e9}, {"psi", 6894.757}}, 1e9, 1.3e12};

/// Text "t/mm^3 (in units of the part 7.85e-09)": unit in which a number is in the usual range, and its value in units
/// of `own`. Empty if there is none, or if it is that of `own`.
std::string likely_unit(double value, double own, const Usual& usual, const std::string& owner) {
  for (const NamedUnit& unit : usual.units)
    if (value * unit.factor >= usual.least && value * unit.factor <= usual.most)
      return std::abs(unit.factor - own) < 1e-6 * own
                 ? std::string()
                 : fmt::format("{} (in units of {} {:.4g})", unit.name, owner, value * unit.factor / own);
  return "";
}

}  // namespace

std::string substance_doubt(const Substance& s, const Units& units, const std::string& owner) {
  if (!units.named() || !(s.density > 0.0)) return {};
  const double length = units.length.factor, mass = units.mass.factor, time = units.time.factor;
  const double per_volume = mass / (length * length * length), pressure = mass / (length * time * time);
  const double density = s.density * per_volume, speed = std::sqrt(s.modulus / s.density) * length / time;
  const bool heavy = density < 10.0 || density > 30000.0, fast = s.modulus > 0.0 && (speed < 100.0 || speed > 20000.0);
  if (!heavy && !fast) return {};
  std::string text = fmt::format("{}: ", s.what);
  if (heavy) {
    const std::string own = fmt::format("{}/{}^3", units.mass.label, units.length.label), usual = "kg/m^3";
    text += fmt::format("a density of {:.4g} {}{}; usual values are 10 to 30 000 {}", s.density, own,
                        own == usual ? "" : fmt::format(", that is {:.3g} {}", density, usual), usual);
  }
  if (heavy && fast) text += "; ";
  if (fast)
    text += fmt::format(
        "a modulus of {:.4g} and a density of {:.4g} in units {}, {}, {} mean a speed of sound of {:.3g} m/s; usual "
        "values are 100 to 20 000 m/s",
        s.modulus, s.density, units.length.label, units.mass.label, units.time.label, speed);
  std::vector<std::string> hints;
  const std::string other_density = likely_unit(s.density, per_volume, usual_density, owner);
  const std::string other_modulus = likely_unit(s.modulus, pressure, usual_modulus, owner);
  if (!other_density.empty()) hints.push_back("the density looks like " + other_density);
  if (!other_modulus.empty()) hints.push_back("the modulus looks like " + other_modulus);
  return text +
         (hints.empty()
              ? ". Check that the units of length, mass and time fit those of the material (for example mm, t, s, MPa)"
              : ": " + join(hints, ", "));
}

}  // namespace tisserand::formats
