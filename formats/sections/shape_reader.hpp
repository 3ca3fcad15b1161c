// SPDX-License-Identifier: GPL-3.0-or-later
// Reads sections given by `shape` and computes their constants.
#pragma once

#include <string>
#include <vector>

#include "common/units.hpp"
#include "formats/sections/section.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// Key sets of the shapes, "section_circle" and so on, which PART.md describes.
std::vector<KeySet> shape_key_sets();

/// Section by its shape. `shape`: value of that key in `node`. After a reported error the section is empty.
Section read_shape(const Context& context, const YamlNode& node, const YamlNode& shape, const Units& units,
                   const std::string& prefix);

}  // namespace tisserand::formats
