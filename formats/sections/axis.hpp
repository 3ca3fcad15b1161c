// SPDX-License-Identifier: GPL-3.0-or-later
// Check for principal axes through centroid and shear centre, which some beams need.
#pragma once

#include <optional>
#include <string>

#include "formats/sections/section.hpp"

namespace tisserand::formats {

/// Text, with values, of the first condition that the section violates, or nothing. Conditions: y and z are principal
/// axes, centroid and shear centre lie on the axis of the beam, shear is uncoupled, and the section is no rod. The
/// tolerance is 1e-9 of the section's own measures.
std::optional<std::string> off_axis_text(const Section& section);

}  // namespace tisserand::formats
