// SPDX-License-Identifier: GPL-3.0-or-later
// Loop of method: bdf: steps, rows, jumps of loads.
#pragma once

#include "mechanism/run/run.hpp"

namespace tisserand::mechanism {

/// Integrates with `method: bdf` from the started state to the end. Counts and outcome go to the report. Rows at
/// instants of `interval` are interpolated. Throws Error in a build without CVODE.
void integrate_bdf(Run& run, RowWriter& out);

}  // namespace tisserand::mechanism
