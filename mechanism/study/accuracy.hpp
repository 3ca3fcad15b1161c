// A run whose tolerance and modes follow from the error that is asked for (`accuracy` of the integrator).
#pragma once

#include "mechanism/simulate.hpp"

namespace tisserand::mechanism {

/// Runs the analysis with falling tolerances until the error of the chosen channel, estimated from what the last of
/// them changed, is at most the one asked for; the results are those of the last run. The first run has half of the
/// modes of all superelements that name none; where it differs by too much there is one with all of them. Where the
/// channel does not feel the upper half the runs go on without them, and half of what is left. Notes of the report tell
/// tolerance, estimate and modes with what the runs cost; a doubt, where the error cannot be reached, or not by a run of
/// ten minutes or of 20 times the first one, or files hold too few modes.
///
/// E_n = max(d_n (τ_n/τ_{n-1})^p, d_{n-1} (τ_n/τ_{n-2})^p, d_n (N_{n-1}/N_n)^{s p}) from the differences d of runs with
/// tolerances τ and N steps. The order p is 0.7, of radau 0.5, or 0.9 of what was seen where that is less; s is 2, of
/// radau 5. The first tolerance is ten times the error asked for (radau: 0.03; a millionth for rates of what may
/// vibrate), the second an eighth (a tenth, a thirtieth) of it, each further one aims at 0.4 of the error. A method that
/// is not named is radau where that can (formats/SCENE.md). Throws Error: the channel is not stored, or stays zero.
RunEnd simulate_to_accuracy(const RunRequest& request, const RunControl& control);

}  // namespace tisserand::mechanism
