// SPDX-License-Identifier: GPL-3.0-or-later
// The fields of scene.yaml, for its readers, schema/scene.schema.json and SCENE.md.
#pragma once

#include <vector>

#include "formats/yaml/field.hpp"

namespace tisserand::formats {

/// Fields of scene.yaml: one KeySet for each kind of map.
std::vector<KeySet> scene_key_sets();

/// Types that the fields of scene_key_sets() use, in addition to its kinds of maps.
std::vector<NamedType> scene_types();

}  // namespace tisserand::formats
