// SPDX-License-Identifier: GPL-3.0-or-later
// Trial runs, and conclusions from their differences: the remaining error, the next tolerance, the modes.
#include "mechanism/study/accuracy.hpp"

#include <algorithm>
#include <cmath>
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

/// Dependence of errors and work of a method on its tolerance.
struct Rates {
  double first;        ///< tolerance of the first run over the requested error
  double second_part;  ///< first tolerance over the second one
  double order;        ///< assumed order of the error in the tolerance, E ~ τ^p, at most
  double steps_order;  ///< order of the error in the steps
  double fewest_more;  ///< least ratio of the steps of two runs whose difference is used
  double work;         ///< steps ~ τ^-work
};
/// Errors of generalised alpha that distribute the tolerance over the time have p = 1. Its steps end at instants of
/// output. Runs whose steps these instants determine do not differ.
constexpr Rates shared{10.0, 8.0, 0.7, 2.0, 1.3, 0.5};
/// Radau needs 1.5 times the steps for a tenth of the tolerance. Its errors fall less evenly, since an estimate of
/// lower order controls the steps. On smooth motion errors of 10 to 100 times the tolerance add up.
constexpr Rates of_radau{0.03, 10.0, 0.5, 5.0, 1.05, 0.2};

/// First tolerance of radau over the requested error, and its ratio to the second, for rates in scenes that may
/// vibrate. Error control sees vibrations by their displacements. Smaller ones are damped and missing in every run, but
/// may be most of a velocity. A vibration 10⁵ times faster than the motion has 10⁻⁵ of the displacement.
constexpr double first_of_rates = 1e-6, second_of_rates = 30.0;
/// Largest number of steps of the first run of an automatic method. Beyond it another method is taken.
constexpr long most_first_steps = 50000;
constexpr double aim = 0.4;                              ///< fraction of the error at which a further tolerance aims
constexpr double least_part = 1e-3, most_part = 0.5;     ///< bounds of a tolerance over the previous one
constexpr double least_order = 0.3, trusted_part = 0.9;  ///< bound and fraction of measured orders
/// No further run begins if its predicted time exceeds both this [s] and this multiple of the first run.
constexpr double longest_run = 600.0, longest_of_first = 20.0;
constexpr double least_tolerance = 1e-12, most_tolerance = 0.05;
constexpr int most_runs = 8;
constexpr double instants = 500.0;  ///< stored instants, if the scene names none
/// Fraction of the error that omitted modes may cause.
constexpr double modes_part = 0.1;
/// Fraction of the error that modes missing in the files may cause without a warning.
constexpr double most_missing = 0.5;
/// Fraction of the error of modes that remains with twice the modes. Frequencies rise at least in proportion to the
/// number of modes. The error of quasi-static modes falls with the inverse square of their frequency.
constexpr double modes_fall = 0.25;

/// Conclusions from differences of runs with falling tolerances: the error of the last run, and the next tolerance.
class FallingTolerance {
 public:
  explicit FallingTolerance(const Rates& rates) : rates_(rates), order_(rates.order) {}

  double first(double error) const {
    return std::clamp(rates_.first * error, rates_.second_part * least_tolerance, most_tolerance);
  }
  double second(double first) const { return first / rates_.second_part; }

  /// Registers the `change` of the history by a run with a tolerance `fall` times smaller and `more` times the steps.
  void observe(double change, double fall, double more) {
    if (change_ > 0.0 && change > 0.0)
      order_ = std::min(order_, std::max(least_order, trusted_part * std::log(change_ / change) / std::log(fall_)));
    error_ = std::max({change * std::pow(fall, -order_), change_ * std::pow(fall * fall_, -order_),
                       change * std::pow(more, -rates_.steps_order * order_)});
    // Instants of output or the longest step determined the steps, not the tolerance. Equal steps give no difference.
    if (more < rates_.fewest_more) error_ = std::numeric_limits<double>::infinity();
    change_ = change;
    fall_ = fall;
  }
  /// Discards the last change, which was not caused by the tolerance.
  void forget() { change_ = 0.0; }

  double change() const { return change_; }
  double error() const { return error_; }
  double next(double tolerance, double error) const {
    const double aimed = std::isfinite(error_) ? tolerance * std::pow(aim * error / error_, 1.0 / order_)
                                               : tolerance / rates_.second_part;
    return std::max(least_tolerance, std::clamp(aimed, least_part * tolerance, most_part * tolerance));
  }
  /// Predicted time of a run with the tolerance `next`, if one with `tolerance` took `seconds`.
  double predicted(double seconds, double tolerance, double next) const {
    return seconds * std::pow(tolerance / next, rates_.work);
  }

 private:
  Rates rates_;
  double order_;
  double change_ = 0.0, fall_ = 1.0;  ///< previous run: change of the history, and of the tolerance
  double error_ = 0.0;
};

/// Modes per body with a choice; empty: all modes of all bodies.
using Modes = std::map<std::string, int>;

/// Recorder of the history of one channel. `judge` receives the report of a completed run before it is stored.
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
  const std::string channel = formats::without_alias(channel_, layout);
  std::vector<std::string> names;
  for (const formats::Block& block : formats::all_blocks(layout))
    for (std::size_t i = 0; i < block.width(); ++i) {
      names.push_back(block.dataset.substr(1) + (block.columns[i].empty() ? "" : "/" + block.columns[i]));
      if (names.back() != channel) continue;
      values_ = block.values;
      column_ = i;
      return;
    }
  throw Error(fmt::format("integrator.accuracy.of: there is no channel '{}'", printable_line(channel_, 200)), where_,
              fmt::format("the nearest are {}", listed(nearest_names(channel_, names))));
}

/// Whether something in the scene may vibrate much faster than it moves.
bool may_vibrate(const formats::Scene& scene) {
  const auto bends = [](const formats::BodySpec& body) {
    return !std::holds_alternative<formats::RigidBodySpec>(body);
  };
  return !scene.springs.empty() || !scene.bushings.empty() || std::ranges::any_of(scene.bodies, bends);
}

bool is_place(const std::string& channel) {
  return channel.starts_with("nodes/position/") || channel.starts_with("nodes/rotation/") ||
         channel.starts_with("joints/coordinate/");
}

/// Method if the scene leaves it open: radau, except with friction, since its steps do not end where friction changes.
formats::Method chosen_method(const formats::Scene& scene) {
  const bool rubs = std::ranges::any_of(scene.joints, [](const auto& joint) { return joint.friction.has_value(); });
  return rubs || scene.integrator.linear_solver == formats::LinearSolver::qr ? formats::Method::generalised_alpha
                                                                             : formats::Method::radau;
}

/// Entry of `output.channels` for this channel: the channel itself for nodes, else the dataset ("joints/force").
std::string dataset_of(const std::string& channel) {
  if (channel.starts_with("nodes/")) return channel;
  const std::size_t group = channel.find('/');
  return group == std::string::npos ? channel : channel.substr(0, channel.find('/', group + 1));
}

class Search {
 public:
  Search(const RunRequest& request, const RunControl& control)
      : request_(request),
        control_(control),
        accuracy_(*request.scene.integrator.accuracy),
        recorder_(accuracy_.of, request.scene.file) {
    quantity_.name = "accuracy";
    quantity_.norm = accuracy_.norm;
    quantity_.scale = accuracy_.scale;
    const formats::Method method = request.scene.integrator.method;
    use(method == formats::Method::automatic ? chosen_method(request.scene) : method);
  }

  RunEnd run() {
    const Modes half = halved();
    RunEnd end = begin(half);
    if (end.report.outcome != RunOutcome::completed) return end;
    double tolerance = tolerance_.first(accuracy_.error), next = tolerance_.second(tolerance);
    previous_ = {recorder_.history, end.report.steps};
    modes_.mixed = !half.empty();
    if (modes_.mixed) modes_.half = previous_.history;
    for (int run = 2;; ++run) {
      const double before = std::exchange(tolerance, next);
      const bool last = run == most_runs || tolerance <= least_tolerance;
      recorder_.judge = [&](RunReport& report) { judge(report, before, tolerance, last); };
      end = take(tolerance, modes_.left, request_.path, recorder_);
      recorder_.judge = nullptr;
      if (end.report.outcome != RunOutcome::completed || last || too_long_ || is_reached()) return end;
      previous_.history = recorder_.history;
      if (run == 2) leave_out_modes(tolerance);
      next = tolerance_.next(tolerance, room_);
    }
  }

 private:
  /// Data of a run besides its report.
  struct Trial {
    Series history;
    long steps = 0;
  };
  /// Data on the number of modes.
  struct Choice {
    Modes left;               ///< empty: all
    Series half;              ///< history at the first tolerance with half of them; empty: the run had all of them
    bool mixed = false;       ///< the previous run had half of the modes, and its tolerance
    double upper_half = 0.0;  ///< change by the upper half of all modes
    double left_out = 0.0;    ///< change by omitted modes
  };

  void use(formats::Method method) {
    method_ = method;
    Rates rates = method == formats::Method::radau ? of_radau : shared;
    if (method == formats::Method::radau && !is_place(accuracy_.of) && may_vibrate(request_.scene))
      rates.first = first_of_rates, rates.second_part = second_of_rates;
    tolerance_ = FallingTolerance(rates);
  }

  /// Runs at the first tolerance. If the chosen method fails, it takes another one. Nothing is stored, unless it fails.
  RunEnd begin(const Modes& modes) {
    const bool replaceable =
        request_.scene.integrator.method == formats::Method::automatic && method_ == formats::Method::radau;
    most_steps_ = replaceable ? most_first_steps : 0;
    std::optional<RunEnd> end;
    try {
      end = take(tolerance_.first(accuracy_.error), modes, "", recorder_);
    } catch (const Error&) {
      if (!replaceable) throw;
    }
    most_steps_ = 0;
    const bool fits =
        end && (end->report.outcome == RunOutcome::completed ||
                (end->report.outcome == RunOutcome::interrupted && end->report.steps <= most_first_steps));
    if (replaceable && !fits) {
      use(formats::Method::generalised_alpha);
      end = take(tolerance_.first(accuracy_.error), modes, "", recorder_);
    }
    first_took_ = now() - began_;
    if (end->report.outcome != RunOutcome::completed)
      end = take(tolerance_.first(accuracy_.error), {}, request_.path, recorder_);
    return std::move(*end);
  }

  RunEnd take(double tolerance, const Modes& modes, const std::string& path, Recorder& recorder) {
    const formats::Scene scene = scene_with(tolerance, modes);
    RunRequest request{scene, request_.files, request_.begin, path};
    request.listener = &recorder;
    RunControl control = control_;
    long steps = 0;
    if (most_steps_ > 0) {
      control.interrupted = [&] { return steps > most_steps_ || (control_.interrupted && control_.interrupted()); };
      control.progress = [&](double time) {
        ++steps;
        if (control_.progress) control_.progress(time);
      };
    }
    began_ = now();
    RunEnd end = simulate(request, control);
    cost_.push_back(
        fmt::format("{:.2g} ({:.2g} s{})", tolerance, now() - began_, modes.empty() ? "" : ", fewer modes"));
    return end;
  }

  formats::Scene scene_with(double tolerance, const Modes& modes) const {
    formats::Scene scene = request_.scene;
    formats::IntegratorSpec& integrator = scene.integrator;
    integrator.accuracy.reset();
    integrator.method = method_;
    integrator.error_control.tolerance = integrator.bdf.relative_tolerance = tolerance;
    integrator.bdf.absolute_tolerance = 1e-2 * tolerance;
    if (!scene.output.interval) scene.output.interval = (integrator.end - integrator.start) / instants;
    scene.output.every = 1;
    scene.checkpoint = {};
    if (!scene.output.channels.empty()) scene.output.channels.push_back(dataset_of(accuracy_.of));
    for (formats::BodySpec& body : scene.bodies)
      if (auto* spec = std::get_if<formats::SuperelementBodySpec>(&body); spec != nullptr)
        if (const auto found = modes.find(spec->name); found != modes.end()) spec->modes = found->second;
    return scene;
  }

  /// Half of the modes of every superelement whose modes the scene leaves open; empty: there is nothing to halve.
  Modes halved() const {
    Modes half;
    bool any = false;
    for (const formats::BodySpec& body : request_.scene.bodies) {
      const auto* spec = std::get_if<formats::SuperelementBodySpec>(&body);
      if (spec == nullptr || spec->rigid || spec->modes || spec->cutoff || !spec->damping.ratios.empty() ||
          !spec->damping.ratios_internal.empty())
        continue;
      const std::vector<int>& node = request_.files.superelements.at(spec->file).superelement.dof_node;
      const auto all = static_cast<int>(std::ranges::count(node, -1));
      const auto found = modes_.left.find(spec->name);
      const int now = found == modes_.left.end() ? all : found->second;
      half[spec->name] = now / 2;
      any = any || now > 1;
    }
    return any ? half : Modes{};
  }

  /// Halves the modes after the second run, as long as this changes its history little. Further runs omit these modes.
  void leave_out_modes(double tolerance) {
    if (modes_.half.x.empty() || modes_.upper_half > modes_part * accuracy_.error) return;
    modes_.left_out = modes_.upper_half;
    modes_.left = halved();
    for (Modes half = halved(); !half.empty(); half = halved()) {
      if (take(tolerance, half, "", recorder_).report.outcome != RunOutcome::completed) return;
      const double change = error_of(recorder_.history, previous_.history, quantity_);
      if (change > modes_part * accuracy_.error) return;
      modes_.left_out = change;
      modes_.left = std::move(half);
    }
  }

  /// Compares the last two runs. Returns the change that missing modes may cause.
  double compare(double fall, long steps) {
    const double change = error_of(previous_.history, recorder_.history, quantity_);
    tolerance_.observe(change, fall, static_cast<double>(steps) / static_cast<double>(std::max(1L, previous_.steps)));
    const double missing = modes_.mixed          ? modes_fall * change
                           : modes_.left.empty() ? modes_fall * modes_.upper_half
                                                 : modes_.left_out;
    // Modes missing in the files do not depend on the tolerance. A warning will report them.
    room_ = missing > most_missing * accuracy_.error ? accuracy_.error : accuracy_.error - missing;
    return missing;
  }

  /// Repeats the previous run with all modes if it had half of them and differs too much.
  void separate(double tolerance) {
    modes_.mixed = false;
    tolerance_.forget();
    const double began = began_;
    Recorder whole(accuracy_.of, request_.scene.file);
    const RunEnd end = take(tolerance, {}, "", whole);
    began_ = began + now() - began_;
    if (end.report.outcome != RunOutcome::completed) {
      modes_.half = {};
      return;
    }
    modes_.upper_half = error_of(modes_.half, whole.history, quantity_);
    previous_ = {std::move(whole.history), end.report.steps};
  }

  void judge(RunReport& report, double before, double tolerance, bool last) {
    const double fall = before / tolerance;
    double missing = compare(fall, report.steps);
    if (modes_.mixed && (!is_reached() || missing > most_missing * accuracy_.error)) {
      separate(before);
      missing = compare(fall, report.steps);
    }
    previous_.steps = report.steps;
    const double next = tolerance_.next(tolerance, room_),
                 needed = tolerance_.predicted(now() - began_, tolerance, next);
    too_long_ = !is_reached() && needed > std::max(longest_run, longest_of_first * first_took_);
    report.notes.push_back(fmt::format(
        "accuracy: the error of '{}' is {} ({:g} asked for), with tolerance {:.3g}{}{}; runs by tolerance: {}",
        accuracy_.of, reported_error(tolerance_.error() + missing), accuracy_.error, tolerance, reported_method(),
        reported_modes(), join(cost_, ", ")));
    if (!last && !too_long_ && !is_reached()) return;
    if (modes_.left.empty() && missing > most_missing * accuracy_.error)
      report.doubts.push_back(
          fmt::format("'{}' may need modes that the superelement files do not contain: the upper half of the modes in "
                      "the files changes it by {:.2g}; increase 'modes' in the part",
                      accuracy_.of, modes_.upper_half));
    if (is_reached()) return;
    const char* const other = method_ == formats::Method::radau ? "" : ", or use method: radau";
    const std::string cost =
        !too_long_ ? "" : fmt::format(", and the next run would take about {:.0f} min", needed / 60.0);
    const std::string longer =
        !too_long_ ? "" : fmt::format(", or give error_control: {{tolerance: {:.2g}}} instead of accuracy", next);
    report.doubts.push_back(fmt::format("the error {:g} of '{}' was not reached: it is {}{}; allow a larger error{}{}",
                                        accuracy_.error, accuracy_.of, reported_error(tolerance_.error()), cost, other,
                                        longer));
  }

  bool is_reached() const { return tolerance_.error() <= room_; }
  std::string reported_modes() const {
    if (modes_.half.x.empty()) return {};
    if (modes_.mixed)
      return fmt::format("; half of the modes and the previous tolerance together change it by {:.2g}",
                         tolerance_.change());
    if (modes_.left.empty())
      return fmt::format("; the upper half of the modes changes it by {:.2g}", modes_.upper_half);
    std::vector<std::string> counts;
    for (const auto& [name, count] : modes_.left) counts.push_back(fmt::format("{} of '{}'", count, name));
    return fmt::format("; modes: {}, the others change it by {:.1g}", listed(counts), modes_.left_out);
  }

  std::string reported_method() const {
    if (method_ == request_.scene.integrator.method) return {};
    return method_ == formats::Method::radau ? " of radau" : " of generalised_alpha";
  }

  std::string reported_error(double error) {
    return std::isfinite(error) ? fmt::format("estimated at {:.2g}", error)
                                : "not estimated, because runs with other tolerances took the same steps";
  }

  double now() const { return control_.clock ? control_.clock() : 0.0; }

  const RunRequest& request_;
  const RunControl& control_;
  const AccuracySpec& accuracy_;
  formats::StudyQuantity quantity_;
  Recorder recorder_;
  formats::Method method_ = formats::Method::generalised_alpha;
  FallingTolerance tolerance_{shared};
  Choice modes_;
  Trial previous_;                 ///< the previous run
  std::vector<std::string> cost_;  ///< tolerance and seconds of each run
  double began_ = 0.0;             ///< start of the present run
  double first_took_ = 0.0;
  long most_steps_ = 0;    ///< limit of the present run; 0: none
  bool too_long_ = false;  ///< the next run would take too long
  double room_ = 0.0;      ///< allowed error of the tolerance
};

}  // namespace

RunEnd simulate_to_accuracy(const RunRequest& request, const RunControl& control) {
  if (!request.restart.empty())
    throw Error("a run with 'accuracy' cannot continue from a file", request.scene.file,
                "give 'step' or 'error_control' instead of it");
  return Search(request, control).run();
}

}  // namespace tisserand::mechanism
