// SPDX-License-Identifier: GPL-3.0-or-later
// Projection of S and M on boundary and internal modes: reduced matrices of the superelement file.
#pragma once

#include "formats/part/part.hpp"
#include "formats/superelement/superelement.hpp"
#include "reducer/modes/boundary_modes.hpp"
#include "reducer/modes/internal_modes.hpp"

namespace tisserand::reducer {

/// Deviations of the projection from its exact form before correction, relative to the largest entries.
struct ProjectionDefects {
  double stiffness_coupling = 0.0;  ///< |S̄_BI|, exactly 0 in theory
  double orthonormality = 0.0;      ///< |Φᵀ M_II Φ − 1|
  double rigid_residual = 0.0;      ///< |S̄ R| before the rigid motions were projected out
};

struct Projection {
  formats::Superelement superelement;
  ProjectionDefects defects;
};

/// Projection [Car00] (25), (38) with T = [1 0; Ψ Φ]: S̄ = diag(S_BB + S_BI Ψ + Ψᵀ(S_IB + S_II Ψ), Λ), M̄ = [M_BB +
/// M_BI Ψ + Ψᵀ M_IB + Ψᵀ M_II Ψ, (M_BI + Ψᵀ M_II) Φ; ., 1], symmetrised. The canonical form is exact: S̄_BI = 0, M̄_II
/// = 1, S̄_II = Λ ascending, and S̄ R = 0 by projection.
Projection project(const formats::Part& part, const InternalProblem& problem, const BoundaryModes& boundary,
                   const InternalModes& internal);

}  // namespace tisserand::reducer
