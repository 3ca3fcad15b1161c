// Intended mechanisms inside a part. The part is reduced with one coordinate of each held, which then becomes internal.
#pragma once

#include <vector>

#include "reducer/algebra/null_space.hpp"
#include "reducer/modes/internal_modes.hpp"

namespace tisserand::reducer {

/// `p` with the internal coordinates `pins` behind those of the boundary: what is left inside is stiff.
Partition pinned(const Partition& p, const std::vector<int>& pins);

/// From a reduction of the pinned part (n_B + k boundary coordinates, of which the last k are pins) to that of the part
/// itself. The static modes of the pins are the motions N without stiffness. Ψ takes c of them, the pins of the rigid
/// motions of the boundary: Ψ = Ψ_B + N c, c = R_P R_B⁺. Inside the vectors are N, M_II-orthonormal, with eigenvalue 0
/// and first; then the eigenvectors of what is left of the modes without N. `problem` is that of the part itself.
/// Throws Error if a motion has no mass either.
void release_pins(const InternalProblem& problem, const std::vector<int>& pins, BoundaryModes& boundary,
                  InternalModes& internal);

/// x = S_II⁺ f with xᵀ M_II N = 0 for forces f less M_II N Nᵀ f, which do no work on N; `problem.S_II` is the factor of
/// the pinned part. Without a mechanism S_II⁻¹ f.
Eigen::MatrixXd static_answers(const InternalProblem& problem, const InternalModes& internal, const Eigen::MatrixXd& f);

}  // namespace tisserand::reducer
