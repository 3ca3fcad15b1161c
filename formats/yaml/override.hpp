// Values from the command line (--set path=value) that change the tree of a part or scene before it is read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tisserand::formats {

struct YamlDocument;

/// --set path.to.key=value: steps are keys of maps, and indices or the `name` of entries in lists; value is YAML.
struct Override {
  std::string path;
  std::string value;
};

/// Splits "path=value" at the first '='. Throws Error if there is no path or no '='.
Override parse_override(const std::string& text);

/// Sets the values in the tree, creating maps that are absent. An entry of a collection (a map whose keys are chosen by
/// the user, such as `bodies`) is not created on the way to a deeper key: that would hide a misspelt name. Throws all
/// errors together.
void apply_overrides(YamlDocument& document, const std::vector<Override>& overrides,
                     const std::vector<std::string_view>& collections);

}  // namespace tisserand::formats
