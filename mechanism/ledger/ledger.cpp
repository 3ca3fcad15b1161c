// Windows, activities, replays, lines: the story of a ledger.
#include "mechanism/ledger/ledger.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/ledger/activity.hpp"
#include "mechanism/ledger/comparison.hpp"
#include "mechanism/ledger/inertia_verdict.hpp"
#include "mechanism/ledger/settle.hpp"
#include "mechanism/ledger/transfer.hpp"

namespace tisserand::mechanism {
namespace {

/// Processor time and steps of one scene over all windows: of each window the least time.
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
        stage_{files, control, request.windows, request.channels},
        own_(build_model(request.scene, files)) {}

  Ledger make() {
    const std::vector<Toggle> toggles = toggles_of(request_.scene, stage_.files, request_.choice);
    tell(0.0, "the run");
    reference_ = request_.results.empty() ? run_reference(request_.scene, request_.begin, stage_)
                                          : windows_of_results(request_.scene, request_.results, stage_);
    if (interrupted()) return stopped();
    for (const LedgerWindow& window : reference_.windows)
      own_windows_.push_back(replay(request_.scene, window, window.begin, KeepStates::yes));
    measure_sizes();
    for (const Toggle& toggle : toggles) ledger_.lines.push_back({toggle, {}, 0.0, {}, 0.0, false, "", 0.0});
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
    return std::move(ledger_);
  }

  WindowHistory replay(const formats::Scene& scene, const LedgerWindow& window, const State& begin,
                       KeepStates keep) const {
    return replay_window(scene, window, begin, whole(), keep, stage_);
  }

  /// Of a run of its own all of it was seen, of stored results the windows.
  void measure_sizes() {
    sizes_ = reference_.sizes;
    if (sizes_) return;
    sizes_.emplace(own_windows_.front().measures->list());
    for (const WindowHistory& window : own_windows_)
      for (const MeasuredRow& row : window.rows) sizes_->observe(row);
  }

  /// Activities, and their shares of the sum.
  void weigh_activities() {
    const SampledPowers powers(own_.model, own_windows_);
    double sum = 0.0;
    for (LedgerLine& line : ledger_.lines) {
      if (!line.toggle.works) continue;
      try {
        if (line.toggle.effect == formats::effect_word(formats::Effect::flexibility)) {
          if (line.toggle.is == "on") line.activity = powers.of_strain(line.toggle.body);
        } else {
          const BuiltModel other = build_model(toggled(request_.scene, line.toggle), stage_.files);
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
    if (line.activity && request_.least_activity > 0.0 && line.share < request_.least_activity) return;
    try {
      replay_toggled(line);
    } catch (const Error& error) {
      line.failure = error.what();
    }
  }

  /// The scene as it is and as it could be by turns, so that both have the same machine.
  void replay_toggled(LedgerLine& line) {
    const formats::Scene scene = toggled(request_.scene, line.toggle);
    const BuiltModel other = build_model(scene, stage_.files);
    Comparison comparison(*sizes_, own_.model.length);
    std::vector<WindowHistory> histories;
    Cost own, changed;
    for (std::size_t w = 0; w < reference_.windows.size() && !interrupted(); ++w) {
      const LedgerWindow& window = reference_.windows[w];
      const State begin = beginning(line.toggle, w, other.model);
      histories.push_back(replay(scene, window, begin, KeepStates::no));
      if (line.failure.empty() && !histories.back().failure.empty()) line.failure = histories.back().failure;
      comparison.add(own_windows_[w], histories.back());
      add_times(scene, window, begin, own, changed);
    }
    line.changes = comparison.changes();
    line.replayed = true;
    line.cost = own.per_step() > 0.0 ? changed.per_step() / own.per_step() - 1.0 : 0.0;
    if (line.toggle.effect == inertia_word) histories_[&line] = std::move(histories);
    own_per_step_.push_back(own.per_step());
  }

  /// Where the other model begins: as the scene does, at the first row of its own window. What becomes stiffer or
  /// softer takes the deformation that it would have in the same motion.
  State beginning(const Toggle& toggle, std::size_t window, const Model& other) const {
    const State& own = own_windows_[window].states.front();
    if (!share_states(own_.model, other)) return transfer(own_.model, own, other);
    const bool settles =
        toggle.effect == inertia_word || toggle.effect == formats::effect_word(formats::Effect::stiffening);
    const LedgerWindow& times = reference_.windows[window];
    return settles ? settled(other, own, times.end - times.start) : own;
  }

  void add_times(const formats::Scene& scene, const LedgerWindow& window, const State& begin, Cost& own,
                 Cost& changed) const {
    double own_least = std::numeric_limits<double>::infinity(), least = own_least;
    long own_steps = 0, steps = 0;
    for (int k = 0; k < request_.repeats && !interrupted(); ++k) {
      const WindowHistory before = replay(request_.scene, window, window.begin, KeepStates::no);
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
      std::vector<InertiaRun>& of_body = runs[line.toggle.body];
      if (of_body.empty()) of_body.push_back({line.toggle.is, &own_windows_, 0.0, nullptr});
      of_body.push_back({line.toggle.becomes, &histories_.at(&line), line.cost, &line.from_best});
    }
    for (const auto& [body, of_body] : runs)
      ledger_.verdicts.push_back(inertia_verdict(body, of_body, *sizes_, own_.model.length));
  }

  Ledger finished() {
    ledger_.scene = request_.scene.name;
    ledger_.windows = static_cast<int>(reference_.windows.size());
    ledger_.window = reference_.windows.front().end - reference_.windows.front().start;
    if (!own_per_step_.empty()) {
      const auto [least, most] = std::ranges::minmax(own_per_step_);
      ledger_.seconds_per_step = least;
      ledger_.scatter = least > 0.0 ? most / least - 1.0 : 0.0;
    }
    const auto change = [](const LedgerLine& line) { return line.changes.empty() ? -1.0 : line.changes.front().part; };
    std::ranges::stable_sort(ledger_.lines, std::greater{}, change);
    return std::move(ledger_);
  }

  const LedgerRequest& request_;
  const RunControl& control_;
  LedgerStage stage_;
  BuiltModel own_;
  ReferenceRun reference_;
  std::vector<WindowHistory> own_windows_;
  std::optional<MeasureSizes> sizes_;
  std::vector<double> own_per_step_;  ///< processor time of the scene as it is, beside each line
  std::map<const LedgerLine*, std::vector<WindowHistory>> histories_;
  Ledger ledger_;
};

}  // namespace

Ledger make_ledger(const LedgerRequest& request, const BodyFiles& files, const RunControl& control) {
  if (request.scene.analysis != formats::AnalysisKind::dynamics)
    throw Error("a ledger is made of the motion of a dynamics analysis", request.scene.file,
                "name one with --analysis");
  if (request.scene.integrator.accuracy)
    throw Error("a ledger needs steps, not `accuracy`, which changes them from run to run", request.scene.file,
                "give integrator.step or error_control in its place");
  return LedgerMaker(request, files, control).make();
}

}  // namespace tisserand::mechanism
