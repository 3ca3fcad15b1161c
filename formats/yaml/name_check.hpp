// Names of things: their spelling, uniqueness, and references to them.
#pragma once

#include <string>
#include <unordered_set>
#include <vector>

#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// [A-Za-z_][A-Za-z0-9_-]*
bool is_name(const std::string& text);

/// A finding if the name of the entry at `where` is not a name or is in `seen`; adds it there. `noun` is "beam".
void check_name(const std::string& noun, const std::string& name, const std::string& where,
                std::vector<std::string>& seen, Faults& faults);

/// The same for names of a scene, which may be paths of instances: "corner_fl/arm", "link[3]/bar".
void check_path_name(const std::string& noun, const std::string& name, const std::string& where,
                     std::unordered_set<std::string>& seen, Faults& faults);

/// A finding if `name` is not in `known`, with the nearest one: "beam 'rod': there is no section 'owm'".
void check_reference(const std::string& subject, const std::string& noun, const std::string& name,
                     const std::vector<std::string>& known, const std::string& where, const std::string& key,
                     Faults& faults);

}  // namespace tisserand::formats
