// The benchmarks of examples/rigid_benchmarks and examples/flexible_benchmarks: every scene against its targets.csv.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "formats/override.hpp"
#include "formats/scene.hpp"
#include "mechanism/series.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism {
namespace {

const std::string examples = TISSERAND_SOURCE_DIR "/examples/";

/// A line of targets.csv; examples/common.sh explains the columns.
struct Target {
  std::string scene, refine, quantity, channel;
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
    Target t{cells[0], cells[1], cells[3], cells[4], {}, std::stod(cells[5]), std::stod(cells[6]), std::stod(cells[7]),
             cells[8], cells[9]};
    std::istringstream values(cells[2]);
    for (std::string value; values >> value;) t.values.push_back(value);
    targets.push_back(t);
  }
  return targets;
}

/// Runs one scene of a folder with its last two values and checks every line about it.
class Targets : public testing::TestWithParam<const char*> {
 protected:
  void run(const std::string& scene, const std::string& setting, const std::string& result) const {
    std::vector<formats::Override> overrides;
    if (!setting.empty()) overrides.push_back(formats::parse_override(setting));
    const RunReport report = simulate(formats::read_scene(folder_.file(scene + ".scene.yaml"), overrides),
                                      folder_.file(result), RunControl{});
    ASSERT_EQ(report.outcome, RunOutcome::completed) << report.reason;
  }

  /// Relative error of a target in a run.
  double error(const Target& t, const std::string& result) const {
    const Series s = read_series({{folder_.file(result)}, {}, {t.channel}, {}}).back();
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < s.x.size(); ++i)
      if (std::abs(s.x[i] - t.time) < std::abs(s.x[nearest] - t.time)) nearest = i;
    return (s.y[nearest] - t.target) / t.scale;
  }

  void check(const std::string& folder, const std::string& scene) const {
    std::filesystem::copy_file(examples + folder + "/" + scene + ".scene.yaml", folder_.file(scene + ".scene.yaml"));
    const std::vector<std::string> results = {"finest.results.h5", "coarser.results.h5"};
    bool ran = false;
    for (const Target& t : read_targets(folder)) {
      if (t.scene != scene) continue;
      SCOPED_TRACE(t.quantity);
      for (std::size_t i = 0; i < (t.order.empty() ? 1 : 2) && !ran; ++i)
        run(scene, t.values.empty() ? "" : t.refine + "=" + t.values[t.values.size() - 1 - i], results[i]);
      ran = true;
      const double finest = error(t, results[0]);
      if (!t.accept.empty()) {
        EXPECT_LT(std::abs(finest), std::stod(t.accept));
      }
      if (!t.order.empty()) {
        EXPECT_NEAR(std::log2(error(t, results[1]) / finest), std::stod(t.order), 0.4);
      }
    }
    EXPECT_TRUE(ran) << "no target for " << scene;
  }

  test_support::TemporaryFolder folder_;
};

class RigidTargets : public Targets {};
INSTANTIATE_TEST_SUITE_P(Scenes, RigidTargets,
                         testing::Values("pendulum", "four_bar_2", "four_bar_10", "andrews", "bricard", "heavy_top",
                                         "free_body"),
                         [](const testing::TestParamInfo<const char*>& scene) { return scene.param; });
TEST_P(RigidTargets, AreMet) { check("rigid_benchmarks", GetParam()); }

class FlexibleTargets : public Targets {
 protected:
  void reduce(const std::string& part, const std::string& name) const {
    const std::string command = TISSERAND_BINARY_DIR "/bin/reducer run " + examples + "flexible_benchmarks/" + part +
                                ".part.yaml -o " + folder_.file(name + ".superelement.h5") + " > " +
                                folder_.file("log") + " 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }
};
INSTANTIATE_TEST_SUITE_P(Scenes, FlexibleTargets,
                         testing::Values("spin_up", "princeton", "bend_45", "roll_up", "top_fast", "top_slow"),
                         [](const testing::TestParamInfo<const char*>& scene) { return scene.param; });
TEST_P(FlexibleTargets, AreMet) { check("flexible_benchmarks", GetParam()); }

class SuperelementTargets : public FlexibleTargets {};
INSTANTIATE_TEST_SUITE_P(Scenes, SuperelementTargets,
                         testing::Values("spin_up_superelement_4", "princeton_superelement_4"),
                         [](const testing::TestParamInfo<const char*>& scene) { return scene.param; });
TEST_P(SuperelementTargets, AreMet) {
  if (!std::filesystem::exists(TISSERAND_BINARY_DIR "/bin/reducer")) GTEST_SKIP() << "built without the reducer";
  reduce("spin_up_piece", "quarter");
  reduce("princeton_piece", "princeton_4");
  check("flexible_benchmarks", GetParam());
}

}  // namespace
}  // namespace tisserand::mechanism
