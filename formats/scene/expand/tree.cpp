// SPDX-License-Identifier: GPL-3.0-or-later
// Reads, merges, overrides and expands a scene.
#include "formats/scene/expand/tree.hpp"

#include "formats/scene/expand/include.hpp"
#include "formats/scene/expand/instances.hpp"
#include "formats/yaml/emit.hpp"

namespace tisserand::formats {
namespace {

/// Stage at which an override applies: to the list of files, to their tree, or to entries that exist in the flat tree
/// only ("bodies.corner_fl/arm.mass").
enum class Stage { files, tree, flat };

Stage stage_of(const Override& change) {
  if (change.path == "include" || change.path.starts_with("include.")) return Stage::files;
  return change.path.find_first_of("/[") != std::string::npos ? Stage::flat : Stage::tree;
}

std::vector<Override> chosen(const std::vector<Override>& overrides, Stage stage) {
  std::vector<Override> list;
  for (const Override& change : overrides)
    if (stage_of(change) == stage) list.push_back(change);
  return list;
}

}  // namespace

YamlDocument load_scene_tree(const std::string& path, const std::vector<Override>& overrides,
                             const std::vector<KeySet>& legal_keys) {
  const std::vector<std::string_view> collections = collection_keys(legal_keys);
  TreeLoader loader(collections);
  YamlDocument document = loader.load(path, chosen(overrides, Stage::files));
  apply_overrides(document, chosen(overrides, Stage::tree), collections);
  SceneExpander(document, loader, legal_keys).run();
  apply_overrides(document, chosen(overrides, Stage::flat), collections);
  return document;
}

std::string scene_text(const std::string& path, const std::vector<Override>& overrides,
                       const std::vector<KeySet>& legal_keys) {
  const std::vector<std::string_view> collections = collection_keys(legal_keys);
  TreeLoader loader(collections);
  YamlDocument document = loader.load(path, chosen(overrides, Stage::files));
  for (const Override& change : chosen(overrides, Stage::flat))
    throw Error(fmt::format("'{}' belongs to an instance and cannot be set in a scene file", change.path), path,
                "change a parameter of the instance instead");
  apply_overrides(document, chosen(overrides, Stage::tree), collections);
  std::erase_if(document.root.children, [](const YamlNode& child) { return child.key == "include"; });
  rebase_files(document, document.root);
  return block_text(document.root);
}

}  // namespace tisserand::formats
