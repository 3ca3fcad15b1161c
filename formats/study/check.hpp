// Findings in a study beyond the types of its values.
#pragma once

#include "formats/study/study.hpp"
#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// Names that refer to nothing, axes that nothing uses, what is missing.
void find_faults(const Study& study, Faults& faults);

}  // namespace tisserand::formats
