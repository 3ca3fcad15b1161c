// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of names: their spelling, uniqueness, and references to them.
#pragma once

#include <functional>
#include <string>
#include <unordered_set>
#include <vector>

#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// Whether the text is a valid name: [A-Za-z_][A-Za-z0-9_-]*.
bool is_name(const std::string& text);

/// List with one text of each entry. `text`: member or function that gives it, as in `texts_of(scene.joints,
/// &JointSpec::name)`.
template <class Entries, class Text>
std::vector<std::string> texts_of(const Entries& entries, Text text) {
  std::vector<std::string> texts;
  for (const auto& entry : entries) texts.emplace_back(std::invoke(text, entry));
  return texts;
}

/// Text "did you mean 'arm'?" if one of the names `known` is near to `word`, else the text `otherwise`.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known, const std::string& otherwise);

/// Subject of findings about an entry of a collection: "beam 'rod'".
template <class Entry>
Subject subject_of(const std::string& noun, const Entry& entry, Faults& faults) {
  return {noun + " '" + entry.name + "'", entry.where, faults};
}

/// Checks a name: adds a finding if it is invalid or already in `seen`. Then adds the name to `seen`.
void check_name(const Subject& subject, const std::string& name, std::vector<std::string>& seen);
/// Checks the name of an entry and returns the entry's subject. `noun`: kind of entry, for example "beam".
template <class Entry>
Subject check_name(const std::string& noun, const Entry& entry, std::vector<std::string>& seen, Faults& faults) {
  Subject subject = subject_of(noun, entry, faults);
  check_name(subject, entry.name, seen);
  return subject;
}

/// Checks a name of a scene, which may be the path of an instance's entry: "corner_fl/arm", "link[3]/bar". Adds it to
/// `seen`.
void check_path_name(const Subject& subject, const std::string& name, std::unordered_set<std::string>& seen);
template <class Entry>
Subject check_path_name(const std::string& noun, const Entry& entry, std::unordered_set<std::string>& seen,
                        Faults& faults) {
  Subject subject = subject_of(noun, entry, faults);
  check_path_name(subject, entry.name, seen);
  return subject;
}

/// Adds a finding if `name` is not in `known`: "beam 'rod': there is no section 'owm'". The finding suggests the
/// nearest name.
void check_reference(const Subject& subject, const std::string& key, const std::string& noun, const std::string& name,
                     const std::vector<std::string>& known);

}  // namespace tisserand::formats
