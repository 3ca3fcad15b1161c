// SPDX-License-Identifier: GPL-3.0-or-later
// Fields that are read directly into a member: numbers, counts, texts, vectors, words.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "formats/yaml/field.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// Reads the value of the field's key. Without the key `value` stays unchanged; a missing required key is recorded as
/// an error, and numbers and vectors become NaN. Overloads for types of one kind of file are declared with its readers.
void read_value(const MapReader& map, const Field& field, double& value);
void read_value(const MapReader& map, const Field& field, int& value);
void read_value(const MapReader& map, const Field& field, std::string& value);
void read_value(const MapReader& map, const Field& field, std::vector<std::string>& value);
void read_value(const MapReader& map, const Field& field, Eigen::Vector3d& value);
void read_value(const MapReader& map, const Field& field, std::vector<double>& value);
void read_value(const MapReader& map, const Field& field, std::optional<double>& value);
void read_value(const MapReader& map, const Field& field, std::optional<int>& value);
void read_value(const MapReader& map, const Field& field, std::optional<Eigen::Vector3d>& value);
/// Reads an inertia tensor.
void read_value(const MapReader& map, const Field& field, Eigen::Matrix3d& value);
void read_value(const MapReader& map, const Field& field, Eigen::Quaterniond& value);
void read_value(const MapReader& map, const Field& field, std::optional<Eigen::Quaterniond>& value);

/// Node of the field's key, or null if the key is absent. Records an error if the key is required and absent.
const YamlNode* find_or_require(const MapReader& map, const Field& field);

/// Text of a value in the notation of the pages: 0.9, 1e-6, `[0, 0, 1]`. It is empty for types without such a notation.
std::string standard_text(double value);
std::string standard_text(int value);
std::string standard_text(const Eigen::Vector3d& value);
template <class T>
std::string standard_text(const T& /*value*/) {
  return "";
}

template <class T>
struct MemberPointer;
template <class Struct, class Value>
struct MemberPointer<Value Struct::*> {
  using Owner = Struct;
};
template <auto member>
using OwnerOf = typename MemberPointer<decltype(member)>::Owner;

/// Mark of a type: the address of owner_mark<Struct> identifies the type.
template <class Struct>
inline constexpr char owner_mark = 0;

template <const auto& choices>
inline constexpr auto words_of = [] {
  std::array<std::string_view, std::size(choices)> words;
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = choices[i].word;
  return words;
}();

/// Field of a key whose value is read into `member`. Without `fallback` the default is the member's value in a new
/// struct.
template <auto member>
Field plain(std::string_view key, std::string_view type, std::string_view meaning, std::string_view fallback = {}) {
  Field field{key, type, meaning, fallback};
  field.owner = &owner_mark<OwnerOf<member>>;
  field.read = [](const MapReader& map, const Field& read, void* owner) {
    read_value(map, read, static_cast<OwnerOf<member>*>(owner)->*member);
  };
  field.standard = [] { return standard_text(OwnerOf<member>{}.*member); };
  return field;
}

/// Field of a key with one of several words, which other code reads. `choices`: array of Choice with the words.
template <const auto& choices>
Field words(std::string_view key, std::string_view meaning, std::string_view fallback = {}) {
  return {key, "", meaning, fallback, words_of<choices>};
}

/// Field of a key with one of several words. The word's value in the array `choices` is stored in `member`.
template <auto member, const auto& choices>
Field choice(std::string_view key, std::string_view meaning, std::string_view fallback = {}) {
  Field field = words<choices>(key, meaning, fallback);
  field.owner = &owner_mark<OwnerOf<member>>;
  field.read = [](const MapReader& map, const Field& read, void* owner) {
    const YamlNode* node = find_or_require(map, read);
    if (node == nullptr) return;
    auto& value = static_cast<OwnerOf<member>*>(owner)->*member;
    if constexpr (requires { value.has_value(); })
      value = map.choice(read.key, choices, value.value_or(std::begin(choices)->value));
    else
      value = map.choice(read.key, choices, value);
  };
  field.standard = [] {
    for (const auto& one : choices)
      if (one.value == OwnerOf<member>{}.*member) return fmt::format("`{}`", one.word);
    return std::string();
  };
  return field;
}

/// Reads all keys of the map whose fields belong to members of `spec`.
template <class Spec>
void read_fields(const MapReader& map, Spec& spec) {
  for (const Field& field : map.fields())
    if (field.owner == &owner_mark<Spec>) field.read(map, field, &spec);
}

/// Field of a key whose value is a map. The map has the keys of the list `noun` and is read into the struct `member`.
template <auto member>
Field nested(std::string_view key, std::string_view noun, std::string_view meaning, std::string_view fallback = {}) {
  Field field{key, noun, meaning, fallback};
  field.owner = &owner_mark<OwnerOf<member>>;
  field.read = [](const MapReader& map, const Field& read, void* owner) {
    const YamlNode* node = find_or_require(map, read);
    if (node == nullptr) return;
    auto& value = static_cast<OwnerOf<member>*>(owner)->*member;
    if constexpr (requires { value.emplace(); })
      read_fields(map.inside(*node, read.type), value.emplace());
    else
      read_fields(map.inside(*node, read.type), value);
  };
  return field;
}

/// Reads an entry of a collection: its name, its place `where`, and the keys that belong to members of Spec.
template <class Spec>
Spec read_entry(const MapReader& map, Spec spec = {}) {
  spec.name = map.node().key;
  spec.where = map.context().entry;
  read_fields(map, spec);
  return spec;
}

/// Reads all entries of the collection `key` into `specs`. Entries are maps with the keys of the list `noun` ("point
/// mass" for `point_mass`). `read_rest`: reads the keys of an entry that belong to no member.
template <class Spec, class Rest>
void read_entries(const MapReader& top, std::string_view key, const std::string& noun, std::vector<Spec>& specs,
                  Rest read_rest) {
  std::string list = noun;
  std::ranges::replace(list, ' ', '_');
  for (const YamlNode* node : top.entries(key, noun)) {
    const MapReader map(entry_context(top.context().reader, noun, *node), *node, list);
    Spec spec = read_entry<Spec>(map);
    read_rest(map, spec);
    specs.push_back(std::move(spec));
  }
}
template <class Spec>
void read_entries(const MapReader& top, std::string_view key, const std::string& noun, std::vector<Spec>& specs) {
  read_entries(top, key, noun, specs, [](const MapReader&, Spec&) {});
}

}  // namespace tisserand::formats
