// One run of a scene, from the file to the results: the story of this stage.
#pragma once

#include <optional>
#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/build/build_model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/run/checkpoint.hpp"
#include "mechanism/run/report.hpp"
#include "mechanism/run/run.hpp"

namespace tisserand::mechanism {

/// One analysis of a scene: what it reads and starts from, and where its rows go.
struct RunRequest {
  const formats::Scene& scene;  ///< with the kind and the settings of this analysis (formats::scene_of)
  const BodyFiles& files;
  std::optional<State> begin;        ///< end of another analysis of the same scene, in place of the poses of the bodies
  std::string path;                  ///< of the results
  std::string restart;               ///< checkpoint or results file to go on from; empty: none
  std::optional<double> at;          ///< instant in a results file; absent: the last one
  Joining joining = Joining::apart;  ///< with `restart`: whether the rows until then are taken over
  ChangedValues changed = ChangedValues::refused;  ///< with `restart`
  RunListener* listener = nullptr;
};

struct RunEnd {
  RunReport report;
  State state;
};

/// Builds the model, starts, runs the analysis and writes its results. Throws Error for faults of the input.
RunEnd simulate(const RunRequest& request, const RunControl& control);

/// The same for a scene of one analysis.
RunReport simulate(const formats::Scene& scene, const std::string& path, const RunControl& control);

/// Builds and starts but runs nothing: counts and notes.
RunReport inspect(const formats::Scene& scene, const RunControl& control);

}  // namespace tisserand::mechanism
