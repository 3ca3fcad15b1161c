// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of names: their spelling, uniqueness, and references to them.
#pragma once

#include <functional>
#include <string>
#include <unordered_set>
#include <vector>

#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// Whether the text is [A-Za-z_][A-Za-z0-9_-]*.
bool is_name(const std::string& text);

/// Texts of the entries, one each: `texts_of(scene.joints, &JointSpec::name)`.
template <class Entries, class Text>
std::vector<std::string> texts_of(const Entries& entries, Text text) {
  std::vector<std::string> texts;
  for (const auto& entry : entries) texts.emplace_back(std::invoke(text, entry));
  return texts;
}

/// Text "did you mean 'arm'?" if a known word is near, else `otherwise`.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known, const std::string& otherwise);

/// Subject of findings about an entry of a collection: "beam 'rod'".
template <class Entry>
Subject subject_of(const std::string& noun, const Entry& entry, Faults& faults) {
  return {noun + " '" + entry.name + "'", entry.where, faults};
}

/// Adds a finding if the name is invalid or in `seen`; adds it to `seen`.
void check_name(const Subject& subject, const std::string& name, std::vector<std::string>& seen);
/// Checks the name of an entry and returns its subject. `noun` is, for example, "beam".
template <class Entry>
Subject check_name(const std::string& noun, const Entry& entry, std::vector<std::string>& seen, Faults& faults) {
  Subject subject = subject_of(noun, entry, faults);
  check_name(subject, entry.name, seen);
  return subject;
}

/// Checks names of a scene, which may be paths of instances: "corner_fl/arm", "link[3]/bar".
void check_path_name(const Subject& subject, const std::string& name, std::unordered_set<std::string>& seen);
template <class Entry>
Subject check_path_name(const std::string& noun, const Entry& entry, std::unordered_set<std::string>& seen,
                        Faults& faults) {
  Subject subject = subject_of(noun, entry, faults);
  check_path_name(subject, entry.name, seen);
  return subject;
}

/// Adds a finding with the nearest name if `name` is not in `known`: "beam 'rod': there is no section 'owm'".
void check_reference(const Subject& subject, const std::string& key, const std::string& noun, const std::string& name,
                     const std::vector<std::string>& known);

}  // namespace tisserand::formats
