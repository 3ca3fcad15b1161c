// Checkpoints of a running analysis, and runs that go on from a checkpoint or from a results file.
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

/// SHA-256 of what a state block means: version and fields, names of nodes, coordinates and constraints, superelements.
/// Values (masses, loads, steps) are no part of it.
std::string fingerprint(const Model& model, const State& state);

/// Writes <results>.checkpoint.h5 when it is due, each replacing the one before.
class Checkpoints {
 public:
  /// "arm.results.h5" -> "arm.checkpoint.h5". `time`: where the run begins or goes on.
  Checkpoints(const formats::Scene& scene, const std::string& results, double time);

  /// After an accepted step. Where a checkpoint is written all rows until then are on the disk, and workspace and
  /// method forget factors and what they have learnt, so that this run and one that goes on from the file execute the
  /// same arithmetic.
  void after_step(Run& run, const Schedule& schedule, Stepper& stepper, formats::ResultsWriter& results) {
    if (due_after_step(run.built.state.time())) write(run, schedule, stepper, results);
  }
  /// Removes what was written, which belongs to no run any more.
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

/// Which of these automatic effects the run that a file (RestartFile) belongs to had left out: effect_name().
std::vector<std::string> effects_off(const std::string& file, const std::vector<EffectUse>& uses);

std::string checkpoint_path(const std::string& results);

/// What `--restart` names, and the run that it belongs to.
struct RestartFile {
  std::string path;  ///< as it lies on the disk: .part where only that is there
  bool checkpoint = false;
  std::string results;  ///< name of the results of that run; empty: an older checkpoint does not know it
};

/// Throws Error: missing, damaged, of another kind.
RestartFile find_restart(const std::string& file);

/// Throws Error if writing `results` would overwrite the run that is gone on from: its results, finished or not, or the
/// checkpoint itself.
void require_apart(const RestartFile& restart, const std::string& results);

enum class Joining { apart, appended };

/// What holds where values of the scene are not those of the run that is gone on from.
enum class ChangedValues { refused, accepted };

/// Puts the run where a checkpoint left it, or at a stored instant (`at`, absent: the last) of a results file: from a
/// checkpoint bit for bit (same machine, same binary), from results through the start of an analysis, to the tolerance.
/// Appended, the results begin with the rows of the run that is gone on from, until then (run.beginning).
/// Throws Error: not of this scene, values that are changed and refused, past the end of the integrator, not dynamics,
/// channels that are missing, the results of that run not found. Values that are accepted are listed in a note.
void resume(Run& run, const std::string& file, const std::optional<double>& at, Joining joining, ChangedValues changed);

}  // namespace tisserand::mechanism
