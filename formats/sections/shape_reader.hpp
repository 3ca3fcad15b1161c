// SPDX-License-Identifier: GPL-3.0-or-later
// Reads sections given by `shape` and computes their constants.
#pragma once

#include <string>
#include <vector>

#include "common/units.hpp"
#include "formats/sections/section.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// Key sets of the maps of shapes, named "section_circle" and so on, as PART.md describes them.
std::vector<KeySet> shape_key_sets();

/// Reads a section given by its shape. `shape`: value of the key `shape` in `node`. After a recorded error the section
/// is empty.
Section read_shape(const Context& context, const YamlNode& node, const YamlNode& shape, const Units& units,
                   const std::string& prefix);

}  // namespace tisserand::formats
