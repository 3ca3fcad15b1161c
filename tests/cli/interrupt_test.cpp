// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that end before their end: Ctrl-C, kill, sudden death, and steps that do not converge.
#include <chrono>
#include <functional>
#include <random>
#include <thread>

#include "tests/cli/scenes.hpp"
#include "tests/support/trials.hpp"

namespace tisserand::cli::interrupt_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Interrupt : public Folder {
 protected:
  /// A run of hours.
  pid_t start_long_run() const {
    return start({program("mechanism"), "run", "arm.scene.yaml", "-o", "long.h5", "--set", "integrator.end=1e5"},
                 where);
  }
  /// Waits on a slow machine too; five minutes at most.
  static void wait_until(const std::function<bool()>& holds) {
    for (int i = 0; i < 30000 && !holds(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  /// Waits until the results have appeared and some steps are done.
  void wait_for_results() const {
    wait_until([&] { return std::filesystem::exists(file("long.h5.part")); });
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  /// The run has stored rows, which it does every second.
  void wait_for_rows() const {
    wait_for_results();
    Surroundings other = where;
    other.folder = file("reader");
    std::filesystem::create_directory(other.folder);  // streams of its own
    wait_until([&] {
      return call({program("mechanism"), "channels", file("long.h5.part")}, other).out.find("instants from 0 to") !=
             std::string::npos;
    });
  }
  void expect_every_command_reads(const std::string& results) const {
    const Outcome channels = mechanism({"channels", results});
    EXPECT_EQ(channels.code, 0) << channels.error;
    EXPECT_THAT(channels.out, HasSubstr("not completed: "));
    EXPECT_EQ(mechanism({"export", results, "-o", "long.csv"}).code, 0);
    EXPECT_THAT(read_text(file("long.csv")), HasSubstr("time [s],"));
  }
};

TEST_F(Interrupt, SignalsLeaveResultsUpToThenAndExit130) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const pid_t child = start_long_run();
    wait_for_results();
    ::kill(child, signal);
    const Outcome outcome = finish(child, where);
    EXPECT_EQ(outcome.code, 130) << outcome.error;
    EXPECT_THAT(outcome.out, HasSubstr("interrupted at t = "));
    EXPECT_FALSE(std::filesystem::exists(file("long.h5.part")));
    EXPECT_THAT(mechanism({"channels", "long.h5"}).out, HasSubstr("not completed: interrupted at t = "));
    expect_every_command_reads("long.h5");
    EXPECT_EQ(mechanism({"plot", "long.h5", "-c", "energy/total", "-o", "long.svg"}).code, 0);
  }
}

TEST_F(Interrupt, TellsProgressAfterASecondOnTheErrorStream) {
  const pid_t child = start_long_run();
  wait_until([&] { return read_text(file(".err")).find("simulating: 0 %") != std::string::npos; });
  ::kill(child, SIGINT);
  const Outcome outcome = finish(child, where);
  EXPECT_THAT(outcome.error, HasSubstr("simulating: 0 %"));
  EXPECT_THAT(outcome.error, Not(HasSubstr("done in")));
  EXPECT_THAT(outcome.out, Not(HasSubstr("simulating")));
  const auto begin = std::chrono::steady_clock::now();
  const std::string error = mechanism({"run", "arm.scene.yaml", "-o", "short.h5"}).error;
  if (std::chrono::steady_clock::now() - begin < std::chrono::seconds(1)) {
    EXPECT_THAT(error, Not(HasSubstr("simulating")));
  }
}

/// TISSERAND_KILLS=100 kills as often as one likes; the writer alone is killed in
/// tests/formats/results/results_kill_test.cpp.
TEST_F(Interrupt, FilesOfKilledRunsAreRead) {
  const int kills = test_support::trials(5);
  std::mt19937 random(8);
  // Up to three times what a run takes to its first results on this machine, under its present load.
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const pid_t first = start_long_run();
  wait_for_results();
  const auto until_results = std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - begin).count();
  ::kill(first, SIGKILL);
  EXPECT_EQ(finish(first, where).code, 1000 + SIGKILL);
  std::uniform_int_distribution<long> microseconds(0, 3 * until_results);
  int read = 0;
  for (int k = 0; k < kills; ++k) {
    std::filesystem::remove(file("long.h5.part"));
    const pid_t child = start_long_run();
    std::this_thread::sleep_for(std::chrono::microseconds(microseconds(random)));
    ::kill(child, SIGKILL);
    EXPECT_EQ(finish(child, where).code, 1000 + SIGKILL);
    if (!std::filesystem::exists(file("long.h5.part"))) continue;  // killed before the first row
    SCOPED_TRACE(k);
    expect_every_command_reads("long.h5.part");
    ++read;
  }
  if (kills >= 20) {
    EXPECT_GT(read, 0);
  }
  // The next run of the same name goes its way.
  EXPECT_EQ(mechanism({"run", "arm.scene.yaml", "-o", "long.h5"}).code, 0);
}

TEST_F(Interrupt, ResultsOfSeveralSecondsSurviveSuddenDeath) {
  const pid_t child = start_long_run();
  wait_for_rows();
  ::kill(child, SIGKILL);
  finish(child, where);
  expect_every_command_reads("long.h5.part");
  EXPECT_THAT(mechanism({"channels", "long.h5"}).out, HasSubstr("instants from 0 to"));  // finds the .part
  EXPECT_EQ(mechanism({"plot", "long.h5.part", "-c", "energy/total", "-o", "long.svg"}).code, 0);
}

TEST_F(Interrupt, StepThatCannotConvergeIsExplained) {
  // No step of this size turns the block so far within two iterations.
  const Outcome outcome = mechanism({"run", "arm.scene.yaml", "-o", "stuck.h5", "--set",
                                     "loads.push.value.2={table: [[0, 0], [0.05, 0], [0.06, 1e7]]}", "--set",
                                     "integrator.max_iterations=2", "--set", "integrator.max_halvings=3"});
  EXPECT_EQ(outcome.code, 3) << outcome.out << outcome.error;
  EXPECT_THAT(outcome.error,
              AllOf(HasSubstr("did not converge"), HasSubstr("worst at "), HasSubstr("the step is too long")));
  EXPECT_THAT(outcome.error,
              AllOf(HasSubstr("after 3 halvings"), ::testing::ContainsRegex("(translation|rotation|axis)")));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("rejected"), HasSubstr("not converged: ")));
  EXPECT_THAT(mechanism({"channels", "stuck.h5"}).out, HasSubstr("not completed: t = "));
  EXPECT_EQ(mechanism({"export", "stuck.h5", "-o", "stuck.csv"}).code, 0);
}

TEST_F(Interrupt, LastInstantOfAFailedRunIsStored) {
  const Outcome outcome = mechanism({"run", "arm.scene.yaml", "-o", "nan.h5", "--set",
                                     "loads.push.value.2=\"sqrt(0.0601-t)\"", "--set", "output.every=5"});
  EXPECT_EQ(outcome.code, 3) << outcome.error;
  EXPECT_EQ(mechanism({"export", "nan.h5", "-c", "time", "-o", "/dev/stdout"}).out, "time [s]\n0\n0.05\n0.06\n");
}

TEST_F(Interrupt, FormulaThatIsNoNumberEndsTheRunByName) {
  for (const char* formula : {"1/(t-0.05)", "sqrt(0.05-t)"}) {
    const Outcome outcome = mechanism({"run", "arm.scene.yaml", "-o", "nan.h5", "--set", "integrator.step=0.0125",
                                       "--set", std::string("loads.push.value.2=\"") + formula + "\""});
    EXPECT_EQ(outcome.code, 3) << outcome.out << outcome.error;
    EXPECT_THAT(outcome.error,
                AllOf(HasSubstr("load 'push', z component"), HasSubstr(formula), HasSubstr("not a finite number")));
    EXPECT_THAT(mechanism({"channels", "nan.h5"}).out, HasSubstr("not completed: load 'push'"));
  }
}

TEST_F(Interrupt, OutputOfARunningProgramIsRefused) {
  const pid_t child = start_long_run();
  wait_for_results();
  Surroundings other = where;
  other.folder = file("other");
  std::filesystem::create_directory(other.folder);  // streams of its own
  expect_error(call({program("mechanism"), "run", file("arm.scene.yaml"), "-o", file("long.h5")}, other),
               {"long.h5", "another program is writing these results now", "another name with -o"});
  expect_error(
      call({program("mechanism"), "run", file("arm.scene.yaml"), "--restart", file("long.h5"), "--append"}, other),
      {"long.h5", "another program is writing these results now"});
  ::kill(child, SIGKILL);
  finish(child, where);
  EXPECT_EQ(mechanism({"run", "arm.scene.yaml", "-o", "long.h5"}).code, 0);  // its end has freed the name
}

}  // namespace
}  // namespace tisserand::cli::interrupt_test
