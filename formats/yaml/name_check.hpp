// Names of things: their spelling, uniqueness, and references to them.
#pragma once

#include <functional>
#include <string>
#include <unordered_set>
#include <vector>

#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// [A-Za-z_][A-Za-z0-9_-]*
bool is_name(const std::string& text);

/// A text of each entry: `texts_of(scene.joints, &JointSpec::name)`.
template <class Entries, class Text>
std::vector<std::string> texts_of(const Entries& entries, Text text) {
  std::vector<std::string> texts;
  for (const auto& entry : entries) texts.emplace_back(std::invoke(text, entry));
  return texts;
}

/// "did you mean 'arm'?", if a known word is near; else what else can be done.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known, const std::string& otherwise);

/// An entry of a collection as what its findings are about: "beam 'rod'".
template <class Entry>
Subject subject_of(const std::string& noun, const Entry& entry, Faults& faults) {
  return {noun + " '" + entry.name + "'", entry.where, faults};
}

/// A finding if the name of the subject is not a name or is in `seen`; adds it there.
void check_name(const Subject& subject, const std::string& name, std::vector<std::string>& seen);
/// Checks the name of an entry and returns its subject. `noun` is, for example, "beam".
template <class Entry>
Subject check_name(const std::string& noun, const Entry& entry, std::vector<std::string>& seen, Faults& faults) {
  Subject subject = subject_of(noun, entry, faults);
  check_name(subject, entry.name, seen);
  return subject;
}

/// The same for names of a scene, which may be paths of instances: "corner_fl/arm", "link[3]/bar".
void check_path_name(const Subject& subject, const std::string& name, std::unordered_set<std::string>& seen);
template <class Entry>
Subject check_path_name(const std::string& noun, const Entry& entry, std::unordered_set<std::string>& seen,
                        Faults& faults) {
  Subject subject = subject_of(noun, entry, faults);
  check_path_name(subject, entry.name, seen);
  return subject;
}

/// A finding if `name` is not in `known`, with the nearest one: "beam 'rod': there is no section 'owm'".
void check_reference(const Subject& subject, const std::string& key, const std::string& noun, const std::string& name,
                     const std::vector<std::string>& known);

}  // namespace tisserand::formats
