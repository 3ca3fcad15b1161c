// The analyses of a scene by name: which of them a command means, in which order, and where their results go.
#pragma once

#include <string>
#include <vector>

#include "formats/scene/scene.hpp"

namespace tisserand::mechanism {

struct PlannedAnalysis {
  std::string name;      ///< empty: the only analysis of a scene without names
  std::string from;      ///< of those planned before it
  formats::Scene scene;  ///< with its kind and settings
  std::string results;
};

/// What the user said about the results file.
struct OutputName {
  std::string path;
  bool chosen = false;  ///< by -o, or made from the name of the scene
};

/// The analysis `name` of the scene and before it those that it starts from, directly or not; all analyses in the order
/// of the file if `name` is empty. A path that was chosen is that of the named or only analysis; where a scene has
/// several, the files of the others carry their names. Throws Error with the nearest name if there is no such analysis.
std::vector<PlannedAnalysis> plan(const formats::Scene& scene, const std::string& name, const OutputName& output);

/// "arm.results.h5", "shake" -> "arm.shake.results.h5".
std::string with_name(const std::string& results, const std::string& name);

}  // namespace tisserand::mechanism
