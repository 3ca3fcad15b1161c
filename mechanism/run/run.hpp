// SPDX-License-Identifier: GPL-3.0-or-later
// Data of one run of an analysis, and what all analyses share: start, and rows of results.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "formats/results/results.hpp"
#include "mechanism/build/build_model.hpp"
#include "mechanism/doubts/doubts.hpp"
#include "mechanism/run/limits.hpp"
#include "mechanism/run/report.hpp"
#include "mechanism/step/step.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// Callbacks between a run and its caller.
struct RunControl {
  std::function<bool()> interrupted;          ///< returns whether the user has interrupted; called once per step
  std::function<void(double time)> progress;  ///< called after every accepted step
  std::function<double()> clock;              ///< returns seconds, for the report
  std::function<void(const std::string&)> announce = {};  ///< receives messages for the user before the steps
};

/// Listener that receives the rows of a run and may add to its report.
class RunListener {
 public:
  virtual ~RunListener() = default;
  /// Receives the layout of the rows, before the first row.
  virtual void begin(const formats::ResultsLayout& layout) = 0;
  /// Receives one row.
  virtual void row(const formats::ResultsRow& row) = 0;
  /// Receives the state of each row, after row().
  virtual void state(const State&) {}
  /// Receives the report before it is stored, and may add to it.
  virtual void end(RunReport&) {}
};

/// Data to predict the size of the results from the rows stored so far, if the number of rows is unknown.
struct OutputForecast {
  std::size_t bytes = 0;  ///< size of a row [byte]; 0: no prediction
  double from = 0.0;      ///< instant from which rows are stored
  double rows = 0.0;      ///< number of rows stored since `from`
};

class AutomaticEffects;

/// Data of one run of an analysis: scene, model, state, work space, checks and report.
struct Run {
  std::optional<formats::Scene> switched;  ///< scene after application of its effect switches; absent: it has none
  const formats::Scene& scene;
  const RunControl& control;
  RunListener* listener = nullptr;
  RunReport report;
  BuiltModel built;
  Workspace workspace;
  Doubts doubts;
  FrameAngles angles;
  StartFrom from = StartFrom::poses;
  /// Whether some directions have no mass, so that they jump to their static balance.
  bool massless = false;
  State at_start;      ///< state of the built model, before any motion
  std::string values;  ///< values of the scene (formats::scene_values); empty: a program made the scene
  std::vector<double> schedule_memory;  ///< Schedule::memory() of a run that continues from a file; else empty
  std::optional<formats::ResultsBeginning> beginning;  ///< rows of the run to which this one is appended
  OutputForecast forecast;
  AutomaticEffects* automatic = nullptr;  ///< choice of automatic effects; null: no effect is automatic

  Run(const formats::Scene& scene_to_run, const BodyFiles& files, const RunControl& run_control);
  /// Present instant, after an evaluation of the state.
  Instant instant() const { return {built.model, built.state, workspace.now}; }
  double seconds() const { return control.clock ? control.clock() : 0.0; }
};

/// Sentence on the first load, spring force or motion whose value at `time` is not finite, with its formula. Empty:
/// none.
std::string nonfinite_load(Run& run, double time);

/// Sets the run to begin at `end`, the end of another analysis of the same scene, instead of at the poses of the
/// bodies.
void begin_from(Run& run, const State& end);

/// Starts the run: rank, projection, preparation of the analysis, notes for the report. Throws Error.
void start(Run& run);

/// Layout of the rows. Requires that start() or resume() was called. Removes from the model the places that are not
/// stored.
formats::ResultsLayout begin_rows(Run& run, const BodyFiles& files);

/// Reason to end the run at its present accepted, evaluated state; empty: none.
std::string why_to_end(Run& run);
/// Whether the caller has interrupted the run. Then the report gets this outcome.
bool is_interrupted(Run& run);

/// Adds the warnings of the run to the report.
void report_doubts(Run& run);

/// Destination of the rows of a run.
struct RowWriter {
  formats::ResultsRow& row;
  formats::ResultsWriter& writer;
  const std::string& results;  ///< path of the results file
};

/// Function by which an analysis changes a row before it is stored.
using RowEdit = std::function<void(formats::ResultsRow&)>;

/// Stores the present state as a row. `step`: report of the step that led to it. `size`: size of this step [time].
void write_row(Run& run, const StepReport& step, double size, RowWriter& out);
/// Stores the present state as a row, after `edit` has changed the row.
void write_row(Run& run, const StepReport& step, double size, RowWriter& out, const RowEdit& edit);

/// Runs dynamics: takes the steps of the schedule. A step that fails is repeated with a shorter size.
void integrate(Run& run, RowWriter& out);
/// Runs statics.
void equilibrate(Run& run, RowWriter& out);
/// Runs kinematics or inverse dynamics, with the steps of the integrator along the driven motion.
void move_along(Run& run, RowWriter& out);
/// Runs the assembly of the joints.
void assemble(Run& run, RowWriter& out);
/// Runs the analysis of modes.
void find_modes(Run& run, RowWriter& out);

}  // namespace tisserand::mechanism
