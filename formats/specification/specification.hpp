// SPDX-License-Identifier: GPL-3.0-or-later
// Generates JSON Schemas and the tables of PART.md and SCENE.md from the lists of fields. User programs do not call it.
#pragma once

#include <string>
#include <vector>

#include "formats/yaml/field.hpp"

namespace tisserand::formats {

/// Kind of file (part.yaml or scene.yaml) with its key sets and named types.
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

/// Table | key | meaning | default | with a row per field of one table of the page, as Markdown. Empty if no key set
/// has the table.
std::string field_table(const std::vector<KeySet>& sets, const std::string& table);

/// Whether the field determines the kind of the map by one word, for example `shape: circle`.
bool names_kind(const Field& field);

/// Table | word | meaning | of all fields with the given key that determine the kind of a map by one word, as Markdown.
/// Empty if there is none.
std::string kind_table(const std::vector<KeySet>& sets, const std::string& key);

/// Text of the page with new tables between `<!-- fields: table -->` or `<!-- kinds: key -->` and `<!-- end -->`.
/// Throws Error for an unknown table and for a mark without end.
std::string with_field_tables(const std::string& page, const std::string& file, const std::vector<KeySet>& sets);

}  // namespace tisserand::formats
