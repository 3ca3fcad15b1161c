// SPDX-License-Identifier: GPL-3.0-or-later
// Values of an expanded scene as lines of text. Files store them to identify their scene and to show later differences.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "formats/yaml/field.hpp"
#include "formats/yaml/tree.hpp"

namespace tisserand::formats {

/// Function that returns the identifier of the contents of a file, which the tree names under a key such as
/// `inputs.u.file`. Empty result: unknown.
using ContentsOf = std::function<std::string(const std::string& key, const std::string& file)>;

/// Lines "bodies.arm.mass: 2", one per value of a flat tree in its order. After a file that `contents` knows follows a
/// line "inputs.u.file (contents): ...". Equal numbers have equal texts (2, 2.0, 0.2e1). Omitted are values that do not
/// change the mechanism: name, integrator, statics, modes, output, checkpoint, analyses, tolerances, `virtual_bodies`,
/// shapes for pictures, and the sources of the tree (parameters, assemblies, instances).
std::string scene_values(const YamlNode& tree, const ContentsOf& contents);

/// Flat tree as YAML, followed by the lines of `contents` as comments.
std::string text_with_contents(const YamlNode& tree, const ContentsOf& contents);

/// Lines of scene_values(), computed from a text written by text_with_contents(). Throws Error if the text is not YAML.
std::string values_of_text(const std::string& text, const std::string& where);

/// Value that differs between two scenes: its key, and its texts before and after. A value that is not given has the
/// text "nothing".
struct ValueChange {
  std::string key;
  std::string before;
  std::string after;
};

/// Differences of two texts of scene_values(), in the order of `after`; then values that only `before` has. Ignored are
/// blanks, keys given with their default in `legal_keys`, added channels that nothing uses, and renamed files with
/// equal contents.
std::vector<ValueChange> scene_changes(const std::string& before, const std::string& after,
                                       const std::vector<KeySet>& legal_keys);

/// Text of at most ten changes, each as "bodies.arm.mass: 2 -> 20" after the text `before_each`, then the number of
/// further changes.
std::string changes_text(const std::vector<ValueChange>& changes, const std::string& before_each);

}  // namespace tisserand::formats
