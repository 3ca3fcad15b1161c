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
  std::function<bool()> interrupted;          ///< polled once per step
  std::function<void(double time)> progress;  ///< after every accepted step
  std::function<double()> clock;              ///< seconds, for the report
  std::function<void(const std::string&)> announce = {};  ///< receives messages for the user before the steps
};

/// Listener that receives the rows of a run and may add to its report.
class RunListener {
 public:
  virtual ~RunListener() = default;
  virtual void begin(const formats::ResultsLayout& layout) = 0;
  virtual void row(const formats::ResultsRow& row) = 0;
  /// Receives the state of each row, after the row.
  virtual void state(const State&) {}
  /// Receives the report before it is stored.
  virtual void end(RunReport&) {}
};

/// Prediction of the size of results from the rows stored so far, if the number of rows is unknown.
struct OutputForecast {
  std::size_t bytes = 0;  ///< bytes of a row; 0: no prediction
  double from = 0.0;      ///< instant from which rows are stored
  double rows = 0.0;      ///< rows stored since then
};

class AutomaticEffects;

struct Run {
  std::optional<formats::Scene> switched;  ///< with effect switches: the scene after their application
  const formats::Scene& scene;
  const RunControl& control;
  RunListener* listener = nullptr;
  RunReport report;
  BuiltModel built;
  Workspace workspace;
  Doubts doubts;
  FrameAngles angles;
  StartFrom from = StartFrom::poses;
  bool massless = false;                               ///< some directions have no mass: they jump to their balance
  State at_start;                                      ///< state of the built model, before any motion
  std::string values;                                  ///< formats::scene_values; empty: a program made the scene
  std::vector<double> schedule_memory;                 ///< for a run that continues from a file; else empty
  std::optional<formats::ResultsBeginning> beginning;  ///< rows of the run to which this one is appended
  OutputForecast forecast;
  AutomaticEffects* automatic = nullptr;               ///< null: no effect is automatic

  Run(const formats::Scene& scene_to_run, const BodyFiles& files, const RunControl& run_control);
  /// Present instant, after an evaluation of the state.
  Instant instant() const { return {built.model, built.state, workspace.now}; }
  double seconds() const { return control.clock ? control.clock() : 0.0; }
};

/// Text on the first load, spring force or motion whose value at `time` is not finite, with its formula; or empty.
std::string nonfinite_load(Run& run, double time);

/// Begins at the end of another analysis of the same scene instead of at the poses of its bodies.
void begin_from(Run& run, const State& end);

/// Starts the run: rank, projection, preparation of the analysis, notes for the report. Throws Error.
void start(Run& run);

/// Layout of the rows, after start() or resume(). The model keeps only the places that are stored.
formats::ResultsLayout begin_rows(Run& run, const BodyFiles& files);

/// Reason to end the run at the present accepted, evaluated state; empty: none.
std::string why_to_end(Run& run);
/// Whether the caller has interrupted the run. Sets the outcome in the report.
bool is_interrupted(Run& run);

/// Adds the warnings of the run to the report.
void tell_doubts(Run& run);

/// Destination of the rows of a run.
struct RowWriter {
  formats::ResultsRow& row;
  formats::ResultsWriter& writer;
  const std::string& results;  ///< path of the file
};

/// Change of a row by an analysis before it is stored.
using RowEdit = std::function<void(formats::ResultsRow&)>;

/// Stores the present state.
void write_row(Run& run, const StepReport& step, double size, RowWriter& out);
void write_row(Run& run, const StepReport& step, double size, RowWriter& out, const RowEdit& edit);

/// Takes the steps of the schedule. A step that fails is repeated with a shorter size.
void integrate(Run& run, RowWriter& out);
/// Runs statics.
void equilibrate(Run& run, RowWriter& out);
/// Runs kinematics or inverse dynamics: the steps of the integrator along the driven motion.
void move_along(Run& run, RowWriter& out);
void assemble(Run& run, RowWriter& out);
void find_modes(Run& run, RowWriter& out);

}  // namespace tisserand::mechanism
