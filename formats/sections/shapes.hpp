// SPDX-License-Identifier: GPL-3.0-or-later
// Section constants of simple shapes, by closed formulas.
#pragma once

#include "formats/sections/section.hpp"

namespace tisserand::formats {

/// Shear areas follow Cowper, The shear coefficient in Timoshenko's beam theory, J. Appl. Mech. 33 (1966) 335, with ν =
/// 0, since a section has no material: 5/6 A for the rectangle, 6/7 A for the circle, A/2 for a thin circular tube. At
/// ν = 0.3 his values are larger by 2, 3.4 and 6 %. If that matters, give the constants.

/// Section that is a full circle. J = Iy + Iz (exact).
Section circle_section(double radius);

/// Section that is a circular tube, by outer radius and wall thickness. J = Iy + Iz (exact). With m = inner / outer
/// radius, the shear area A_s follows from A_s/A = 6 (1 + m²)² / (7 (1 + m²)² + 20 m²).
Section hollow_circle_section(double radius, double thickness);

/// Section that is a rectangle, with `width` along y and `height` along z. J is by Saint-Venant's series (Timoshenko
/// and Goodier, Theory of Elasticity, 3rd ed., section 109): for sides a <= b, J = a³b/3 (1 − 192/π⁵ a/b Σ_{n odd}
/// tanh(nπb/(2a))/n⁵).
Section rectangle_section(double width, double height);

/// Section that is a rectangular tube, by outer sides w (`width`), h (`height`) and uniform wall thickness t. Shear
/// areas and J hold for thin walls. J is by Bredt's formula (Timoshenko and Goodier, section 115): J = 4 A_m² t / s
/// with the enclosed area A_m = (w−t)(h−t) and s = 2(w−t) + 2(h−t) along the middle line. With n = breadth / depth of
/// the middle line, the shear area A_s follows from A_s/A = 10 (1 + 3n)² / (12 + 72n + 150n² + 90n³ + 30n³ (1 + n)).
Section hollow_rectangle_section(double width, double height, double thickness);

}  // namespace tisserand::formats
