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

/// Number and total length of the windows.
struct WindowChoice {
  int windows = 5;
  double share = 0.25;  ///< fraction of the time of the run that all windows together take
};

/// Record of one window: measured rows, processor time of its steps, and the reason of an early end (empty: none).
struct WindowHistory {
  std::optional<Measures> measures;  ///< measures of the layout of its rows
  std::vector<double> time;
  std::vector<MeasuredRow> rows;
  std::vector<State> states;  ///< state of each row, if requested
  double seconds = 0.0;       ///< processor time of the steps
  long steps = 0;
  std::string failure;
};

/// Files, control and choices that all replays of a ledger share.
struct LedgerStage {
  const BodyFiles& files;
  const RunControl& control;  ///< its clock counts processor time
  const WindowChoice& choice;
  const std::vector<std::string>& channels;
};

/// Reference of a ledger: the states at which windows begin, and the sizes of the measures.
struct ReferenceRun {
  std::vector<LedgerWindow> windows;
  std::optional<Measures> measures;
  std::optional<MeasureSizes> sizes;
  std::string doubt;  ///< warning that stored results belong to another scene; empty: none
};
/// Runs the scene from `begin` (absent: its poses) without results. Throws Error if the run ends early. An interrupted
/// run returns what it has.
ReferenceRun run_reference(const formats::Scene& scene, const std::optional<State>& begin, const LedgerStage& stage);

/// Windows from `file`, results of the same scene. Each begins at the first stored instant at or after its time.
ReferenceRun windows_of_results(const formats::Scene& scene, const std::string& file, const LedgerStage& stage);

enum class KeepStates { no, yes };

/// Replays one window of a run of length `whole` with `scene`. `begin` is a state of its model (absent: its poses).
/// Throws Error if the scene cannot begin there.
WindowHistory replay_window(const formats::Scene& scene, const LedgerWindow& window, const std::optional<State>& begin,
                            double whole, KeepStates keep, const LedgerStage& stage);

}  // namespace tisserand::mechanism
