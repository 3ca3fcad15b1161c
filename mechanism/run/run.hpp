// What one run of an analysis owns, and what all analyses do alike: start, and rows of results.
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

/// What the outside world tells a run and hears of it.
struct RunControl {
  std::function<bool()> interrupted;          ///< polled once per step
  std::function<void(double time)> progress;  ///< after every accepted step
  std::function<double()> clock;              ///< seconds, for the report
  std::function<void(const std::string&)> announce = {};  ///< hears what a user should know before the steps
};

/// Hears of the rows of a run, and may add to its report.
class RunListener {
 public:
  virtual ~RunListener() = default;
  virtual void begin(const formats::ResultsLayout& layout) = 0;
  virtual void row(const formats::ResultsRow& row) = 0;
  /// After each row: the state that it tells.
  virtual void state(const State&) {}
  /// Before the report is stored.
  virtual void end(RunReport&) {}
};

/// Foretells the size of results from those that are stored, where nothing else tells how many rows there will be.
struct OutputForecast {
  std::size_t bytes = 0;  ///< of a row; 0: nothing is to be told
  double from = 0.0;      ///< instant from which rows are stored
  double rows = 0.0;      ///< since then
};

class AutomaticEffects;

struct Run {
  std::optional<formats::Scene> switched;  ///< where the scene switches effects: what is left of it
  const formats::Scene& scene;
  const RunControl& control;
  RunListener* listener = nullptr;
  RunReport report;
  BuiltModel built;
  Workspace workspace;
  Doubts doubts;
  FrameAngles angles;
  StartFrom from = StartFrom::poses;
  bool massless = false;                               ///< some directions without mass: they jump to their balance
  State at_start;                                      ///< as the model was built, before anything moved
  std::string values;                                  ///< formats::scene_values; empty: a program made the scene
  std::vector<double> schedule_memory;                 ///< of a run that goes on from a file; empty: it begins
  std::optional<formats::ResultsBeginning> beginning;  ///< rows of the run that this one is appended to
  OutputForecast forecast;
  AutomaticEffects* automatic = nullptr;               ///< null: nothing is

  Run(const formats::Scene& scene_to_run, const BodyFiles& files, const RunControl& run_control);
  /// After an evaluation of the present state.
  Instant instant() const { return {built.model, built.state, workspace.now}; }
  double seconds() const { return control.clock ? control.clock() : 0.0; }
};

/// The first load, force of a spring or motion that is no number at `time`, with its formula, or empty.
std::string nonfinite_load(Run& run, double time);

/// Positions and velocities of the end of another analysis of the same scene in place of the poses of its bodies.
void begin_from(Run& run, const State& end);

/// Rank, projection and what the analysis needs to begin; notes for the report. Throws Error.
void start(Run& run);

/// After start() or resume(): the model keeps the places that are stored.
formats::ResultsLayout begin_rows(Run& run, const BodyFiles& files);

/// Why it must end at the accepted, evaluated state where it stands, or nothing.
std::string why_to_end(Run& run);
/// Whether the outside world wants it to end; the report says so.
bool is_interrupted(Run& run);

/// What the run has come to doubt, into the report.
void tell_doubts(Run& run);

/// Where the rows of a run go.
struct RowWriter {
  formats::ResultsRow& row;
  formats::ResultsWriter& writer;
  const std::string& results;  ///< path of the file
};

/// What an analysis changes in a row before it is stored.
using RowEdit = std::function<void(formats::ResultsRow&)>;

/// Stores the present state.
void write_row(Run& run, const StepReport& step, double size, RowWriter& out);
void write_row(Run& run, const StepReport& step, double size, RowWriter& out, const RowEdit& edit);

/// Takes the steps of the schedule; a step that fails is taken again in halves.
void integrate(Run& run, RowWriter& out);
/// Statics.
void equilibrate(Run& run, RowWriter& out);
/// Kinematics and inverse dynamics: through the steps of the integrator along the driven motion.
void move_along(Run& run, RowWriter& out);
void assemble(Run& run, RowWriter& out);
void find_modes(Run& run, RowWriter& out);

}  // namespace tisserand::mechanism
