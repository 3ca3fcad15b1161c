// Lowest eigenpairs of large pencils: eight or sixteen right-hand sides at a time, so that the factor is read once for
// all of them.
#pragma once

#include <optional>

#include "reducer/modes/spectrum.hpp"

namespace tisserand::reducer {

/// Columns of a block: at most that many eigenvectors of one eigenvalue are found for certain. 16 where many
/// pairs are wanted, else 8: wider blocks take a fifth more columns in all, but orthogonalisation reads the basis half
/// as often.
int lanczos_block(int wanted);

/// The `wanted` lowest pairs and those that converged with them, ascending, Xᵀ M X = 1, by block Lanczos iteration with
/// (S − shift M)⁻¹ M, which is symmetric in the inner product of M: three-term recurrence, one pass of
/// orthogonalisation against all earlier vectors, thick restart [WS00]. Converged: ‖OP x − μ x‖_M ≤ 1e-9 μ, μ = 1/(λ −
/// shift). Starts from the same random numbers always. Empty if the basis cannot grow (an invariant subspace, hardly
/// any mass) or does not converge. Memory: about 2.5 `wanted` + 80 vectors. If the factor lies on several ranks, so do
/// the vectors while it runs, and sums over rows are sums over ranks.
std::optional<EigenPairs> block_lanczos(const Pencil& pencil, int wanted);

/// What the followers do meanwhile.
void help_to_search(const Mumps& factor, int wanted);

}  // namespace tisserand::reducer
