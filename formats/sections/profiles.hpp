// SPDX-License-Identifier: GPL-3.0-or-later
// Rolled and welded shapes: their polygon and constants from the sizes in a part.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/sections/polygon.hpp"

namespace tisserand::formats {

/// Kind of profile: a shape bounded by straight lines, y to the right, z up. All sizes are outer measures, in the order
/// of `keys`.
struct Profile {
  std::string_view shape;
  std::vector<std::string_view> keys;
  std::string_view meaning;  ///< meaning of the keys with an example, for PART.md
};
const std::vector<Profile>& profiles();

/// Profile whose `shape` is the given word, or null.
const Profile* find_profile(std::string_view shape);

/// Fault of the sizes of a profile ("web 0.03 is not less than width 0.02"), or nothing.
std::optional<std::string> profile_fault(std::string_view shape, const std::vector<double>& sizes);

/// Polygon of a profile, with its lower left corner near the origin. Requires sizes without profile_fault().
SectionPolygon profile_polygon(std::string_view shape, const std::vector<double>& sizes);

/// Section of a profile, with constants by polygon_section() and with stored `shape` and `sizes`.
Section profile_section(std::string_view shape, const std::vector<double>& sizes);

/// Section of a profile, or of a shape of sections/shapes.hpp, by its word and sizes; used for tapered beams.
Section shape_section(std::string_view shape, const std::vector<double>& sizes);

}  // namespace tisserand::formats
