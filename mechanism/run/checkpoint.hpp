// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints of a running analysis, and runs that continue from a checkpoint or a results file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/results/checkpoint.hpp"
#include "mechanism/build/effects.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/run/run.hpp"
#include "mechanism/run/schedule.hpp"
#include "mechanism/run/stepper.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// SHA-256 of the meaning of a state block: its version and fields, and the names of nodes, coordinates, constraints
/// and superelements. Values (masses, loads, steps) are not part of it.
std::string fingerprint(const Model& model, const State& state);

/// Writer of the checkpoint file <results>.checkpoint.h5 whenever a checkpoint is due. Each checkpoint replaces the
/// previous one.
class Checkpoints {
 public:
  /// Sets the path of the checkpoint file: "arm.results.h5" -> "arm.checkpoint.h5". `time`: start of the run.
  Checkpoints(const formats::Scene& scene, const std::string& results, double time);

  /// Writes a checkpoint after an accepted step if it is due. All rows until this step are on the disk before. The
  /// method and the workspace then discard matrix factors and history. So this run and one that continues from the file
  /// execute the same arithmetic.
  void after_step(Run& run, const Schedule& schedule, Stepper& stepper, formats::ResultsWriter& results) {
    if (due_after_step(run.built.state.time())) write(run, schedule, stepper, results);
  }
  /// Removes the checkpoint file if this object has written it.
  void discard() const;

 private:
  bool due_after_step(double time);
  void write(Run& run, const Schedule& schedule, Stepper& stepper, formats::ResultsWriter& results);
  void set_next(double time);

  formats::CheckpointSpec spec_;
  std::string scene_;
  std::string path_;
  std::string results_;
  double start_ = 0.0;
  double round_off_ = 0.0;
  long steps_ = 0;
  double next_ = 0.0;
  bool written_ = false;
};

/// Names (effect_name()) of the effects in `uses` that are off in the run of a file. `file`: results or checkpoint
/// file, as find_restart() accepts it.
std::vector<std::string> effects_off(const std::string& file, const std::vector<EffectUse>& uses);

/// Path of the checkpoint file of a results file: "arm.results.h5" -> "arm.checkpoint.h5".
std::string checkpoint_path(const std::string& results);

/// File that `--restart` names, and the run to which the file belongs.
struct RestartFile {
  std::string path;         ///< path on the disk; it ends in .part if only that file exists
  bool checkpoint = false;  ///< whether it is a checkpoint, not a results file
  std::string results;      ///< path of the results of that run; empty: an older checkpoint does not name them
};

/// Finds the file of `--restart`. Throws Error if it is missing, damaged or of another kind.
RestartFile find_restart(const std::string& file);

/// Throws Error if writing `results` would overwrite a file of the previous run: its results, finished or not, or the
/// checkpoint itself.
void require_apart(const RestartFile& restart, const std::string& results);

/// Place of the rows of a restarted run: results of its own (apart), or after the rows of the previous run (appended).
enum class Joining { apart, appended };

/// Treatment of scene values that differ from those of the previous run.
enum class ChangedValues { refused, accepted };

/// Sets the run to the state of a checkpoint, or to a stored instant of a results file. `at`: this instant; absent: the
/// last one. A checkpoint is exact bit for bit on the same machine with the same binary. A state from results is
/// accurate to the tolerance, because the analysis starts again from it. With Joining::appended the results begin with
/// the rows of the previous run until then (run.beginning). Throws Error for another scene, refused changes of values,
/// or a time past the end of the integrator. It also throws for analyses other than dynamics, `method: bdf`, missing
/// channels, and missing results of the previous run. A note lists accepted changes.
void resume(Run& run, const std::string& file, const std::optional<double>& at, Joining joining, ChangedValues changed);

}  // namespace tisserand::mechanism
