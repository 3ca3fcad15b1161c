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

/// Reads files into one YAML document. Each file is a source of the document, with the folder to which the paths in
/// that file are relative.
class TreeLoader {
 public:
  /// `collections`: keys of maps whose entries from several files are merged into one map.
  explicit TreeLoader(std::vector<std::string_view> collections) : collections_(std::move(collections)) {}

  /// Loads the first file and all files that it includes. `changes`: overrides of the first file's key `include`.
  YamlDocument load(const std::string& path, const std::vector<Override>& changes);

  /// Loads another file and all files that it includes into the document, and returns its root. The value `from` is the
  /// file's name.
  YamlNode load_into(YamlDocument& document, const YamlNode& from);

 private:
  struct Visit {
    std::string path;   ///< canonical path
    std::string where;  ///< place of the name of the file; empty for the first file
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
