// SPDX-License-Identifier: GPL-3.0-or-later
// The program as users call it: exit codes, files, messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include <nlohmann/json.hpp>

#include "common/program/version.hpp"
#include "formats/companion/companion.hpp"
#include "formats/modal_body/modal_body.hpp"
#include "formats/recovery/recovery.hpp"
#include "formats/superelement/superelement.hpp"
#include "tests/reducer/parts.hpp"

namespace tisserand::testing::program_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

struct Outcome {
  int code = -1;
  std::string text;  ///< both streams
};

class Program : public ::testing::Test {
 protected:
  std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) /
      ("reducer_" + std::to_string(::getpid()) + "_" + ::testing::UnitTest::GetInstance()->current_test_info()->name());
  std::string part = (folder / "beam.part.yaml").string();

  void SetUp() override {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::filesystem::copy_file(TISSERAND_SOURCE_DIR "/examples/hinged_beam/beam.part.yaml", part);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  Outcome call(const std::string& arguments) const { return call_after("", arguments); }
  /// After a command of the shell, such as a limit, or a variable.
  Outcome call_after(const std::string& before, const std::string& arguments) const {
    const std::string log = (folder / "log").string();
    const std::string command = before + TISSERAND_BINARY_DIR "/bin/reducer " + arguments + " > " + log + " 2>&1";
    const int status = std::system(command.c_str());
    std::ifstream file(log);
    std::stringstream text;
    text << file.rdbuf();
    return {WEXITSTATUS(status), text.str()};
  }
};

// w = PL³/3EI + PL/GA_s of [Car00]'s beam with P = 1e-3 at its tip.
TEST_F(Program, SolveWritesTableAndFieldsBesideThePart) {
  const Outcome run =
      call("solve " + part +
           " --modes 2 --set 'supports={base: all}' --set 'load_cases={tip: {forces: " + "{tip: [0, 0, -1e-3]}}}'");
  ASSERT_EQ(run.code, 0) << run.text;
  EXPECT_THAT(run.text, AllOf(HasSubstr("load case 'tip'"), HasSubstr("base: force (0, 0, 0.001)"),
                              HasSubstr("modes, supported"), HasSubstr("beam.solution.tip.vtu")));
  const double w = 1e-3 * std::pow(141.42, 3) / (3.0 * 2.1e6 * 6.75) + 1e-3 * 141.42 * 2.6 / (2.1e6 * 7.5);
  std::ifstream file(folder / "beam.solution.csv");
  std::string line;
  while (std::getline(file, line) && !line.starts_with("tip,\"tip\",")) continue;
  std::stringstream words(line.substr(10));
  std::vector<double> values;
  for (std::string word; std::getline(words, word, ',');) values.push_back(std::stod(word));
  ASSERT_EQ(values.size(), 6u) << line;
  EXPECT_NEAR(values[2], -w, 1e-9 * w);
  EXPECT_TRUE(std::filesystem::exists(folder / "beam.solution.tip.vtu"));
  EXPECT_TRUE(std::filesystem::exists(folder / "beam.solution-modes.vtu"));
  EXPECT_EQ(call("solve " + part + " --modes -1").code, 2);
  EXPECT_THAT(call("solve " + part).text, HasSubstr("nothing to compute"));
}

TEST_F(Program, RunWritesSuperelementAndCertificateBesideThePart) {
  const Outcome run = call("run " + part);
  ASSERT_EQ(run.code, 0) << run.text;
  EXPECT_THAT(run.text, AllOf(HasSubstr("8 kept"), HasSubstr("total"), HasSubstr("beam.superelement.h5")));
  const formats::LoadedSuperelement loaded = formats::read_superelement((folder / "beam.superelement.h5").string());
  EXPECT_EQ(loaded.superelement.size(), 20);
  EXPECT_FALSE(loaded.superelement.units.named());
  EXPECT_NEAR(loaded.report.rigid.mass, 7.8e-3 * 9.0 * 141.42, 1e-11);
  std::ifstream file(folder / "beam.superelement.certificate.json");
  const nlohmann::json certificate = nlohmann::json::parse(file);
  EXPECT_EQ(certificate.at("content_id"), loaded.superelement.content_id);
  EXPECT_EQ(certificate.at("file").at("fixed_boundary_frequency").size(), 8u);

  const Outcome show = call("show " + (folder / "beam.superelement.h5").string());
  EXPECT_EQ(show.code, 0);
  EXPECT_THAT(show.text, AllOf(HasSubstr("free, full"), HasSubstr("first dropped"), HasSubstr("mass 9.927684")));
}

// Two boundary nodes: a column of boundary modes and one of the flexibility for each of 12 coordinates. A mode takes
// one column at least, that of its residual. The peak of a process never falls, and a phase that goes on after another
// tells its last one: none lies outside those of the first and the last phase.
TEST_F(Program, RunReportsMemoryByPhaseAndColumnsSolved) {
  const auto columns = [&](int modes) {
    const Outcome run = call("run " + part + " --set second_order=no --set modes=" + std::to_string(modes));
    EXPECT_EQ(run.code, 0) << run.text;
    std::smatch peak, solved;
    EXPECT_TRUE(std::regex_search(run.text, peak, std::regex("\npeak memory +(read .* MB, write [0-9]+ MB)\n")));
    std::vector<double> peaks;
    const std::regex number("[a-z)] ([0-9]+) MB");
    const std::string text = peak[1];
    for (std::sregex_iterator it(text.begin(), text.end(), number), end; it != end; ++it)
      peaks.push_back(std::stod((*it)[1]));
    if (peaks.empty()) return 0;
    EXPECT_GE(peaks.front(), 1.0) << text;
    EXPECT_THAT(peaks, ::testing::Each(AllOf(::testing::Ge(peaks.front()), ::testing::Le(peaks.back())))) << text;
    EXPECT_TRUE(
        std::regex_search(run.text, solved, std::regex("\nsubstitutions +([0-9]+) columns [0-9]+\\.[0-9]+ s\n")));
    return solved.size() > 1 ? std::stoi(solved[1]) : 0;
  };
  for (const int modes : {8, 16}) EXPECT_GE(columns(modes), 12 + 12 + modes);
}

TEST_F(Program, RunWritesTheModalBodyThatThePartAsksFor) {
  const Outcome run = call("run " + part + " --set 'modal_body={reference: tip, modes: 4}'");
  ASSERT_EQ(run.code, 0) << run.text;
  EXPECT_THAT(run.text, AllOf(HasSubstr("modal body         4 modes, tip held: "), HasSubstr("beam.modal.h5")));
  const formats::LoadedModalBody loaded = formats::read_modal_body((folder / "beam.modal.h5").string());
  EXPECT_EQ(loaded.body.modes(), 4);
  EXPECT_EQ(loaded.body.node_name, (std::vector<std::string>{"base", "tip"}));
  const Outcome show = call("show " + (folder / "beam.superelement.h5").string());
  EXPECT_THAT(show.text, HasSubstr("modal body         4 modes, tip held: "));
}

// A mechanism would take the companion of an earlier run for that of the new superelement, or refuse both.
TEST_F(Program, RunLeavesNoCompanionOfAnEarlierRunBehind) {
  const std::string companion = (folder / "beam.companion.h5").string(),
                    superelement = (folder / "beam.superelement.h5").string(),
                    bare = "run " + part + " --set second_order=no";
  ASSERT_EQ(call("run " + part).code, 0);
  formats::Companion other = formats::read_companion(companion, formats::read_superelement(superelement).superelement);
  const Outcome run = call(bare + " --set modes=4");
  ASSERT_EQ(run.code, 0) << run.text;
  EXPECT_THAT(run.text, HasSubstr("removed            " + companion + " of an earlier run"));
  EXPECT_FALSE(std::filesystem::exists(companion));
  EXPECT_THAT(call(bare).text, ::testing::Not(HasSubstr(companion)));
  // Files of others stay.
  other.producer = "another program";
  formats::write_companion(companion, other, formats::read_superelement(superelement).superelement);
  EXPECT_THAT(call(bare).text,
              AllOf(HasSubstr(companion), HasSubstr("`mechanism` reads: it belongs to this superelement")));
  EXPECT_THAT(call(bare + " --set modes=4").text, HasSubstr("`mechanism` refuses: it belongs to another superelement"));
  EXPECT_TRUE(std::filesystem::exists(companion));
  std::ofstream(companion) << "notes";
  EXPECT_THAT(call(bare).text, HasSubstr("`mechanism` refuses: it is not a companion file"));
  EXPECT_TRUE(std::filesystem::exists(companion));
}

TEST_F(Program, ThreadsOfTheBlasLeaveEveryBitAsItIs) {
  const auto content = [&](const std::string& threads) {
    const Outcome run = call_after("OPENBLAS_NUM_THREADS=" + threads + " ", "run " + part);
    EXPECT_EQ(run.code, 0) << run.text;
    return formats::read_superelement((folder / "beam.superelement.h5").string()).superelement.content_id;
  };
  std::filesystem::copy_file(TISSERAND_SOURCE_DIR "/tests/benchmarks/plate.part.yaml", part,
                             std::filesystem::copy_options::overwrite_existing);
  const std::string coarse = "plates: {sheet: {corners: [a, b, c, d], elements: [24, 20]}}";
  std::ifstream in(part);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  text.replace(text.find("plates:"), text.find('\n', text.find("plates:")) - text.find("plates:"), coarse);
  std::ofstream(part) << text;
  EXPECT_EQ(content("1"), content("2"));
}

TEST_F(Program, InternalModesAreCountedWhereThatIsCheap) {
  NEEDS_BLOCK_LANCZOS();
  const Outcome run = call("run " + part);
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_EQ(run.text.find("not counted"), std::string::npos) << run.text;
  const Outcome show = call("show " + (folder / "beam.superelement.h5").string());
  EXPECT_NE(show.text.find("count by inertia   8 modes up to the highest kept one\n"), std::string::npos) << show.text;
}

// 21 594 coordinates and 1000 modes take 0.4 GB; a program that has loaded its libraries finds 0.3 GB of 0.7.
TEST_F(Program, PartThatDoesNotFitIsRefusedBeforeItIsFactored) {
#if defined(TISSERAND_SANITIZED)
  GTEST_SKIP() << "the sanitizer reserves terabytes of addresses";
#endif
  const Outcome run = call_after("ulimit -v 700000; ", "run " TISSERAND_SOURCE_DIR
                                                       "/tests/benchmarks/spider_plate.part.yaml --set modes=1000 "
                                                       "--set 'plates.sheet.elements=[60, 60]' -o " +
                                                           (folder / "plate.superelement.h5").string());
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_THAT(run.text, AllOf(HasSubstr("the reduction of 21594 internal coordinates needs another 0.4"),
                              HasSubstr(" GB of memory, but only 0."), HasSubstr("use fewer elements or modes")));
  EXPECT_FALSE(std::filesystem::exists(folder / "plate.superelement.h5"));
}

TEST_F(Program, RecoveryFileIsWrittenWhereThePartAsksForIt) {
  const std::string file = (folder / "beam.recovery.h5").string();
  ASSERT_EQ(call("run " + part).code, 0);
  EXPECT_FALSE(std::filesystem::exists(file));
  const Outcome run = call("run " + part + " --set recovery=yes");
  ASSERT_EQ(run.code, 0) << run.text;
  EXPECT_THAT(run.text, AllOf(HasSubstr("recovery "), HasSubstr("beam.recovery.h5")));
  const formats::RecoveryReader reader(file);
  EXPECT_EQ(reader.recovery().content_id,
            formats::read_superelement((folder / "beam.superelement.h5").string()).superelement.content_id);
  const Outcome recover = call("recover " + file + " " + (folder / "beam.superelement.h5").string());
  EXPECT_EQ(recover.code, 1);
  EXPECT_THAT(recover.text, HasSubstr("expected 'tisserand-results'"));
  EXPECT_EQ(call("recover " + file).code, 2);
}

TEST_F(Program, ShowIgnoresACertificateOfOtherContent) {
  const std::string file = (folder / "arm.superelement.h5").string();
  ASSERT_EQ(call("run " + part + " -o " + file).code, 0);
  std::filesystem::copy_file(folder / "arm.superelement.certificate.json", folder / "kept.json");
  ASSERT_EQ(call("run " + part + " -o " + file + " --set modes=2").code, 0);
  std::filesystem::copy_file(folder / "kept.json", folder / "arm.superelement.certificate.json",
                             std::filesystem::copy_options::overwrite_existing);
  const Outcome show = call("show " + file);
  EXPECT_EQ(show.code, 0);
  EXPECT_THAT(show.text, Not(HasSubstr("first dropped")));
}

TEST_F(Program, MeshWritesAGmshFile) {
  EXPECT_EQ(call("mesh " + part).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "beam.msh"));
}

TEST_F(Program, HelpAndVersionAreUnderstood) {
  EXPECT_THAT(call("--help").text, AllOf(HasSubstr("Examples:"), HasSubstr("reducer run beam.part.yaml")));
  EXPECT_EQ(call("--help").code, 0);
  EXPECT_THAT(call("--version").text, HasSubstr("reducer " + version() + " (Tisserand)\ncommit "));
}

TEST_F(Program, WrongUsageIsTwoAndErrorsAreOne) {
  EXPECT_EQ(call("").code, 2);
  EXPECT_EQ(call("run").code, 2);
  EXPECT_EQ(call("walk").code, 2);
  EXPECT_EQ(call("run " + part + " --nonsense").code, 2);
  const Outcome missing = call("run " + (folder / "none.yaml").string());
  EXPECT_EQ(missing.code, 1);
  EXPECT_THAT(missing.text, HasSubstr("none.yaml"));
  const Outcome many = call("run " + part + " --set modes=1000");
  EXPECT_EQ(many.code, 1);
  EXPECT_THAT(many.text, HasSubstr("1000 internal modes asked for, but only 282 exist"));
  EXPECT_FALSE(std::filesystem::exists(folder / "beam.superelement.h5"));
}

/// Limits are set where the program is called, and named where they strike.
TEST_F(Program, LimitsOfGeometryAreOptions) {
  const std::string step = TISSERAND_SOURCE_DIR "/meshes/square.step";
  EXPECT_EQ(call("groups " + step + " --geometry-memory 2 --geometry-time 100 --trust-geometry").code, 0);
  const Outcome slow = call("groups " + step + " --geometry-time 0.001");
  EXPECT_EQ(slow.code, 1);
  EXPECT_THAT(slow.text, AllOf(HasSubstr("square.step"), HasSubstr("gmsh was stopped"), HasSubstr("--geometry-time")));
  EXPECT_EQ(call("groups " + step + " --geometry-time -1").code, 2);
}

TEST_F(Program, FolderThatDoesNotExistIsReportedBeforeTheWork) {
  const Outcome run = call("run " + part + " -o " + (folder / "none" / "x.superelement.h5").string());
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.text, AllOf(HasSubstr("cannot write to the folder"), HasSubstr("No such file or directory")));
}

TEST_F(Program, OverridesReachThePart) {
  ASSERT_EQ(call("run " + part + " --set modes=0 --set beams.rod.elements=10").code, 0);
  EXPECT_EQ(formats::read_superelement((folder / "beam.superelement.h5").string()).superelement.size(), 12);
}

}  // namespace
}  // namespace tisserand::testing::program_test
