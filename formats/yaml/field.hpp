// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of the fields of maps in part.yaml and scene.yaml, the source of readers, legal keys, JSON Schemas and pages.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tisserand::formats {

class MapReader;

/// Description of one key of a map: its type, meaning, default and reader. Most fields are made by plain(), choice() or
/// words() (fields.hpp). A field written as {key, type, meaning, fallback} is read by other code.
///
/// Notation of `type`: `number`, `integer` (bounds may follow: "number>=0<1"), `text`, `text+` (not empty), `any`;
/// "'word'", 2 or true literally; "/regular expression/"; the name of another list or of a NamedType; "[type]" a list,
/// "[type]3" of three, "[type]2.." of two or more, "[type]3..4"; "{name: type}" a map with names chosen by the user (a
/// collection), may be empty; "{name: type}+" not empty; "a | b" alternatives.
struct Field {
  std::string_view key;
  std::string_view type;           ///< empty: one of `words`
  std::string_view meaning;        ///< text of the page; `ditto`: one row with the field before; empty: no row
  std::string_view fallback = {};  ///< default; "required": the key is required; empty: see `standard`
  std::span<const std::string_view> words = {};
  const void* owner = nullptr;  ///< identifies the struct of the member; null: read by hand
  void (*read)(const MapReader& map, const Field& field, void* owner) = nullptr;
  std::string (*standard)() = nullptr;  ///< returns the member's value in a new struct, as text of the page
  std::string_view table = {};          ///< noun of the list whose table of the page has this field
  bool same_row = false;                ///< whether `meaning` was given as `ditto`

  bool required() const { return fallback == "required"; }
  /// Default value as the page states it.
  std::string default_text() const { return fallback.empty() && standard ? standard() : std::string(fallback); }
};

/// Value of Field::meaning: meaning and default equal those of the field before, and both fields share one row of the
/// page.
inline constexpr std::string_view ditto = "\"";

/// Allowed number of keys of a map, from `fewest` to `most`. A `most` of 0 allows any number.
struct KeyCount {
  int fewest = 0;
  int most = 0;
};

/// Allowed keys of a kind of map. `noun` names the kind in messages, in the JSON Schema and in the marks of the page.
struct KeySet {
  /// `own`: fields of this kind alone. `shared`: fields made by shared_fields(), which follow the own ones.
  KeySet(std::string_view noun, std::vector<Field> own, const std::vector<Field>& shared = {}, KeyCount count = {});

  std::string_view noun;
  std::vector<Field> fields;
  KeyCount count;
};

/// Copies of `fields` that several lists can share; they form one table of the page, named `table`.
std::vector<Field> shared_fields(std::string_view table, std::vector<Field> fields);

/// Keys whose values are maps with names chosen by the user, such as `bodies`.
std::vector<std::string_view> collection_keys(const std::vector<KeySet>& sets);

/// Type with a name, to which the `type` of fields can refer.
struct NamedType {
  std::string_view name;
  std::string_view type;
  std::string_view meaning = {};
};

/// Types and key sets that part.yaml and scene.yaml share: numbers, vectors, orientations, units.
std::vector<NamedType> common_types();
std::vector<KeySet> common_key_sets();

}  // namespace tisserand::formats
