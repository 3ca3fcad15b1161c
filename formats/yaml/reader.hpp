// Strict reading of a tree into structs: legal keys, types, and all errors of a file together.
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

/// Throws Error if the document has the first key of another kind of file and not its own: a part given as a scene.
void require_kind(const YamlReader& reader, std::string_view own, std::string_view other, const std::string& remedy);

/// Collects the errors of one document.
class YamlReader {
 public:
  YamlReader(const YamlDocument& document, std::vector<KeySet> key_sets);

  const YamlNode& root() const { return document_.root; }
  const KeySet& keys(std::string_view noun) const;
  /// The folder of the first file. The file names in that file are relative to it.
  std::filesystem::path folder() const;
  std::string where(const YamlPlace& place) const { return document_.where(place); }

  /// An error inside the entry whose `where` is given. Findings of the check about that entry are then dropped, except
  /// those about a scalar that was read without error.
  void fail(const std::string& entry, const YamlPlace& place, const std::string& what, const std::string& remedy);
  /// Remembers where the value of a key of an entry stands, for findings of the check.
  void note(const std::string& entry, const std::string& key, const YamlNode& node);
  void note_place(const std::string& entry, const YamlPlace& place);
  /// Throws the errors collected and the findings of the check, in the order of the lines.
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

/// What is being read: its words in messages ("section 'tube'") and the `where` of the entry that it belongs to.
struct Context {
  YamlReader& reader;
  std::string subject;
  std::string entry;

  void fail(const YamlPlace& place, const std::string& what, const std::string& remedy) const;
  /// Whether the node is a list, of so many entries if that is said; if not, an error: "`what`, not '4.5'".
  bool require_list(const YamlNode& node, const std::string& what, const std::string& remedy,
                    std::optional<std::size_t> count = std::nullopt) const;
  /// What stands inside of this: "body 'arm': damping".
  Context inside(const std::string& what) const;
};

/// Numbers are finite; not-a-number stands for one that could not be read (the error is recorded).
double read_number(const Context& context, const YamlNode& node, const std::string& what);
std::optional<int> read_integer(const Context& context, const YamlNode& node, const std::string& what);
std::string read_text(const Context& context, const YamlNode& node, const std::string& what);
/// A text or a list of texts.
std::vector<std::string> read_texts(const Context& context, const YamlNode& node, const std::string& what);
/// A list of numbers of any length.
std::vector<double> read_numbers(const Context& context, const YamlNode& node, const std::string& what);

/// The entries of a list. A value that is no list counts as a list of one.
std::span<const YamlNode> items_of(const YamlNode& node);

/// Whether it is a list whose entries are lists: the rows of a matrix.
bool has_rows(const YamlNode& node);

/// Whether a scalar can be read as a number (finite or not).
bool looks_like_number(const YamlNode& node);

template <class T>
struct Choice {
  std::string_view word;
  T value;
};
inline constexpr Choice<bool> on_or_off[] = {{"off", false}, {"on", true}};
inline constexpr Choice<bool> yes_or_no[] = {{"yes", true}, {"no", false}, {"true", true}, {"false", false}};

/// Records an error with the nearest word if `node` is none of `words`; otherwise its index.
std::optional<std::size_t> read_word(const Context& context, const YamlNode& node, const std::string& what,
                                     const std::vector<std::string>& words);

/// One map with known keys. The constructor reports unknown and double keys; asking for a key that its KeySet lacks is
/// a fault of the program.
class MapReader {
 public:
  /// `prefix` ("damping.") precedes the keys in findings of the check when the map is part of a larger entry.
  MapReader(Context context, const YamlNode& node, std::string_view noun, std::string prefix = "");

  const Context& context() const { return context_; }
  const YamlNode& node() const { return node_; }
  const std::vector<Field>& fields() const { return keys_.fields; }
  bool has(std::string_view key) const { return find(key) != nullptr; }
  /// The value or null. A key without a value is found; reading its value is then an error.
  const YamlNode* find(std::string_view key) const;
  /// The value, or null and an error.
  const YamlNode* require(std::string_view key) const;
  /// The map that stands under a key of this one, with that key in messages ("body 'arm': damping").
  MapReader inside(const YamlNode& value, std::string_view noun) const;
  /// Entries of a collection, each once; empty if the key is absent. `noun` ("body") is used in messages.
  std::vector<const YamlNode*> entries(std::string_view key, const std::string& noun) const;

  double number(std::string_view key) const;
  double number(std::string_view key, double fallback) const;
  int integer(std::string_view key, int fallback) const;
  std::string text(std::string_view key) const;
  /// An error at each of these keys that is there: "'axis' has no effect here".
  void refuse(std::initializer_list<std::string_view> keys, const std::string& why, const std::string& remedy) const;
  /// An error at the second key if both are there.
  void refuse_both(std::string_view first, std::string_view second, const std::string& remedy) const;
  /// An error unless exactly one of both is there.
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

  /// Where the map is: its key, or its first character.
  YamlPlace place() const;

 private:
  Context context_;
  const YamlNode& node_;
  const KeySet& keys_;
  std::string prefix_;
};

/// The value of a key that is an entry by itself, as a context: "mesh" at its key.
Context key_context(YamlReader& reader, const YamlNode& node);
/// The entry of a collection as a context: "beam 'rod'" at its key.
Context entry_context(YamlReader& reader, const std::string& noun, const YamlNode& node);

}  // namespace tisserand::formats
