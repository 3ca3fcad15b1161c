// Whether the axes of a section are principal axes through centroid and shear centre, as some beams need.
#pragma once

#include <optional>
#include <string>

#include "formats/sections/section.hpp"

namespace tisserand::formats {

/// What keeps the section from being one whose y and z are principal axes and whose centroid and shear centre lie on
/// the axis of the beam, in words and values; nothing for such a section. Tolerance 1e-9 of the section's own measures.
std::optional<std::string> off_axis_text(const Section& section);

}  // namespace tisserand::formats
