// Constants of unsymmetric sections in bending: how bending stress works on twist.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "formats/sections/polygon.hpp"
#include "formats/sections/walls.hpp"

namespace tisserand::formats {

/// Third moments of area [∫y (y² + z²) dA; ∫z (y² + z²) dA] about the centroid [length⁵], exact (Green's theorem).
Eigen::Vector2d third_moments(const SectionPolygon& polygon);

/// The same of walls as rectangles; corners are counted as the middle lines cross.
Eigen::Vector2d third_moments(const std::vector<WallLine>& lines);

/// The same of a section that remembers its shape: circles, rectangles, profiles, and polygons and walls of
/// remember_outline(). Nothing for a section that is given by constants or by stiffness, or between two others.
std::optional<Eigen::Vector2d> third_moments(const Section& section);

/// Notes the outline in Section::shape ("polygon", "walls") and Section::sizes: of a polygon per ring the number of
/// corners, then y and z of each; of walls y, z, y, z, thickness of each straight piece.
void remember_outline(const SectionPolygon& polygon, Section& section);
void remember_outline(const std::vector<WallLine>& lines, Section& section);

/// Wagner's constants β [length]: normal stress σ, twisted about the shear centre s, adds W = ∫σ |r − s|² dA to the
/// torsional stiffness (Trahair, Flexural-Torsional Buckling of Structures, 1993, sections 2.5 and 17.4), and
///   W = N (I_p/A + |s|²) + β_y M_y − β_z M_z,
///   β_y = ∫z (y² + z²) dA/I_y − 2 z_s,  β_z = ∫y (y² + z²) dA/I_z − 2 y_s   in principal axes,
/// with moments about the centroid, M_y = ∫σ z dA and M_z = −∫σ y dA. In other axes the stress of each moment alone
/// counts, which bends the section in both planes.
struct Monosymmetry {
  double beta_y = 0.0;
  double beta_z = 0.0;
};
Monosymmetry monosymmetry(const Section& section, const Eigen::Vector2d& third_moments);

/// What is known of it: with third_moments(), else with third moments 0, as of doubly symmetric sections.
Monosymmetry known_monosymmetry(const Section& section);

/// Whether β is not known and not zero by symmetry as far as the constants tell: shear centre or axes are oblique.
bool lacks_monosymmetry(const Section& section);

}  // namespace tisserand::formats
