// SPDX-License-Identifier: GPL-3.0-or-later
// Strict reading of a tree into structs: legal keys, types, and all errors of a file at once.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "formats/yaml/fault.hpp"
#include "formats/yaml/field.hpp"
#include "formats/yaml/tree.hpp"

namespace tisserand::formats {

class YamlReader;

/// Throws Error if the document has the key `other`, the first key of another kind of file, but not `own`: for example
/// a part given as a scene.
void require_kind(const YamlReader& reader, std::string_view own, std::string_view other, const std::string& remedy);

/// Reader of one YAML document. It collects all errors and throws them together.
class YamlReader {
 public:
  YamlReader(const YamlDocument& document, std::vector<KeySet> key_sets);

  const YamlNode& root() const { return document_.root; }
  const KeySet& keys(std::string_view noun) const;
  /// Folder of the document's first file. File names in this file are relative to the folder.
  std::filesystem::path folder() const;
  std::string where(const YamlPlace& place) const { return document_.where(place); }

  /// Records an error inside the entry whose `where` is `entry`. Findings of the check about this entry are dropped
  /// later, except those about a scalar that was read without error.
  void fail(const std::string& entry, const YamlPlace& place, const std::string& what, const std::string& remedy);
  /// Records where the value of `key` of `entry` stands in the file. Later findings about this key name that place.
  void note(const std::string& entry, const std::string& key, const YamlNode& node);
  void note_place(const std::string& entry, const YamlPlace& place);
  /// Throws one Error with the recorded errors and the findings of the check, in the order of lines. Throws nothing if
  /// there are none.
  void raise(const Faults& faults) const;

 private:
  struct Placed {
    YamlPlace place;
    Error error;
  };
  struct Noted {
    YamlPlace place;
    bool scalar = false;
  };
  const Noted* noted(const Fault& fault) const;
  bool follows_from_error(const Fault& fault) const;

  const YamlDocument& document_;
  std::vector<KeySet> key_sets_;
  std::vector<Placed> errors_;
  std::set<std::string> broken_;
  std::map<std::pair<std::string, std::string>, Noted> places_;
};

/// Context of reading one map: the reader, its name in messages ("section 'tube'"), and the `where` of its entry.
struct Context {
  YamlReader& reader;
  std::string subject;
  std::string entry;

  void fail(const YamlPlace& place, const std::string& what, const std::string& remedy) const;
  /// Whether the node is a list, and has `count` entries if given. If not, records an error: "`what`, not '4.5'".
  bool require_list(const YamlNode& node, const std::string& what, const std::string& remedy,
                    std::optional<std::size_t> count = std::nullopt) const;
  /// Context of a map inside this one, named for example "body 'arm': damping".
  Context inside(const std::string& what) const;
};

/// Reads a finite number. Otherwise records an error and returns NaN.
double read_number(const Context& context, const YamlNode& node, const std::string& what);
std::optional<int> read_integer(const Context& context, const YamlNode& node, const std::string& what);
std::string read_text(const Context& context, const YamlNode& node, const std::string& what);
/// Reads a list of texts, or a single text as a list of one.
std::vector<std::string> read_texts(const Context& context, const YamlNode& node, const std::string& what);
/// Reads a list of numbers of any length.
std::vector<double> read_numbers(const Context& context, const YamlNode& node, const std::string& what);

/// Entries of a list. A value that is no list is returned as a list of one.
std::span<const YamlNode> items_of(const YamlNode& node);

/// Whether the node is a list whose first entry is a list, as for the rows of a matrix.
bool has_rows(const YamlNode& node);

/// Whether the node is a scalar that reads as a number (finite or not).
bool looks_like_number(const YamlNode& node);

/// Word that a file may contain, with the value that it stands for.
template <class T>
struct Choice {
  std::string_view word;
  T value;
};
inline constexpr Choice<bool> on_or_off[] = {{"off", false}, {"on", true}};
inline constexpr Choice<bool> yes_or_no[] = {{"yes", true}, {"no", false}, {"true", true}, {"false", false}};

/// Index in `words` of the word at `node`. For an unknown word it records an error that suggests the nearest word.
std::optional<std::size_t> read_word(const Context& context, const YamlNode& node, const std::string& what,
                                     const std::vector<std::string>& words);

/// Reader of one map with known keys. The constructor records errors for unknown and duplicate keys. A request for a
/// key that the map's KeySet lacks is a program error.
class MapReader {
 public:
  /// `noun`: KeySet of the map. `prefix`: text such as "damping." before the keys in findings of the check, for a map
  /// that is part of a larger entry.
  MapReader(Context context, const YamlNode& node, std::string_view noun, std::string prefix = "");

  const Context& context() const { return context_; }
  const YamlNode& node() const { return node_; }
  const std::vector<Field>& fields() const { return keys_.fields; }
  bool has(std::string_view key) const { return find(key) != nullptr; }
  /// Value of the key, or null if the key is absent. A key without a value is found; reading its value is an error.
  const YamlNode* find(std::string_view key) const;
  /// Value of the key. If the key is absent, records an error and returns null.
  const YamlNode* require(std::string_view key) const;
  /// Reader of the map `value` at a key of this map. Messages include the key: "body 'arm': damping".
  MapReader inside(const YamlNode& value, std::string_view noun) const;
  /// Entries of the collection at `key`, each name once. Empty if the key is absent. `noun` ("body") is used in
  /// messages.
  std::vector<const YamlNode*> entries(std::string_view key, const std::string& noun) const;

  double number(std::string_view key) const;
  double number(std::string_view key, double fallback) const;
  int integer(std::string_view key, int fallback) const;
  std::string text(std::string_view key) const;
  /// Records an error at each of the keys that is present: "'axis' has no effect here".
  void refuse(std::initializer_list<std::string_view> keys, const std::string& why, const std::string& remedy) const;
  /// Records an error at the key `second` if both keys are present.
  void refuse_both(std::string_view first, std::string_view second, const std::string& remedy) const;
  /// Records an error unless exactly one of the two keys is present.
  void require_one(std::string_view first, std::string_view second, const std::string& remedy) const;
  void fail(const std::string& what, const std::string& remedy) const { context_.fail(place(), what, remedy); }

  template <class T, std::size_t N>
  T choice(std::string_view key, const Choice<T> (&choices)[N], T fallback) const {
    const YamlNode* node = find(key);
    if (node == nullptr) return fallback;
    std::vector<std::string> words;
    for (const Choice<T>& choice : choices) words.emplace_back(choice.word);
    const auto index = read_word(context_, *node, std::string(key), words);
    return index ? choices[*index].value : fallback;
  }

  /// Place of the map in its source: its key, or its first character.
  YamlPlace place() const;

 private:
  Context context_;
  const YamlNode& node_;
  const KeySet& keys_;
  std::string prefix_;
};

/// Context of a top-level key that is an entry itself, such as "mesh". Its place is the key.
Context key_context(YamlReader& reader, const YamlNode& node);
/// Context of an entry of a collection, named for example "beam 'rod'". Its place is the entry's key.
Context entry_context(YamlReader& reader, const std::string& noun, const YamlNode& node);

}  // namespace tisserand::formats
