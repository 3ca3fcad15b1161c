// SPDX-License-Identifier: GPL-3.0-or-later
// Wagner's constants of unsymmetric sections, by which bending stress changes torsional stiffness.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "formats/sections/polygon.hpp"
#include "formats/sections/walls.hpp"

namespace tisserand::formats {

/// Third moments of area [∫y (y² + z²) dA; ∫z (y² + z²) dA] about the centroid [length⁵], exact (Green's theorem).
Eigen::Vector2d third_moments(const SectionPolygon& polygon);

/// Third moments of walls as rectangles. Each wall ends where middle lines meet, without correction of corners.
Eigen::Vector2d third_moments(const std::vector<WallLine>& lines);

/// Third moments of a section with a stored shape: circle, rectangle, profile, or outline by remember_outline().
/// Nothing for a section given by constants or by stiffness, or between two others.
std::optional<Eigen::Vector2d> third_moments(const Section& section);

/// Stores the outline in Section::shape ("polygon", "walls") and Section::sizes. Polygon: for each ring the number of
/// corners, then y and z of each. Walls: y, z, y, z, thickness of each straight piece.
void remember_outline(const SectionPolygon& polygon, Section& section);
void remember_outline(const std::vector<WallLine>& lines, Section& section);

/// Wagner's constants β [length]. Under the normal stress σ, a section twisted about the shear centre s has additional
/// torsional stiffness W (Trahair, Flexural-Torsional Buckling of Structures, 1993, 2.5 and 17.4), W = ∫σ |r − s|² dA:
///   W = N (I_p/A + |s|²) + β_y M_y − β_z M_z,
///   β_y = ∫z (y² + z²) dA/I_y − 2 z_s,  β_z = ∫y (y² + z²) dA/I_z − 2 y_s   in principal axes,
/// with moments about the centroid, M_y = ∫σ z dA and M_z = −∫σ y dA. In other axes β uses the stress of one moment
/// alone, which bends the section in both planes.
struct Monosymmetry {
  double beta_y = 0.0;
  double beta_z = 0.0;
};
Monosymmetry monosymmetry(const Section& section, const Eigen::Vector2d& third_moments);

/// Constants by third_moments() if these are known, else with third moments 0, as for doubly symmetric sections.
Monosymmetry known_monosymmetry(const Section& section);

/// Whether β is unknown and not zero by symmetry as far as constants show: shear centre or axes are oblique.
bool lacks_monosymmetry(const Section& section);

}  // namespace tisserand::formats
