// SPDX-License-Identifier: GPL-3.0-or-later
// Flattens a tree to lines, and compares two lists of lines.
#include "formats/scene/expand/values.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <map>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/yaml/emit.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {
namespace {

constexpr std::string_view contents_mark = " (contents)";
constexpr std::size_t longest_value = 60;

/// Keys of the scene that do not change the mechanism.
constexpr std::array<std::string_view, 13> keys_of_settings{
    "scene",      "integrator",        "statics",       "modes",   "output",
    "checkpoint", "analysis",          "analyses",      "include", "parameters",
    "assemblies", "initial_tolerance", "virtual_bodies"};

/// Whether the value of a key (a path from the root) is omitted.
bool is_setting(const std::vector<std::string_view>& path) {
  const std::string_view top = path.front();
  if (top == "instances" || std::ranges::find(keys_of_settings, top) != keys_of_settings.end()) return true;
  if (path.size() == 2 && top == "effects") return path[1] == "tolerance" || path[1] == "window";
  return path.size() == 3 && top == "bodies" && path[2] == "shape";
}

std::string in_one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

/// Text of a value, equal for equal numbers and truth values.
std::string plain_text(const YamlNode& node) {
  if (node.quoted) return in_one_line(node.text);
  if (looks_like_number(node)) return fmt::format("{}", std::strtod(node.text.c_str(), nullptr));
  if (node.text == "true") return "yes";
  if (node.text == "false") return "no";
  return in_one_line(node.text);
}

struct Flattening {
  const ContentsOf& contents;
  std::vector<std::string_view> path;
  std::string text;

  void add(const YamlNode& node, const std::string& key) {
    if (node.kind == YamlKind::scalar) {
      text += fmt::format("{}: {}\n", key, plain_text(node));
      const std::string id = contents ? contents(key, node.text) : "";
      if (!id.empty()) text += fmt::format("{}{}: {}\n", key, contents_mark, id);
      return;
    }
    std::size_t index = 0;
    for (const YamlNode& child : node.children) {
      const std::string step = node.kind == YamlKind::map ? child.key : fmt::format("{}", index++);
      path.push_back(step);
      if (!is_setting(path)) add(child, key.empty() ? step : key + "." + step);
      path.pop_back();
    }
  }
};

/// Lines of a text by their keys, in their order.
struct Values {
  std::vector<std::string> keys;
  std::map<std::string, std::string> of;

  explicit Values(const std::string& text) {
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      const std::string line = text.substr(begin, end - begin);
      const std::size_t colon = line.find(": ");
      if (colon != std::string::npos && of.try_emplace(line.substr(0, colon), line.substr(colon + 2)).second)
        keys.push_back(line.substr(0, colon));
      begin = end + 1;
    }
  }

  const std::string* find(const std::string& key) const {
    const auto found = of.find(key);
    return found == of.end() ? nullptr : &found->second;
  }
  /// Whether there is a value at the key or below it.
  bool has_below(const std::string& key) const {
    const auto found = of.lower_bound(key + ".");
    return of.contains(key) || (found != of.end() && found->first.starts_with(key + "."));
  }
};

std::string squeezed(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::isspace(c) != 0; });
  return text;
}

bool is_index(std::string_view step) {
  return !step.empty() && std::ranges::all_of(step, [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Key and index of a path: "gravity.2" -> "gravity" and 2.
struct Place {
  std::string key;
  std::optional<std::size_t> index;

  explicit Place(const std::string& path) : key(path) {
    const std::size_t dot = path.rfind('.');
    if (dot == std::string::npos || !is_index(std::string_view(path).substr(dot + 1))) return;
    key = path.substr(0, dot);
    index = std::strtoul(path.c_str() + dot + 1, nullptr, 10);
  }
  std::string word() const { return key.substr(key.rfind('.') + 1); }  // npos + 1 is 0
};

/// Default, as lines of scene_values, of a key of the scene. For longer keys: that of the last word if all lists agree.
std::string standard_of(const Place& place, const std::vector<KeySet>& legal_keys) {
  const std::string word = place.word();
  const bool of_scene = word == place.key;
  std::optional<std::string> standard;
  for (const KeySet& set : legal_keys)
    for (const Field& field : set.fields) {
      if (field.key != word || field.required() || (of_scene && set.noun != "scene")) continue;
      std::string text = field.default_text();
      std::erase(text, '`');
      if (text.empty() || (standard && *standard != text)) return {};
      standard = text;
    }
  if (!standard) return {};
  try {
    YamlNode list;  // below an index, so that no key counts as one of the scene
    list.kind = YamlKind::sequence;
    list.children.push_back(parse_yaml(fmt::format("'{}': {}", word, *standard), "default").root);
    return scene_values(list, {});
  } catch (const Error&) {
    return {};  // the default is a sentence
  }
}

/// Whether a value that only one of the scenes gives is the default.
bool is_standard(const std::string& path, const std::string& value, const Values& other,
                 const std::vector<KeySet>& legal_keys) {
  const Place place(path);
  if (other.has_below(place.key)) return false;
  const Values standard(standard_of(place, legal_keys));
  const std::string key = "0." + place.word();
  const std::string* given = standard.find(place.index ? fmt::format("{}.{}", key, *place.index) : key);
  return given != nullptr && *given == value;
}

/// Entry of a path: "channels.tip.of" -> "channels.tip".
std::string entry_of(const std::string& path) {
  const std::size_t dot = path.find('.');
  return dot == std::string::npos ? path : path.substr(0, path.find('.', dot + 1));
}

/// Whether the path belongs to an added channel, which is an output only. Changed uses of it are found separately.
bool is_added_channel(const std::string& path, const Values& before) {
  return path.starts_with("channels.") && !before.has_below(entry_of(path));
}

bool names_same_contents(const std::string& path, const Values& before, const Values& after) {
  const std::string key = path + std::string(contents_mark);
  const std::string *there = before.find(key), *here = after.find(key);
  return there != nullptr && here != nullptr && *there == *here;
}

std::string shortened(const std::string& value) {
  return value.size() <= longest_value ? value : value.substr(0, longest_value) + "...";
}

}  // namespace

std::string scene_values(const YamlNode& tree, const ContentsOf& contents) {
  Flattening flattening{contents, {}, ""};
  flattening.add(tree, "");
  return std::move(flattening.text);
}

std::string text_with_contents(const YamlNode& tree, const ContentsOf& contents) {
  std::string text = block_text(tree);
  const Values values(scene_values(tree, contents));
  for (const std::string& key : values.keys)
    if (key.ends_with(contents_mark)) text += fmt::format("# {}: {}\n", key, values.of.at(key));
  return text;
}

std::string values_of_text(const std::string& text, const std::string& where) {
  std::string comments;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (text.compare(begin, 2, "# ") == 0) comments += text.substr(begin + 2, end - begin - 2) + "\n";
    begin = end + 1;
  }
  const Values known(comments);
  const auto contents = [&](const std::string& key, const std::string&) {
    const std::string* id = known.find(key + std::string(contents_mark));
    return id == nullptr ? std::string() : *id;
  };
  return scene_values(parse_yaml(text, where).root, contents);
}

std::vector<ValueChange> scene_changes(const std::string& before_text, const std::string& after_text,
                                       const std::vector<KeySet>& legal_keys) {
  const Values before(before_text), after(after_text);
  std::vector<ValueChange> changes;
  const auto known_contents = [](const std::string& key, const Values& other) {
    if (!key.ends_with(contents_mark)) return true;
    return other.find(key) != nullptr;  // unknown on one side
  };
  for (const std::string& key : after.keys) {
    const std::string& value = after.of.at(key);
    const std::string* old = before.find(key);
    if (!known_contents(key, before) || names_same_contents(key, before, after)) continue;
    if (old != nullptr && squeezed(*old) == squeezed(value)) continue;
    if (old == nullptr && (is_added_channel(key, before) || is_standard(key, value, before, legal_keys))) continue;
    changes.push_back({key, old == nullptr ? "nothing" : *old, value});
  }
  for (const std::string& key : before.keys)
    if (after.find(key) == nullptr && known_contents(key, after) &&
        !is_standard(key, before.of.at(key), after, legal_keys))
      changes.push_back({key, before.of.at(key), "nothing"});
  return changes;
}

std::string changes_text(const std::vector<ValueChange>& changes, const std::string& before_each) {
  constexpr std::size_t most = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, changes.size()); ++i) {
    const ValueChange& change = changes[i];
    if (change.key.ends_with(contents_mark))
      text += fmt::format("{}{}: the contents of the file differ", before_each,
                          change.key.substr(0, change.key.size() - contents_mark.size()));
    else
      text += fmt::format("{}{}: {} -> {}", before_each, change.key, shortened(change.before), shortened(change.after));
  }
  if (changes.size() > most) text += fmt::format("{}and {} more", before_each, changes.size() - most);
  return text;
}

}  // namespace tisserand::formats
