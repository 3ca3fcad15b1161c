// SPDX-License-Identifier: GPL-3.0-or-later
// Reads, checks and writes format, version and units of a file.
#include "formats/hdf5/head.hpp"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "common/text.hpp"

namespace tisserand::formats::hdf5 {
namespace {

constexpr std::size_t max_label = 255;

Unit read_unit(const InputFile& file, const std::string& name) {
  Unit unit{file.number_attribute("/", name), ""};
  if (unit.factor != 0.0) unit.label = file.text_attribute("/", name + "_label");
  if (unit.label.size() > max_label)
    throw Error("is too long", fmt::format("{}: attribute '{}_label'", file.path(), name), "shorten it");
  return unit;
}

void write_unit(const Output& out, const std::string& name, const Unit& unit) {
  write_attribute(out, "/", name, unit.factor);
  write_attribute(out, "/", name + "_label", unit.label);
}

void check_unit(const Units& units, const Unit& unit, const std::string& name, Unit (*find)(const std::string&),
                const std::string& where) {
  const std::string place = fmt::format("{}attribute '{}'", where.empty() ? "" : where + ": ", name);
  if (!std::isfinite(unit.factor) || unit.factor < 0.0)
    throw Error(fmt::format("is {}, expected a factor to SI, or 0 for consistent units without names", unit.factor),
                place, "correct the number");
  if ((unit.factor > 0.0) != units.named())
    throw Error(fmt::format("is {}, but length_unit is {}: units have either all three a factor or all three 0",
                            unit.factor, units.length.factor),
                place, "write factors of length, mass and time, or 0 for all three");
  if (unit.factor == 0.0) return;
  Unit known;
  try {
    known = find(unit.label);
  } catch (const Error&) {
    return;  // unknown labels are allowed
  }
  if (std::abs(known.factor - unit.factor) > 1e-9 * known.factor)
    throw Error(
        fmt::format("is {}, but its label '{}' means {}", unit.factor, printable_line(unit.label, 60), known.factor),
        place, "correct the number or the label");
}

struct Version {
  int major = -1, minor = -1;
};

/// Version major.minor; negative numbers if the text is not of this form.
Version parse_version(const std::string& text) {
  Version version;
  const char* end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, version.major);
  const bool dot = error == std::errc() && after != end && *after == '.' && after + 1 != end;
  if (!dot || std::from_chars(after + 1, end, version.minor).ptr != end || version.minor < 0) return {};
  return version;
}

}  // namespace

void check_format(const InputFile& file, const FileKind& kind) {
  const std::string format = file.has_attribute("/", "format") ? file.text_attribute("/", "format") : "";
  if (format != kind.format)
    throw Error(format.empty()
                    ? fmt::format("is an HDF5 file, but not a {} (it has no attribute 'format')", kind.noun)
                    : fmt::format("is a file of the kind '{}', expected '{}'", format.substr(0, 60), kind.format),
                file.path(), kind.source);
  const std::string version = file.text_attribute("/", "version");
  const auto [major, minor] = parse_version(version);
  if (minor < 0)
    throw Error(fmt::format("is '{}', expected major.minor such as '1.0'", version.substr(0, 20)),
                file.path() + ": attribute 'version'", "correct the version");
  if (major != 1)
    throw Error(fmt::format("is {}, this program reads versions 1.x", version.substr(0, 20)),
                file.path() + ": attribute 'version'", kind.other_version);
}

int minor_version(const InputFile& file) { return parse_version(file.text_attribute("/", "version")).minor; }

Units read_units(const InputFile& file) {
  return {read_unit(file, "length_unit"), read_unit(file, "mass_unit"), read_unit(file, "time_unit")};
}

void write_units(const Output& out, const Units& units) {
  write_unit(out, "length_unit", units.length);
  write_unit(out, "mass_unit", units.mass);
  write_unit(out, "time_unit", units.time);
}

void check_units(const Units& units, const std::string& where) {
  check_unit(units, units.length, "length_unit", length_unit, where);
  check_unit(units, units.mass, "mass_unit", mass_unit, where);
  check_unit(units, units.time, "time_unit", time_unit, where);
}

}  // namespace tisserand::formats::hdf5
