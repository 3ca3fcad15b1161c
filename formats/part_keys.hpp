// The legal keys of part.yaml, the same as in schema/part.schema.json.
#pragma once

#include <vector>

#include "formats/yaml_reader.hpp"

namespace tisserand::formats {

std::vector<KeySet> part_key_sets();

}  // namespace tisserand::formats
