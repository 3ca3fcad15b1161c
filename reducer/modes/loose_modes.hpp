// SPDX-License-Identifier: GPL-3.0-or-later
// Intended mechanisms inside a part. The reduction holds one coordinate of each, which then becomes internal.
#pragma once

#include <vector>

#include "reducer/algebra/null_space.hpp"
#include "reducer/modes/internal_modes.hpp"

namespace tisserand::reducer {

/// Partition `p` with the internal coordinates `pins` after those of the boundary: the remaining inside is stiff.
Partition pinned(const Partition& p, const std::vector<int>& pins);

/// Converts a reduction of the pinned part (n_B + k boundary coordinates, the last k of them pins) to that of the part
/// `problem`. The static modes of the pins are the motions N without stiffness. Ψ = Ψ_B + N c takes c of them, the
/// pins' rigid motions with the boundary: c = R_P R_B⁺. Internal vectors are N, M_II-orthonormal with eigenvalue 0,
/// then the eigenvectors of the modes without their share of N. Throws Error if a motion has no mass either.
void release_pins(const InternalProblem& problem, const std::vector<int>& pins, BoundaryModes& boundary,
                  InternalModes& internal);

/// Static answer x = S_II⁺ f with xᵀ M_II N = 0 for forces f − M_II N Nᵀ f, which do no work on N. `problem.S_II` is
/// the factor of the pinned part. Without a mechanism x is S_II⁻¹ f.
Eigen::MatrixXd static_answers(const InternalProblem& problem, const InternalModes& internal, const Eigen::MatrixXd& f);

}  // namespace tisserand::reducer
