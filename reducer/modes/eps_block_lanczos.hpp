// Block Lanczos iteration as an additional type of SLEPc's EPS.
#pragma once

#include <exception>

struct _p_EPS;

namespace tisserand::reducer {

/// The name that EPSSetType takes.
inline constexpr const char* eps_block_lanczos = "block_lanczos";

/// False where SLEPc's header for new solvers (slepc/private/epsimpl.h) was missing when this program was configured.
bool has_block_lanczos();

/// Makes the type known to SLEPc, if there is one; once or more often, while SLEPc runs.
///
/// It solves symmetric problems (EPS_HEP, EPS_GHEP with a semidefinite B) by shift and inversion, with a target below
/// the spectrum. Solutions and products come in blocks: the linear solver should have KSPMatSolve (a shell:
/// PCShellSetMatApply). An iteration is one block. Honours dimensions, tolerances, convergence and stopping tests,
/// monitors, initial and deflation space. At the end follows one step of inverse iteration on all pairs
/// (inverse_iteration.hpp), unless EPSSetPurify is off; then error estimates are the residuals that this step measures.
/// EPS_DIVERGED_BREAKDOWN: the basis cannot grow, or the target is not below the spectrum. Option:
/// -eps_block_lanczos_size, the columns of a block.
void register_block_lanczos();

/// The exception that ended the last EPSSolve of this type, which returned an error code for it; else null.
std::exception_ptr block_lanczos_failure(_p_EPS* eps);

}  // namespace tisserand::reducer
