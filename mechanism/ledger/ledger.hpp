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

/// Choices of the user.
struct LedgerSettings {
  std::string results = {};  ///< results of the same scene whose stored instants begin windows; empty: run it
  WindowChoice windows = {};
  int repeats = 3;                         ///< repetitions of each window for the times
  std::vector<std::string> channels = {};  ///< channels to compare; empty: positions, deflections, reactions
  ToggleChoice choice = {};
};

/// Progress callback: the completed fraction, and the name of what comes next.
using LedgerProgress = std::function<void(double done, const std::string& next)>;

/// Request for a ledger. The scene is a dynamics scene with the settings of its analysis.
struct LedgerRequest {
  const formats::Scene& scene;
  std::optional<State> begin = {};  ///< end state of the analysis that this one continues
  LedgerSettings settings = {};
  LedgerProgress progress = {};
};

/// Line of a ledger: one effect of one body, joint or spring.
struct LedgerLine {
  Toggle toggle;
  std::optional<double> activity;     ///< ∫|P| dt [energy]; absent: does no work, or unknown
  double share = 0.0;                 ///< fraction of the sum of all activities
  std::vector<LedgerChange> changes;  ///< largest change of each kind of measure, in descending order
  double cost = 0.0;                  ///< relative increase of processor time per step against the scene as given
  bool replayed = false;
  bool whole_run = false;  ///< replayed from the start of the run instead of over its windows
  std::string failure;     ///< reason why there are no values, or why a window ended early
  double from_best = 0.0;  ///< inertia options: change against inertia F, if available
};

struct Ledger {
  std::string scene;
  int windows = 0;
  double window = 0.0;                ///< length of one window [time]
  double seconds_per_step = 0.0;      ///< processor time of the scene as given [s]
  double scatter = 0.0;               ///< scatter of seconds_per_step: (largest − least)/least of the repetitions
  std::vector<LedgerLine> lines;      ///< one per effect, in descending order of the largest change
  bool interrupted = false;           ///< lines are missing
  std::vector<std::string> verdicts;  ///< whole sentences on the inertia of superelements
  std::string doubt;                  ///< warning that the stored results may belong to another scene; empty: none
};

/// Repeats the windows of a run, from the same states, once for each effect that the scene has or could have. Each time
/// one effect is switched. control.clock counts processor time. Throws Error.
Ledger make_ledger(const LedgerRequest& request, const BodyFiles& files, const RunControl& control);

}  // namespace tisserand::mechanism
