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
  /// End state of another analysis of the scene, from which to start; absent: the poses of the bodies.
  std::optional<State> begin = {};
  std::string path = {};             ///< path of the results; empty: none are stored
  std::string restart = {};          ///< checkpoint or results file from which to continue; empty: none
  std::optional<double> at = {};     ///< instant in a results file; absent: the last one
  Joining joining = Joining::apart;  ///< with `restart`: whether the rows of the previous run are copied first
  ChangedValues changed = ChangedValues::refused;  ///< with `restart`: whether changed values are accepted
  RunListener* listener = nullptr;
};

/// End of a run: its report and its last state.
struct RunEnd {
  RunReport report;
  State state;
};

/// One attempt to run an analysis. If an automatic effect turns out to matter, its results are discarded and another
/// attempt follows.
class Attempt {
 public:
  /// Builds the model. `scene`: scene of the request, or a copy with fewer effects.
  Attempt(const RunRequest& request, const formats::Scene& scene, const RunControl& control);
  Run& run() { return run_; }

  /// Starts the run from the restart file of the request if there is one. Otherwise it starts from the state `begin`,
  /// or from the poses of the scene if `begin` is absent.
  void start_from(const std::optional<State>& begin);
  /// Runs the analysis, writes its rows and finishes the results. `automatic` has chosen the effects and monitors them
  /// (null: none is automatic). Returns nothing if the run must begin again with other effects; its results are then
  /// discarded.
  std::optional<RunEnd> finish(AutomaticEffects* automatic);

 private:
  const RunRequest& request_;
  double began_ = 0.0, began_start_ = 0.0;
  Run run_;
};

/// Runs the scene with as few automatic effects as possible, and repeats the run until all effects that matter are on.
/// `whole`: attempt with all effects on.
RunEnd run_with_fewest(const RunRequest& request, const RunControl& control, AutomaticEffects& automatic,
                       Attempt& whole);

}  // namespace tisserand::mechanism
