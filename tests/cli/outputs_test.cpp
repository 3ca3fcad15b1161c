// SPDX-License-Identifier: GPL-3.0-or-later
// Outputs that cannot or must not be written, results of a wrong kind, words that are no commands.
#include <unistd.h>

#include "common/child.hpp"
#include "common/program/version.hpp"
#include "tests/cli/scenes.hpp"

namespace tisserand::cli::outputs_test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class Outputs : public Folder {
 protected:
  void make_results() { ASSERT_EQ(mechanism({"run", "arm.scene.yaml", "-o", "arm.results.h5"}).code, 0); }
};

TEST_F(Outputs, PlaceIsLookedAtBeforeTheRun) {
  expect_error(mechanism({"run", "arm.scene.yaml", "-o", "none/x.h5"}), {"none/", "No such file", "create it first"});
  expect_error(mechanism({"run", "arm.scene.yaml", "-o", "."}), {"is a folder"});
  expect_error(mechanism({"run", "arm.scene.yaml", "-o", "none/"}), {"is a folder"});
  expect_error(mechanism({"run", "arm.scene.yaml", "-o", "/dev/null"}), {"/dev/null", "device"});
}

TEST_F(Outputs, InputsAndFilesOfOtherKindsAreNotReplaced) {
  const std::string scene = read_text(file("arm.scene.yaml")), element = read_text(file("se.superelement.h5"));
  expect_error(mechanism({"run", "arm.scene.yaml", "-o", "arm.scene.yaml"}), {"replace its own input", "another name"});
  expect_error(mechanism({"run", "arm.scene.yaml", "-o", "./se.superelement.h5"}), {"replace its own input"});
  write_text(file("letter.txt"), "dear reader");
  expect_error(mechanism({"run", "arm.scene.yaml", "-o", "letter.txt"}), {"letter.txt", "other kinds of file"});
  EXPECT_EQ(read_text(file("arm.scene.yaml")), scene);
  EXPECT_EQ(read_text(file("se.superelement.h5")), element);
  EXPECT_EQ(read_text(file("letter.txt")), "dear reader");
  make_results();
  make_results();  // older results are
  expect_error(mechanism({"export", "arm.results.h5", "-o", "arm.results.h5"}), {"replace its own input"});
  expect_error(mechanism({"plot", "arm.results.h5", "-c", "energy/total", "-o", "none/x.png"}),
               {"none/", "No such file"});
  expect_error(mechanism({"plot", "arm.results.h5", "-c", "energy/total", "-o", "x.bmp"}), {"x.bmp", ".pdf or .eps"});
  expect_error(mechanism({"export", "arm.results.h5", "-o", "none/x.csv"}), {"none/", "No such file"});
  EXPECT_EQ(mechanism({"channels", "arm.results.h5"}).code, 0);
}

TEST_F(Outputs, FolderWithoutPermissionIsReported) {
  if (::geteuid() == 0) {  // root may write everywhere
    std::filesystem::permissions(folder.path(), std::filesystem::perms::all);
    where.user = 65534;
    if (mechanism({"--version"}).code == 127) GTEST_SKIP() << "the user nobody cannot reach " << program("mechanism");
  }
  std::filesystem::create_directory(file("locked"));
  std::filesystem::permissions(file("locked"), static_cast<std::filesystem::perms>(0555));
  expect_error(mechanism({"run", "arm.scene.yaml", "-o", "locked/x.h5"}),
               {"locked/", "Permission denied", "may write"});
  write_text(file("secret.yaml"), arm_scene);
  std::filesystem::permissions(file("secret.yaml"), std::filesystem::perms::none);
  expect_error(mechanism({"run", "secret.yaml"}), {"secret.yaml", "Permission denied"});
}

TEST_F(Outputs, FullDiskIsReported) {
  make_results();
  expect_error(mechanism({"export", "arm.results.h5", "-o", "/dev/full"}),
               {"/dev/full", "No space left", "free some space"});
  Surroundings full = where;
  full.standard_output = "/dev/full";
  expect_error(call({program("mechanism"), "channels", "arm.results.h5"}, full), {"standard output", "No space left"});
}

TEST_F(Outputs, LimitOfTheFileSizeEndsTheRunWithReadableResults) {
  where.file_size = 740'000;  // head, reserve and the first chunk of each dataset take about 710 kB
  const Outcome outcome = mechanism({"run", "arm.scene.yaml", "-o", "big.h5", "--set", "integrator.end=30", "--set",
                                     "integrator.step=0.001", "--set", "integrator.tolerance=1e-4"});
  expect_error(outcome, {"big.h5", "may not grow beyond", "store fewer channels"});
  where.file_size = RLIM_INFINITY;
  const Outcome channels = mechanism({"channels", "big.h5"});
  EXPECT_EQ(channels.code, 0) << channels.error;
  EXPECT_THAT(channels.out,
              AllOf(HasSubstr("not completed"), HasSubstr("instants from 0 to"), HasSubstr("may not grow beyond")));
  EXPECT_EQ(mechanism({"export", "big.h5", "-c", "energy", "-o", "big.csv"}).code, 0);
}

TEST_F(Outputs, ExportGoesToStandardOutput) {
  make_results();
  const Outcome outcome = mechanism({"export", "arm.results.h5", "-c", "energy/total", "-o", "/dev/stdout"});
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("time [s],energy/total [J]\n"), HasSubstr("\n0.05,")));
  const Outcome dash = mechanism({"export", "arm.results.h5", "-c", "energy/total", "-o", "-"});
  EXPECT_EQ(dash.out, outcome.out);
  EXPECT_FALSE(std::filesystem::exists(file("-")));
  EXPECT_EQ(mechanism({"export", "arm.results.h5", "-c", "energy/total", "-o", "a.csv"}).out, "table: a.csv\n");
}

TEST_F(Outputs, ReaderThatLeavesEarlyIsNoError) {
  make_results();
  // The shell closes the pipe after one line; PIPESTATUS-free: the error stream and the code of mechanism are kept
  // apart.
  const std::string command =
      "(" + program("mechanism") + " channels arm.results.h5; echo $? > code) 2> errors | head -1 > first";
  ASSERT_EQ(call({"/bin/sh", "-c", command}, where).code, 0);
  EXPECT_THAT(read_text(file("first")), HasSubstr("scene 'arm'"));
  EXPECT_THAT(read_text(file("errors")), IsEmpty());
  EXPECT_EQ(read_text(file("code")), "0\n");
}

TEST_F(Outputs, ResultsOfAWrongKindAreRefused) {
  make_results();
  for (const char* command : {"channels", "export", "plot"}) {
    std::vector<std::string> rest{"-c", "energy/total"};
    if (std::string(command) != "channels")
      rest.insert(rest.end(), {"-o", std::string(command) == "plot" ? "x.svg" : "x.csv"});
    const auto refused = [&](const std::string& input, const std::vector<std::string>& words) {
      std::vector<std::string> all{command, input};
      all.insert(all.end(), rest.begin(), rest.end());
      expect_error(mechanism(all), words);
    };
    refused("se.superelement.h5", {"kind 'tisserand-superelement'", "*.results.h5"});
    refused("arm.scene.yaml", {"is not an HDF5 file"});
    refused("none.results.h5", {"none.results.h5", "No such file"});
    rest[1] = "energy/totl";
    refused("arm.results.h5", {"no channel 'energy/totl'", "did you mean 'energy/total'?"});
    rest[1] = "nodes/positon";
    refused("arm.results.h5", {"no channel 'nodes/positon'", "did you mean 'nodes/position'?"});
  }
  expect_error(with("check", {"bodies.se.file=arm.results.h5"}), {"arm.results.h5", "tisserand-results"});
  EXPECT_FALSE(std::filesystem::exists(file("x.svg")));
  EXPECT_FALSE(std::filesystem::exists(file("x.csv")));
}

TEST_F(Outputs, RhythmOfOutput) {
  const auto times = [&](const std::vector<std::string>& settings) {
    std::vector<std::string> words{"run", "arm.scene.yaml", "-o", "o.h5"};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    EXPECT_EQ(mechanism(words).code, 0);
    return mechanism({"export", "o.h5", "-c", "time", "-o", "/dev/stdout"}).out;
  };
  EXPECT_EQ(times({"output.every=4"}), "time [s]\n0\n0.04\n0.08\n0.1\n");  // the last instant always
  EXPECT_EQ(times({"output={every: 4, from: 0.05}"}), "time [s]\n0.08\n0.1\n");
  EXPECT_EQ(times({"output={interval: 0.05}"}), "time [s]\n0\n0.05\n0.1\n");
  times({"output.channels=[energy, nodes/position]"});
  const std::string channels = mechanism({"channels", "o.h5"}).out;
  EXPECT_THAT(channels,
              AllOf(HasSubstr("energy/total"), HasSubstr("nodes/position/rod/1/x"), Not(HasSubstr("velocity"))));
}

TEST_F(Outputs, SingleNodesAreStoredUnderBothNames) {
  ASSERT_EQ(mechanism({"run", "arm.scene.yaml", "-o", "arm.results.h5", "--set",
                       "output.channels=[nodes/position/rod/end, nodes/velocity/block/hook/z]"})
                .code,
            0);
  const std::string channels = mechanism({"channels", "arm.results.h5"}).out;
  EXPECT_THAT(channels, AllOf(HasSubstr("nodes/position/rod/2/x"), HasSubstr("nodes/velocity/block/hook/y"),
                              HasSubstr("  = nodes/position/rod/2/x\n"), Not(HasSubstr("rod/1")),
                              Not(HasSubstr("rod/start")), Not(HasSubstr("rotation")), Not(HasSubstr("energy"))));
  const auto column = [&](const std::string& name) {
    const Outcome outcome = mechanism({"export", "arm.results.h5", "-c", name, "-o", "/dev/stdout"});
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    return outcome.out.substr(outcome.out.find('\n'));
  };
  EXPECT_EQ(column("nodes/position/rod/end/z"), column("nodes/position/rod/2/z"));
  expect_error(with("run", {"output.channels=[nodes/position/rod/edn]"}),
               {"there is no node 'rod/edn'", "nodes with similar names are rod/end"});
  expect_error(with("check", {"output.channels=[nodes/position/rod/edn]"}), {"there is no node 'rod/edn'"});
}

TEST_F(Outputs, ShapesAreThoseOfTheStoredNodes) {
  write_text(file("tones.scene.yaml"), R"yaml(scene: cantilever
analysis: modes
bodies:
  rod: {type: beam, from: [0, 0, 0], to: [1, 0, 0], elements: 2, section: {shape: circle, radius: 0.01}, material: {E: 2.1e11, nu: 0.3, density: 7800}}
joints: {clamp: {type: fixed, a: ground, b: rod/start}}
modes: {count: 3}
output: {channels: [nodes/position/rod/end]}
)yaml");
  const Outcome run = mechanism({"run", "tones.scene.yaml"});
  ASSERT_EQ(run.code, 0) << run.error;
  const std::string csv = mechanism({"export", "tones.results.h5", "-c", "modes", "-o", "/dev/stdout"}).out;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3);
  EXPECT_THAT(csv, AllOf(HasSubstr("modes/frequency [Hz]"), HasSubstr("modes/rotation/rod/2/z/imaginary"),
                         Not(HasSubstr("rod/1"))));
  const Outcome plot = mechanism({"plot", "tones.results.h5", "-c", "modes/frequency", "-o", "tones.svg"});
  if (plot.error.find("gnuplot is not installed") == std::string::npos) {
    EXPECT_EQ(plot.code, 0) << plot.error;
  }
}

// gnuplot takes "|command" for a pipe, so no name of a file may reach it.
TEST_F(Outputs, NamesOfPicturesAreNoCommands) {
  ASSERT_EQ(mechanism({"run", "arm.scene.yaml"}).code, 0);
  const std::string name = "|touch EXECUTED;'.png";
  const auto plot = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"plot", "arm.results.h5", "-c", "energy/kinetic", "-o", name};
    words.insert(words.end(), more.begin(), more.end());
    return mechanism(words);
  };
  const Outcome drawn = plot({});
  if (drawn.error.find("gnuplot is not installed") != std::string::npos) GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_EQ(drawn.code, 0) << drawn.error;
  EXPECT_TRUE(std::filesystem::exists(file(name)));
  EXPECT_FALSE(std::filesystem::exists(file("EXECUTED")));
  EXPECT_THAT(plot({"--range", "100", "200"}).error,
              HasSubstr("no values between 100 and 200; the run goes from 0 to "));
  for (const char* title : {"it's\na `touch EXECUTED`", "'90s", "''"})  // the trial: gnuplot ended the text there
    EXPECT_EQ(plot({"--title", title}).code, 0) << title;
  EXPECT_FALSE(std::filesystem::exists(file("EXECUTED")));
}

// A companion and a table of the run, a scene and a part were replaced.
TEST_F(Outputs, ReplaceNoInputsAndNoFilesOfOtherKinds) {
  make_results();
  std::filesystem::copy(file("arm.results.h5"), file("driven.h5"));
  std::filesystem::copy(file("se.superelement.h5"), file("se.companion.h5"));
  write_text(file("driven.scene.yaml"),
             std::string(arm_scene) + "inputs: {u: {file: driven.h5, time: /time, value: /energy/kinetic}}\n");
  const std::vector<std::pair<std::vector<std::string>, std::string>> refused{
      {{"run", "driven.scene.yaml", "-o", "driven.h5"}, "the output would replace its own input"},
      {{"run", "arm.scene.yaml", "-o", "se.companion.h5"}, "the output would replace its own input"},
      {{"run", "arm.scene.yaml", "-o", "other.companion.h5"}, "does not end in .results.h5 or .h5"},
      {{"run", "arm.scene.yaml", "-o", "-"}, "is a device or pipe"},
      {{"export", "arm.results.h5", "-c", "energy", "-o", "arm.scene.yaml"}, "does not end in .csv"},
      {{"view", "arm.results.h5", "-o", "arm.scene.yaml"}, "does not end in .html"},
      {{"plot", "arm.results.h5", "-c", "energy/kinetic", "-o", "arm.results.h5"}, "its own input"},
      {{"picture", "arm.results.h5", "-o", "se.superelement.h5"}, "does not end in .png"}};
  for (const auto& [words, why] : refused) {
    const std::string path = file(words.back());
    const bool existed = std::filesystem::exists(path);
    const std::string before = existed ? read_text(path) : "";
    expect_error(mechanism(words), {words.back(), why});
    EXPECT_EQ(std::filesystem::exists(path), existed);
    EXPECT_EQ(existed ? read_text(path) : "", before);
  }
}

TEST_F(Outputs, HyphenIsStandardOutput) {
  make_results();
  const std::string table = mechanism({"export", "arm.results.h5", "-c", "energy", "-o", "-"}).out;
  EXPECT_EQ(table, mechanism({"export", "arm.results.h5", "-c", "energy", "-o", "/dev/stdout"}).out);
  EXPECT_THAT(table, HasSubstr("energy/kinetic"));
  const Outcome page = mechanism({"view", "arm.results.h5", "-o", "-"});
  EXPECT_THAT(page.out, AllOf(::testing::StartsWith("<!"), Not(HasSubstr("page: -"))));
  EXPECT_THAT(page.error, HasSubstr("page: -"));
  EXPECT_FALSE(std::filesystem::exists(file("-")));
}

TEST_F(Outputs, RunReportsTheDoubtsOfCheckOnce) {
  const std::string reported =
      "2 groups of bodies without a connection between them: ";  // nothing holds the superelement
  EXPECT_THAT(mechanism({"check", "arm.scene.yaml"}).out, HasSubstr(reported));
  const auto count = [&](const std::string& text) {
    int n = 0;
    for (auto at = text.find(reported); at != std::string::npos; at = text.find(reported, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count(mechanism({"run", "arm.scene.yaml"}).out), 1);
  write_text(file("two.scene.yaml"),
             std::string(arm_scene) + "analyses: {first: {type: dynamics}, second: {type: dynamics}}\n");
  const Outcome two = mechanism({"run", "two.scene.yaml", "--set", "integrator.end=0.02"});
  EXPECT_EQ(two.code, 0) << two.error;
  EXPECT_EQ(count(two.out), 1);
  const Outcome heavy = mechanism({"run", "arm.scene.yaml", "--set", "bodies.block.mass=2e16"});
  EXPECT_THAT(heavy.out, AllOf(HasSubstr("warning"), HasSubstr("differ by more than")));
}

TEST_F(Outputs, UsageErrorsAreTwoAndHelpTeaches) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{},
                                             {"rnu"},
                                             {"run"},
                                             {"run", "arm.scene.yaml", "--nonsense"},
                                             {"run", "a", "b"},
                                             {"export", "arm.results.h5"}}) {
    const Outcome outcome = mechanism(words);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.error, AllOf(HasSubstr("mechanism: "), HasSubstr("--help` explains")));
  }
  EXPECT_THAT(mechanism({"rnu"}).error, HasSubstr("there is no command 'rnu'; did you mean 'run'?"));
  for (const char* command : {"run", "check", "export", "channels", "plot", "compare", "ledger"}) {
    const Outcome outcome = mechanism({command, "--help"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.out, HasSubstr(std::string("\n  mechanism ") + command));  // an example
  }
  EXPECT_THAT(mechanism({"--help"}).out, AllOf(HasSubstr("Examples:"), HasSubstr("Exit codes:"), HasSubstr("Units")));
  EXPECT_THAT(mechanism({"--version"}).out, HasSubstr("mechanism " + version() + " (Tisserand)\ncommit "));
}

TEST_F(Outputs, ExportIsAppendedWhereTheShellAppends) {
  make_results();
  write_text(file("log"), "kept\n");
  const std::string command = program("mechanism") + " export arm.results.h5 -c time -o /dev/stdout >> log";
  ASSERT_EQ(call({"/bin/sh", "-c", command}, where).code, 0);
  EXPECT_THAT(read_text(file("log")), ::testing::StartsWith("kept\ntime [s]\n0\n0.01\n"));
}

TEST_F(Outputs, PictureThatIsCutShortIsAnError) {
  make_results();
  write_text(file("a.svg"), "older");
  for (const char* picture : {"a.png", "a.svg"}) {
    where.file_size = 12'000;  // in place of a full disk; both pictures take more, the script less
    expect_error(mechanism({"plot", "arm.results.h5", "-c", "nodes/position/rod/*", "-o", picture}),
                 {picture, "the picture is incomplete", "free some space"});
    where.file_size = RLIM_INFINITY;
    ASSERT_EQ(
        mechanism({"plot", "arm.results.h5", "-c", "nodes/position/rod/*", "-o", "whole_" + std::string(picture)}).code,
        0);
    EXPECT_GT(std::filesystem::file_size(file("whole_" + std::string(picture))), 12'000u);
  }
  EXPECT_EQ(read_text(file("a.svg")), "older");
  EXPECT_FALSE(std::filesystem::exists(file("a.png")));
}

// The numbers of closed streams were taken by the results: their bytes and messages went into one file.
TEST_F(Outputs, ClosedStreamsHarmNothing) {
  make_results();
  const std::string streams = " <&- >&- 2>&-";
  ASSERT_EQ(call({"/bin/sh", "-c", program("mechanism") + " run arm.scene.yaml -o closed.h5" + streams}, where).code,
            0);
  const auto table = [&](const std::string& name) { return mechanism({"export", name, "-o", "/dev/stdout"}).out; };
  EXPECT_EQ(table("closed.h5"), table("arm.results.h5"));
  EXPECT_EQ(call({"/bin/sh", "-c", program("mechanism") + " run none.yaml" + streams}, where).code, 1);
  if (!std::filesystem::exists(program("reducer"))) GTEST_SKIP() << "built without reducer";
  EXPECT_EQ(call({"/bin/sh", "-c", program("reducer") + " show se.superelement.h5" + streams}, where).code, 0);
}

TEST_F(Outputs, NamesThatAreNoTextReachNeitherTerminalNorReport) {
  const std::string odd = "odd\xff\x1b[31m";
  expect_error(mechanism({"channels", odd + ".h5"}), {"odd\\xff\\x1b[31m.h5"});
  ASSERT_EQ(mechanism({"run", "arm.scene.yaml", "-o", "arm.results.h5", "--set", "checkpoint.every=3"}).code, 0);
  std::filesystem::copy_file(file("arm.checkpoint.h5"), file(odd + ".checkpoint.h5"));
  // The report (JSON) tells from which file the run goes on.
  const Outcome outcome = mechanism({"run", "arm.scene.yaml", "--restart", odd + ".checkpoint.h5", "-o", "rest.h5"});
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("continues from odd\\xff\\x1b[31m"), Not(HasSubstr("\x1b"))));
}

TEST_F(Outputs, RestartNeverOverwritesWhatItGoesOnFrom) {
  ASSERT_EQ(mechanism({"run", "arm.scene.yaml", "-o", "arm.results.h5", "--set", "checkpoint.every=3"}).code, 0);
  const std::string before = read_text(file("arm.results.h5"));
  const auto restart = [&](const std::string& from, const std::vector<std::string>& more) {
    std::vector<std::string> words{"run", "arm.scene.yaml", "--restart", from};
    words.insert(words.end(), more.begin(), more.end());
    return mechanism(words);
  };
  expect_error(restart("arm.checkpoint.h5", {}), {"--restart needs the name of a new results file", "--append"});
  expect_error(restart("arm.checkpoint.h5", {"-o", "./arm.results.h5"}), {"would overwrite the run", "--append"});
  expect_error(restart("arm.checkpoint.h5", {"-o", "arm.h5"}), {"would overwrite the run", "arm.checkpoint.h5"});
  expect_error(restart("arm.results.h5", {"-o", "arm.results.h5", "--at", "0.05"}), {"would overwrite the run"});
  expect_error(mechanism({"run", "arm.scene.yaml", "--append"}), {"--append needs --restart"});
  EXPECT_EQ(read_text(file("arm.results.h5")), before);
  // One that was killed: found by its final name, and its .part is as safe.
  std::filesystem::rename(file("arm.results.h5"), file("arm.results.h5.part"));
  expect_error(restart("arm.results.h5", {"-o", "arm.results.h5", "--at", "0.05"}), {"would overwrite the run"});
  expect_error(restart("arm.checkpoint.h5", {"-o", "arm.results.h5"}), {"would overwrite the run"});
  EXPECT_EQ(read_text(file("arm.results.h5.part")), before);
  EXPECT_EQ(restart("arm.results.h5", {"-o", "rest.results.h5", "--at", "0.05"}).code, 0);
  const Outcome joined = restart("arm.checkpoint.h5", {"--append", "--set", "integrator.end=0.2"});
  EXPECT_EQ(joined.code, 0) << joined.error;
  EXPECT_THAT(joined.out, HasSubstr("begins with the 10 instants of arm.results.h5.part"));
  EXPECT_THAT(mechanism({"channels", "arm.results.h5"}).out, HasSubstr("21 instants from 0 to 0.2 s"));
  EXPECT_FALSE(std::filesystem::exists(file("arm.results.h5.part")));
}

TEST_F(Outputs, PagesAndPicturesTakeTheNamesOfTheirResults) {
  make_results();
  EXPECT_THAT(mechanism({"view", "arm.results.h5"}).out, HasSubstr("page: arm.html"));
  EXPECT_TRUE(std::filesystem::exists(file("arm.html")));
  expect_error(mechanism({"view", "none.h5"}), {"none.h5", "No such file"});
  expect_error(mechanism({"view", "arm.scene.yaml"}), {"arm.scene.yaml"});
  expect_error(mechanism({"view"}), {"no results file is given"});
  EXPECT_FALSE(std::filesystem::exists(file("none.html")));
}

TEST_F(Outputs, PicturesSayWhatTheyCannotShow) {
  make_results();
  const auto fault = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"picture", "arm.results.h5", "-o", "arm.png"};
    words.insert(words.end(), more.begin(), more.end());
    return mechanism(words);
  };
  expect_error(fault({"--time", "7"}), {"arm.results.h5", "no instant t = 7 s", "from 0 to"});
  expect_error(fault({"--time", "nan"}), {"no instant t = nan"});
  expect_error(fault({"--view", "left,3"}), {"'left,3' is not a view", "azimuth,elevation"});
  expect_error(fault({"--size", "2", "2"}), {"2 x 2 pixels", "--size"});
  expect_error(fault({"--trace", "rod/ende"}), {"no node 'rod/ende'", "rod/end"});
  expect_error(fault({"--mode", "3"}), {"holds 0 modes", "analysis: modes"});
  expect_error(mechanism({"picture", "arm.results.h5", "-o", "arm.jpg"}), {"arm.jpg", ".png"});
  const Outcome alone =
      call({"/usr/bin/env", "PATH=/nowhere", program("mechanism"), "picture", "arm.results.h5", "--no-sandbox"}, where);
  expect_error(alone, {"pictures need Chromium, which is not installed", "apt-get install chromium"});
  write_text(file("chromium"), "#!/bin/sh\necho no display >&2\nexit 1\n");
  std::filesystem::permissions(file("chromium"), std::filesystem::perms::owner_all);
  expect_error(call({"/usr/bin/env", "PATH=" + folder.path().string(), program("mechanism"), "picture",
                     "arm.results.h5", "--no-sandbox"},
                    where),
               {"did not answer", "no display"});
  EXPECT_FALSE(std::filesystem::exists(file("arm.png")));
  for (const auto& left : std::filesystem::directory_iterator(folder.path()))
    EXPECT_NE(left.path().extension(), ".html");
}

TEST_F(Outputs, PicturesAreTheSameEachTime) {
  if (!is_program("chromium")) GTEST_SKIP() << "not tested: there is no chromium here (apt-get install chromium)";
  make_results();
  for (const char* name : {"a.png", "b.png"}) {
    std::vector<std::string> words{
        "picture", "arm.results.h5", "--time", "0.02", "--time", "0.1", "--size", "300", "200", "-o", name};
    if (::geteuid() == 0) words.push_back("--no-sandbox");
    const Outcome outcome = mechanism(words);
    ASSERT_EQ(outcome.code, 0) << outcome.error;
  }
  const std::string bytes = read_text(file("a.png"));
  EXPECT_EQ(bytes, read_text(file("b.png")));
  ASSERT_GT(bytes.size(), 24u);
  EXPECT_EQ(bytes.substr(0, 4), "\x89PNG");
  EXPECT_EQ(bytes.substr(16, 8), std::string("\0\0\1\x2c\0\0\0\xc8", 8));  // of the header: 300 x 200 pixels
}

}  // namespace
}  // namespace tisserand::cli::outputs_test
