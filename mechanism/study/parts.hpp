// Superelement files that a study makes, by the program of the other stage: the only place that names it.
#pragma once

#include <functional>

#include "mechanism/study/cells.hpp"

namespace tisserand::mechanism {

/// Makes the superelement file of the part unless it is there. Throws Error: the program is missing, or with what it
/// said.
void reduce_part(const PartRequest& part, const std::function<bool()>& is_stopped);

}  // namespace tisserand::mechanism
