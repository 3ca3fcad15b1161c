// A tree back as text: values of a study that become --set options, and scenes that a study writes.
#pragma once

#include <string>

#include "formats/yaml/tree.hpp"

namespace tisserand::formats {

/// The value in one line, as --set path=value takes it; parse_yaml() reads it back as the same tree.
std::string flow_text(const YamlNode& node);

/// A file with one key in a line at its two outer levels, `flow_text` below.
std::string block_text(const YamlNode& root);

}  // namespace tisserand::formats
