// SPDX-License-Identifier: GPL-3.0-or-later
// Reads units by their labels.
#include "formats/yaml/units_reader.hpp"

namespace tisserand::formats {
namespace {

Unit read_unit(const MapReader& map, std::string_view key, Unit (*by_label)(const std::string&)) {
  const YamlNode* node = map.require(key);
  if (node == nullptr) return {};
  const std::string label = read_text(map.context(), *node, std::string(key));
  if (label.empty()) return {};
  try {
    return by_label(label);
  } catch (const Error& error) {
    map.context().fail(node->place, error.message(), error.remedy());
    return {};
  }
}

}  // namespace

Units read_units(const MapReader& map) {
  const YamlNode* node = map.find("units");
  if (node == nullptr) return Units::si();
  const Context context{map.context().reader, "units", map.context().entry};
  if (node->kind == YamlKind::scalar) {
    read_word(context, *node, "value", {"consistent"});
    return Units::consistent();
  }
  const MapReader units(context, *node, "units", "units.");
  Units result;
  result.length = read_unit(units, "length", length_unit);
  result.mass = read_unit(units, "mass", mass_unit);
  result.time = read_unit(units, "time", time_unit);
  return result;
}

}  // namespace tisserand::formats
