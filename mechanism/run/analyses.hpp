// SPDX-License-Identifier: GPL-3.0-or-later
// Plan of the analyses of a scene: which of them a command runs, in which order, and the paths of their results.
#pragma once

#include <string>
#include <vector>

#include "formats/scene/scene.hpp"

namespace tisserand::mechanism {

/// Analysis that a command runs: its scene, its start and the path of its results.
struct PlannedAnalysis {
  std::string name;  ///< name of the analysis; empty: the only one of a scene without names
  /// Name of the planned analysis at whose end this one starts. Empty: it starts from the poses of the scene.
  std::string from;
  formats::Scene scene;  ///< scene with the kind and settings of this analysis
  std::string results;   ///< path of its results file
};

/// Path of a results file, and who chose it.
struct OutputName {
  std::string path;
  bool chosen = false;  ///< whether -o gives the path; otherwise it follows from the name of the scene
};

/// Plan of the analyses to run. It holds the analysis `name`, after those from which it starts; an empty `name` means
/// all analyses in the order of the file. A path given by -o belongs to the analysis `name`, or to the only one. Paths
/// of other analyses contain the name of the analysis. Throws Error with the nearest name if there is no such analysis.
std::vector<PlannedAnalysis> plan(const formats::Scene& scene, const std::string& name, const OutputName& output);

/// Path of a results file with the name of an analysis added: "arm.results.h5", "shake" -> "arm.shake.results.h5".
std::string with_name(const std::string& results, const std::string& name);

}  // namespace tisserand::mechanism
