// SPDX-License-Identifier: GPL-3.0-or-later
// Runs without files, whose rows and states go to listeners.
#include "mechanism/ledger/replay.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "common/error.hpp"
#include "formats/results/results.hpp"
#include "formats/yaml/emit.hpp"
#include "mechanism/run/simulated_scene.hpp"
#include "mechanism/run/stored_state.hpp"
#include "mechanism/simulate.hpp"

namespace tisserand::mechanism {
namespace {

/// Largest number of compared rows of a window and of a whole run. With error control, rows shorten the steps.
constexpr int most_rows = 40, most_rows_of_a_run = 200;

double run_time(const formats::Scene& scene) { return scene.integrator.end - scene.integrator.start; }

/// Beginning and end of window i. Windows have equal lengths, and their beginnings are evenly spaced over the run.
std::pair<double, double> window_times(const formats::IntegratorSpec& integrator, const WindowChoice& choice, int i) {
  const double whole = integrator.end - integrator.start;
  const double start = integrator.start + whole * i / choice.windows;
  return {start, start + choice.share * whole / choice.windows};
}

/// End of a window on the grid of steps from `start`, after one step at least and not beyond the run.
double end_on_grid(const formats::IntegratorSpec& integrator, double start, double end) {
  if (!integrator.error_control.active && integrator.step > 0.0)
    end = start + integrator.step * std::max(1.0, std::round((end - start) / integrator.step));
  return std::min(end, integrator.end);
}

class ReferenceListener : public RunListener {
 public:
  ReferenceListener(const formats::Scene& scene, const LedgerStage& stage, ReferenceRun& run)
      : scene_(scene), stage_(stage), run_(run) {}

  void begin(const formats::ResultsLayout& layout) override {
    run_.measures.emplace(scene_, layout, stage_.channels, Measures::Missing::is_error);
    run_.sizes.emplace(run_.measures->list());
  }
  void row(const formats::ResultsRow& row) override { run_.sizes->observe(run_.measures->values(row)); }
  void state(const State& state) override {
    const int next = count_of(run_.windows);
    if (next == stage_.choice.windows) return;
    const auto [start, end] = window_times(scene_.integrator, stage_.choice, next);
    const double round_off = 1e-9 * run_time(scene_), time = state.time();
    if (time < start - round_off || time > scene_.integrator.end - round_off) return;
    run_.windows.push_back({time, end_on_grid(scene_.integrator, time, time + (end - start)), state});
  }

 private:
  const formats::Scene& scene_;
  const LedgerStage& stage_;
  ReferenceRun& run_;
};

class ReplayListener : public RunListener {
 public:
  ReplayListener(const formats::Scene& scene, KeepStates keep, const LedgerStage& stage, WindowHistory& history)
      : scene_(scene), keep_(keep), stage_(stage), history_(history) {}

  void begin(const formats::ResultsLayout& layout) override {
    history_.measures.emplace(scene_, layout, stage_.channels,
                              keep_ == KeepStates::yes ? Measures::Missing::is_error : Measures::Missing::is_left_out);
  }
  void row(const formats::ResultsRow& row) override {
    history_.time.push_back(row.time);
    history_.rows.push_back(history_.measures->values(row));
  }
  void state(const State& state) override {
    if (keep_ == KeepStates::yes) history_.states.push_back(state);
  }

 private:
  const formats::Scene& scene_;
  KeepStates keep_;
  const LedgerStage& stage_;
  WindowHistory& history_;
};

/// Scene that computes one window of the run.
formats::Scene windowed(const formats::Scene& scene, const LedgerWindow& window, double whole) {
  formats::Scene part = scene;
  const double length = window.end - window.start;
  const int rows = length > 0.99 * whole ? most_rows_of_a_run : most_rows;
  formats::IntegratorSpec& integrator = part.integrator;
  integrator.start = window.start;
  integrator.end = window.end;
  part.checkpoint = {};
  part.output = {};
  part.output.from = window.start;
  if (!integrator.error_control.active) {
    const double steps = integrator.step > 0.0 ? length / integrator.step : 1.0;
    part.output.every = std::max(1, static_cast<int>(steps / rows));
    return part;
  }
  // Defaults that depend on the length of the run keep the values of the whole run.
  formats::ErrorControl& control = integrator.error_control;
  if (control.max_step == 0.0) control.max_step = 0.1 * whole;
  if (control.min_step == 0.0) control.min_step = 1e-12 * whole;
  if (integrator.method != formats::Method::radau) control.tolerance *= length / whole;
  if (window.begin.step() > 0.0) integrator.step = window.begin.step();
  part.output.interval = length / rows;
  return part;
}

[[noreturn]] void throw_unfinished(const formats::Scene& scene, const RunReport& report) {
  throw Error(fmt::format("the reference run of the ledger ended early: {}", report.reason), scene.file,
              "a ledger needs a run that reaches its end: shorten integrator.end");
}

void require_windows(const formats::Scene& scene, const ReferenceRun& run) {
  if (run.windows.empty())
    throw Error("the run has no instant at which a window can begin", scene.file, "give it more steps");
}

/// Message with the first line in which the scene of the results differs; empty: no difference, or unknown.
std::string other_scene(const formats::Scene& scene, const BodyFiles& files, const formats::ResultsReader& results) {
  const std::string& stored = results.layout().simulated.text;
  if (!scene.tree || stored.empty()) return {};
  const bool has_contents = stored.find("\n# ") != std::string::npos;  // results of former versions have no contents
  std::istringstream there(stored), here(has_contents ? scene_text(scene, files) : formats::block_text(*scene.tree));
  std::string a, b;
  while (true) {
    const bool more_there = bool(std::getline(there, a)), more_here = bool(std::getline(here, b));
    if (!more_there && !more_here) return {};
    if (more_there && more_here && a == b) continue;
    const auto text = [](bool more, const std::string& line) {
      return more ? fmt::format("'{}'", line.substr(std::min(line.find_first_not_of(' '), line.size()))) : "nothing";
    };
    return fmt::format(
        "{} contains results of another scene or of other settings: {} there, {} in this scene. The windows begin with "
        "the states of these results",
        results.path(), text(more_there, a), text(more_here, b));
  }
}

}  // namespace

ReferenceRun run_reference(const formats::Scene& scene, const std::optional<State>& begin, const LedgerStage& stage) {
  formats::Scene whole = scene;
  whole.checkpoint = {};
  whole.output = {};
  whole.output.from = scene.integrator.start;
  ReferenceRun run;
  ReferenceListener listener(whole, stage, run);
  RunRequest request{whole, stage.files, begin};
  request.listener = &listener;
  const RunReport report = simulate(request, stage.control).report;
  if (report.outcome == RunOutcome::interrupted) return run;
  if (report.outcome != RunOutcome::completed) throw_unfinished(scene, report);
  require_windows(scene, run);
  return run;
}

ReferenceRun windows_of_results(const formats::Scene& scene, const std::string& file, const LedgerStage& stage) {
  const formats::ResultsReader results(file);
  const std::vector<double> time = results.time();
  const BuiltModel built = build_model(scene, stage.files);
  Workspace workspace(built.model);
  ReferenceRun run;
  run.doubt = other_scene(scene, stage.files, results);
  for (int i = 0; i < stage.choice.windows; ++i) {
    const auto [start, end] = window_times(scene.integrator, stage.choice, i);
    const auto found = std::ranges::lower_bound(time, start - 1e-9 * run_time(scene));
    if (found == time.end() || *found >= scene.integrator.end) break;
    if (!run.windows.empty() && *found <= run.windows.back().start) continue;  // two windows share a stored instant
    State state = built.state;
    read_stored_state(built.model, file, *found, state, workspace);
    run.windows.push_back({*found, end_on_grid(scene.integrator, *found, *found + (end - start)), state});
  }
  require_windows(scene, run);
  return run;
}

WindowHistory replay_window(const formats::Scene& scene, const LedgerWindow& window, const std::optional<State>& begin,
                            double whole, KeepStates keep, const LedgerStage& stage) {
  const formats::Scene part = windowed(scene, window, whole);
  WindowHistory history;
  ReplayListener listener(part, keep, stage, history);
  RunRequest request{part, stage.files, begin};
  request.listener = &listener;
  const RunReport report = simulate(request, stage.control).report;
  history.seconds = report.seconds_steps;
  history.steps = report.steps;
  if (report.outcome != RunOutcome::completed) history.failure = report.reason;
  return history;
}

}  // namespace tisserand::mechanism
