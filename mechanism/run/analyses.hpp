// SPDX-License-Identifier: GPL-3.0-or-later
// Plan of the analyses of a scene: which of them a command runs, in which order, and the paths of their results.
#pragma once

#include <string>
#include <vector>

#include "formats/scene/scene.hpp"

namespace tisserand::mechanism {

struct PlannedAnalysis {
  std::string name;      ///< empty: the only analysis of a scene without names
  std::string from;      ///< name of an analysis planned before it; empty: none
  formats::Scene scene;  ///< scene with the kind and settings of this analysis
  std::string results;
};

/// Path of the results file.
struct OutputName {
  std::string path;
  bool chosen = false;  ///< true: given by -o; false: made from the name of the scene
};

/// Plan with the analysis `name` of the scene, after those from which it starts. An empty `name` means all in the order
/// of the file. A path given by -o belongs to the named or only analysis. Paths of the others contain their names.
/// Throws Error with the nearest name if there is no such analysis.
std::vector<PlannedAnalysis> plan(const formats::Scene& scene, const std::string& name, const OutputName& output);

/// Path with the name of an analysis: "arm.results.h5", "shake" -> "arm.shake.results.h5".
std::string with_name(const std::string& results, const std::string& name);

}  // namespace tisserand::mechanism
