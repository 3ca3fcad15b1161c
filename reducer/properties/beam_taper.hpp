// SPDX-License-Identifier: GPL-3.0-or-later
// Sections along a tapered beam: stations between two end sections, and constants at a point between stations.
#pragma once

#include <vector>

#include "formats/sections/section.hpp"

namespace tisserand::reducer {

/// Equally spaced sections of a tapered beam from `first` to `second`. Sections of one shape get five, whose sizes
/// vary linearly. Area and second moments of doubly symmetric shapes are then polynomials of degree 2 and 4 at most,
/// so five are exact. The other constants are close. Sections of different shapes get two, between which the constants
/// vary linearly. The beam axis runs through the point of each section from which its centroid is measured.
std::vector<formats::Section> taper_stations(const formats::Section& first, const formats::Section& second);

/// Sections of a piece of a tapered beam that is divided into elements. `stations`: sections of the whole beam.
/// `from`, `to`: shares of its length, 0 <= from < to <= 1.
std::vector<formats::Section> stations_between(const std::vector<formats::Section>& stations, double from, double to);

/// Constants of a tapered beam at ξ = `xi` in [0, 1], by the polynomial through all stations (Lagrange). The result
/// has no name, shape and place.
formats::Section constants_at(const std::vector<formats::Section>& stations, double xi);

}  // namespace tisserand::reducer
