// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a ledger: windows, activities, replays, lines.
#include "mechanism/ledger/ledger.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/stable_sort.hpp"
#include "common/text.hpp"
#include "mechanism/ledger/activity.hpp"
#include "mechanism/ledger/comparison.hpp"
#include "mechanism/ledger/inertia_verdict.hpp"
#include "mechanism/switching/transfer.hpp"

namespace tisserand::mechanism {
namespace {

/// Processor time and steps of one scene, summed over windows. The time of a window is the least of its repetitions.
struct Cost {
  double least = 0.0;
  long steps = 0;
  double per_step() const { return steps > 0 ? least / static_cast<double>(steps) : 0.0; }
};

class LedgerMaker {
 public:
  LedgerMaker(const LedgerRequest& request, const BodyFiles& files, const RunControl& control)
      : request_(request),
        control_(control),
        stage_{files, control, request.settings.windows, request.settings.channels},
        own_(build_model(request.scene, files)) {}

  Ledger make() {
    const std::vector<Toggle> toggles = toggles_of(request_.scene, stage_.files, request_.settings.choice);
    tell(0.0, "reference run");
    reference_ = request_.settings.results.empty()
                     ? run_reference(request_.scene, request_.begin, stage_)
                     : windows_of_results(request_.scene, request_.settings.results, stage_);
    if (interrupted()) return stopped();
    for (const LedgerWindow& window : reference_.windows) {
      own_windows_.push_back(replay(request_.scene, window, window.begin, KeepStates::yes));
      if (interrupted()) return stopped();
      require_whole(own_windows_.back());
    }
    measure_sizes(toggles);
    if (interrupted()) return stopped();
    for (const Toggle& toggle : toggles) ledger_.lines.emplace_back().toggle = toggle;
    weigh_activities();
    for (std::size_t i = 0; i < ledger_.lines.size() && !interrupted(); ++i) {
      tell(static_cast<double>(i + 1) / static_cast<double>(ledger_.lines.size() + 1), toggles[i].subject());
      judge(ledger_.lines[i]);
    }
    if (interrupted()) return stopped();
    compare_inertia();
    return finished();
  }

 private:
  double whole() const { return request_.scene.integrator.end - request_.scene.integrator.start; }
  bool interrupted() const { return control_.interrupted && control_.interrupted(); }
  void tell(double done, const std::string& next) const {
    if (request_.progress) request_.progress(done, next);
  }
  Ledger stopped() {
    ledger_.interrupted = true;
    std::erase_if(ledger_.lines, [](const LedgerLine& line) { return !line.replayed; });
    return finished();
  }

  WindowHistory replay(const formats::Scene& scene, const LedgerWindow& window, const std::optional<State>& begin,
                       KeepStates keep) const {
    return replay_window(scene, window, begin, whole(), keep, stage_);
  }
  void require_whole(const WindowHistory& own) const {
    if (!own.failure.empty() || own.states.empty())
      throw Error(fmt::format("the unchanged scene ended early: {}", own.failure), request_.scene.file,
                  "a ledger needs a run that reaches its end: shorten integrator.end");
  }

  /// Sizes from the reference run; with stored results from the windows, or from the whole run if a line needs it.
  void measure_sizes(const std::vector<Toggle>& toggles) {
    sizes_ = reference_.sizes;
    if (sizes_) return;
    const std::vector<WindowHistory>& seen =
        std::ranges::any_of(toggles, changes_deformation) ? own_run() : own_windows_;
    if (interrupted()) return;
    sizes_.emplace(seen.front().measures->list());
    for (const WindowHistory& window : seen)
      for (const MeasuredRow& row : window.rows) sizes_->observe(row);
  }

  /// Computes activities and their fractions of the sum.
  void weigh_activities() {
    const SampledPowers powers(own_.model, own_windows_);
    double sum = 0.0;
    for (LedgerLine& line : ledger_.lines) {
      if (!line.toggle.works) continue;
      try {
        if (line.toggle.effect == formats::effect_word(formats::Effect::flexibility)) {
          if (line.toggle.is == "on") line.activity = powers.of_strain(line.toggle.owner);
        } else {
          const BuiltModel other = build_model(toggled(request_.scene, stage_.files, line.toggle), stage_.files);
          if (share_states(own_.model, other.model)) line.activity = powers.of_difference(other.model);
        }
      } catch (const Error& error) {
        line.failure = error.what();
      }
      sum += line.activity.value_or(0.0);
    }
    for (LedgerLine& line : ledger_.lines)
      if (sum > 0.0) line.share = line.activity.value_or(0.0) / sum;
  }

  void judge(LedgerLine& line) {
    if (!line.failure.empty()) return;
    try {
      replay_toggled(line);
    } catch (const Error& error) {
      line.failure = error.what();
    }
  }

  /// Replays the given and the changed scene by turns, so that both see the same load of the machine.
  void replay_toggled(LedgerLine& line) {
    const formats::Scene scene = toggled(request_.scene, stage_.files, line.toggle);
    const BuiltModel other = build_model(scene, stage_.files);
    const bool whole_run = restarts(line.toggle, other.model);
    const std::vector<LedgerWindow> windows = whole_run ? std::vector{whole_window()} : reference_.windows;
    const std::vector<WindowHistory>& own_windows = whole_run ? own_run() : own_windows_;
    Comparison comparison(*sizes_, own_.model.length);
    std::vector<WindowHistory> histories;
    Cost own, changed;
    std::string failure;
    for (std::size_t w = 0; w < windows.size() && !interrupted(); ++w) {
      const std::optional<State> own_begin = whole_run ? request_.begin : windows[w].begin;
      const std::optional<State> begin = whole_run ? start_of_run(other.model) : own_windows[w].states.front();
      histories.push_back(replay(scene, windows[w], begin, KeepStates::no));
      if (failure.empty()) failure = histories.back().failure;
      comparison.add(own_windows[w], histories.back());
      add_times(windows[w], own_begin, begin, scene, own, changed);
    }
    if (interrupted()) return;  // values of only some windows would mislead
    line.failure = failure;
    line.changes = comparison.changes();
    line.whole_run = whole_run;
    line.replayed = true;
    line.cost = own.per_step() > 0.0 ? changed.per_step() / own.per_step() - 1.0 : 0.0;
    if (line.toggle.effect == inertia_word) histories_[&line] = std::move(histories);
    own_per_step_.push_back(own.per_step());
  }

  static bool changes_deformation(const Toggle& toggle) {
    return toggle.effect == inertia_word || toggle.effect == formats::effect_word(formats::Effect::stiffening) ||
           toggle.effect == formats::effect_word(formats::Effect::flexibility);
  }
  /// A body of another stiffness would begin a window with a deformation that does not fit it, and vibrate. So it runs
  /// from the start.
  bool restarts(const Toggle& toggle, const Model& other) const {
    return changes_deformation(toggle) || !share_states(own_.model, other);
  }
  LedgerWindow whole_window() const {
    return {request_.scene.integrator.start, request_.scene.integrator.end, reference_.windows.front().begin};
  }
  const std::vector<WindowHistory>& own_run() {
    if (!own_run_.empty()) return own_run_;
    own_run_.push_back(replay(request_.scene, whole_window(), request_.begin, KeepStates::yes));
    if (!interrupted()) require_whole(own_run_.front());
    return own_run_;
  }
  /// State at the start of the run; absent: the poses of the scene.
  std::optional<State> start_of_run(const Model& other) const {
    if (!request_.begin || share_states(own_.model, other)) return request_.begin;
    return transfer(own_.model, *request_.begin, other);
  }

  void add_times(const LedgerWindow& window, const std::optional<State>& own_begin, const std::optional<State>& begin,
                 const formats::Scene& scene, Cost& own, Cost& changed) const {
    double own_least = std::numeric_limits<double>::infinity(), least = own_least;
    long own_steps = 0, steps = 0;
    for (int k = 0; k < request_.settings.repeats && !interrupted(); ++k) {
      const WindowHistory before = replay(request_.scene, window, own_begin, KeepStates::no);
      const WindowHistory after = replay(scene, window, begin, KeepStates::no);
      own_least = std::min(own_least, before.seconds);
      least = std::min(least, after.seconds);
      own_steps = before.steps;
      steps = after.steps;
    }
    own.least += own_least;
    own.steps += own_steps;
    changed.least += least;
    changed.steps += steps;
  }

  void compare_inertia() {
    std::map<std::string, std::vector<InertiaRun>> runs;
    for (LedgerLine& line : ledger_.lines) {
      if (line.toggle.effect != inertia_word || !line.failure.empty()) continue;
      std::vector<InertiaRun>& of_body = runs[line.toggle.owner];
      if (of_body.empty()) of_body.push_back({line.toggle.is, &own_run(), 0.0, nullptr});
      of_body.push_back({line.toggle.becomes, &histories_.at(&line), line.cost, &line.from_best});
    }
    for (const auto& [body, of_body] : runs)
      ledger_.verdicts.push_back(inertia_verdict(body, of_body, *sizes_, own_.model.length));
  }

  Ledger finished() {
    ledger_.scene = request_.scene.name;
    ledger_.doubt = reference_.doubt;
    ledger_.windows = count_of(reference_.windows);
    if (ledger_.windows > 0) ledger_.window = reference_.windows.front().end - reference_.windows.front().start;
    if (!own_per_step_.empty()) {
      const auto [least, most] = std::ranges::minmax(own_per_step_);
      ledger_.seconds_per_step = least;
      ledger_.scatter = least > 0.0 ? most / least - 1.0 : 0.0;
    }
    const auto change = [](const LedgerLine& line) { return line.changes.empty() ? -1.0 : line.changes.front().part; };
    sort_stably(ledger_.lines, std::greater{}, change);
    return std::move(ledger_);
  }

  const LedgerRequest& request_;
  const RunControl& control_;
  LedgerStage stage_;
  BuiltModel own_;
  ReferenceRun reference_;
  std::vector<WindowHistory> own_windows_;
  std::vector<WindowHistory> own_run_;  ///< the whole run, computed once a line needs it
  std::optional<MeasureSizes> sizes_;
  std::vector<double> own_per_step_;  ///< processor time of the scene as given, measured with each line
  std::map<const LedgerLine*, std::vector<WindowHistory>> histories_;
  Ledger ledger_;
};

}  // namespace

Ledger make_ledger(const LedgerRequest& request, const BodyFiles& files, const RunControl& control) {
  if (request.scene.analysis != formats::AnalysisKind::dynamics)
    throw Error("a ledger needs a dynamics analysis", request.scene.file, "choose one with --analysis");
  if (request.scene.integrator.accuracy)
    throw Error("a ledger cannot be combined with `accuracy`, which changes the steps from run to run",
                request.scene.file, "set integrator.step or error_control instead of it");
  return LedgerMaker(request, files, control).make();
}

}  // namespace tisserand::mechanism
