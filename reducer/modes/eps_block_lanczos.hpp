// SPDX-License-Identifier: GPL-3.0-or-later
// Block Lanczos iteration as an additional type of SLEPc's EPS.
#pragma once

#include <exception>

struct _p_EPS;

namespace tisserand::reducer {

/// Name of the type for EPSSetType.
inline constexpr const char* eps_block_lanczos = "block_lanczos";

/// Whether SLEPc's header for new solvers (slepc/private/epsimpl.h) was found when this program was configured.
bool has_block_lanczos();

/// Registers the type with SLEPc, if available. May be called repeatedly while SLEPc runs.
///
/// It solves symmetric problems (EPS_HEP, EPS_GHEP with a semidefinite B) by shift and inversion, with a target below
/// the spectrum. Solutions and products come in blocks: the linear solver should have KSPMatSolve (a shell:
/// PCShellSetMatApply). An iteration is one block. Honours dimensions, tolerances, convergence and stopping tests,
/// monitors, initial and deflation space. Finally it takes one step of inverse iteration on all pairs
/// (inverse_iteration.hpp), unless EPSSetPurify is off. Error estimates are then the residuals of this step.
/// EPS_DIVERGED_BREAKDOWN: the basis cannot grow, or the target is not below the spectrum. Option:
/// -eps_block_lanczos_size, the columns of a block.
void register_block_lanczos();

/// Exception that ended the last EPSSolve of this type, which returned an error code for it; otherwise null.
std::exception_ptr block_lanczos_failure(_p_EPS* eps);

}  // namespace tisserand::reducer
