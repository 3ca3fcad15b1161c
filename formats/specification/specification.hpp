// SPDX-License-Identifier: GPL-3.0-or-later
// Generates JSON Schemas and the tables of PART.md and SCENE.md from the lists of fields. User programs do not call it.
#pragma once

#include <string>
#include <vector>

#include "formats/yaml/field.hpp"

namespace tisserand::formats {

/// Kind of file, part.yaml or scene.yaml, with its lists of fields.
struct FileKind {
  std::string name;  ///< "part" or "scene"
  std::vector<KeySet> sets;
  std::vector<NamedType> types;
  bool parameters = false;  ///< whether a text such as $name may replace numbers, words and lists

  std::string schema_file() const { return "formats/schema/" + name + ".schema.json"; }
  std::string page_file() const;
};

/// Kinds of files: part.yaml and scene.yaml.
std::vector<FileKind> file_kinds();

/// JSON Schema (2020-12) with a definition for each list and each named type.
std::string schema_text(const FileKind& kind);

/// Rows | key | meaning | default | of the fields of one table; empty if no list has it.
std::string field_table(const std::vector<KeySet>& sets, const std::string& table);

/// Whether the field determines the kind of the map by one word, for example `shape: circle`.
bool tells_kind(const Field& field);

/// Rows | word | meaning | of all fields with that key that determine the kind of a map; empty if there is none.
std::string kind_table(const std::vector<KeySet>& sets, const std::string& key);

/// The page with new text between `<!-- fields: table -->` or `<!-- kinds: key -->` and `<!-- end -->`. Throws Error
/// for an unknown table and for a mark without end.
std::string with_field_tables(const std::string& page, const std::string& file, const std::vector<KeySet>& sets);

}  // namespace tisserand::formats
