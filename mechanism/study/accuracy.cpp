// Trials, what they differ by, and the next tolerance.
#include "mechanism/study/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/results/blocks.hpp"
#include "mechanism/study/measure.hpp"

namespace tisserand::mechanism {
namespace {

using formats::AccuracySpec;

constexpr double first_tolerance = 10.0;              ///< over the error asked for
constexpr double second_part = 8.0;                   ///< of the first tolerance
constexpr double aim = 0.4;                           ///< part of the error that a further tolerance aims at
constexpr double least_part = 1e-3, most_part = 0.5;  ///< of the tolerance before
/// Order of the error in the tolerance, E ~ τ^p, that is relied on at most and at least, and the part of a measured
/// one: p is one where the whole time shares the tolerance; steps of radau are measured by an estimate of lower order.
constexpr double usual_order = 0.7, radau_order = 0.5, least_order = 0.3, trusted_part = 0.9;
/// Errors fall with the steps to twice the power with which they fall with the tolerance, or faster; runs whose steps
/// are not this much more say nothing.
constexpr double steps_order = 2.0, fewest_more = 1.3;
constexpr double least_tolerance = 1e-12, most_tolerance = 0.05;
constexpr int most_runs = 8;
constexpr double instants = 500.0;  ///< stored ones, where the scene names none
/// Of the error, that modes which are left out may make.
constexpr double modes_part = 0.1;
/// What twice the modes leave of their error: frequencies rise at least in proportion to their number, what a mode
/// follows quasi-statically errs with the inverse square of its own.
constexpr double modes_fall = 0.25;

/// Modes per body with a choice; empty: all of all.
using Modes = std::map<std::string, int>;

/// The history of one channel; `judge` sees the report of a run that completed before it is stored.
class Recorder : public RunListener {
 public:
  Recorder(std::string channel, std::string where) : channel_(std::move(channel)), where_(std::move(where)) {}

  void begin(const formats::ResultsLayout& layout) override;
  void row(const formats::ResultsRow& row) override {
    history.x.push_back(row.time);
    history.y.push_back(values_(row)[column_]);
  }
  void end(RunReport& report) override {
    if (judge && report.outcome == RunOutcome::completed) judge(report);
  }

  Series history;
  std::function<void(RunReport&)> judge;

 private:
  std::string channel_, where_;
  const double* (*values_)(const formats::ResultsRow&) = nullptr;
  std::size_t column_ = 0;
};

void Recorder::begin(const formats::ResultsLayout& layout) {
  history = {};
  history.source = where_;
  history.channel = channel_;
  std::vector<std::string> names;
  for (const formats::Block& block : formats::all_blocks(layout))
    for (std::size_t i = 0; i < block.width(); ++i) {
      names.push_back(block.dataset.substr(1) + (block.columns[i].empty() ? "" : "/" + block.columns[i]));
      if (names.back() != channel_) continue;
      values_ = block.values;
      column_ = i;
      return;
    }
  throw Error(fmt::format("integrator.accuracy.of: there is no channel '{}'", printable_line(channel_, 200)), where_,
              fmt::format("the nearest are {}", listed(nearest_names(channel_, names))));
}

/// A results file that nobody keeps.
struct Passing {
  std::string path;
  explicit Passing(std::string place) : path(std::move(place)) {}
  ~Passing() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

class Search {
 public:
  Search(const RunRequest& request, const RunControl& control)
      : request_(request),
        control_(control),
        accuracy_(*request.scene.integrator.accuracy),
        recorder_(accuracy_.of, request.scene.file),
        passing_(request.path + ".modes") {
    quantity_.name = "accuracy";
    quantity_.norm = accuracy_.norm;
    quantity_.scale = accuracy_.scale;
    order_ = request.scene.integrator.method == formats::Method::radau ? radau_order : usual_order;
  }

  RunEnd run();

 private:
  RunEnd take(double tolerance, const Modes& modes, const std::string& path);
  formats::Scene scene_with(double tolerance, const Modes& modes) const;
  Modes halved() const;
  void leave_out_modes(double tolerance);
  void judge(RunReport& report, double before, double tolerance, bool last);
  std::string told_of_modes() const;

  const RunRequest& request_;
  const RunControl& control_;
  const AccuracySpec& accuracy_;
  formats::StudyQuantity quantity_;
  Recorder recorder_;
  Passing passing_;
  std::vector<std::string> cost_;  ///< of each run: tolerance and seconds
  Series previous_;                ///< of the run before
  Series half_;                    ///< at the second tolerance, with half of the modes
  Modes modes_;                    ///< that are left; empty: all
  double half_changes_ = 0.0;      ///< what the upper half of all modes adds
  double left_out_ = 0.0;          ///< what modes that are left out would change
  double order_;
  long steps_ = 0;                    ///< of the run before
  double change_ = 0.0, fall_ = 1.0;  ///< by the run before: of the history, and of the tolerance
  double estimate_ = 0.0;             ///< of what the tolerance leaves
  double room_ = 0.0;                 ///< for it
};

formats::Scene Search::scene_with(double tolerance, const Modes& modes) const {
  formats::Scene scene = request_.scene;
  formats::IntegratorSpec& integrator = scene.integrator;
  integrator.accuracy.reset();
  integrator.error_control.tolerance = integrator.bdf.relative_tolerance = tolerance;
  integrator.bdf.absolute_tolerance = 1e-2 * tolerance;
  if (!scene.output.interval) scene.output.interval = (integrator.end - integrator.start) / instants;
  scene.output.every = 1;
  if (!scene.output.channels.empty()) scene.output.channels.push_back(accuracy_.of);
  for (formats::BodySpec& body : scene.bodies)
    if (auto* spec = std::get_if<formats::SuperelementBodySpec>(&body); spec != nullptr)
      if (const auto found = modes.find(spec->name); found != modes.end()) spec->modes = found->second;
  return scene;
}

RunEnd Search::take(double tolerance, const Modes& modes, const std::string& path) {
  const formats::Scene scene = scene_with(tolerance, modes);
  RunRequest request{scene, request_.files, request_.begin, path, "", std::nullopt};
  request.listener = &recorder_;
  const auto now = [this] { return control_.clock ? control_.clock() : 0.0; };
  const double start = now();
  RunEnd end = simulate(request, control_);
  cost_.push_back(fmt::format("{:.2g} ({:.2g} s{})", tolerance, now() - start, modes.empty() ? "" : ", fewer modes"));
  return end;
}

/// Half of the modes of every superelement whose modes the scene leaves open; empty: there is nothing to halve.
Modes Search::halved() const {
  Modes half;
  bool any = false;
  for (const formats::BodySpec& body : request_.scene.bodies) {
    const auto* spec = std::get_if<formats::SuperelementBodySpec>(&body);
    if (spec == nullptr || spec->rigid || spec->modes || spec->cutoff || !spec->damping.ratios.empty() ||
        !spec->damping.ratios_internal.empty())
      continue;
    const std::vector<int>& node = request_.files.superelements.at(spec->file).superelement.dof_node;
    const auto all = static_cast<int>(std::ranges::count(node, -1));
    const auto found = modes_.find(spec->name);
    const int now = found == modes_.end() ? all : found->second;
    half[spec->name] = now / 2;
    any = any || now > 1;
  }
  return any ? half : Modes{};
}

/// After the second run, while halves of the modes change what it found by little: further runs go without them.
void Search::leave_out_modes(double tolerance) {
  if (half_.x.empty() || half_changes_ > modes_part * accuracy_.error) return;
  left_out_ = half_changes_;
  modes_ = halved();
  for (Modes half = halved(); !half.empty(); half = halved()) {
    if (take(tolerance, half, passing_.path).report.outcome != RunOutcome::completed) return;
    const double change = error_of(recorder_.history, previous_, quantity_);
    if (change > modes_part * accuracy_.error) return;
    left_out_ = change;
    modes_ = std::move(half);
  }
}

std::string Search::told_of_modes() const {
  if (half_.x.empty()) return {};
  if (modes_.empty()) return fmt::format("; the upper half of the modes changes it by {:.2g}", half_changes_);
  std::vector<std::string> counts;
  for (const auto& [name, count] : modes_) counts.push_back(fmt::format("{} of '{}'", count, name));
  return fmt::format("; modes: {}, the others change it by {:.1g}", listed(counts), left_out_);
}

void Search::judge(RunReport& report, double before, double tolerance, bool last) {
  if (modes_.empty() && !half_.x.empty() && half_changes_ == 0.0)
    half_changes_ = error_of(half_, recorder_.history, quantity_);
  const double missing = modes_.empty() ? modes_fall * half_changes_ : left_out_;
  const double change = error_of(previous_, recorder_.history, quantity_);
  if (change_ > 0.0 && change > 0.0)
    order_ = std::min(order_, std::max(least_order, trusted_part * std::log(change_ / change) / std::log(fall_)));
  const double fall = before / tolerance, more = static_cast<double>(report.steps) / std::max(1L, steps_);
  estimate_ = std::max(change * std::pow(fall, -order_), change_ * std::pow(fall * fall_, -order_));
  estimate_ = std::max(estimate_, change * std::pow(more, -steps_order * order_));
  // Instants of output or the longest step, not the tolerance, chose the steps: the same ones differ by nothing.
  if (more < fewest_more) estimate_ = std::numeric_limits<double>::infinity();
  change_ = change;
  fall_ = fall;
  steps_ = report.steps;
  room_ = accuracy_.error - std::min(missing, 0.5 * accuracy_.error);
  report.notes.push_back(
      fmt::format("accuracy: the error of '{}' is estimated at {:.2g} ({:g} asked for), with tolerance "
                  "{:.3g}{}; runs before, by tolerance: {}",
                  accuracy_.of, estimate_ + missing, accuracy_.error, tolerance, told_of_modes(), join(cost_, ", ")));
  if (!last && estimate_ > room_) return;
  if (modes_.empty() && missing > 0.5 * accuracy_.error)
    report.doubts.push_back(
        fmt::format("'{}' may miss modes that the superelement files do not hold: the upper half of "
                    "those that they hold changes it by {:.2g}; raise 'modes' in the part",
                    accuracy_.of, half_changes_));
  if (estimate_ > room_)
    report.doubts.push_back(
        fmt::format("an error of {:g} of '{}' was not reached: {:.2g} is estimated; ask for less, or "
                    "take method: radau",
                    accuracy_.error, accuracy_.of, estimate_));
}

RunEnd Search::run() {
  double tolerance = std::min(first_tolerance * accuracy_.error, most_tolerance);
  RunEnd end = take(tolerance, modes_, request_.path);
  if (end.report.outcome != RunOutcome::completed) return end;
  previous_ = recorder_.history;
  steps_ = end.report.steps;
  double next = tolerance / second_part;
  if (const Modes half = halved(); !half.empty())
    if (take(next, half, passing_.path).report.outcome == RunOutcome::completed) half_ = recorder_.history;
  for (int run = 2;; ++run) {
    const double before = std::exchange(tolerance, next);
    const bool last = run == most_runs || tolerance <= least_tolerance;
    recorder_.judge = [&](RunReport& report) { judge(report, before, tolerance, last); };
    end = take(tolerance, modes_, request_.path);
    recorder_.judge = nullptr;
    if (end.report.outcome != RunOutcome::completed || last || estimate_ <= room_) return end;
    previous_ = recorder_.history;
    if (run == 2) leave_out_modes(tolerance);
    const double aimed = tolerance * std::pow(aim * room_ / estimate_, 1.0 / order_);
    next = std::max(least_tolerance, std::clamp(aimed, least_part * tolerance, most_part * tolerance));
  }
}

}  // namespace

RunEnd simulate_to_accuracy(const RunRequest& request, const RunControl& control) {
  if (!request.restart.empty())
    throw Error("a run with 'accuracy' cannot go on from a file", request.scene.file,
                "give 'step' or 'error_control' in its place");
  return Search(request, control).run();
}

}  // namespace tisserand::mechanism
