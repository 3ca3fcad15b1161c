// What a run says of itself: counts, balance, doubts; as JSON and as text.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/units.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/analyses/start.hpp"
#include "mechanism/solver/linear_solver.hpp"

namespace tisserand::mechanism {

/// What the run has chosen of an automatic effect.
struct ChosenEffect {
  std::string effect, body;
  bool on = true;
  double demand = 0.0;  ///< what it would change, over the tolerance: at most, where it is off; else why it is on
  double time = 0.0;    ///< when
};

/// unstable: statics found an equilibrium in which some direction is unstable.
enum class RunOutcome { completed, unstable, not_converged, interrupted };
/// Whether the analysis went to its end.
inline bool is_finished(RunOutcome outcome) {
  return outcome == RunOutcome::completed || outcome == RunOutcome::unstable;
}

struct RunReport {
  formats::AnalysisKind analysis = formats::AnalysisKind::dynamics;
  RunOutcome outcome = RunOutcome::completed;
  std::string reason;   ///< of a run that did not complete
  std::string results;  ///< path of the results file
  std::string before;   ///< report (JSON) of the run that this one is appended to, or empty
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
  double energy_reference = 0.0;        ///< largest energy that moved: EnergyBalance::moved()
  Mobility mobility;
  Preflight preflight;
  std::vector<std::string> not_unique;  ///< joints whose reactions are not unique: those of least norm are stored
  Projection projection;
  std::string table_title;  ///< of the lines that only this analysis has: poses, modes
  std::vector<std::string> table;
  std::vector<std::string> notes;
  std::vector<std::string> scene_notes;  ///< those of `notes` that the scene gives, not the analysis
  std::vector<std::string> doubts;   ///< of the results, measured while it ran
  std::vector<std::string> effects;  ///< what the model contains: pools and terms that are on
  std::string switches;              ///< optional effects that it has, and those that the scene switches off
  double tolerance = 0.0;            ///< of automatic effects; 0: there are none
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

/// As JSON (stored in the results file) and as the lines that the command prints.
std::string report_json(const RunReport& report);
std::string report_text(const RunReport& report, const Units& units);

/// Removes the notes on the scene that a report before has had, `told`, and adds the others to it: analyses of one
/// command have the same scene.
void drop_told_notes(RunReport& report, std::vector<std::string>& told);

}  // namespace tisserand::mechanism
