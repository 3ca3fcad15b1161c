// Section constants of simple shapes, by closed formulas.
#pragma once

#include "formats/section.hpp"

namespace tisserand::formats {

/// Shear areas of all shapes come from the energy of the shear stress averaged over the width (Jourawski):
/// A_s = I² / ∫ S(z)²/b(z) dz with S the first moment of the area beyond z and b the width there. That is 5/6 A for the
/// rectangle and 9/10 A for the circle, does not depend on the Poisson ratio, and tends to A/2 for a thin tube.

/// Full circle. J = Iy + Iz (exact).
Section circle_section(double radius);

/// Circular tube with outer radius and wall thickness. J = Iy + Iz (exact).
Section hollow_circle_section(double radius, double thickness);

/// Rectangle with `width` along y and `height` along z. J by Saint-Venant's series (Timoshenko and Goodier, Theory of
/// Elasticity, 3rd ed., section 109): for sides a <= b, J = a³b/3 (1 − 192/π⁵ a/b Σ_{n odd} tanh(nπb/(2a))/n⁵).
Section rectangle_section(double width, double height);

/// Rectangular tube with outer sides and one wall thickness t. J by Bredt's formula for thin closed walls (Timoshenko and
/// Goodier, section 115): J = 4 A_m² t / s with A_m = (w−t)(h−t) inside and s = 2(w−t) + 2(h−t) along the middle line.
Section hollow_rectangle_section(double width, double height, double thickness);

}  // namespace tisserand::formats
