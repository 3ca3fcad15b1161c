// SPDX-License-Identifier: GPL-3.0-or-later
// Sections of shells and materials of solids from layouts and materials of part.yaml.
#pragma once

#include "formats/part/part.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Property of a shell from its layout in part.yaml. `user` ("shell 'skin'") and `where` are for messages.
ShellProperty shell_property(const formats::Part& part, const formats::ShellLayout& layout, const std::string& user,
                             const std::string& where);

SolidProperty solid_property(const formats::Part& part, const formats::SolidGroup& solid);

}  // namespace tisserand::reducer
