// SPDX-License-Identifier: GPL-3.0-or-later
// A run of a scene from its start to its report, and repeated runs of a scene with automatic effects.
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

/// Request to run one analysis: its input, its start, and the destination of its rows.
struct RunRequest {
  const formats::Scene& scene;  ///< scene with the kind and settings of this analysis (formats::scene_of)
  const BodyFiles& files;
  std::optional<State> begin = {};   ///< end of another analysis of the same scene, instead of the poses of the bodies
  std::string path = {};             ///< path of the results; empty: none are stored
  std::string restart = {};          ///< checkpoint or results file from which to continue; empty: none
  std::optional<double> at = {};     ///< instant in a results file; absent: the last one
  Joining joining = Joining::apart;  ///< with `restart`: whether the rows until then are copied
  ChangedValues changed = ChangedValues::refused;  ///< with `restart`: whether changed values are accepted
  RunListener* listener = nullptr;
};

struct RunEnd {
  RunReport report;
  State state;
};

class Attempt {
 public:
  /// `scene`: that of the request, or a copy with fewer effects.
  Attempt(const RunRequest& request, const formats::Scene& scene, const RunControl& control);
  Run& run() { return run_; }

  /// Starts from `begin`, from the poses of the scene (absent), or from the restart file of the request.
  void start_from(const std::optional<State>& begin);
  /// Runs the analysis, writes its rows and finishes the results. `automatic` has chosen the effects and monitors them
  /// (null: none is automatic). Absent: the run must begin again with other effects, and its results are discarded.
  std::optional<RunEnd> finish(AutomaticEffects* automatic);

 private:
  const RunRequest& request_;
  double began_ = 0.0, began_start_ = 0.0;
  Run run_;
};

/// Runs with as few effects as possible, again until all that matter are on. `whole`: the run with all on.
RunEnd run_with_fewest(const RunRequest& request, const RunControl& control, AutomaticEffects& automatic,
                       Attempt& whole);

}  // namespace tisserand::mechanism
