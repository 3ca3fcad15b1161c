// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a study beyond the types of its values.
#pragma once

#include "formats/study/study.hpp"
#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// Adds the faults of a study to `faults`: names without definition, unused axes and missing entries.
void find_faults(const Study& study, Faults& faults);

}  // namespace tisserand::formats
