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

/// Paths of the files that a run of the scene reads and must not replace.
std::vector<std::string> inputs(const formats::Scene& scene);

/// Path of the results file of a run: `asked`, or empty for the default of the scene. `asked`: path that the user
/// gives, or empty. With Joining::appended the default is the results file of the restarted run. Throws Error for
/// Joining::appended without `restart`. It also throws for a restarted run that does not append and has no `asked`, or
/// one that would overwrite the previous run.
std::string output_of(const std::string& asked, Joining joining, const std::optional<RestartFile>& restart);

}  // namespace tisserand::mechanism
