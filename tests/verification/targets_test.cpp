// SPDX-License-Identifier: GPL-3.0-or-later
// The benchmarks of examples/rigid_benchmarks and examples/flexible_benchmarks: every scene against its targets.csv.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "formats/yaml/override.hpp"
#include "mechanism/histories/series.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::targets_test {
namespace {

const std::string examples = TISSERAND_SOURCE_DIR "/examples/";

/// A line of targets.csv; examples/common.sh explains the columns.
struct Target {
  std::string scene, analysis, refine, quantity, channel;
  std::vector<std::string> values;
  double time = 0.0, target = 0.0, scale = 1.0;
  std::string accept, order;
};

std::vector<Target> read_targets(const std::string& folder) {
  std::ifstream in(examples + folder + "/targets.csv");
  std::vector<Target> targets;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::vector<std::string> cells;
    std::istringstream stream(line + ",end");
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (cells.size() != 11) throw std::runtime_error("targets.csv: " + line);
    const std::size_t colon = std::min(cells[0].find(':'), cells[0].size());
    Target t{cells[0].substr(0, colon),
             colon < cells[0].size() ? cells[0].substr(colon + 1) : "",
             cells[1],
             cells[3],
             cells[4],
             {},
             std::stod(cells[5]),
             std::stod(cells[6]),
             std::stod(cells[7]),
             cells[8],
             cells[9]};
    std::istringstream values(cells[2]);
    for (std::string value; values >> value;) t.values.push_back(value);
    targets.push_back(t);
  }
  return targets;
}

/// Runs one scene of a folder with its last two values and checks every line about it.
class Targets : public ::testing::TestWithParam<const char*> {
 protected:
  void run(const Target& t, const std::string& setting, const std::string& result) {
    std::vector<formats::Override> overrides;
    if (!setting.empty()) overrides.push_back(formats::parse_override(setting));
    const formats::Scene scene = formats::read_scene(folder_.file(t.scene + ".scene.yaml"), overrides);
    const RunReport report = t.analysis.empty() ? simulate(scene, folder_.file(result), RunControl{})
                                                : run_analysis(scene, t.analysis, result).report;
    ASSERT_EQ(report.outcome, RunOutcome::completed) << report.reason;
    frequencies_[result].clear();
    for (const std::string& line : report.table) {
      std::istringstream words(line);
      double number = 0.0, frequency = 0.0;
      if (words >> number >> frequency) frequencies_[result].push_back(frequency);
    }
  }

  /// One analysis of several, after the one that it starts from.
  RunEnd run_analysis(const formats::Scene& scene, const std::string& name, const std::string& result) const {
    for (const formats::Analysis& analysis : scene.analyses) {
      if (analysis.name != name) continue;
      std::optional<State> begin;
      if (!analysis.from.empty()) begin = run_analysis(scene, analysis.from, "from_" + result).state;
      return simulate({formats::scene_of(scene, analysis), read_body_files(scene), begin, folder_.file(result), "", {}},
                      RunControl{});
    }
    throw std::runtime_error("no analysis " + name);
  }

  /// Relative error of a target in a run.
  double error(const Target& t, const std::string& result) const {
    if (t.channel.starts_with("modes/"))
      return (frequencies_.at(result).at(std::stoul(t.channel.substr(6)) - 1) - t.target) / t.scale;
    const Series s = read_series({{folder_.file(result)}, {}, {t.channel}, {}}).back();
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < s.x.size(); ++i)
      if (std::abs(s.x[i] - t.time) < std::abs(s.x[nearest] - t.time)) nearest = i;
    return (s.y[nearest] - t.target) / t.scale;
  }

  /// All scenes, with what they include.
  void copy_scenes(const std::string& folder) const {
    for (const auto& file : std::filesystem::directory_iterator(examples + folder))
      if (file.path().extension() == ".yaml")
        std::filesystem::copy_file(file.path(), folder_.file(file.path().filename().string()));
  }

  void check(const std::string& folder, const std::string& scene) {
    copy_scenes(folder);
    const std::vector<std::string> results = {"finest.results.h5", "coarser.results.h5"};
    std::size_t ran = 0;  // of the two finest runs of this analysis
    bool any = false;
    std::string analysis = "none yet";
    for (const Target& t : read_targets(folder)) {
      if (t.scene != scene) continue;
      SCOPED_TRACE(t.quantity);
      if (t.analysis != analysis) ran = 0;
      analysis = t.analysis;
      any = true;
      for (; ran < (t.order.empty() ? 1U : 2U); ++ran)
        run(t, t.values.empty() ? "" : t.refine + "=" + t.values[t.values.size() - 1 - ran], results[ran]);
      const double finest = error(t, results[0]);
      if (!t.accept.empty()) {
        EXPECT_LT(std::abs(finest), std::stod(t.accept));
      }
      if (!t.order.empty()) {
        EXPECT_NEAR(std::log2(error(t, results[1]) / finest), std::stod(t.order), 0.4);
      }
    }
    EXPECT_TRUE(any) << "no target for " << scene;
  }

  test_support::TemporaryFolder folder_;
  std::map<std::string, std::vector<double>> frequencies_;  ///< of results files of modes
};

class RigidTargets : public Targets {};
INSTANTIATE_TEST_SUITE_P(Scenes, RigidTargets,
                         ::testing::Values("pendulum", "four_bar_2", "four_bar_10", "andrews", "bricard", "heavy_top",
                                           "free_body", "equal_crank", "spring_crank"),
                         [](const ::testing::TestParamInfo<const char*>& scene) { return scene.param; });
TEST_P(RigidTargets, AreMet) { check("rigid_benchmarks", GetParam()); }

// A step that ends on the very change point, where the slider's rows lose a rank: x = 2 cos(pi t/2) all the same.
TEST(EqualCrank, PassesAStepOnTheChangePoint) {
  const test_support::TemporaryFolder folder;
  std::vector<formats::Override> overrides;
  for (const char* setting : {"motions.speed.value=pi/2*t", "initial_tolerance=10", "integrator.end=2"})
    overrides.push_back(formats::parse_override(setting));
  const std::string results = folder.file("crank.results.h5");
  const RunReport report = simulate(
      formats::read_scene(examples + "rigid_benchmarks/equal_crank.scene.yaml", overrides), results, RunControl{});
  ASSERT_EQ(report.outcome, RunOutcome::completed) << report.reason;
  const Series x = read_series({{results}, {}, {"nodes/position/slider/x"}, {}}).front();
  for (std::size_t i = 0; i < x.x.size(); ++i)
    EXPECT_NEAR(x.y[i], 2.0 * std::cos(0.5 * std::numbers::pi * x.x[i]), 1e-9) << x.x[i];
}

class FlexibleTargets : public Targets {
 protected:
  /// The superelements of a scene; false if this build cannot make them.
  bool reduce(const std::string& scene) const;
  void reduce(const std::string& part, const std::string& name, const std::string& settings) const {
    const std::string command = TISSERAND_BINARY_DIR "/bin/reducer run " + examples + "flexible_benchmarks/" + part +
                                ".part.yaml -o " + folder_.file(name + ".superelement.h5") + " " + settings + " > " +
                                folder_.file("log") + " 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }
};
INSTANTIATE_TEST_SUITE_P(Scenes, FlexibleTargets,
                         ::testing::Values("spin_up", "spin_up_steady", "princeton", "bend_45", "roll_up",
                                           "l_frame_tones", "l_frame_loads", "top_fast", "top_slow", "simeon", "shaft",
                                           "shaft_centred", "turning_beams"),
                         [](const ::testing::TestParamInfo<const char*>& scene) { return scene.param; });
TEST_P(FlexibleTargets, AreMet) { check("flexible_benchmarks", GetParam()); }

bool FlexibleTargets::reduce(const std::string& scene) const {
  if (!std::filesystem::exists(TISSERAND_BINARY_DIR "/bin/reducer")) return false;
  if (scene == "spin_up_superelement_4") reduce("spin_up_piece", "quarter", "");
  for (const auto& [pieces, length] : {std::pair{"2", "0.254"}, {"4", "0.127"}, {"8", "0.0635"}})
    if (scene == std::string("princeton_superelement_") + pieces)
      reduce("princeton_piece", std::string("princeton_") + pieces, std::string("--set points.tip.0=") + length);
  if (scene == "bend_45_superelements") {
    reduce("bend_piece", "bend_5", "");
    reduce("bend_piece", "bend_10",
           "--set points.middle=[3.92598157590686,-0.0770956447087,0] "
           "--set points.tip=[7.84590957278449,-0.308266633275107,0]");
  }
  if (scene == "l_frame_tones_superelement") reduce("l_frame", "l_frame", "--set modes=32");
  if (scene == "l_frame_loads_superelement" || scene == "l_frame_loads_second_order")
    reduce("l_frame", "l_frame_thin", "--set sections.flat.width=0.6 --set modes=0");
  if (scene.starts_with("top_")) reduce("top", "top", "");
  if (scene == "spin_up_second_order")
    reduce("spin_up_piece", "whole", "--set points.tip.0=10 --set beams.beam.elements=32");
  if (scene == "turning_second_order")
    reduce("turning_piece", "turning_whole", "--set points.tip.0=1 --set beams.beam.elements=32 --set modes=12");
  if (scene == "princeton_second_order") reduce("princeton_piece", "princeton_second_4", "--set modes=12");
  if (scene == "bend_45_second_order") reduce("bend_piece", "bend_second_5", "--set modes=16");
  if (scene == "flying_second_order") reduce("flying_piece", "flying_16", "--set points.tip.0=0.625");
  if (scene == "roll_up_second_order") {
    reduce("roll_up_piece", "roll_up_6", "--set points.tip.0=1.66666666666667");
    reduce("roll_up_piece", "roll_up_12", "--set points.tip.0=0.833333333333333");
  }
  if (scene == "turning_superelements") {
    reduce("turning_piece", "turning_4", "");
    reduce("turning_piece", "turning_8", "--set points.tip.0=0.125");
  }
  return true;
}

class SuperelementTargets : public FlexibleTargets {};
INSTANTIATE_TEST_SUITE_P(Scenes, SuperelementTargets,
                         ::testing::Values("spin_up_superelement_4", "princeton_superelement_2",
                                           "princeton_superelement_4", "princeton_superelement_8",
                                           "bend_45_superelements", "l_frame_tones_superelement",
                                           "l_frame_loads_superelement", "top_fast_superelement",
                                           "top_slow_superelement", "turning_superelements", "spin_up_second_order",
                                           "turning_second_order", "princeton_second_order", "bend_45_second_order",
                                           "roll_up_second_order", "l_frame_loads_second_order", "flying_second_order"),
                         [](const ::testing::TestParamInfo<const char*>& scene) { return scene.param; });
TEST_P(SuperelementTargets, AreMet) {
  if (!reduce(GetParam())) GTEST_SKIP() << "built without the reducer";
  check("flexible_benchmarks", GetParam());
}

// Every row of the references, not the last one alone: the slow top falls below the level and rises again.
class TopDirections : public FlexibleTargets {};
INSTANTIATE_TEST_SUITE_P(Scenes, TopDirections,
                         ::testing::Values("top_fast", "top_slow", "top_fast_superelement", "top_slow_superelement"),
                         [](const ::testing::TestParamInfo<const char*>& scene) { return scene.param; });
TEST_P(TopDirections, FollowTheRigidBody) {
  const std::string scene = GetParam();
  if (scene.ends_with("superelement") && !reduce(scene)) GTEST_SKIP() << "built without the reducer";
  copy_scenes("flexible_benchmarks");
  const bool is_fast = scene.starts_with("top_fast");
  std::vector<formats::Override> overrides;
  for (const char* setting : {is_fast ? "integrator.step=1e-4" : "integrator.step=2e-4",
                              is_fast ? "output.interval=0.002" : "output.interval=0.01"})
    overrides.push_back(formats::parse_override(setting));
  const std::string results = folder_.file("top.results.h5");
  const RunReport report =
      simulate(formats::read_scene(folder_.file(scene + ".scene.yaml"), overrides), results, RunControl{});
  ASSERT_EQ(report.outcome, RunOutcome::completed) << report.reason;
  const auto rows = test_support::reference_rows(is_fast ? "prism_top_fast.csv" : "prism_top_slow.csv");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Series end = read_series({{results}, {}, {std::string("nodes/position/beam/*/") + "xyz"[axis]}, {}}).back();
    ASSERT_EQ(end.x.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ASSERT_NEAR(end.x[i], rows[i][0], 1e-9);
      EXPECT_NEAR(end.y[i] / 240.0, rows[i][axis + 1], is_fast ? 1e-3 : 1e-2) << rows[i][0];
    }
  }
}

}  // namespace
}  // namespace tisserand::mechanism::targets_test
