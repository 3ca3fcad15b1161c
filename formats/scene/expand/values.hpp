// The values of an expanded scene as lines of text: what a file keeps of the scene that it belongs to, and what
// differs from it later.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "formats/yaml/field.hpp"
#include "formats/yaml/tree.hpp"

namespace tisserand::formats {

/// Identifier of the contents of a file that the tree names under a key such as `inputs.u.file`; empty: none is known.
using ContentsOf = std::function<std::string(const std::string& key, const std::string& file)>;

/// One line "bodies.arm.mass: 2" per value of a flat tree, in the order of the tree; after a file that `contents` knows
/// a line "inputs.u.file (contents): ...". Numbers are written alike (2, 2.0, 0.2e1). What does not change the
/// mechanism is left out: name, integrator, statics, modes, output, checkpoint, analyses, tolerances, `virtual_bodies`,
/// shapes for pictures, and what the tree was made from (parameters, assemblies, instances).
std::string scene_values(const YamlNode& tree, const ContentsOf& contents);

/// A flat tree as YAML, and after it as comments the lines of `contents`.
std::string text_with_contents(const YamlNode& tree, const ContentsOf& contents);

/// scene_values of such a text. Throws Error if it is no YAML.
std::string values_of_text(const std::string& text, const std::string& where);

/// A value that differs; "nothing" where it is not given.
struct ValueChange {
  std::string key;
  std::string before;
  std::string after;
};

/// Differences of two texts of scene_values, in the order of `after`, then those that only `before` has. No difference:
/// blanks, a key that is given with the default of `legal_keys`, an unused channel that was added, another name of a
/// file with the same contents.
std::vector<ValueChange> scene_changes(const std::string& before, const std::string& after,
                                       const std::vector<KeySet>& legal_keys);

/// "bodies.arm.mass: 2 -> 20", at most ten, each after `before_each`, and how many more there are.
std::string changes_text(const std::vector<ValueChange>& changes, const std::string& before_each);

}  // namespace tisserand::formats
