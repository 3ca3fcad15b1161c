// The fields of part.yaml: what it may hold, for its readers, schema/part.schema.json and PART.md.
#pragma once

#include <string_view>
#include <vector>

#include "formats/yaml/field.hpp"

namespace tisserand::formats {

/// A list for each kind of map.
std::vector<KeySet> part_key_sets();

/// Types that the lists name beside these kinds of maps.
std::vector<NamedType> part_types();

/// The top-level maps from names to entries.
std::vector<std::string_view> part_collections();

}  // namespace tisserand::formats
