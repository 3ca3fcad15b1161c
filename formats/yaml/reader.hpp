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

/// Throws Error if the document has the first key of another kind of file but not its own: a part given as a scene.
void require_kind(const YamlReader& reader, std::string_view own, std::string_view other, const std::string& remedy);

/// Collects the errors of one document.
class YamlReader {
 public:
  YamlReader(const YamlDocument& document, std::vector<KeySet> key_sets);

  const YamlNode& root() const { return document_.root; }
  const KeySet& keys(std::string_view noun) const;
  /// Folder of the first file. File names in that file are relative to it.
  std::filesystem::path folder() const;
  std::string where(const YamlPlace& place) const { return document_.where(place); }

  /// Records an error inside the entry with the given `where`. Findings of the check about this entry are then dropped,
  /// except those about a scalar that was read without error.
  void fail(const std::string& entry, const YamlPlace& place, const std::string& what, const std::string& remedy);
  /// Records the place of the value of a key of an entry, for findings of the check.
  void note(const std::string& entry, const std::string& key, const YamlNode& node);
  void note_place(const std::string& entry, const YamlPlace& place);
  /// Throws the recorded errors and the findings of the check, in the order of lines.
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

/// Context of reading: its name in messages ("section 'tube'") and the `where` of its entry.
struct Context {
  YamlReader& reader;
  std::string subject;
  std::string entry;

  void fail(const YamlPlace& place, const std::string& what, const std::string& remedy) const;
  /// Whether the node is a list (of `count` entries, if given). If not, records an error: "`what`, not '4.5'".
  bool require_list(const YamlNode& node, const std::string& what, const std::string& remedy,
                    std::optional<std::size_t> count = std::nullopt) const;
  /// Context of a map inside this one: "body 'arm': damping".
  Context inside(const std::string& what) const;
};

/// Reads a finite number. Returns not-a-number after a recorded error.
double read_number(const Context& context, const YamlNode& node, const std::string& what);
std::optional<int> read_integer(const Context& context, const YamlNode& node, const std::string& what);
std::string read_text(const Context& context, const YamlNode& node, const std::string& what);
/// Reads a text or a list of texts.
std::vector<std::string> read_texts(const Context& context, const YamlNode& node, const std::string& what);
/// Reads a list of numbers of any length.
std::vector<double> read_numbers(const Context& context, const YamlNode& node, const std::string& what);

/// Entries of a list. A value that is no list counts as a list of one.
std::span<const YamlNode> items_of(const YamlNode& node);

/// Whether the node is a list of lists: the rows of a matrix.
bool has_rows(const YamlNode& node);

/// Whether a scalar is a number (finite or not).
bool looks_like_number(const YamlNode& node);

template <class T>
struct Choice {
  std::string_view word;
  T value;
};
inline constexpr Choice<bool> on_or_off[] = {{"off", false}, {"on", true}};
inline constexpr Choice<bool> yes_or_no[] = {{"yes", true}, {"no", false}, {"true", true}, {"false", false}};

/// Index of the word `node` in `words`. For an unknown word records an error with the nearest one.
std::optional<std::size_t> read_word(const Context& context, const YamlNode& node, const std::string& what,
                                     const std::vector<std::string>& words);

/// Map with known keys. The constructor reports unknown and duplicate keys. A request for a key that its KeySet lacks
/// is a program error.
class MapReader {
 public:
  /// `prefix` ("damping.") precedes the keys in findings of the check when the map is part of a larger entry.
  MapReader(Context context, const YamlNode& node, std::string_view noun, std::string prefix = "");

  const Context& context() const { return context_; }
  const YamlNode& node() const { return node_; }
  const std::vector<Field>& fields() const { return keys_.fields; }
  bool has(std::string_view key) const { return find(key) != nullptr; }
  /// Value of the key, or null. A key without a value is found; reading its value is an error.
  const YamlNode* find(std::string_view key) const;
  /// Value of the key, or null and an error.
  const YamlNode* require(std::string_view key) const;
  /// Map at a key of this one, with that key in messages ("body 'arm': damping").
  MapReader inside(const YamlNode& value, std::string_view noun) const;
  /// Entries of a collection, each once. Empty if the key is absent. `noun` ("body") is used in messages.
  std::vector<const YamlNode*> entries(std::string_view key, const std::string& noun) const;

  double number(std::string_view key) const;
  double number(std::string_view key, double fallback) const;
  int integer(std::string_view key, int fallback) const;
  std::string text(std::string_view key) const;
  /// Records an error at each of these keys that is present: "'axis' has no effect here".
  void refuse(std::initializer_list<std::string_view> keys, const std::string& why, const std::string& remedy) const;
  /// Records an error at the second key if both are present.
  void refuse_both(std::string_view first, std::string_view second, const std::string& remedy) const;
  /// Records an error unless exactly one of both is present.
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

  /// Place of the map: its key, or its first character.
  YamlPlace place() const;

 private:
  Context context_;
  const YamlNode& node_;
  const KeySet& keys_;
  std::string prefix_;
};

/// Context of a key that is an entry itself: "mesh" at its key.
Context key_context(YamlReader& reader, const YamlNode& node);
/// Context of an entry of a collection: "beam 'rod'" at its key.
Context entry_context(YamlReader& reader, const std::string& noun, const YamlNode& node);

}  // namespace tisserand::formats
