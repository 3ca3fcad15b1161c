// SPDX-License-Identifier: GPL-3.0-or-later
// One run of a scene, from the file to the results.
#pragma once

#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/run/attempt.hpp"

namespace tisserand::mechanism {

/// Builds the model, starts, runs the analysis and writes its results. Returns the report and the last state. Throws
/// Error for errors in the input.
RunEnd simulate(const RunRequest& request, const RunControl& control);

/// Runs a scene with one analysis and writes the results to `path`. Throws Error.
RunReport simulate(const formats::Scene& scene, const std::string& path, const RunControl& control);

/// Builds and starts the model without running it. Returns a report with counts and notes. Throws Error.
RunReport inspect(const formats::Scene& scene, const RunControl& control);

}  // namespace tisserand::mechanism
