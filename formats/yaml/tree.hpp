// SPDX-License-Identifier: GPL-3.0-or-later
// Text of part.yaml and scene.yaml as a plain tree with lines and columns.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tisserand::formats {

enum class YamlKind { null, scalar, sequence, map };

/// Place in a YAML document: line and column (from 1) in one of its sources.
struct YamlPlace {
  int line = 0;
  int column = 0;
  int source = 0;  ///< index in YamlDocument::sources

  bool operator==(const YamlPlace&) const = default;
};

/// Node of a YAML tree: a value, with its key if it is in a map. Children are in the order of the file and may have
/// duplicate keys.
struct YamlNode {
  YamlKind kind = YamlKind::null;
  bool quoted = false;  ///< scalar in quotes: text, never a number
  std::string text;     ///< text of a scalar
  YamlPlace place;
  std::string key;  ///< key in a map
  YamlPlace key_place;
  std::vector<YamlNode> children;
};

/// Kind of a source: a file, or the text of an override.
enum class YamlSourceKind { file, option };
/// Source of values of a YAML document: its kind, name and folder.
struct YamlSource {
  YamlSourceKind kind = YamlSourceKind::file;
  std::string name;
  std::string folder;  ///< folder of an included file, relative to the first file's folder; "": equal to it
};

/// YAML tree with its sources: first the file, then its includes and the overrides that changed it.
struct YamlDocument {
  YamlNode root;
  std::vector<YamlSource> sources;

  /// Text of a place: "file:line:column", or the text of the override.
  std::string where(const YamlPlace& place) const;
};

/// Parses one YAML document. Anchors and aliases are resolved by copying; tags and merge keys are not supported.
/// Limits: depth 100, one million values, 16 MiB. Throws Error with file:line:column.
YamlDocument parse_yaml(const std::string& text, const std::string& file);

/// Reads a file and parses it with parse_yaml(). Throws Error (missing, a folder, empty, binary, syntax).
YamlDocument load_yaml(const std::string& path);

/// Sets the source index of the places of the node and of everything below it to `source`.
void mark_source(YamlNode& node, int source);

/// Number of nodes of a tree, including its root.
std::size_t count_nodes(const YamlNode& node);

/// Value of a key of the map `node`, or null if there is none.
const YamlNode* find_child(const YamlNode& node, std::string_view key);
YamlNode* find_child(YamlNode& node, std::string_view key);

/// Description of a node for messages: "'4.5'", "the text \"4.5\"", "a list of 3", "a map", "nothing".
std::string describe(const YamlNode& node);

}  // namespace tisserand::formats
