// SPDX-License-Identifier: GPL-3.0-or-later
// Names in files of superelements: boundary nodes, load cases.
#pragma once

#include <string>

namespace tisserand::formats {

/// Whether the name is valid: [A-Za-z_][A-Za-z0-9_-]*, at most 255 bytes.
bool valid_name(const std::string& name);

}  // namespace tisserand::formats
