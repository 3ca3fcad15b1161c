// SPDX-License-Identifier: GPL-3.0-or-later
// Includes files, each once and in a chain of limited depth, and merges their entries and settings.
#include "formats/scene/expand/include.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <system_error>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t deepest_chain = 20;
constexpr std::size_t most_files = 1000;
constexpr std::size_t most_values = 2'000'000;

/// Maps of settings, in which an included file only fills in absent keys.
constexpr std::array<std::string_view, 3> settings{"integrator", "statics", "output"};

std::string canonical(const std::string& path) {
  std::error_code ignored;
  const fs::path found = fs::weakly_canonical(path, ignored);
  return ignored ? path : found.string();
}

void merge_entries(const YamlDocument& document, YamlNode&& from, YamlNode& into) {
  std::map<std::string_view, const YamlNode*> known;
  for (const YamlNode& child : into.children) known.try_emplace(child.key, &child);
  std::vector<Error> errors;
  for (const YamlNode& child : from.children)
    if (const auto first = known.find(child.key); first != known.end())
      errors.emplace_back(fmt::format("'{}' of '{}' is given twice (first in {})", child.key, into.key,
                                      document.where(first->second->key_place)),
                          document.where(child.key_place), "rename or remove one");
  if (!errors.empty()) throw merge_errors(errors);
  for (YamlNode& child : from.children) into.children.push_back(std::move(child));
}

void merge_settings(YamlNode&& from, YamlNode& into) {
  for (YamlNode& child : from.children)
    if (find_child(into, child.key) == nullptr) into.children.push_back(std::move(child));
}

/// Merges an included file: entries of collections, settings, and other values that the including file does not give.
void merge(const YamlDocument& document, const std::vector<std::string_view>& collections, YamlNode&& included,
           YamlNode& root) {
  for (YamlNode& child : included.children) {
    YamlNode* own = find_child(root, child.key);
    const bool maps = own != nullptr && own->kind == YamlKind::map && child.kind == YamlKind::map;
    if (own == nullptr)
      root.children.push_back(std::move(child));
    else if (maps && std::ranges::find(collections, child.key) != collections.end())
      merge_entries(document, std::move(child), *own);
    else if (maps && std::ranges::find(settings, child.key) != settings.end())
      merge_settings(std::move(child), *own);
    else if (own->kind == YamlKind::null)
      *own = std::move(child);
  }
}

}  // namespace

void TreeLoader::fail(const std::string& what, const std::string& where, const std::string& remedy) const {
  std::string text = what;
  for (auto visit = chain_.rbegin(); visit != chain_.rend(); ++visit)
    if (!visit->where.empty() && visit->where != where) text += fmt::format(", included from {}", visit->where);
  throw Error(text, where, remedy);
}

YamlDocument TreeLoader::load(const std::string& path, const std::vector<Override>& changes) {
  folder_ = fs::path(path).parent_path().string();
  YamlDocument document = load_yaml(path);
  apply_overrides(document, changes, collections_);
  values_ = count_nodes(document.root);
  chain_.push_back({canonical(path), ""});
  seen_.insert(chain_.back().path);
  include_all(document, document.root);
  chain_.pop_back();
  return document;
}

YamlNode TreeLoader::load_into(YamlDocument& document, const YamlNode& from) {
  const std::string where = document.where(from.place);
  if (from.kind != YamlKind::scalar || from.text.empty())
    fail(fmt::format("a file name is needed, not {}", describe(from)), where, "write it relative to this file");
  const fs::path base = document.sources.at(static_cast<std::size_t>(from.place.source)).folder;
  const std::string relative = (base / from.text).lexically_normal().string();
  const std::string path = canonical((fs::path(folder_) / relative).string());
  for (const Visit& visit : chain_)
    if (visit.path == path) fail(fmt::format("'{}' includes itself", from.text), where, "remove this include");
  if (chain_.size() >= deepest_chain) fail("included files are nested more than 20 levels deep", where, "");
  if (document.sources.size() >= most_files)
    fail(fmt::format("the scene includes more than {} files", most_files), where, "");
  chain_.push_back({path, where});
  seen_.insert(path);
  YamlNode root = load_file(document, (fs::path(folder_) / relative).lexically_normal().string(),
                            fs::path(relative).parent_path().string());
  chain_.pop_back();
  return root;
}

YamlNode TreeLoader::load_file(YamlDocument& document, const std::string& name, const std::string& folder) {
  const int source = count_of(document.sources);
  YamlDocument file;
  try {
    file = load_yaml(name);
  } catch (const Error& error) {
    throw Error(fmt::format("{}; included from {}", error.what(), chain_.back().where), "", "");
  }
  values_ += count_nodes(file.root);
  if (values_ > most_values)
    fail(fmt::format("the files together have more than {} values", most_values), chain_.back().where, "");
  document.sources.push_back({YamlSourceKind::file, name, folder});
  mark_source(file.root, source);
  if (file.root.kind != YamlKind::map)
    fail(fmt::format("the file must be a map of keys and values, not {}",
                     file.root.kind == YamlKind::scalar ? "a text" : describe(file.root)),
         document.where(file.root.place), "write keys such as `bodies:`");
  include_all(document, file.root);
  return std::move(file.root);
}

void TreeLoader::include_all(YamlDocument& document, YamlNode& root) {
  if (root.kind != YamlKind::map) return;
  const auto found = std::ranges::find(root.children, "include", &YamlNode::key);
  if (found == root.children.end()) return;
  const YamlNode list = std::move(*found);
  root.children.erase(found);
  if (std::ranges::find(root.children, "include", &YamlNode::key) != root.children.end())
    fail("key 'include' is given twice", document.where(list.key_place), "write a list of files");
  for (const YamlNode& item : items_of(list)) include(document, root, item);
}

void TreeLoader::include(YamlDocument& document, YamlNode& root, const YamlNode& item) {
  const fs::path base = document.sources.at(static_cast<std::size_t>(item.place.source)).folder;
  const std::string path = canonical((fs::path(folder_) / base / item.text).string());
  const bool open = std::ranges::any_of(chain_, [&](const Visit& visit) { return visit.path == path; });
  if (item.kind == YamlKind::scalar && seen_.contains(path) && !open) return;  // each file once
  merge(document, collections_, load_into(document, item), root);
}

}  // namespace tisserand::formats
