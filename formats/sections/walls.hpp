// SPDX-License-Identifier: GPL-3.0-or-later
// Thin-walled sections given by the middle lines of their walls: open or closed, with any number of cells.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/sections/polygon.hpp"

namespace tisserand::formats {

/// Line of straight walls with one thickness, through points (y, z). A closed line repeats its first point at the end.
/// Lines are joined at common points.
struct WallLine {
  Ring points;
  double thickness = 0.0;
};

/// Largest number of straight walls of a section.
inline constexpr std::size_t largest_wall_count = 500;

/// Fault of the walls, or nothing: no wall, a wall without length or thickness, unconnected walls, all walls on one
/// straight line (better a rectangle), more than `largest_wall_count`.
std::optional<std::string> walls_fault(const std::vector<WallLine>& lines);

/// Centroid (y, z) of the walls, in the coordinates of their points.
Eigen::Vector2d walls_centroid(const std::vector<WallLine>& lines);

/// Section with constants by the theory of thin walls, about the centroid, Poisson's ratio 0. Along a wall of thickness
/// t, the warping functions of sections/flow.hpp depend on the arc length s alone. The flow t dω/ds ... is constant for
/// torsion. So the functions are potentials of a network with conductances t/length, solved exactly at its nodes.
///   torsion: flow t (ω' + h), h = y z' − z y'; J = ∫t (ω' + h)² ds + Σ length t³/3: Bredt for cells of any number,
///            the sum for open walls (Timoshenko and Goodier, Theory of Elasticity, 3rd ed., sections 108 and 115);
///   shear:   flow t ψ', (t ψ')' = −t x_i: the shear flow VQ/I with its redundant part in cells; compliance and shear
///            centre as in sections/flow.hpp ([Pil02] chapter 6 in its thin-walled form);
///   warping constant ∫t ω_s² ds about the shear centre.
/// Second moments are those of the walls as rectangles, with length t³/12. Each wall ends where middle lines meet,
/// without correction of corners. walls_fault() must be empty.
Section walls_section(const std::vector<WallLine>& lines);

}  // namespace tisserand::formats
