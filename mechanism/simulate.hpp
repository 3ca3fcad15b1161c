// One run of a scene, from the file to the results: the story of this stage.
#pragma once

#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/run/attempt.hpp"

namespace tisserand::mechanism {

/// Builds the model, starts, runs the analysis and writes its results. Throws Error for faults of the input.
RunEnd simulate(const RunRequest& request, const RunControl& control);

/// The same for a scene of one analysis.
RunReport simulate(const formats::Scene& scene, const std::string& path, const RunControl& control);

/// Builds and starts but runs nothing: counts and notes.
RunReport inspect(const formats::Scene& scene, const RunControl& control);

}  // namespace tisserand::mechanism
