// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of the fields of maps in part.yaml and scene.yaml, the source of readers, legal keys, JSON Schemas and pages.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tisserand::formats {

class MapReader;

/// Key of a map. Most are made by plain(), choice() or words() (fields.hpp). Other code reads a field written as {key,
/// type, meaning, fallback}.
///
/// Notation of `type`: `number`, `integer` (bounds may follow: "number>=0<1"), `text`, `text+` (not empty), `any`;
/// "'word'", 2 or true literally; "/regular expression/"; the name of another list or of a NamedType; "[type]" a list,
/// "[type]3" of three, "[type]2.." of two or more, "[type]3..4"; "{name: type}" a map with names chosen by the user (a
/// collection), may be empty; "{name: type}+" not empty; "a | b" alternatives.
struct Field {
  std::string_view key;
  std::string_view type;           ///< empty: one of `words`
  std::string_view meaning;        ///< as in the page; `ditto`: in one row with the field before; empty: no row
  std::string_view fallback = {};  ///< value without the key; "required": no default; empty: see `standard`
  std::span<const std::string_view> words = {};
  const void* owner = nullptr;  ///< identifies the struct of the member; null: read by hand
  void (*read)(const MapReader& map, const Field& field, void* owner) = nullptr;
  std::string (*standard)() = nullptr;  ///< value in a new struct, as text of the page
  std::string_view table = {};          ///< noun of the list in whose table of the page it is
  bool same_row = false;                ///< `meaning` was `ditto`

  bool required() const { return fallback == "required"; }
  /// Default value as the page states it.
  std::string default_text() const { return fallback.empty() && standard ? standard() : std::string(fallback); }
};

/// Meaning and fallback equal to those of the field before, in one row of the page.
inline constexpr std::string_view ditto = "\"";

/// Allowed number of keys of a map. `most` 0: any number.
struct KeyCount {
  int fewest = 0;
  int most = 0;
};

/// Allowed keys of a kind of map. `noun` is also its name in the JSON Schema and in the marks of the page.
struct KeySet {
  /// `shared`: fields made by shared_fields(), which follow its own.
  KeySet(std::string_view noun, std::vector<Field> own, const std::vector<Field>& shared = {}, KeyCount count = {});

  std::string_view noun;
  std::vector<Field> fields;
  KeyCount count;
};

/// Fields that several lists share, and that form one table of the page.
std::vector<Field> shared_fields(std::string_view table, std::vector<Field> fields);

/// Keys of maps whose keys are names chosen by the user, such as `bodies`.
std::vector<std::string_view> collection_keys(const std::vector<KeySet>& sets);

/// Named type, which lists refer to.
struct NamedType {
  std::string_view name;
  std::string_view type;
  std::string_view meaning = {};
};

/// Types and lists that part.yaml and scene.yaml share: numbers, vectors, orientations, units.
std::vector<NamedType> common_types();
std::vector<KeySet> common_key_sets();

}  // namespace tisserand::formats
