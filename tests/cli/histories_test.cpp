// SPDX-License-Identifier: GPL-3.0-or-later
// What people look at from the command line: plots against a reference run, units, channels of the scene, large
// outputs.
#include <chrono>
#include <sstream>
#include <thread>

#include "common/child.hpp"
#include "tests/cli/scenes.hpp"

namespace tisserand::cli::histories_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Histories : public Folder {
 protected:
  void make_results() { ASSERT_EQ(mechanism({"run", "arm.scene.yaml", "-o", "arm.results.h5"}).code, 0); }
};

TEST_F(Histories, APlotShowsTheDifferenceFromAReferenceRun) {
  if (!is_program("gnuplot")) GTEST_SKIP() << "not tested: there is no gnuplot here (apt-get install gnuplot-nox)";
  make_results();
  ASSERT_EQ(mechanism({"run", "arm.scene.yaml", "-o", "fine.results.h5", "--set", "integrator.step=0.002"}).code, 0);
  const Outcome plot = mechanism({"plot", "arm.results.h5", "-c", "nodes/position/rod/end/z", "--reference",
                                  "fine.results.h5:fine", "--units", "mm,ms", "-o", "tip.svg"});
  ASSERT_EQ(plot.code, 0) << plot.error;
  EXPECT_THAT(plot.out, AllOf(HasSubstr("arm, nodes/position/rod/end/z: differs by at most "), HasSubstr(" mm, RMS "),
                              HasSubstr("picture: tip.svg")));
  EXPECT_THAT(read_text(file("tip.svg")), AllOf(HasSubstr("difference of position [mm]"), HasSubstr("time [ms]")));
  const Outcome compared =
      mechanism({"compare", "arm.results.h5", "-c", "nodes/position/rod/end/z", "--reference", "fine.results.h5"});
  EXPECT_EQ(compared.code, 0) << compared.error;
  EXPECT_THAT(compared.out, HasSubstr("Compared at 11 instants from 0 to 0.1 s"));
  expect_error(mechanism({"plot", "arm.results.h5", "-c", "energy/total", "--difference", "-o", "e.svg"}),
               {"0 references for 'energy/total'"});
  expect_error(mechanism({"view", "arm.results.h5", "--reference", "fine.results.h5"}),
               {"a page can have only CSV files as references", "another run"});
  expect_error(mechanism({"plot", "arm.results.h5", "-c", "energy/total", "--units", "mm", "-o", "e.svg"}),
               {"no quantity in the plot can be shown in mm, a unit of length", "--units"});
}

TEST_F(Histories, ATitleMayHoldApostrophes) {
  if (!is_program("gnuplot")) GTEST_SKIP() << "not tested: there is no gnuplot here (apt-get install gnuplot-nox)";
  make_results();
  for (const char* title : {"'90s", "a 'b' c", "it''s", "'"}) {
    const Outcome plot = mechanism({"plot", "arm.results.h5", "-c", "energy", "--title", title, "-o", "q.svg"});
    EXPECT_EQ(plot.code, 0) << plot.error;
  }
}

// A trial of November 2026: `channels` of a scene were quantities for expressions alone.
TEST_F(Histories, ChannelsOfTheSceneAreStoredWithUnits) {
  write_text(file("more.scene.yaml"), std::string(arm_scene) + R"yaml(channels:
  swing: {type: coordinate, of: hinge}
  spin: {type: rate, of: hinge}
  height: {type: position, of: rod/end, axis: z, origin: [0, 0, -1]}
  sink: {type: velocity, of: rod/end, axis: [0, 0, -2]}
)yaml");
  ASSERT_EQ(mechanism({"run", "more.scene.yaml"}).code, 0);
  const std::string listed = mechanism({"channels", "more.results.h5", "-c", "channels"}).out;
  for (const char* line : {"channels/value/swing   [rad]", "channels/value/spin    [rad s^-1]",
                           "channels/value/height  [m]", "channels/value/sink    [m s^-1]"})
    EXPECT_THAT(listed, HasSubstr(line));
  const Outcome csv =
      mechanism({"export", "more.results.h5", "-c", "channels", "-c", "joints/coordinate/hinge", "-c",
                 "joints/rate/hinge", "-c", "nodes/position/rod/end/z", "-c", "nodes/velocity/rod/end/z", "-o", "-"});
  ASSERT_EQ(csv.code, 0) << csv.error;
  std::istringstream lines(csv.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_THAT(line, HasSubstr("nodes/position/rod/end/z [m],nodes/velocity/rod/end/z"));
  int rows = 0;
  while (std::getline(lines, line)) {
    std::vector<double> v;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) v.push_back(std::stod(cell));
    ASSERT_EQ(v.size(), 9u);
    // time, coordinate, rate, swing, spin, height, sink; then z and velocity, whose names are other ones of nodes. The
    // channels are what nodes and joints have.
    EXPECT_NEAR(v[3], v[1], 1e-15);
    EXPECT_NEAR(v[4], v[2], 1e-15);
    EXPECT_NEAR(v[5], v[7] + 1.0, 1e-15);
    EXPECT_NEAR(v[6], -v[8], 1e-15);
    ++rows;
  }
  EXPECT_EQ(rows, 11);
  ASSERT_EQ(mechanism({"run", "more.scene.yaml", "--set", "output.channels=[channels]", "-o", "few.results.h5"}).code,
            0);
  EXPECT_THAT(mechanism({"channels", "few.results.h5"}).out, Not(HasSubstr("nodes/")));
}

TEST_F(Histories, LargeResultsAreAnnounced) {
  const Outcome check = with("check", {"integrator.end=1e6"});
  EXPECT_THAT(check.out, AllOf(HasSubstr("the results will take about"), HasSubstr(" GB: 1e+08 instants"),
                               HasSubstr("output: {interval: 500}")));
  EXPECT_THAT(with("check", {"integrator.end=1e6", "output={interval: 1e4}"}).out, Not(HasSubstr("will take about")));
  EXPECT_THAT(with("check", {}).out, Not(HasSubstr("will take about")));
}

// Nobody knows beforehand how many steps error control takes: it is said once there are 10 MB.
TEST_F(Histories, LargeResultsOfChosenStepsAreAnnouncedWhileTheyGrow) {
  std::filesystem::copy_file(TISSERAND_SOURCE_DIR "/tests/verification/references/trials/restart_changed.scene.yaml",
                             file("long.scene.yaml"));
  const pid_t child = start({program("mechanism"), "run", "long.scene.yaml", "--set", "integrator.end=1e5", "--set",
                             "integrator.error_control={tolerance: 1e-5}", "--set", "checkpoint.every=100000"},
                            where);
  const auto runs = [&] {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == 0;
  };
  const auto said = [&] { return read_text(file(".err")).find("the results will take about") != std::string::npos; };
  while (runs() && !said()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ::kill(child, SIGINT);
  const Outcome outcome = finish(child, where);
  EXPECT_EQ(outcome.code, 130) << outcome.error;
  EXPECT_THAT(outcome.error, AllOf(HasSubstr("the results will take about"), HasSubstr("output: {interval: 50}"),
                                   Not(HasSubstr("done in"))));
  EXPECT_THAT(outcome.out, HasSubstr("interrupted at t = "));
  EXPECT_GT(std::filesystem::file_size(file("long.results.h5")), 5'000'000U) << "it is no guess";
}

TEST_F(Histories, UnknownOptionsNameTheNearest) {
  const Outcome outcome = mechanism({"run", "arm.scene.yaml", "--setx", "a=1"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.error, HasSubstr("did you mean --set?"));
  const Outcome reducer = call({program("reducer"), "run", "a.part.yaml", "--sett", "a=1"}, where);
  EXPECT_EQ(reducer.code, 2);
  EXPECT_THAT(reducer.error, HasSubstr("did you mean --set?"));
}

}  // namespace
}  // namespace tisserand::cli::histories_test
