// The legal keys of scene.yaml, the same as in schema/scene.schema.json.
#pragma once

#include <vector>

#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

std::vector<KeySet> scene_key_sets();

}  // namespace tisserand::formats
