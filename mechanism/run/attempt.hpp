// A run of a scene from its start to its report, and runs of a scene that chooses its effects.
#pragma once

#include <optional>
#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/build/build_model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/run/automatic_effects.hpp"
#include "mechanism/run/checkpoint.hpp"
#include "mechanism/run/report.hpp"
#include "mechanism/run/run.hpp"

namespace tisserand::mechanism {

/// One analysis of a scene: what it reads and starts from, and where its rows go.
struct RunRequest {
  const formats::Scene& scene;  ///< with the kind and the settings of this analysis (formats::scene_of)
  const BodyFiles& files;
  std::optional<State> begin = {};   ///< end of another analysis of the same scene, in place of the poses of the bodies
  std::string path = {};             ///< of the results; empty: none are stored
  std::string restart = {};          ///< checkpoint or results file to go on from; empty: none
  std::optional<double> at = {};     ///< instant in a results file; absent: the last one
  Joining joining = Joining::apart;  ///< with `restart`: whether the rows until then are taken over
  ChangedValues changed = ChangedValues::refused;  ///< with `restart`
  RunListener* listener = nullptr;
};

struct RunEnd {
  RunReport report;
  State state;
};

class Attempt {
 public:
  /// `scene`: that of the request, or the same with fewer effects.
  Attempt(const RunRequest& request, const formats::Scene& scene, const RunControl& control);
  Run& run() { return run_; }

  /// From there, from the poses of the scene (absent), or from the file of the request.
  void start_from(const std::optional<State>& begin);
  /// Runs the analysis, writes its rows and finishes the results. `automatic`: what has chosen the effects, and watches;
  /// null: nothing is automatic. Absent: the run must begin again with other effects, and nothing of it stays.
  std::optional<RunEnd> finish(AutomaticEffects* automatic);

 private:
  const RunRequest& request_;
  double began_ = 0.0, began_start_ = 0.0;
  Run run_;
};

/// Runs with as few effects as can be, until one has all that matter; `whole`: the run with all of them on.
RunEnd run_with_fewest(const RunRequest& request, const RunControl& control, AutomaticEffects& automatic,
                       Attempt& whole);

}  // namespace tisserand::mechanism
