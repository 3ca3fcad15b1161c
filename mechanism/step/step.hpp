// SPDX-License-Identifier: GPL-3.0-or-later
// Time step of the constrained equations on SO(3): generalised alpha and HHT, index 3 and stabilised index 2.
//
// The numbers are those of docs/THEORY.md, section 10. The calls in step.cpp cite them. ∘ exp: retract(), on
// SO(3) the exponential of a material rotation vector. a: the algorithmic acceleration.
//   (58) r(q, v, v̇, λ, t) = G_iner + G_int + Bᵀλ − F = 0,  Φ(q, t) = 0                                    [BCA12] (1)
//   (62) (1−α_m) a_{n+1} + α_m a_n = (1−α_f) v̇_{n+1} + α_f v̇_n                                           [BCA12] (8)
//   (63) v_{n+1} = v_n + h ((1−γ) a_n + γ a_{n+1})
//   (64) q_{n+1} = q_n ∘ exp(h v_n + h² ((1/2−β) a_n + β a_{n+1}) + δ)
//   (67) index 3: δ = 0. Stabilised index 2: B v_{n+1} + Φ_t = 0 in place of Φ = 0 in (58), and δ with W δ + Bᵀμ = 0
//        brings Φ(q_{n+1}) to zero; W = c_m M + c_k K of the bodies                                         [GGL85],
//        [ABC15]
//   (68) Unknowns: d = h² β Δa and Δλ. Δv̇ = c_m d, Δv = c_c d, Δq = c_k d (+ δ) with
//        c_m = (1−α_m)/((1−α_f) β h²), c_c = γ/(β h), c_k = 1
//   (69) [A Bᵀ; B̂ 0][d; Δλ] = −[r; φ], A = c_m ∂r/∂v̇ + c_c ∂r/∂v + c_k ∂r/∂q
//   (70) Index 3: φ = Φ, B̂ = B T(θ), since d is an increment of the rotation vector θ of the step. Stabilised:
//        φ = (β h/γ)(B v + Φ_t), B̂ = B + (β h/γ) ∂(B v)/∂q
#pragma once

#include "formats/scene/scene.hpp"
#include "mechanism/step/step_report.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// End of a step: its instant, and the instant at which loads are evaluated there, just before a jump.
struct StepEnd {
  double time = 0.0;
  double load_time = 0.0;
};

/// Computes one step from `state` to `end`. Requires an accepted, consistent state. On any outcome but `accepted`
/// positions, velocities and accelerations are unchanged. If the rank of the constraints changed (omitted rows are
/// violated, or the step fails in an overconstrained mechanism), the rows are chosen again and the step is repeated.
/// Only a new choice of rows allocates memory.
[[nodiscard]] StepReport advance(const Model& model, const formats::IntegratorSpec& options, const StepEnd& end,
                                 State& state, Workspace& workspace);

}  // namespace tisserand::mechanism
