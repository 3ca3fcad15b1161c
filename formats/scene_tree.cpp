// Read, merge, override, expand, override.
#include "formats/scene_tree.hpp"

#include "formats/scene_include.hpp"
#include "formats/scene_instances.hpp"

namespace tisserand::formats {

namespace {

/// Whether a path names something that only exists in the flat tree: "bodies.corner_fl/arm.mass".
bool names_instance(const Override& change) { return change.path.find_first_of("/[") != std::string::npos; }

std::vector<Override> chosen(const std::vector<Override>& overrides, bool of_instances) {
  std::vector<Override> list;
  for (const Override& change : overrides)
    if (names_instance(change) == of_instances) list.push_back(change);
  return list;
}

}  // namespace

YamlDocument load_scene_tree(const std::string& path, const std::vector<Override>& overrides) {
  TreeLoader loader;
  YamlDocument document = loader.load(path);
  apply_overrides(document, chosen(overrides, false), scene_collections());
  SceneExpander(document, loader).run();
  apply_overrides(document, chosen(overrides, true), scene_collections());
  return document;
}

}  // namespace tisserand::formats
