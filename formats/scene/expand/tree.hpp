// scene.yaml with `include`, `parameters`, `assemblies` and `instances` as the flat tree that the readers of a scene
// know.
#pragma once

#include <string>
#include <vector>

#include "formats/yaml/override.hpp"
#include "formats/yaml/reader.hpp"
#include "formats/yaml/tree.hpp"

namespace tisserand::formats {

/// Reads the file and what it includes, applies the overrides, replaces parameters and makes the instances: their
/// bodies, joints, motions, springs and loads stand in the maps of the scene with names such as `corner_fl/upper_arm`
/// and `link[3]/bar`. Overrides of such names are applied to the flat tree, all others before. File names of included
/// files are made relative to the folder of the scene. Throws Error (all errors of one stage together). `legal_keys`:
/// of scene.yaml, for messages about keys that do not exist and to know maps whose keys are names.
YamlDocument load_scene_tree(const std::string& path, const std::vector<Override>& overrides,
                             const std::vector<KeySet>& legal_keys);

/// The scene with its overrides as one file to stand in the same folder: what it includes is merged, parameters and
/// instances stay. Throws Error; overrides of entries of instances have no place in it.
std::string scene_text(const std::string& path, const std::vector<Override>& overrides,
                       const std::vector<KeySet>& legal_keys);

}  // namespace tisserand::formats
