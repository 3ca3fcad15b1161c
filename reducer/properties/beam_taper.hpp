// Sections along a tapered beam: from two end sections to stations, and from stations to the constants at a point.
#pragma once

#include <vector>

#include "formats/sections/section.hpp"

namespace tisserand::reducer {

/// Equally spaced sections from `first` to `second`. Of the same shape: five, whose sizes vary linearly; area and
/// second moments are then polynomials of degree 2 and 4 at most for every doubly symmetric shape, which five stations
/// hold exactly, and the other constants are joined closely. Otherwise two: the constants vary linearly. The axis runs
/// through the point of each section from which its centroid is measured.
std::vector<formats::Section> taper_stations(const formats::Section& first, const formats::Section& second);

/// The stations of a piece of the beam, for a beam that is divided into elements; 0 <= from < to <= 1.
std::vector<formats::Section> stations_between(const std::vector<formats::Section>& stations, double from, double to);

/// Constants at ξ in [0, 1] by the polynomial through all stations (Lagrange); without name, shape and place.
formats::Section constants_at(const std::vector<formats::Section>& stations, double xi);

}  // namespace tisserand::reducer
