// Names of the files that commands read and write.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/run/checkpoint.hpp"

namespace tisserand::mechanism {

/// "dir/pendulum.scene.yaml" -> "dir/pendulum.results.h5": outputs lie beside what they are made of.
std::string default_results(const std::string& scene);

/// "dir/pendulum.results.h5" -> "dir/pendulum.html".
std::string default_page(const std::vector<std::string>& results, const char* ending);

/// The files that a run reads and must not replace.
std::vector<std::string> inputs(const formats::Scene& scene);

/// The results file that was asked for; empty: that of the scene. A run that goes on from a file never overwrites what
/// the file belongs to. Throws Error.
std::string output_of(const std::string& asked, Joining joining, const std::optional<RestartFile>& restart);

}  // namespace tisserand::mechanism
