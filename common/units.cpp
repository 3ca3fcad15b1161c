// SPDX-License-Identifier: GPL-3.0-or-later
// Known units, conversion factors, and labels such as "N" or "kg mm s^-2".
#include "common/units.hpp"

#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand {
namespace {

struct KnownUnit {
  std::string_view label;
  double factor;
};

/// Exact by definition: 1 in = 25.4 mm and 1 lb = 0.45359237 kg (international yard and pound agreement of 1959).
/// 1 slug = 1 lbf s²/ft = 0.45359237 × 9.80665 / 0.3048 kg.
constexpr std::array<KnownUnit, 6> length_units{
    {{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}, {"km", 1e3}, {"in", 0.0254}, {"ft", 0.3048}}};
constexpr std::array<KnownUnit, 5> mass_units{
    {{"kg", 1.0}, {"g", 1e-3}, {"t", 1e3}, {"lb", 0.45359237}, {"slug", 0.45359237 * 9.80665 / 0.3048}}};
constexpr std::array<KnownUnit, 2> time_units{{{"s", 1.0}, {"ms", 1e-3}}};

Unit find_unit(std::span<const KnownUnit> known, const std::string& label, const std::string& quantity) {
  std::vector<std::string> labels;
  for (const KnownUnit& unit : known) {
    if (unit.label == label) return {unit.factor, label};
    labels.emplace_back(unit.label);
  }
  throw Error(fmt::format("unknown unit of {} '{}'", quantity, label), "",
              fmt::format("known units of {} are {}", quantity, join(labels, ", ")));
}

std::string powers(const Units& units, int length, int mass, int time) {
  std::vector<std::string> parts;
  const auto add = [&parts](const std::string& label, int power) {
    if (power != 0) parts.push_back(power == 1 ? label : fmt::format("{}^{}", label, power));
  };
  add(units.mass.label, mass);
  add(units.length.label, length);
  add(units.time.label, time);
  return join(parts, " ");
}

}  // namespace

UnitConversion convert_units(const Units& from, const Units& to, const std::string& where) {
  if (from.named() != to.named())
    throw Error(from.named() ? fmt::format("has the units {}, {}, {}, but the scene that uses it names no units",
                                           from.length.label, from.mass.label, from.time.label)
                             : fmt::format("names no units, but the scene that uses it has the units {}, {}, {}",
                                           to.length.label, to.mass.label, to.time.label),
                where, "name the units in both files or in neither");
  if (!from.named()) return {};
  return {from.length.factor / to.length.factor, from.mass.factor / to.mass.factor, from.time.factor / to.time.factor};
}

Unit length_unit(const std::string& label) { return find_unit(length_units, label, "length"); }
Unit mass_unit(const std::string& label) { return find_unit(mass_units, label, "mass"); }
Unit time_unit(const std::string& label) { return find_unit(time_units, label, "time"); }

std::string unit_label(const Units& units, int length, int mass, int time) {
  if (!units.named()) return "";
  const auto is = [](double factor, double wanted) { return std::abs(factor / wanted - 1.0) < 1e-12; };
  const double l = units.length.factor, t = units.time.factor, newton = units.mass.factor * l / (t * t);
  if (mass == 1 && time == -2 && length == 1 && is(newton, 1.0)) return "N";
  if (mass == 1 && time == -2 && length == 2 && is(newton, 1.0)) return "N " + units.length.label;
  if (mass == 1 && time == -3 && length == 2 && is(newton * l / t, 1.0)) return "W";
  if (mass == 1 && time == -3 && length == 2 && is(newton * l / t, 1e-3)) return "mW";
  if (mass == 1 && time == -2 && length == -1 && is(newton / (l * l), 1.0)) return "Pa";
  if (mass == 1 && time == -2 && length == -1 && is(newton / (l * l), 1e6)) return "MPa";
  return powers(units, length, mass, time);
}

std::string energy_label(const Units& units) {
  const std::string label = unit_label(units, 2, 1, -2);
  return label == "N m" ? "J" : label == "N mm" ? "mJ" : label;
}

std::string after_number(const std::string& label) { return label.empty() ? "" : " " + label; }

std::string after_time(const Units& units) { return after_number(unit_label(units, 0, 0, 1)); }

std::string turn_rate_label(const Units& units) {
  return units.named() ? "rad/" + unit_label(units, 0, 0, 1) : "rad per unit of time";
}

}  // namespace tisserand
