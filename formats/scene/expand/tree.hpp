// SPDX-License-Identifier: GPL-3.0-or-later
// Expands scene.yaml with `include`, `parameters`, `assemblies` and `instances` to the flat tree that readers use.
#pragma once

#include <string>
#include <vector>

#include "formats/yaml/override.hpp"
#include "formats/yaml/reader.hpp"
#include "formats/yaml/tree.hpp"

namespace tisserand::formats {

/// Flat tree of a scene. Reads the file and its includes, applies overrides, replaces parameters and expands instances.
/// Entries of instances get names such as `corner_fl/upper_arm` and `link[3]/bar` in the maps of the scene. Overrides
/// of entries of instances apply to the flat tree, all other overrides before expansion. File names in included files
/// become relative to the scene's folder. Throws Error that joins all errors of a stage. `legal_keys`: keys of
/// scene.yaml, for messages about unknown keys and to find maps whose keys are names.
YamlDocument load_scene_tree(const std::string& path, const std::vector<Override>& overrides,
                             const std::vector<KeySet>& legal_keys);

/// Text of the scene with its overrides, as one file for the same folder. Includes are merged; parameters and instances
/// stay. Throws Error, also for an override of an entry of an instance.
std::string scene_text(const std::string& path, const std::vector<Override>& overrides,
                       const std::vector<KeySet>& legal_keys);

}  // namespace tisserand::formats
