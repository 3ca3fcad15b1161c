// SPDX-License-Identifier: GPL-3.0-or-later
// The fields of part.yaml, for its readers, schema/part.schema.json and PART.md.
#pragma once

#include <vector>

#include "formats/yaml/field.hpp"

namespace tisserand::formats {

/// Fields of part.yaml: one KeySet for each kind of map.
std::vector<KeySet> part_key_sets();

/// Types that the fields of part_key_sets() use, in addition to its kinds of maps.
std::vector<NamedType> part_types();

}  // namespace tisserand::formats
