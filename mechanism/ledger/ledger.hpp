// SPDX-License-Identifier: GPL-3.0-or-later
// `mechanism ledger`: how much each optional effect of a scene changes its motion, and what it costs.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/ledger/comparison.hpp"
#include "mechanism/ledger/replay.hpp"
#include "mechanism/ledger/toggles.hpp"

namespace tisserand::mechanism {

/// Settings of a ledger that the user chooses.
struct LedgerSettings {
  /// Path of results of the same scene, whose stored instants begin windows; empty: the scene is run.
  std::string results = {};
  WindowChoice windows = {};
  int repeats = 3;                         ///< number of repetitions of each window, for the times
  std::vector<std::string> channels = {};  ///< channels to compare; empty: positions, deflections, reactions
  ToggleChoice choice = {};
};

/// Progress callback. It receives the completed fraction and the name of what comes next.
using LedgerProgress = std::function<void(double done, const std::string& next)>;

/// Request for a ledger. The scene is a dynamics scene with the settings of its analysis.
struct LedgerRequest {
  const formats::Scene& scene;
  std::optional<State> begin = {};  ///< end state of the analysis that this one continues
  LedgerSettings settings = {};
  LedgerProgress progress = {};
};

/// Line of a ledger: change and cost of one effect of one body, joint or spring.
struct LedgerLine {
  Toggle toggle;
  /// Activity ∫|P| dt [energy] (SampledPowers). Absent: unknown, or the effect does no work.
  std::optional<double> activity;
  double share = 0.0;                 ///< fraction of the sum of all activities
  std::vector<LedgerChange> changes;  ///< largest change of each kind of measure, in descending order
  /// Relative increase of processor time per step, compared with the scene as given.
  double cost = 0.0;
  bool replayed = false;   ///< whether windows were repeated with this change
  bool whole_run = false;  ///< whether the run was repeated from its start instead of over its windows
  std::string failure;     ///< reason why there are no values, or why a window ended early
  double from_best = 0.0;  ///< for an inertia option: change relative to inertia F, if available
};

/// Report on all optional effects of a scene: how much each one changes the motion, and what it costs.
struct Ledger {
  std::string scene;
  int windows = 0;
  double window = 0.0;                ///< length of one window [time]
  double seconds_per_step = 0.0;      ///< processor time of the scene as given [s]
  double scatter = 0.0;               ///< scatter of seconds_per_step: (largest − least)/least of the repetitions
  std::vector<LedgerLine> lines;      ///< one per effect, in descending order of the largest change
  bool interrupted = false;           ///< whether an interruption ended the ledger, so that lines are missing
  std::vector<std::string> verdicts;  ///< whole sentences on the inertia of superelements
  std::string doubt;                  ///< warning that the stored results may belong to another scene; empty: none
};

/// Makes the ledger of a scene. It repeats the windows of a run from the same states, once for each effect that the
/// scene has or could have. Each time one effect is switched. Requires that control.clock counts processor time. Throws
/// Error.
Ledger make_ledger(const LedgerRequest& request, const BodyFiles& files, const RunControl& control);

}  // namespace tisserand::mechanism
