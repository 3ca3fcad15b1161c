// SPDX-License-Identifier: GPL-3.0-or-later
// Run whose tolerance and modes follow from the requested error (`accuracy` of the integrator).
#pragma once

#include "mechanism/simulate.hpp"

namespace tisserand::mechanism {

/// Runs the analysis with falling tolerances until the estimated error of the chosen channel is at most the requested
/// one (`accuracy` of the integrator). The estimate follows from the changes between runs. Returns the last run, and
/// its results are stored. Throws Error if the channel is not stored or stays zero, or if `request` continues from a
/// file.
///
/// The first run has half of the modes of all superelements for which the scene gives no number of modes. If it differs
/// too much from the second run, one run has all modes. If the upper half of the modes does not affect the channel,
/// runs continue without it, and without half of the rest. Notes report tolerance, estimate, modes and cost. A warning
/// says if the error is not reached, or would need a run of more than ten minutes or of 20 times the first one. A
/// warning also says if files hold too few modes.
///
/// The estimate of run n is E_n = max(d_n (τ_n/τ_{n-1})^p, d_{n-1} (τ_n/τ_{n-2})^p, d_n (N_{n-1}/N_n)^{s p}). d are the
/// differences of consecutive runs, with tolerances τ and N steps. p is 0.7 (radau 0.5), or 0.9 of the observed order
/// if that is less. s is 2 (radau 5). The first tolerance is 10 times the error (radau: 0.03, or 1e-6 for rates of what
/// may vibrate). The second one is an eighth of it (radau: a tenth, or a thirtieth). Each further one aims at 0.4 of
/// the error. Without a named method radau is used where possible (formats/SCENE.md).
RunEnd simulate_to_accuracy(const RunRequest& request, const RunControl& control);

}  // namespace tisserand::mechanism
