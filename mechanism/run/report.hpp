// SPDX-License-Identifier: GPL-3.0-or-later
// Report of a run: counts, balance, warnings; as JSON and as text.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/units.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/analyses/start.hpp"
#include "mechanism/solver/linear_solver.hpp"

namespace tisserand::mechanism {

/// Choice of a run for one automatic effect.
struct ChosenEffect {
  std::string effect, body;
  bool on = true;
  double demand = 0.0;  ///< off: bound of its change, over the tolerance; on: the change that turned it on
  double time = 0.0;    ///< time of this change
};

/// Outcome of a run. unstable: statics found an equilibrium in which some direction is unstable.
enum class RunOutcome { completed, unstable, not_converged, interrupted };
/// Whether the analysis reached its end.
inline bool is_finished(RunOutcome outcome) {
  return outcome == RunOutcome::completed || outcome == RunOutcome::unstable;
}

struct RunReport {
  formats::AnalysisKind analysis = formats::AnalysisKind::dynamics;
  RunOutcome outcome = RunOutcome::completed;
  std::string reason;   ///< why a run did not complete
  std::string results;  ///< path of the results file
  std::string before;   ///< report (JSON) of the run to which this one is appended, or empty
  double time = 0.0;    ///< last time reached
  long steps = 0;
  long iterations = 0;
  long factorisations = 0;
  long row_choices = 0;  ///< steps at which the active constraint rows were chosen again
  long rejected = 0;     ///< steps repeated with a smaller size
  long inaccurate = 0;   ///< among them: steps with a too large local error
  double least_step = 0.0, greatest_step = 0.0;
  std::vector<std::string> rejections;  ///< time and reason of the first ones
  double largest_constraint = 0.0;      ///< largest violation over all steps
  long rows = 0;                        ///< stored instants
  double balance = 0.0;                 ///< energy balance at the last stored instant
  double largest_balance = 0.0;         ///< largest size over the stored instants
  double energy_reference = 0.0;        ///< largest energy that moved: EnergyBalance::moved()
  Mobility mobility;
  Preflight preflight;
  std::vector<std::string> not_unique;  ///< joints whose reactions are not unique: those of least norm are stored
  Projection projection;
  std::string table_title;  ///< title of lines that only this analysis has: poses, modes
  std::vector<std::string> table;
  std::vector<std::string> notes;
  std::vector<std::string> scene_notes;  ///< those of `notes` that depend on the scene, not on the analysis
  std::vector<std::string> doubts;   ///< warnings about the results, measured during the run
  std::vector<std::string> effects;  ///< contents of the model: pools and active terms
  std::string switches;              ///< optional effects of the model, and those that the scene disables
  double tolerance = 0.0;            ///< tolerance of automatic effects; 0: there are none
  std::vector<ChosenEffect> automatic;
  long repeated = 0;  ///< steps of runs that began again because an effect that was off mattered
  std::string solver;
  SolverHealth solver_health;
  int unknowns = 0, nonzeros = 0;
  double seconds_model = 0.0, seconds_start = 0.0, seconds_steps = 0.0, seconds_output = 0.0;

  void end(RunOutcome how, std::string why) {
    outcome = how;
    reason = std::move(why);
  }
};

/// Report as JSON (stored in the results file) and as the lines that the command prints.
std::string report_json(const RunReport& report);
std::string report_text(const RunReport& report, const Units& units);

/// Removes the notes on the scene that a previous report contained (`told`), and adds the others to `told`. Analyses of
/// one command share the scene.
void drop_told_notes(RunReport& report, std::vector<std::string>& told);

}  // namespace tisserand::mechanism
