// SPDX-License-Identifier: GPL-3.0-or-later
// Projection of S and M on boundary and internal modes: reduced matrices of the superelement file.
#pragma once

#include "formats/part/part.hpp"
#include "formats/superelement/superelement.hpp"
#include "reducer/modes/boundary_modes.hpp"
#include "reducer/modes/internal_modes.hpp"

namespace tisserand::reducer {

/// Deviations of the reduced matrices from the exact canonical form before project() corrects them, relative to the
/// largest entries.
struct ProjectionDefects {
  double stiffness_coupling = 0.0;  ///< largest |S̄_BI|, which is 0 in theory
  double orthonormality = 0.0;      ///< largest |Φᵀ M_II Φ − 1| of the internal vectors Φ
  double rigid_residual = 0.0;      ///< largest |S̄ R| with the rigid motions R, before project() removes it
};

/// Superelement of a projection, with the deviations that were removed from it.
struct Projection {
  formats::Superelement superelement;
  ProjectionDefects defects;
};

/// Projects S and M on the basis of THEORY (79), which gives the reduced matrices S̄ and M̄ of THEORY (80),
/// symmetrised ([Car00] (25), (38)). The canonical form of THEORY (7) is set exactly: S̄_BI = 0, M̄_II = 1, and S̄_II
/// = Λ, ascending. A projection makes S̄ R = 0 exact for the rigid motions R.
Projection project(const formats::Part& part, const InternalProblem& problem, const BoundaryModes& boundary,
                   const InternalModes& internal);

}  // namespace tisserand::reducer
