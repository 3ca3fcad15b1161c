// Rolled and welded shapes: from the sizes that a part gives to a polygon and its constants.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/sections/polygon.hpp"

namespace tisserand::formats {

/// Shapes bounded by straight lines; y to the right, z up. Sizes in the order of `keys`, all outer measures:
///   I        height, width and flange of the top, web, bottom_width, bottom_flange; web in the middle of both flanges;
///   channel  height, width, web, flange; the web at the left, flanges to +y;
///   angle    height, width, web, flange: the web stands up at the left end of the flange;
///   tee      height, width, web, flange: the flange at the top;
///   zed      height, width of each flange (web included), web, flange: top flange to +y, bottom flange to −y;
///   box      height, width, top, bottom, left, right: thicknesses of the walls;
///   hat      height, width of the top, brim (each), thickness: open at the bottom, brims at the bottom;
///   cross    height, width, web (of the upright), flange (of the horizontal).
struct Profile {
  std::string_view shape;
  std::vector<std::string_view> keys;
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
