// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a tree as text: values of a study as --set options, and scenes that a study writes.
#pragma once

#include <string>

#include "formats/yaml/tree.hpp"

namespace tisserand::formats {

/// The value on one line, as --set path=value accepts it. parse_yaml() reads it back as the same tree.
std::string flow_text(const YamlNode& node);

/// Text of a file with one key per line at its two outer levels, and `flow_text` below.
std::string block_text(const YamlNode& root);

}  // namespace tisserand::formats
