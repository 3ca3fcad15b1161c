// `include` of scene.yaml: files whose maps are merged into one tree.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/yaml/override.hpp"
#include "formats/yaml/tree.hpp"

namespace tisserand::formats {

/// Reads files into one document: each has a source of its own, with the folder that its paths are relative to.
class TreeLoader {
 public:
  /// Entries of several files come together in maps with the keys `collections`.
  explicit TreeLoader(std::vector<std::string_view> collections) : collections_(std::move(collections)) {}

  /// The first file, with all that it includes; `changes`: of its `include`.
  YamlDocument load(const std::string& path, const std::vector<Override>& changes);

  /// Another file of the same document, named in a value at `from`; with all that it includes.
  YamlNode load_into(YamlDocument& document, const YamlNode& from);

 private:
  struct Visit {
    std::string path;   ///< canonical
    std::string where;  ///< of the word that named it; empty for the first file
  };
  YamlNode load_file(YamlDocument& document, const std::string& name, const std::string& folder);
  void include_all(YamlDocument& document, YamlNode& root);
  void include(YamlDocument& document, YamlNode& root, const YamlNode& item);
  [[noreturn]] void fail(const std::string& what, const std::string& where, const std::string& remedy) const;

  std::vector<std::string_view> collections_;
  std::string folder_;          ///< of the first file
  std::vector<Visit> chain_;    ///< from the first file to the one being read
  std::set<std::string> seen_;  ///< canonical
  std::size_t values_ = 0;
};

}  // namespace tisserand::formats
