// The fields of scene.yaml: what it may hold, for its readers, schema/scene.schema.json and SCENE.md.
#pragma once

#include <vector>

#include "formats/yaml/field.hpp"

namespace tisserand::formats {

/// A list for each kind of map.
std::vector<KeySet> scene_key_sets();

/// Types that the lists name beside these kinds of maps.
std::vector<NamedType> scene_types();

}  // namespace tisserand::formats
