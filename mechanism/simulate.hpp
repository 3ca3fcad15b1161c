// One run of a scene, from the file to the results: the story of this stage.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "formats/scene.hpp"
#include "mechanism/build_model.hpp"
#include "mechanism/initial.hpp"
#include "mechanism/integrator.hpp"
#include "mechanism/model.hpp"
#include "mechanism/state.hpp"

namespace tisserand::mechanism {

/// What the outside world tells a run and hears of it.
struct RunControl {
  std::function<bool()> interrupted;          ///< polled once per step
  std::function<void(double time)> progress;  ///< after every accepted step
  std::function<double()> clock;              ///< seconds, for the report
};

enum class RunOutcome { completed, not_converged, interrupted };

struct RunReport {
  formats::AnalysisKind analysis = formats::AnalysisKind::dynamics;
  RunOutcome outcome = RunOutcome::completed;
  std::string reason;   ///< of a run that did not complete
  std::string results;  ///< path of the results file
  double time = 0.0;    ///< reached
  long steps = 0;
  long iterations = 0;
  long factorisations = 0;
  long row_choices = 0;  ///< steps at which the constraint rows that are solved for were chosen anew
  long rejected = 0;     ///< steps taken again with half the size
  long inaccurate = 0;   ///< of these, steps whose local error was too large
  double least_step = 0.0, greatest_step = 0.0;
  std::vector<std::string> rejections;  ///< the first ones: when and why
  double largest_constraint = 0.0;      ///< over all steps
  long rows = 0;                        ///< stored instants
  double balance = 0.0;                 ///< energy balance at the last stored instant
  double largest_balance = 0.0;         ///< over the stored instants
  double energy_reference = 0.0;        ///< largest kinetic + strain + |work|
  Mobility mobility;
  Preflight preflight;
  std::vector<std::string> not_unique;  ///< joints whose reactions are not unique: those of least norm are stored
  Projection projection;
  std::string table_title;  ///< of the lines that only this analysis has: poses, modes
  std::vector<std::string> table;
  std::vector<std::string> notes;
  std::vector<std::string> effects;  ///< what the model contains: pools and terms that are on
  std::string solver;
  SolverHealth solver_health;
  int unknowns = 0, nonzeros = 0;
  double seconds_model = 0.0, seconds_start = 0.0, seconds_steps = 0.0, seconds_output = 0.0;
};

/// Reads the superelement and modal body files of a scene, each once. Throws Error: all that cannot be read, each once.
BodyFiles read_body_files(const formats::Scene& scene);

/// One analysis of a scene: what it reads and starts from, and where its rows go.
struct RunRequest {
  const formats::Scene& scene;  ///< with the kind and the settings of this analysis (formats::scene_of)
  const BodyFiles& files;
  std::optional<State> begin;  ///< end of another analysis of the same scene, in place of the poses of the bodies
  std::string path;            ///< of the results
  std::string restart;         ///< checkpoint or results file to go on from; empty: none
  std::optional<double> at;    ///< instant in a results file; absent: the last one
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

/// As JSON (stored in the results file) and as the lines that the command prints.
std::string report_json(const RunReport& report);
std::string report_text(const RunReport& report, const Units& units);

}  // namespace tisserand::mechanism
