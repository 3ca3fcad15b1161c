// SPDX-License-Identifier: GPL-3.0-or-later
// Ten scenes with an accuracy asked for, fixed before they were measured: what `integrator: accuracy` reaches and
// costs, beside the cheapest setting of a study over methods, steps and tolerances; as markdown. Arguments: names of
// cases, none: all.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/error.hpp"
#include "mechanism/study/accuracy.hpp"
#include "mechanism/study/measure.hpp"
#include "tests/benchmarks/mechanisms.hpp"
#include "tests/support/scenes/andrews.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::benchmarks {
namespace {

using formats::ErrorNorm;
using mechanism::RunReport;
using mechanism::Series;

struct Asked {
  std::string name;
  std::string what;
  Case input;
  formats::AccuracySpec accuracy;
};

Case shipped(const std::string& scene) {
  Case input{formats::read_scene(TISSERAND_SOURCE_DIR "/" + scene, {}), {}};
  return input;
}

Case stored_every(Case input, double interval) {
  input.scene.output.interval = interval;
  return input;
}

/// The ten cases: rigid and flexible, plane and spatial, driven and free, smooth, hit, stopped and stiff.
std::vector<Asked> cases() {
  const auto ask = [](double error, const char* of, ErrorNorm norm) {
    return formats::AccuracySpec{error, of, norm, std::nullopt};
  };
  const std::string rigid = "examples/rigid_benchmarks/", flexible = "examples/flexible_benchmarks/";
  std::vector<Asked> list;
  list.push_back({"pendulum", "mathematical pendulum, 10 s", shipped(rigid + "pendulum.scene.yaml"),
                  ask(1e-5, "nodes/position/bob/y", ErrorNorm::max)});
  list.push_back({"andrews", "Andrews' mechanism, 0.05 s", shipped(rigid + "andrews.scene.yaml"),
                  ask(1e-3, "nodes/position/k5/x", ErrorNorm::max)});
  list.push_back({"heavy_top", "heavy top, 0.5 s", shipped(rigid + "heavy_top.scene.yaml"),
                  ask(1e-3, "nodes/position/top/center/z", ErrorNorm::max)});
  list.push_back({"spring_crank", "rigid slider-crank with spring, 1 s", shipped(rigid + "spring_crank.scene.yaml"),
                  ask(1e-4, "nodes/position/second/x", ErrorNorm::max)});
  list.push_back({"bounce", "ball on a stiff stop, 0.64 s", shipped("tests/stability/scenes/bounce.scene.yaml"),
                  ask(1e-3, "nodes/position/ball/z", ErrorNorm::max)});
  list.push_back({"chain", "20 rigid rods fall, 1 s", stored_every(rigid_chain(20, 1000), 0.01),
                  ask(1e-4, "nodes/position/link19/tip/z", ErrorNorm::final)});
  list.push_back({"hinged_beam", "hinged beam, one superelement, 20 s",
                  stored_every(hinged_beam(4, formats::Formulation::stabilised_index2), 0.02),
                  ask(1e-2, "nodes/angular_velocity/beam/base/z", ErrorNorm::rms)});
  list.push_back({"spherical_beam", "spherical joint, five beams, impulse, 40 s",
                  shipped("examples/spherical_beam/nonlinear.scene.yaml"),
                  ask(1e-2, "nodes/position/beam/end/z", ErrorNorm::max)});
  list.push_back({"slider_crank", "slider-crank, reduced rod, driven, 0.1 s",
                  stored_every(slider_crank_reduced(4, 0.1), 5e-4),
                  ask(1e-4, "nodes/position/rod/tip/x", ErrorNorm::max)});
  list.push_back({"spin_up", "spin-up of four beams, 20 s", shipped(flexible + "spin_up.scene.yaml"),
                  ask(1e-3, "nodes/position/beam/end/y", ErrorNorm::rms)});
  return list;
}

/// A run, or several: what was stored, and CPU seconds.
struct Run {
  std::string setting;
  Series history;
  RunReport report;
  double seconds = 0.0, error = std::numeric_limits<double>::infinity();
  bool done() const { return report.outcome == mechanism::RunOutcome::completed; }
};

constexpr double longest_run = 8.0;          ///< CPU seconds of one setting
constexpr double longest_reference = 120.0;  ///< CPU seconds of the reference, and of all runs of `accuracy`
constexpr double finest = 1e-11;             ///< tolerance of the reference
constexpr double quick_run = 0.5;            ///< CPU seconds up to which the median of three is taken

class Measured {
 public:
  explicit Measured(const Asked& asked) : asked_(asked) {
    scene_ = asked.input.scene;
    scene_.integrator.step = 1e-4 * (scene_.integrator.end - scene_.integrator.start);
    if (!scene_.output.interval) scene_.output.interval = (scene_.integrator.end - scene_.integrator.start) / 500.0;
    if (!scene_.output.channels.empty()) scene_.output.channels.push_back(asked.accuracy.of);
    quantity_.norm = asked.accuracy.norm;
    files_ = asked.input.files;
  }

  Run take(const formats::Scene& scene, std::string setting, double longest) const {
    Run run;
    run.setting = std::move(setting);
    std::vector<double> seconds;
    do {
      const double begin = cpu_seconds();
      const mechanism::RunControl control{
          [begin, longest] { return cpu_seconds() - begin > longest; }, {}, [] { return cpu_seconds(); }};
      const mechanism::RunRequest request{scene, files_, std::nullopt, path_, "", std::nullopt};
      try {
        run.report = (scene.integrator.accuracy ? mechanism::simulate_to_accuracy(request, control)
                                                : mechanism::simulate(request, control))
                         .report;
      } catch (const Error& error) {
        run.report.outcome = mechanism::RunOutcome::not_converged;
        run.report.reason = error.what();
      }
      seconds.push_back(cpu_seconds() - begin);
    } while (seconds.size() < 3 && seconds.front() < quick_run);
    std::ranges::sort(seconds);
    run.seconds = seconds[seconds.size() / 2];
    if (run.done()) run.history = mechanism::read_quantities(path_, {asked_.accuracy.of}).front();
    return run;
  }

  Run measured(Run run, const Series& reference) const {
    if (run.done()) run.error = mechanism::error_of(run.history, reference, quantity_);
    fmt::print("| {} | {:.2e} | {:.4f} | {} | {} |\n", run.setting, run.error, run.seconds, run.report.steps,
               run.done() ? "" : run.report.reason);
    std::fflush(stdout);
    return run;
  }

  formats::Scene controlled(formats::Method method, double tolerance) const {
    formats::Scene scene = scene_;
    scene.integrator.method = method;
    scene.integrator.error_control = {true, tolerance, 0.0, 0.0};
    return scene;
  }
  formats::Scene stepped(double step) const {
    formats::Scene scene = scene_;
    scene.integrator.step = step;
    return scene;
  }
  formats::Scene accurate() const {
    formats::Scene scene = scene_;
    scene.integrator.error_control.active = true;
    scene.integrator.accuracy = asked_.accuracy;
    scene.integrator.method = formats::Method::automatic;
    return scene;
  }
  double interval() const { return *scene_.output.interval; }
  const formats::StudyQuantity& quantity() const { return quantity_; }

 private:
  const Asked& asked_;
  formats::Scene scene_;
  mechanism::BodyFiles files_;
  formats::StudyQuantity quantity_;
  test_support::TemporaryFolder folder_;
  std::string path_ = folder_.file("run.results.h5");
};

/// A line of a study, from coarse to fine: until three settings in a row meet the request.
std::vector<Run> line(double error, const std::function<Run(int)>& take) {
  std::vector<Run> runs;
  int met = 0;
  for (int k = 0; k < 24 && met < 3; ++k) {
    runs.push_back(take(k));
    met = runs.back().error <= error ? met + 1 : 0;
    if (runs.back().seconds > longest_run) break;
  }
  return runs;
}

/// The cheapest setting of a line that meets the request, as all finer ones do.
void choose(const std::vector<Run>& runs, double error, const Run*& best) {
  for (auto run = runs.rbegin(); run != runs.rend() && run->error <= error; ++run)
    if (best == nullptr || run->seconds < best->seconds) best = &*run;
}

/// What the report of an accuracy run says.
double estimate_of(const RunReport& report) {
  const std::string words = "is estimated at ";
  for (const std::string& note : report.notes)
    if (const std::size_t at = note.find(words); at != std::string::npos)
      return std::stod(note.substr(at + words.size()));
  return std::numeric_limits<double>::infinity();
}

struct Row {
  std::string text;
  bool met = false, cheap = false;
};

Row judge(const Asked& asked) {
  const double error = asked.accuracy.error;
  fmt::print("\n### {}: {}, {:g} of `{}`\n\n| setting | error | CPU s | steps | |\n| --- | --- | --- | --- | --- |\n",
             asked.name, asked.what, error, asked.accuracy.of);
  const Measured scene(asked);
  const Run fine = scene.take(scene.controlled(formats::Method::radau, finest), "reference: radau", longest_reference);
  (void)scene.measured(scene.take(scene.controlled(formats::Method::radau, 10.0 * finest),
                                  "radau, ten times the tolerance of the reference", longest_reference),
                       fine.history);
  if (!fine.done()) throw Error("the reference of " + asked.name + " does not complete: " + fine.report.reason, "", "");
  const auto alpha_tolerance = [&](int k) { return 0.1 * std::pow(10.0, -0.5 * k); };
  const std::vector<Run> controlled = line(error, [&](int k) {
    const double tolerance = alpha_tolerance(k);
    return scene.measured(scene.take(scene.controlled(formats::Method::generalised_alpha, tolerance),
                                     fmt::format("generalised_alpha, tolerance {:.1e}", tolerance), longest_run),
                          fine.history);
  });
  const std::vector<Run> stepped = line(error, [&](int k) {
    const double step = scene.interval() / (1 << k);
    return scene.measured(
        scene.take(scene.stepped(step), fmt::format("generalised_alpha, step {:.1e}", step), longest_run),
        fine.history);
  });
  const std::vector<Run> radau = line(error, [&](int k) {
    const double tolerance = alpha_tolerance(k);
    return scene.measured(scene.take(scene.controlled(formats::Method::radau, tolerance),
                                     fmt::format("radau, tolerance {:.1e}", tolerance), longest_run),
                          fine.history);
  });
  const Run* cheapest = nullptr;
  choose(controlled, error, cheapest);
  choose(stepped, error, cheapest);
  const Run* same_method = cheapest;
  choose(radau, error, cheapest);
  Run run = scene.measured(scene.take(scene.accurate(), "accuracy", longest_reference), fine.history);
  for (const std::string& note : run.report.notes)
    if (note.starts_with("accuracy")) fmt::print("\n{}\n", note);
  for (const std::string& doubt : run.report.doubts) fmt::print("\ndoubt: {}\n", doubt);
  const double last =
      run.report.seconds_model + run.report.seconds_start + run.report.seconds_steps + run.report.seconds_output;
  Row row;
  row.met = run.error <= error;
  row.cheap = cheapest != nullptr && run.seconds <= 3.0 * cheapest->seconds;
  row.text =
      fmt::format("| {} | {:g} | {:.1e} | {:.1e} | {:.3f} | {:.3f} | {} | {:.3f} | {:.1f} | {:.1f} |\n", asked.what,
                  error, estimate_of(run.report), run.error, run.seconds, last, cheapest ? cheapest->setting : "none",
                  cheapest ? cheapest->seconds : 0.0, cheapest ? run.seconds / cheapest->seconds : 0.0,
                  same_method ? run.seconds / same_method->seconds : 0.0);
  fmt::print("\n{}", row.text);
  return row;
}

int judge_all(const std::vector<std::string>& names) {
  std::string table;
  int met = 0, cheap = 0, count = 0;
  for (const Asked& asked : cases()) {
    if (!names.empty() && std::ranges::find(names, asked.name) == names.end()) continue;
    const Row row = judge(asked);
    table += row.text;
    ++count;
    met += row.met;
    cheap += row.cheap;
  }
  fmt::print(
      "\n## All\n\n| case | error asked for | estimate | true error | CPU s | last run | cheapest setting | CPU s | "
      "ratio | of generalised_alpha |\n| --- | --: | --: | --: | --: | --: | --- | --: | --: | --: |\n{}\n"
      "{} of {} are accurate enough, {} cost at most three times the cheapest setting.\n",
      table, met, count, cheap);
  return 0;
}

}  // namespace
}  // namespace tisserand::benchmarks

int main(int count, char** arguments) {
  try {
    return tisserand::benchmarks::judge_all({arguments + 1, arguments + count});
  } catch (const std::exception& error) {
    fmt::print(stderr, "accuracy_cases: {}\n", error.what());
    return 1;
  }
}
