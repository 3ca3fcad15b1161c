// SPDX-License-Identifier: GPL-3.0-or-later
// Intended mechanisms inside a part. The reduction holds one coordinate of each, which then becomes internal.
#pragma once

#include <vector>

#include "reducer/algebra/null_space.hpp"
#include "reducer/modes/internal_modes.hpp"

namespace tisserand::reducer {

/// Partition `p` with the interior coordinates `pins` appended to the boundary. One pin per mechanism makes the
/// remaining interior stiff. `pins`: indices in Partition::internal, ascending.
Partition pinned(const Partition& p, const std::vector<int>& pins);

/// Converts the reduction of the pinned part (k pins as the last boundary coordinates) to that of the part `problem`,
/// in which the pins are interior coordinates. The boundary modes of the pins are the motions N without stiffness. The
/// boundary modes become Ψ_B + N c, where c = R_P R_B⁺ lets the pins follow rigid motions of the boundary (R_P, R_B:
/// rows of System::R). The internal vectors become N, M_II-orthonormal with eigenvalue 0, then the internal modes made
/// orthogonal to N and solved for eigenvectors again. Throws Error if a motion without stiffness moves no mass either.
void release_pins(const InternalProblem& problem, const std::vector<int>& pins, BoundaryModes& boundary,
                  InternalModes& internal);

/// Static displacements of the interior under forces `f` with the boundary held (n_I x columns of `f`). A mechanism
/// has motions N without stiffness, the first loose() internal vectors. Then the result x has xᵀ M_II N = 0, and the
/// forces are reduced to f − M_II N Nᵀ f, which do no work on N. `problem.S_II` is the factor of the pinned part.
/// Without a mechanism x = S_II⁻¹ f.
Eigen::MatrixXd static_answers(const InternalProblem& problem, const InternalModes& internal, const Eigen::MatrixXd& f);

}  // namespace tisserand::reducer
