// JSON Schemas and the tables of PART.md and SCENE.md from the lists of fields. No program of the users calls this.
#pragma once

#include <string>
#include <vector>

#include "formats/yaml/field.hpp"

namespace tisserand::formats {

/// What is known of part.yaml or scene.yaml.
struct FileKind {
  std::string name;  ///< "part" or "scene"
  std::vector<KeySet> sets;
  std::vector<NamedType> types;
  bool parameters = false;  ///< a text such as $name may stand for numbers, words and lists

  std::string schema_file() const { return "formats/schema/" + name + ".schema.json"; }
  std::string page_file() const;
};

/// part.yaml and scene.yaml.
std::vector<FileKind> file_kinds();

/// The JSON Schema (2020-12): one definition for each list and each named type.
std::string schema_text(const FileKind& kind);

/// The rows | key | meaning | default | of the fields of one table; empty if no list has it.
std::string field_table(const std::vector<KeySet>& sets, const std::string& table);

/// Whether the field says by one word of what kind the map is: `shape: circle`.
bool tells_kind(const Field& field);

/// The rows | word | meaning | of all fields with that key that tell the kind of a map; empty if there is none.
std::string kind_table(const std::vector<KeySet>& sets, const std::string& key);

/// The page with what stands between `<!-- fields: table -->` or `<!-- kinds: key -->` and `<!-- end -->` made anew.
/// Throws Error for a table that no list has and for a mark without end.
std::string with_field_tables(const std::string& page, const std::string& file, const std::vector<KeySet>& sets);

}  // namespace tisserand::formats
