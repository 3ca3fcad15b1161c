// One list of fields per map of part.yaml and scene.yaml: readers, legal keys, JSON Schemas and pages all come from it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tisserand::formats {

class MapReader;

/// A key of a map. Most are made by plain(), choice() or words() (fields.hpp); a field written as {key, type, meaning,
/// fallback} is read by hand.
///
/// Notation of `type`: `number`, `integer` (bounds may follow: "number>=0<1"), `text`, `text+` (not empty), `any`;
/// "'word'", 2 or true themselves; "/regular expression/"; the name of another list or of a NamedType; "[type]" a list,
/// "[type]3" of three, "[type]2.." of two or more, "[type]3..4"; "{name: type}" a map from names that the user
/// chooses (a collection), which may be left empty, "{name: type}+" one that may not; "a | b" either.
struct Field {
  std::string_view key;
  std::string_view type;           ///< empty: one of `words`
  std::string_view meaning;        ///< as the page has it; `ditto`: one row with the field before; empty: no row
  std::string_view fallback = {};  ///< what holds without the key; "required": it must be given; empty: see `standard`
  std::span<const std::string_view> words = {};
  const void* owner = nullptr;  ///< stands for the struct that has the member; null: read by hand
  void (*read)(const MapReader& map, const Field& field, void* owner) = nullptr;
  std::string (*standard)() = nullptr;  ///< the value that a new struct has, as text of the page
  std::string_view table = {};          ///< noun of the list to which it belongs in the page
  bool same_row = false;                ///< `meaning` was `ditto`

  bool required() const { return fallback == "required"; }
  /// What the page says to hold without the key.
  std::string default_text() const { return fallback.empty() && standard ? standard() : std::string(fallback); }
};

/// Meaning and fallback of the field before, in one row of the page.
inline constexpr std::string_view ditto = "\"";

/// How many keys a map may have; `most` 0: any number.
struct KeyCount {
  int fewest = 0;
  int most = 0;
};

/// The keys that a kind of map may have; `noun` is also its name in the JSON Schema and in the marks of the page.
struct KeySet {
  /// `shared`: made by shared_fields(), after the own ones.
  KeySet(std::string_view noun, std::vector<Field> own, const std::vector<Field>& shared = {}, KeyCount count = {});

  std::string_view noun;
  std::vector<Field> fields;
  KeyCount count;
};

/// Fields that several lists have in common, and one table of the page.
std::vector<Field> shared_fields(std::string_view table, std::vector<Field> fields);

/// Keys of maps whose keys are names that the user chooses, such as `bodies`.
std::vector<std::string_view> collection_keys(const std::vector<KeySet>& sets);

/// A type with a name of its own, which lists refer to.
struct NamedType {
  std::string_view name;
  std::string_view type;
  std::string_view meaning = {};
};

/// Types and lists that part.yaml and scene.yaml have in common: numbers, vectors, orientations, units.
std::vector<NamedType> common_types();
std::vector<KeySet> common_key_sets();

}  // namespace tisserand::formats
