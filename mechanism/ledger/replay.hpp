// Windows of a run, and the same windows again with a scene that may differ in one effect.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/ledger/measures.hpp"
#include "mechanism/run/run.hpp"

namespace tisserand::mechanism {

/// A stretch of a run and the state at its beginning.
struct LedgerWindow {
  double start = 0.0, end = 0.0;
  State begin;
};

struct WindowChoice {
  int windows = 5;
  double share = 0.25;  ///< of the time of the run, all windows together
};

/// What was seen of one window: rows that are measured, how long its steps took, and why it ended early (empty: it did
/// not).
struct WindowHistory {
  std::optional<Measures> measures;  ///< of the layout of its rows
  std::vector<double> time;
  std::vector<MeasuredRow> rows;
  std::vector<State> states;  ///< of each row, where they are asked for
  double seconds = 0.0;       ///< of processor time in the steps
  long steps = 0;
  std::string failure;
};

/// What a replay needs of its surroundings.
struct LedgerStage {
  const BodyFiles& files;
  const RunControl& control;  ///< its clock: of the processor
  const WindowChoice& choice;
  const std::vector<std::string>& channels;
};

/// Runs the scene from `begin` (absent: its poses) without results; keeps the states at which windows begin, and the
/// largest sizes of what is measured. Throws Error where it does not come to its end; one that is interrupted returns
/// what there is.
struct ReferenceRun {
  std::vector<LedgerWindow> windows;
  std::optional<Measures> measures;
  std::optional<MeasureSizes> sizes;
  std::string doubt;  ///< of stored results: that they are not of this scene; empty: they are, or do not tell
};
ReferenceRun run_reference(const formats::Scene& scene, const std::optional<State>& begin, const LedgerStage& stage);

/// The windows of `file`, results of the same scene: each begins at the first instant stored after its time.
ReferenceRun windows_of_results(const formats::Scene& scene, const std::string& file, const LedgerStage& stage);

enum class KeepStates { no, yes };

/// One window of a run of length `whole` with `scene`, whose model `begin` is a state of; absent: from its poses.
/// Throws Error where the scene cannot begin there.
WindowHistory replay_window(const formats::Scene& scene, const LedgerWindow& window, const std::optional<State>& begin,
                            double whole, KeepStates keep, const LedgerStage& stage);

}  // namespace tisserand::mechanism
