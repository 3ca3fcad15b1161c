// SPDX-License-Identifier: GPL-3.0-or-later
// Part of the step tangent that inertia option M adds to that of option B: the exact motion of the centre of mass.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/tangent/work.hpp"

namespace tisserand::mechanism {

/// Changes the step tangent of inertia option B in work.A_BB and the stored A_BI and A_IB to that of option M,
/// THEORY (37). Internal coordinates are not eliminated. The change is the tangent of m Jᵀ R₀ᵀẍ_cm, with δx_cm = R₀ J
/// δq, less that of the kinetic energy ½ m |v̄|² of the interpolated centre of mass, v̄ = Γ ẏ/m, Γ = Φ_TᵀM̄:
/// ΔA = m Jᵀ (c_m J + c_c A_v) − [W Γᵀ Γ P + Pᵀ Γᵀ Γ (Z − c_m P)]/m
/// W and Z are those of A_BI = W M_BI and A_IB = M_IB Z, without damping. A_v = 2 (Ω₀~ J + J̇) − J Ω~ is the derivative
/// of R₀ᵀẍ_cm by the velocities, in which J Ω~ acts on rotations alone. U̇ in J̇ and the gyroscopic coupling 2 Γ_Iᵀ Ω₀~
/// Γ_I/m of internal coordinates are omitted, which keeps A_II diagonal. Both are of the order of deformation times
/// rate.
void add_center_of_mass_tangent(const SuperelementBody& body, SuperelementScratch& scratch, SuperelementWork& work);

}  // namespace tisserand::mechanism
