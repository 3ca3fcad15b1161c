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

/// SHA-256 of the meaning of a state block: version and fields, names of nodes, coordinates and constraints,
/// superelements. Values (masses, loads, steps) are not part of it.
std::string fingerprint(const Model& model, const State& state);

/// Writes <results>.checkpoint.h5 when it is due. Each checkpoint replaces the previous one.
class Checkpoints {
 public:
  /// Sets the path: "arm.results.h5" -> "arm.checkpoint.h5". `time`: start of the run.
  Checkpoints(const formats::Scene& scene, const std::string& results, double time);

  /// Writes a checkpoint after an accepted step if it is due. All rows until then are on the disk first. Workspace and
  /// method discard factors and history, so that this run and one that continues from the file execute the same
  /// arithmetic.
  void after_step(Run& run, const Schedule& schedule, Stepper& stepper, formats::ResultsWriter& results) {
    if (due_after_step(run.built.state.time())) write(run, schedule, stepper, results);
  }
  /// Removes the written checkpoint, which belongs to no run any more.
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

/// Names (effect_name()) of these automatic effects that are off in the run of a file (RestartFile).
std::vector<std::string> effects_off(const std::string& file, const std::vector<EffectUse>& uses);

std::string checkpoint_path(const std::string& results);

/// File that `--restart` names, and the run to which it belongs.
struct RestartFile {
  std::string path;  ///< name on the disk: .part if only that exists
  bool checkpoint = false;
  std::string results;  ///< name of the results of that run; empty: unknown to an older checkpoint
};

/// Finds the file of `--restart`. Throws Error if it is missing, damaged or of another kind.
RestartFile find_restart(const std::string& file);

/// Throws Error if writing `results` would overwrite the previous run: its results, finished or not, or the checkpoint
/// itself.
void require_apart(const RestartFile& restart, const std::string& results);

enum class Joining { apart, appended };

/// Treatment of scene values that differ from those of the previous run.
enum class ChangedValues { refused, accepted };

/// Sets the run to a checkpoint, or to a stored instant (`at`, absent: the last) of a results file. A checkpoint is
/// exact bit for bit (same machine, same binary). Results are accurate to the tolerance, by the start of an analysis.
/// Appended, the results begin with the rows of the previous run until then (run.beginning). Throws Error: another
/// scene, refused changes of values, time past the end of the integrator, not dynamics, missing channels, missing
/// results of that run. A note lists accepted changes.
void resume(Run& run, const std::string& file, const std::optional<double>& at, Joining joining, ChangedValues changed);

}  // namespace tisserand::mechanism
