// Read, merge, override, expand, override.
#include "formats/scene/expand/tree.hpp"

#include "formats/scene/expand/include.hpp"
#include "formats/scene/expand/instances.hpp"

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

YamlDocument load_scene_tree(const std::string& path, const std::vector<Override>& overrides,
                             const std::vector<KeySet>& legal_keys) {
  const std::vector<std::string_view> collections = collection_keys(legal_keys);
  TreeLoader loader(collections);
  YamlDocument document = loader.load(path);
  apply_overrides(document, chosen(overrides, false), collections);
  SceneExpander(document, loader, legal_keys).run();
  apply_overrides(document, chosen(overrides, true), collections);
  return document;
}

}  // namespace tisserand::formats
