// SPDX-License-Identifier: GPL-3.0-or-later
// Windows of a run, and their repetition with a scene that may differ in one effect.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/ledger/measures.hpp"
#include "mechanism/run/run.hpp"

namespace tisserand::mechanism {

/// Time interval of a run and the state at its beginning.
struct LedgerWindow {
  double start = 0.0, end = 0.0;
  State begin;
};

/// Number of the windows of a ledger, and their total length.
struct WindowChoice {
  int windows = 5;
  double share = 0.25;  ///< fraction of the time of the run that all windows together take
};

/// Record of one window: measured rows, processor time of its steps, and the reason of an early end.
struct WindowHistory {
  std::optional<Measures> measures;  ///< measures of the layout of its rows
  std::vector<double> time;          ///< instants of the rows
  std::vector<MeasuredRow> rows;
  std::vector<State> states;  ///< state of each row, if requested
  double seconds = 0.0;       ///< processor time of the steps
  long steps = 0;
  std::string failure;  ///< reason why the window ended early; empty: it did not
};

/// Files, control and choices that all replays of a ledger share.
struct LedgerStage {
  const BodyFiles& files;
  const RunControl& control;  ///< control of the runs, whose clock counts processor time
  const WindowChoice& choice;
  const std::vector<std::string>& channels;
};

/// Reference of a ledger: windows with the states at which they begin, and sizes of the measures.
struct ReferenceRun {
  std::vector<LedgerWindow> windows;
  std::optional<Measures> measures;
  std::optional<MeasureSizes> sizes;
  std::string doubt;  ///< warning that stored results belong to another scene; empty: none
};
/// Runs the scene as given, without results file, and returns the reference of the ledger. `begin`: state at which it
/// starts; absent: the poses of the scene. Throws Error if the run ends early. If the user interrupts it, the reference
/// holds what there is.
ReferenceRun run_reference(const formats::Scene& scene, const std::optional<State>& begin, const LedgerStage& stage);

/// Reference of the ledger from `file`, results of the same scene. Each window begins at the first stored instant at or
/// after its planned time.
ReferenceRun windows_of_results(const formats::Scene& scene, const std::string& file, const LedgerStage& stage);

/// Whether a replay stores the state of each row.
enum class KeepStates { no, yes };

/// Replays one window of a run with `scene`. `begin`: state of its model at the start of the window; absent: the poses
/// of the scene. `whole`: length of the run [time]. Throws Error if the scene cannot begin there.
WindowHistory replay_window(const formats::Scene& scene, const LedgerWindow& window, const std::optional<State>& begin,
                            double whole, KeepStates keep, const LedgerStage& stage);

}  // namespace tisserand::mechanism
