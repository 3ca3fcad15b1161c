// SPDX-License-Identifier: GPL-3.0-or-later
// Torsion and shear of a section by Saint-Venant's theory: boundary integral equations on the polygon's sides.
#pragma once

#include <Eigen/Core>

#include "formats/sections/polygon.hpp"

namespace tisserand::formats {

/// Section constants of torsion and shear by Saint-Venant's theory with Poisson's ratio 0, since a section has no
/// material. With this ratio shear stresses are a gradient. Energy and Cowper's coefficients then agree, as do the
/// shear centres of Saint-Venant and Trefftz.
struct SaintVenant {
  double torsion_constant = 0.0;                           ///< J [length⁴]
  Eigen::Vector2d shear_center = Eigen::Vector2d::Zero();  ///< position (y, z) from the centroid
  Eigen::Matrix2d shear_compliance =
      Eigen::Matrix2d::Zero();  ///< C [1/area]: shear strains γ follow from G γ = C Q for shear forces Q = (Qy, Qz)
};

/// Constants of torsion and shear of a polygon, from Neumann problems of Laplace's equation about the centroid ([Pil02]
/// chapters 5 and 6 pose them, for finite elements):
///   torsion ∇²ω = 0, ∂ω/∂n = z n_y − y n_z; J = Iy + Iz − ∮ω ∂ω/∂n ds;
///   shear ∇²ψ_y = −y, ∇²ψ_z = −z, ∂ψ/∂n = 0; C = Q⁻¹ [∫ψ_i x_j dA] Q⁻¹, Q = [Iz Iyz; Iyz Iy];
///   centre ∫(ω − z_s y + y_s z) y dA = 0, and likewise with z instead of the last y (Trefftz).
/// With ψ = h + a particular polynomial, all unknowns are harmonic and area integrals become boundary integrals.
/// Collocation of Green's formula ½u + ∫∂G/∂n u ds = ∫G ∂u/∂n ds uses cubic polynomials between four Gauss points per
/// panel, with closed integrals. Panels shrink towards corners. The relative error is about 1e-5, also for J of walls
/// as thin as 1/1000 of their length, but not for spikes (is_resolved()). Cost: 2 to 50 ms.
SaintVenant saint_venant(const SectionPolygon& polygon);

}  // namespace tisserand::formats
