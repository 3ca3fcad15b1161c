// SPDX-License-Identifier: GPL-3.0-or-later
// Values from the command line (--set path=value) that change the tree of a part or scene before it is read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tisserand::formats {

struct YamlDocument;

/// Override of a value, from the option --set path.to.key=value. Steps of the path are keys of maps, and indices or the
/// `name` of entries in lists. The value is YAML.
struct Override {
  std::string path;
  std::string value;
};

/// Splits "path=value" at the first '='. Throws Error if there is no path or no '='.
Override parse_override(const std::string& text);

/// Sets the values of the overrides in the tree and creates absent maps on their paths. `collections`: keys of maps
/// with names chosen by the user, such as `bodies`. An entry of a collection is not created on the path to a deeper
/// key, since that would hide a misspelt name. Throws one Error with all errors.
void apply_overrides(YamlDocument& document, const std::vector<Override>& overrides,
                     const std::vector<std::string_view>& collections);

}  // namespace tisserand::formats
