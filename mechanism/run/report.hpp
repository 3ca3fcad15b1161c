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
  /// Demand D (switching/demand.hpp): the estimated change by the effect, relative to the tolerance. Effect off:
  /// largest D of the run. Effect on: D that turned it on.
  double demand = 0.0;
  double time = 0.0;  ///< time of `demand`
};

/// Outcome of a run. `unstable`: statics found an equilibrium in which some direction is unstable.
enum class RunOutcome { completed, unstable, not_converged, interrupted };
/// Whether an analysis with this outcome reached its end.
inline bool is_finished(RunOutcome outcome) {
  return outcome == RunOutcome::completed || outcome == RunOutcome::unstable;
}

/// Report of a run: outcome, counts, accuracy, notes, warnings and times.
struct RunReport {
  formats::AnalysisKind analysis = formats::AnalysisKind::dynamics;
  RunOutcome outcome = RunOutcome::completed;
  std::string reason;   ///< reason why the run did not complete
  std::string results;  ///< path of the results file
  std::string before;   ///< report (JSON) of the run to which this one is appended, or empty
  double time = 0.0;    ///< last time reached
  long steps = 0;
  long iterations = 0;
  long factorisations = 0;
  long row_choices = 0;  ///< number of steps at which the active constraint rows were chosen again
  long rejected = 0;     ///< number of steps repeated with a smaller size
  long inaccurate = 0;   ///< part of `rejected`: steps with a too large local error
  double least_step = 0.0, greatest_step = 0.0;
  std::vector<std::string> rejections;  ///< time and reason of the first rejected steps
  double largest_constraint = 0.0;      ///< largest violation of the constraints over all steps
  long rows = 0;                        ///< number of stored instants
  double balance = 0.0;                 ///< energy balance at the last stored instant
  double largest_balance = 0.0;         ///< largest size of the energy balance over the stored instants
  double energy_reference = 0.0;        ///< largest energy that moved, EnergyBalance::moved()
  Mobility mobility;
  Preflight preflight;
  std::vector<std::string> not_unique;  ///< joints without unique reactions; reactions of least norm are stored
  Projection projection;
  std::string table_title;  ///< title of lines that only this analysis has: poses, modes
  std::vector<std::string> table;
  std::vector<std::string> notes;
  std::vector<std::string> scene_notes;  ///< part of `notes` that depends on the scene, not on the analysis
  std::vector<std::string> doubts;       ///< warnings about the results, measured during the run
  std::vector<std::string> effects;      ///< contents of the model: pools and active terms
  std::string switches;                  ///< optional effects of the model, and those that the scene disables
  double tolerance = 0.0;                ///< tolerance of automatic effects; 0: there are none
  std::vector<ChosenEffect> automatic;
  long repeated = 0;  ///< number of steps of discarded runs, which began again because an effect that was off mattered
  std::string solver;
  SolverHealth solver_health;
  int unknowns = 0, nonzeros = 0;
  double seconds_model = 0.0, seconds_start = 0.0, seconds_steps = 0.0, seconds_output = 0.0;

  void end(RunOutcome how, std::string why) {
    outcome = how;
    reason = std::move(why);
  }
};

/// Report as JSON, as it is stored in the results file.
std::string report_json(const RunReport& report);
/// Report as the lines that the command prints.
std::string report_text(const RunReport& report, const Units& units);

/// Removes from `report` the notes on the scene that `reported` holds, and adds the other ones to `reported`. The list
/// `reported` holds notes of previous analyses of the same command, which share the scene.
void drop_reported_notes(RunReport& report, std::vector<std::string>& reported);

}  // namespace tisserand::mechanism
