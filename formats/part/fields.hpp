// The fields of part.yaml: what it may hold, for its readers, schema/part.schema.json and PART.md.
#pragma once

#include <vector>

#include "formats/yaml/field.hpp"

namespace tisserand::formats {

/// A list for each kind of map.
std::vector<KeySet> part_key_sets();

/// Types that the lists name beside these kinds of maps.
std::vector<NamedType> part_types();

}  // namespace tisserand::formats
