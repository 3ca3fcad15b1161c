// SPDX-License-Identifier: GPL-3.0-or-later
// Block Lanczos iteration as an additional type of SLEPc's EPS.
#pragma once

#include <exception>

struct _p_EPS;

namespace tisserand::reducer {

/// Name under which register_block_lanczos() adds the method to SLEPc, for EPSSetType.
inline constexpr const char* eps_block_lanczos = "block_lanczos";

/// Whether SLEPc's header for new solvers (slepc/private/epsimpl.h) was found when this program was configured.
bool has_block_lanczos();

/// Registers block Lanczos as an EPS type of SLEPc, if has_block_lanczos(). May be called repeatedly while SLEPc is
/// initialised.
///
/// The type solves symmetric problems (EPS_HEP, or EPS_GHEP with a semidefinite B) by shift and inversion. It requires
/// a target below the spectrum. It solves and multiplies blocks of columns, so the linear solver should have
/// KSPMatSolve (a shell: PCShellSetMatApply). One iteration of the EPS is one block. The type honours dimensions,
/// tolerances, convergence and stopping tests, monitors, and the initial and deflation spaces. At the end it applies
/// one step of inverse iteration to all pairs (inverse_iteration.hpp), unless EPSSetPurify is off. The error estimates
/// are then the residuals of this step. EPS_DIVERGED_BREAKDOWN means that the basis cannot grow or that the target is
/// not below the spectrum. The option -eps_block_lanczos_size sets the number of columns of a block.
void register_block_lanczos();

/// Exception for which the last EPSSolve of this type returned an error code; null if there was none.
std::exception_ptr block_lanczos_failure(_p_EPS* eps);

}  // namespace tisserand::reducer
