// Sections given by `shape`: from the YAML entry to constants.
#pragma once

#include <string>
#include <vector>

#include "common/units.hpp"
#include "formats/sections/section.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// One key set per shape, "section_circle" and so on; PART.md describes them.
std::vector<KeySet> shape_key_sets();

/// `shape` is the value of the key of that name in `node`. After an error, which is recorded, the section is empty.
Section read_shape(const Context& context, const YamlNode& node, const YamlNode& shape, const Units& units,
                   const std::string& prefix);

}  // namespace tisserand::formats
