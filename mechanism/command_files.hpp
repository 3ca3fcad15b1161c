// SPDX-License-Identifier: GPL-3.0-or-later
// Names of the files that commands read and write.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/run/checkpoint.hpp"

namespace tisserand::mechanism {

/// Default results file in the folder of the scene: "dir/pendulum.scene.yaml" -> "dir/pendulum.results.h5".
std::string default_results(const std::string& scene);

/// Default page or picture in the folder of the first results: "dir/pendulum.results.h5" -> "dir/pendulum.html".
std::string default_page(const std::vector<std::string>& results, const char* ending);

/// Files that a run reads and must not replace.
std::vector<std::string> inputs(const formats::Scene& scene);

/// Results file of a run: `asked`, or empty for the default of the scene. A restarted run never overwrites the results
/// of its restart file unless it appends to them. Throws Error.
std::string output_of(const std::string& asked, Joining joining, const std::optional<RestartFile>& restart);

}  // namespace tisserand::mechanism
