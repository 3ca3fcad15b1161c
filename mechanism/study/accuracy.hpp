// SPDX-License-Identifier: GPL-3.0-or-later
// Run whose tolerance and modes follow from the requested error (`accuracy` of the integrator).
#pragma once

#include "mechanism/simulate.hpp"

namespace tisserand::mechanism {

/// Runs the analysis with falling tolerances until the estimated error of the chosen channel is at most the requested
/// one. The estimate follows from the changes between runs. The results are those of the last run. The first run has
/// half of the modes of all superelements that name none. If it differs too much, one run has all of them. If the upper
/// half does not affect the channel, runs continue without it, and without half of the rest. Notes report tolerance,
/// estimate, modes and cost. A warning says if the error is not reached, or not by a run of ten minutes or 20 times the
/// first one, or if files hold too few modes.
///
/// E_n = max(d_n (τ_n/τ_{n-1})^p, d_{n-1} (τ_n/τ_{n-2})^p, d_n (N_{n-1}/N_n)^{s p}) from the differences d of runs with
/// tolerances τ and N steps. p is 0.7 (radau 0.5), or 0.9 of the observed order if that is less. s is 2 (radau 5). The
/// first tolerance is 10 times the error (radau: 0.03, or 1e-6 for rates of what may vibrate). The second is an eighth
/// of it (radau: a tenth, or a thirtieth). Each further one aims at 0.4 of the error. Without a named method radau is
/// used where possible (formats/SCENE.md). Throws Error: the channel is not stored, or stays zero.
RunEnd simulate_to_accuracy(const RunRequest& request, const RunControl& control);

}  // namespace tisserand::mechanism
