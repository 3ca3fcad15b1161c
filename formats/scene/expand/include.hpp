// SPDX-License-Identifier: GPL-3.0-or-later
// `include` of scene.yaml: merges the maps of several files into one tree.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/yaml/override.hpp"
#include "formats/yaml/tree.hpp"

namespace tisserand::formats {

/// Reads files into one document. Each file is a source with the folder to which its paths are relative.
class TreeLoader {
 public:
  /// Entries of several files are merged in maps whose key is in `collections`.
  explicit TreeLoader(std::vector<std::string_view> collections) : collections_(std::move(collections)) {}

  /// Loads the first file and all that it includes. `changes`: overrides of its `include`.
  YamlDocument load(const std::string& path, const std::vector<Override>& changes);

  /// Loads another file into the same document, with all that it includes. The value at `from` names it.
  YamlNode load_into(YamlDocument& document, const YamlNode& from);

 private:
  struct Visit {
    std::string path;   ///< canonical path
    std::string where;  ///< place that names the file; empty for the first file
  };
  YamlNode load_file(YamlDocument& document, const std::string& name, const std::string& folder);
  void include_all(YamlDocument& document, YamlNode& root);
  void include(YamlDocument& document, YamlNode& root, const YamlNode& item);
  [[noreturn]] void fail(const std::string& what, const std::string& where, const std::string& remedy) const;

  std::vector<std::string_view> collections_;
  std::string folder_;          ///< folder of the first file
  std::vector<Visit> chain_;    ///< from the first file to the one being read
  std::set<std::string> seen_;  ///< canonical paths
  std::size_t values_ = 0;
};

}  // namespace tisserand::formats
