// The legal keys of part.yaml, the same as in schema/part.schema.json.
#pragma once

#include <string_view>
#include <vector>

#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

std::vector<KeySet> part_key_sets();

/// The top-level maps from names to entries.
std::vector<std::string_view> part_collections();

}  // namespace tisserand::formats
