// `mechanism ledger`: what each optional effect of a scene changes in its motion, and what it costs.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/ledger/comparison.hpp"
#include "mechanism/ledger/replay.hpp"
#include "mechanism/ledger/toggles.hpp"

namespace tisserand::mechanism {

/// Choices of the user.
struct LedgerSettings {
  std::string results = {};  ///< of the same scene, whose stored instants begin windows; empty: a run of its own
  WindowChoice windows = {};
  int repeats = 3;                         ///< of each window, for times
  std::vector<std::string> channels = {};  ///< that are compared; empty: places, deflections, reactions
  ToggleChoice choice = {};
};

/// Hears the part that is done, and what comes next.
using LedgerProgress = std::function<void(double done, const std::string& next)>;

/// What is asked of a ledger. The scene is one of dynamics, with the settings of its analysis.
struct LedgerRequest {
  const formats::Scene& scene;
  std::optional<State> begin = {};  ///< end of the analysis that this one goes on from
  LedgerSettings settings = {};
  LedgerProgress progress = {};
};

/// One effect of one body.
struct LedgerLine {
  Toggle toggle;
  std::optional<double> activity;     ///< ∫|P| dt [energy]; absent: does no work, or not known
  double share = 0.0;                 ///< of the activities of all lines
  std::vector<LedgerChange> changes;  ///< the largest of each kind of measure, the largest first
  double cost = 0.0;                  ///< of processor time per step, over that of the scene as it is, less one
  bool replayed = false;
  bool whole_run = false;  ///< replayed from the start of the run, not over its windows
  std::string failure;     ///< why there are no figures, or why a window ended early
  double from_best = 0.0;  ///< inertia options: change against inertia F with stiffening, if it is there
};

struct Ledger {
  std::string scene;
  int windows = 0;
  double window = 0.0;                ///< length of one [time]
  double seconds_per_step = 0.0;      ///< of processor time, of the scene as it is
  double scatter = 0.0;               ///< of that: (largest − least)/least of repetitions
  std::vector<LedgerLine> lines;      ///< the largest change first
  bool interrupted = false;           ///< lines are missing
  std::vector<std::string> verdicts;  ///< on the inertia of superelements, whole sentences
  std::string doubt;                  ///< of the results whose instants begin windows; empty: none
};

/// Takes the windows of a run, and for each effect that the scene has or could have the same windows again with this
/// one the other way round, from the same states. control.clock counts processor time. Throws Error.
Ledger make_ledger(const LedgerRequest& request, const BodyFiles& files, const RunControl& control);

}  // namespace tisserand::mechanism
