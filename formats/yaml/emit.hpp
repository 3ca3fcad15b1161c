// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a tree as text: values of a study as --set options, and scenes that a study writes.
#pragma once

#include <string>

#include "formats/yaml/tree.hpp"

namespace tisserand::formats {

/// Text of the value on one line, in the form that --set path=value accepts. parse_yaml() reads the text back as an
/// equal tree.
std::string flow_text(const YamlNode& node);

/// Text of a YAML file: one key per line at the two outer levels, and flow_text() for the values below.
std::string block_text(const YamlNode& root);

}  // namespace tisserand::formats
