// SPDX-License-Identifier: GPL-3.0-or-later
// Superelement files that a study makes with `reducer`. Only this file names that program.
#pragma once

#include <functional>

#include "mechanism/study/cells.hpp"

namespace tisserand::mechanism {

/// Makes the superelement file of the part unless it exists. Throws Error: the program is missing, or its message.
void reduce_part(const PartRequest& part, const std::function<bool()>& is_stopped);

}  // namespace tisserand::mechanism
