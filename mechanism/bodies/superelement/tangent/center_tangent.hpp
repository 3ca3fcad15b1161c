// The part of the step tangent that inertia option M adds to that of option B: the exact motion of the centre of mass.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/tangent/work.hpp"

namespace tisserand::mechanism {

/// Turns the step tangent of B in work.A_BB and the stored A_BI and A_IB into those of M, THEORY (37); internal
/// coordinates are not eliminated. It adds the tangent of m Jᵀ R₀ᵀẍ_cm, with δx_cm = R₀ J δq, less that of the kinetic
/// energy ½ m |v̄|² of the interpolated centre of mass, v̄ = Γ ẏ/m, Γ = Φ_TᵀM̄:
///   ΔA = m Jᵀ (c_m J + c_c A_v) − [W Γᵀ Γ P + Pᵀ Γᵀ Γ (Z − c_m P)]/m
/// where W and Z are those of A_BI = W M_BI and A_IB = M_IB Z (without damping), and A_v = 2 (Ω₀~ J + J̇) − J
/// Ω~ (the last on rotations) is the derivative of R₀ᵀẍ_cm with respect to the velocities. Left out are U̇ in J̇ and the
/// gyroscopic coupling 2 Γ_Iᵀ Ω₀~ Γ_I/m of internal coordinates, which keep A_II diagonal; both are of the order of
/// deformation times rate.
void add_center_of_mass_tangent(const SuperelementBody& body, SuperelementScratch& scratch, SuperelementWork& work);

}  // namespace tisserand::mechanism
