// Rolled and welded shapes: from the sizes that a part gives to a polygon and its constants.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/sections/polygon.hpp"

namespace tisserand::formats {

/// A shape bounded by straight lines; y to the right, z up. Sizes in the order of `keys`, all outer measures.
struct Profile {
  std::string_view shape;
  std::vector<std::string_view> keys;
  std::string_view meaning;  ///< of the keys, with an example, for PART.md
};
const std::vector<Profile>& profiles();

/// The profile of that word, or null.
const Profile* find_profile(std::string_view shape);

/// What is wrong with the sizes ("web 0.03 is not less than width 0.02"), or nothing.
std::optional<std::string> profile_fault(std::string_view shape, const std::vector<double>& sizes);

/// Corners of the shape, its lower left corner near the origin. The sizes have no fault.
SectionPolygon profile_polygon(std::string_view shape, const std::vector<double>& sizes);

/// Constants by polygon_section(); `shape` and `sizes` are remembered.
Section profile_section(std::string_view shape, const std::vector<double>& sizes);

/// The shapes of sections/shapes.hpp by word and sizes as well as profiles: what tapered beams need.
Section shape_section(std::string_view shape, const std::vector<double>& sizes);

}  // namespace tisserand::formats
