// SPDX-License-Identifier: GPL-3.0-or-later
// Superelement files that a study makes with `reducer`. Only this file names that program.
#pragma once

#include <functional>

#include "mechanism/study/cells.hpp"

namespace tisserand::mechanism {

/// Makes the superelement file of a part with the program `reducer`, unless the file exists. Throws Error if the
/// program is missing, or with the message of the program.
void reduce_part(const PartRequest& part, const std::function<bool()>& is_stopped);

}  // namespace tisserand::mechanism
