// What is wrong with a part that can be read.
#pragma once

#include "formats/fault.hpp"
#include "formats/part.hpp"

namespace tisserand::formats {

/// All findings; check(part) throws them.
Faults find_faults(const Part& part);

}  // namespace tisserand::formats
