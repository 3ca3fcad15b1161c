// SPDX-License-Identifier: GPL-3.0-or-later
// Sections bounded by straight lines: area moments of polygons, and their Section by Saint-Venant's theory.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/sections/section.hpp"

namespace tisserand::formats {

/// Closed polygon: corners (y, z) in order, in either orientation. The first corner is not repeated at the end.
using Ring = std::vector<Eigen::Vector2d>;

/// Cross-section that is bounded by an outer polygon and by the polygons of its holes.
struct SectionPolygon {
  Ring outer;
  std::vector<Ring> holes;
};

/// Largest number of corners of a section with its holes. The matrix of the boundary equations grows with the square of
/// this number.
inline constexpr std::size_t largest_polygon = 200;

/// Fault of a polygon, or nothing: fewer than three corners, corners that coincide, sides that cross or touch, a hole
/// that is not inside, more than `largest_polygon` corners.
std::optional<std::string> polygon_fault(const SectionPolygon& polygon);

/// Area, centroid (y, z), and second moments of area about the centroid. They are exact (Green's theorem; Steger, On
/// the calculation of moments of polygons, report FGBV-96-05, TU Munich 1996). Holes are subtracted for either
/// orientation.
struct AreaMoments {
  double area = 0.0;
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  double second_moment_y = 0.0;   ///< ∫z² dA
  double second_moment_z = 0.0;   ///< ∫y² dA
  double second_moment_yz = 0.0;  ///< ∫y z dA
};
AreaMoments area_moments(const SectionPolygon& polygon);

/// Section with the constants of a polygon about its centroid: exact area moments, and J, shear centre and shear
/// compliance by saint_venant() (sections/flow.hpp). Requires a polygon without polygon_fault().
Section polygon_section(const SectionPolygon& polygon);

/// Whether the constants are above round-off: J and shear areas are positive, and J is at least 1e-8 (Iy + Iz). False
/// for spikes and for walls thinner than about 1/5000 of their length.
bool is_resolved(const Section& section);

/// Sets Iyz, shear coupling and shear centre to zero where they are round-off (1e-9 of their scale). So symmetric
/// sections are exactly symmetric.
void drop_round_off(Section& section);

}  // namespace tisserand::formats
