// The components of a load as functions of time.
#pragma once

#include <string>

#include "formats/scene.hpp"
#include "formats/yaml_reader.hpp"

namespace tisserand::formats {

/// A number, a text (expression in t), {expression: .., breakpoints: [..]}, {table: [[t, value], ..]} or {file:
/// table.csv} (relative to `folder`).
TimeFunctionSpec read_time_function(const Context& context, const YamlNode& node, const std::string& what,
                                    const std::string& folder);

/// Times of a table and breakpoints increase; values are finite; the expression has a text.
void check_time_function(const TimeFunctionSpec& function, const std::string& subject, const std::string& where,
                         const std::string& key, Faults& faults);

}  // namespace tisserand::formats
