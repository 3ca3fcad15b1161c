// SPDX-License-Identifier: GPL-3.0-or-later
// Wagner's constants of unsymmetric sections, by which bending stress changes torsional stiffness.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "formats/sections/polygon.hpp"
#include "formats/sections/walls.hpp"

namespace tisserand::formats {

/// Third moments of area [∫y (y² + z²) dA; ∫z (y² + z²) dA] of a polygon about its centroid [length⁵]. They are exact
/// (Green's theorem).
Eigen::Vector2d third_moments(const SectionPolygon& polygon);

/// Third moments of area [∫y (y² + z²) dA; ∫z (y² + z²) dA] of walls, as rectangles, about their centroid [length⁵].
/// Each wall ends where middle lines meet, without correction of corners.
Eigen::Vector2d third_moments(const std::vector<WallLine>& lines);

/// Third moments of area [∫y (y² + z²) dA; ∫z (y² + z²) dA] of a section with a stored shape: circle, rectangle,
/// profile, or outline by remember_outline(). Nothing for a section given by constants or by stiffness, or interpolated
/// between two others.
std::optional<Eigen::Vector2d> third_moments(const Section& section);

/// Stores an outline in Section::shape ("polygon", "walls") and Section::sizes. Sizes of a polygon: for each ring the
/// number of corners, then y and z of each corner. Sizes of walls: y, z, y, z, thickness of each straight piece.
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

/// Wagner's constants of a section. They use third_moments(section) if it returns a value, else third moments of 0, as
/// doubly symmetric sections have.
Monosymmetry known_monosymmetry(const Section& section);

/// Whether Wagner's constants are unknown and the known constants do not show that they are zero by symmetry: the shear
/// centre or the axes are oblique.
bool lacks_monosymmetry(const Section& section);

}  // namespace tisserand::formats
