// SPDX-License-Identifier: GPL-3.0-or-later
// Products of powers of unit symbols, their factors, and conversion of series.
#include "mechanism/histories/shown_units.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <numbers>
#include <set>
#include <string_view>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::mechanism {
namespace {

using Kind = Dimension::Kind;

struct Symbol {
  std::string_view name;
  double factor;
  Dimension dimension;
};

constexpr double pi = std::numbers::pi;
constexpr double pound = 0.45359237, inch = 0.0254, pound_force = pound * 9.80665;  // exact, as in common/units.cpp
constexpr Dimension of_nothing{}, of_length{1, 0, 0, 0}, of_mass{0, 1, 0, 0}, of_time{0, 0, 1, 0}, of_angle{0, 0, 0, 1},
    of_force{1, 1, -2, 0}, of_energy{2, 1, -2, 0, Kind::energy}, of_power{2, 1, -3, 0}, of_stress{-1, 1, -2, 0},
    of_frequency{0, 0, -1, 0, Kind::frequency}, of_turning{0, 0, -1, 1};

constexpr std::array known_symbols{Symbol{"1", 1.0, of_nothing},
                                   Symbol{"%", 0.01, of_nothing},
                                   Symbol{"m", 1.0, of_length},
                                   Symbol{"mm", 1e-3, of_length},
                                   Symbol{"cm", 1e-2, of_length},
                                   Symbol{"km", 1e3, of_length},
                                   Symbol{"um", 1e-6, of_length},
                                   Symbol{"µm", 1e-6, of_length},
                                   Symbol{"in", inch, of_length},
                                   Symbol{"ft", 12.0 * inch, of_length},
                                   Symbol{"kg", 1.0, of_mass},
                                   Symbol{"g", 1e-3, of_mass},
                                   Symbol{"t", 1e3, of_mass},
                                   Symbol{"lb", pound, of_mass},
                                   Symbol{"slug", pound_force / (12.0 * inch), of_mass},
                                   Symbol{"s", 1.0, of_time},
                                   Symbol{"ms", 1e-3, of_time},
                                   Symbol{"us", 1e-6, of_time},
                                   Symbol{"µs", 1e-6, of_time},
                                   Symbol{"min", 60.0, of_time},
                                   Symbol{"h", 3600.0, of_time},
                                   Symbol{"rad", 1.0, of_angle},
                                   Symbol{"mrad", 1e-3, of_angle},
                                   Symbol{"deg", pi / 180.0, of_angle},
                                   Symbol{"°", pi / 180.0, of_angle},
                                   Symbol{"rev", 2.0 * pi, of_angle},
                                   Symbol{"rpm", 2.0 * pi / 60.0, of_turning},
                                   Symbol{"N", 1.0, of_force},
                                   Symbol{"mN", 1e-3, of_force},
                                   Symbol{"kN", 1e3, of_force},
                                   Symbol{"MN", 1e6, of_force},
                                   Symbol{"lbf", pound_force, of_force},
                                   Symbol{"J", 1.0, of_energy},
                                   Symbol{"mJ", 1e-3, of_energy},
                                   Symbol{"kJ", 1e3, of_energy},
                                   Symbol{"W", 1.0, of_power},
                                   Symbol{"mW", 1e-3, of_power},
                                   Symbol{"kW", 1e3, of_power},
                                   Symbol{"Pa", 1.0, of_stress},
                                   Symbol{"kPa", 1e3, of_stress},
                                   Symbol{"MPa", 1e6, of_stress},
                                   Symbol{"GPa", 1e9, of_stress},
                                   Symbol{"bar", 1e5, of_stress},
                                   Symbol{"psi", pound_force / (inch * inch), of_stress},
                                   Symbol{"Hz", 1.0, of_frequency},
                                   Symbol{"kHz", 1e3, of_frequency}};

struct Quantity {
  std::string_view name;
  Dimension dimension;
};

constexpr std::array known_quantities{Quantity{"length", of_length},
                                      Quantity{"angle", of_angle},
                                      Quantity{"time", of_time},
                                      Quantity{"mass", of_mass},
                                      Quantity{"velocity", {1, 0, -1, 0}},
                                      Quantity{"acceleration", {1, 0, -2, 0}},
                                      Quantity{"angular_velocity", of_turning},
                                      Quantity{"angular_acceleration", {0, 0, -2, 1}},
                                      Quantity{"force", of_force},
                                      Quantity{"moment", {2, 1, -2, 0}},
                                      Quantity{"energy", of_energy},
                                      Quantity{"power", of_power},
                                      Quantity{"stress", of_stress},
                                      Quantity{"frequency", of_frequency},
                                      Quantity{"rate", {0, 0, -1, 0}}};

/// Factor of a power of a unit: "m^-2" -> m, -2.
std::optional<MeasuredUnit> factor_of(std::string_view word) {
  int exponent = 1;
  if (const std::size_t hat = word.find('^'); hat != std::string_view::npos) {
    const std::string_view digits = word.substr(hat + 1);
    const auto [rest, code] = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (code != std::errc() || rest != digits.data() + digits.size() || exponent < -6 || exponent > 6) return {};
    word = word.substr(0, hat);
  }
  const auto found = std::ranges::find(known_symbols, word, &Symbol::name);
  if (found == known_symbols.end()) return {};
  MeasuredUnit unit;
  for (int k = 0; k < std::abs(exponent); ++k) unit.factor *= exponent > 0 ? found->factor : 1.0 / found->factor;
  const Dimension& d = found->dimension;
  unit.dimension = {exponent * d.length, exponent * d.mass, exponent * d.time, exponent * d.angle, d.kind};
  return unit;
}

void multiply(MeasuredUnit& unit, const MeasuredUnit& by, int sign) {
  unit.factor *= sign > 0 ? by.factor : 1.0 / by.factor;
  unit.dimension.length += sign * by.dimension.length;
  unit.dimension.mass += sign * by.dimension.mass;
  unit.dimension.time += sign * by.dimension.time;
  unit.dimension.angle += sign * by.dimension.angle;
  if (by.dimension.kind != Kind::plain) unit.dimension.kind = by.dimension.kind;
}

std::string name_of(const Dimension& dimension, const std::string& unit) {
  const auto found = std::ranges::find(known_quantities, dimension, &Quantity::dimension);
  return found == known_quantities.end() ? "quantity in " + unit : std::string(found->name);
}

ShownUnit parse_one(const std::string& piece) {
  const std::size_t equals = piece.find('=');
  const std::string text = equals == std::string::npos ? piece : piece.substr(equals + 1);
  const std::optional<MeasuredUnit> unit = measured_unit(text);
  if (!unit) {
    std::vector<std::string> known;
    for (const Symbol& symbol : known_symbols) known.emplace_back(symbol.name);
    throw Error(fmt::format("unknown unit '{}'", printable_line(text, 60)), "--units",
                "write products of " + join(known, " ") + ", for example 'N mm', m/s^2, rad/s");
  }
  if (equals != std::string::npos) {
    const std::string name = piece.substr(0, equals);
    const auto quantity = std::ranges::find(known_quantities, name, &Quantity::name);
    std::vector<std::string> names;
    for (const Quantity& one : known_quantities) names.emplace_back(one.name);
    if (quantity == known_quantities.end())
      throw Error(fmt::format("unknown quantity '{}'", printable_line(name, 60)), "--units",
                  "choose among " + join(names, ", ") + "; the unit alone is also enough");
    if (quantity->dimension != unit->dimension)
      throw Error(fmt::format("{} is not a unit of {}", text, name), "--units",
                  fmt::format("it is a unit of {}", name_of(unit->dimension, text)));
  }
  return {text, *unit};
}

/// Factor from the unit of a file to a requested one; empty if none was requested.
std::optional<double> conversion(const std::vector<ShownUnit>& units, std::string& unit, std::set<std::string>& used) {
  const std::optional<MeasuredUnit> own = measured_unit(unit);
  if (!own) return {};
  for (const ShownUnit& shown : units) {
    if (shown.unit.dimension != own->dimension) continue;
    used.insert(shown.text);
    unit = shown.text;
    return own->factor / shown.unit.factor;
  }
  return {};
}

}  // namespace

std::optional<MeasuredUnit> measured_unit(const std::string& text) {
  MeasuredUnit unit;
  int sign = 1;
  bool any = false;
  std::size_t at = 0;
  while (at < text.size()) {
    if (text[at] == ' ' || text[at] == '*') {
      ++at;
    } else if (text[at] == '/') {
      if (!any || sign < 0) return {};  // "a/b/c" is ambiguous
      sign = -1;
      ++at;
    } else {
      const std::size_t end = std::min(text.find_first_of(" */", at), text.size());
      const std::optional<MeasuredUnit> by = factor_of(std::string_view(text).substr(at, end - at));
      if (!by) return {};
      multiply(unit, *by, sign);
      any = true;
      at = end;
    }
  }
  return any ? std::optional(unit) : std::nullopt;
}

std::vector<ShownUnit> parse_shown_units(const std::vector<std::string>& pieces) {
  std::vector<ShownUnit> units;
  for (const std::string& text : pieces) {
    std::size_t at = 0;
    while (at <= text.size()) {
      const std::size_t end = std::min(text.find(',', at), text.size());
      ShownUnit next = parse_one(text.substr(at, end - at));
      for (const ShownUnit& other : units)
        if (other.unit.dimension == next.unit.dimension)
          throw Error(fmt::format("{} and {} are units of the same quantity", other.text, next.text), "--units",
                      "give only one of them");
      units.push_back(std::move(next));
      at = end + 1;
    }
  }
  return units;
}

void show_in(const std::vector<ShownUnit>& units, std::vector<Series>& series) {
  if (units.empty() || series.empty()) return;
  std::set<std::string> used;
  const std::string first = series.front().unit, first_x = series.front().x_unit;
  for (Series& one : series) {
    if (one.kind == SeriesKind::reference && one.unit.empty()) one.unit = first;
    if (one.kind == SeriesKind::reference && one.x_unit.empty()) one.x_unit = first_x;
    if (const auto factor = conversion(units, one.unit, used))
      for (double& y : one.y) y *= *factor;
    if (const auto factor = conversion(units, one.x_unit, used))
      for (double& x : one.x) x *= *factor;
  }
  for (const ShownUnit& unit : units)
    if (!used.contains(unit.text))
      throw Error(fmt::format("no quantity in the plot can be shown in {}, a unit of {}", unit.text,
                              name_of(unit.unit.dimension, unit.text)),
                  "--units", first.empty() ? "omit it; runs without named units cannot be converted" : "omit it");
}

}  // namespace tisserand::mechanism
