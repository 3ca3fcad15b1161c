// SPDX-License-Identifier: GPL-3.0-or-later
// Reductions by several processes (mpirun): the same results, the same errors, and an end in every case.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <vector>

#include "formats/superelement/superelement.hpp"
#include "tests/reducer/parts.hpp"

namespace tisserand::testing::ranks_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string source = TISSERAND_SOURCE_DIR;
/// 3456 coordinates in two spiders: enough to be shared.
const std::string plate = source + "/tests/benchmarks/spider_plate.part.yaml --set 'plates.sheet.elements=[24, 24]'";
const std::string beam = source + "/examples/hinged_beam/beam.part.yaml --set beams.rod.elements=400";

struct Outcome {
  int code = -1;
  std::string text;  ///< both streams
};

Eigen::Index boundary_size(const formats::Superelement& s) {
  return std::count_if(s.dof_node.begin(), s.dof_node.end(), [](int node) { return node >= 0; });
}

/// S_BB − λ M_BB − λ² M_BI (Λ − λ)⁻¹ M_IB of a file in canonical form.
Eigen::MatrixXd condensed(const formats::Superelement& s, double lambda) {
  const Eigen::Index n = s.size(), n_B = boundary_size(s);
  const Eigen::MatrixXd M_BI = s.mass.topRightCorner(n_B, n - n_B);
  const Eigen::VectorXd inside = s.stiffness.diagonal().tail(n - n_B).array() - lambda;
  return s.stiffness.topLeftCorner(n_B, n_B) - lambda * s.mass.topLeftCorner(n_B, n_B) -
         lambda * lambda * M_BI * inside.cwiseInverse().asDiagonal() * M_BI.transpose();
}

/// mpirun as from a user's shell: of what this process's own MPI has put into the environment it would take fright.
std::string launcher() {
  std::string text = "env -i";
  for (const char* const name : {"PATH", "HOME", "ASAN_OPTIONS", "LSAN_OPTIONS", "UBSAN_OPTIONS"})
    if (const char* const value = std::getenv(name)) text += std::string(" ") + name + "='" + value + "'";
  return text + " OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 timeout 300 mpirun --oversubscribe";
}

class Ranks : public ::testing::Test {
 protected:
  std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / ("reducer_ranks_" + std::to_string(::getpid()) + "_" +
                                                     ::testing::UnitTest::GetInstance()->current_test_info()->name());

  void SetUp() override {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    if (std::system("mpirun --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "not tested: there is no mpirun";
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  /// By so many processes; more than the machine has cores.
  Outcome call(int ranks, const std::string& arguments) const {
    const std::string log = (folder / "log").string();
    const std::string start = ranks == 1 ? "" : launcher() + " -n " + std::to_string(ranks) + " ";
    const int status =
        std::system((start + TISSERAND_BINARY_DIR "/bin/reducer " + arguments + " > " + log + " 2>&1").c_str());
    std::ifstream file(log);
    std::stringstream text;
    text << file.rdbuf();
    return {WEXITSTATUS(status), text.str()};
  }

  formats::Superelement reduced(int ranks, const std::string& arguments) const {
    const std::string output = (folder / ("by" + std::to_string(ranks) + ".superelement.h5")).string();
    const Outcome run = call(ranks, "run " + arguments + " -o " + output);
    EXPECT_EQ(run.code, 0) << run.text;
    if (ranks > 1) {
      EXPECT_THAT(run.text, HasSubstr("processes          " + std::to_string(ranks)));
    }
    return formats::read_superelement(output).superelement;
  }

  /// S̄_BB to `statics`, frequencies and condensed dynamic stiffness between the poles to 1e-9.
  static void expect_same(const formats::Superelement& one, const formats::Superelement& many, double statics) {
    ASSERT_EQ(one.size(), many.size());
    const Eigen::Index n_B = boundary_size(one);
    EXPECT_LT(relative_difference(many.stiffness.topLeftCorner(n_B, n_B), one.stiffness.topLeftCorner(n_B, n_B)),
              statics);
    for (Eigen::Index k = n_B; k < one.size(); ++k)
      EXPECT_NEAR(std::sqrt(many.stiffness(k, k) / one.stiffness(k, k)), 1.0, 1e-9)
          << "internal coordinate " << k - n_B;
    int compared = 0;
    for (Eigen::Index k = n_B; k + 1 < one.size(); ++k) {
      const double below = one.stiffness(k, k), above = one.stiffness(k + 1, k + 1);
      if (above < 1.2 * below) continue;
      const double lambda = 0.5 * (below + above);
      EXPECT_LT(relative_difference(condensed(many, lambda), condensed(one, lambda)), 1e-9) << "behind " << k - n_B;
      ++compared;
    }
    EXPECT_GE(compared, 3);
  }
};

TEST_F(Ranks, TwoReduceShellsAsOneDoes) { expect_same(reduced(1, plate), reduced(2, plate), 1e-12); }

// The certificate of one process tells a round-off of 1.1e-12 of S̄.
TEST_F(Ranks, ThreeReduceSolidsAsOneDoes) {
  const std::string part = source + "/examples/crank/crank.part.yaml";
  const formats::Superelement one = reduced(1, part), three = reduced(3, part);
  expect_same(one, three, 4e-12);
  // The companion rests on the same factor and modes: the files have the same size.
  const auto size = [&](const char* name) { return static_cast<double>(std::filesystem::file_size(folder / name)); };
  EXPECT_NEAR(size("by3.companion.h5"), size("by1.companion.h5"), 0.01 * size("by1.companion.h5"));
}

// 400 elements in a row are ill-conditioned: by one process (4 + φ)EI/(1 + φ)L of the beam is 4.6e-10 off.
TEST_F(Ranks, TwoReduceBeamsWithPairsOfEqualModesAsOneDoes) { expect_same(reduced(1, beam), reduced(2, beam), 1e-10); }

TEST_F(Ranks, KrylovSchurIsShared) {
  const std::string part = plate + " --set eigensolver=krylov_schur --set modes=6";
  expect_same(reduced(1, part), reduced(2, part), 1e-12);
}

// One process without a launcher ends without the clean-up of MPI: nothing may be left, in the output either.
TEST_F(Ranks, OneLeavesNoFilesBehind) {
  const std::filesystem::path temporary = folder / "tmp";
  std::filesystem::create_directory(temporary);
  ASSERT_EQ(::setenv("TMPDIR", temporary.c_str(), 1), 0);
  const Outcome run = call(1, "run " + beam + " -o " + (folder / "one.superelement.h5").string());
  ::unsetenv("TMPDIR");
  EXPECT_EQ(run.code, 0);
  EXPECT_THAT(run.text, HasSubstr("one.companion.h5 ("));
  EXPECT_TRUE(std::filesystem::is_empty(temporary));
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path().filename());
  EXPECT_THAT(files, ::testing::UnorderedElementsAre("tmp", "log", "one.superelement.h5", "one.companion.h5",
                                                     "one.superelement.certificate.json"));
}

TEST_F(Ranks, FreeModesAreShared) {
  const std::string part = plate + " --set method=rubin --set modes=6";
  expect_same(reduced(1, part), reduced(2, part), 1e-12);
}

// A motion without stiffness, here of a spring that points one way, is found by the shared factor, told once, and ends
// all processes.
TEST_F(Ranks, AnErrorIsReportedOnce) {
  const std::string part =
      "run " + beam +
      " --set points.weight='[141.42, 0, 10]' --set 'point_masses={weight: {at: weight, mass: 1}}' --set "
      "'springs={s: {from: tip, to: weight, stiffness: [0, 0, 1e4, 0, 0, 0]}}' -o " +
      (folder / "x.superelement.h5").string();
  const Outcome one = call(1, part), two = call(2, part);
  EXPECT_EQ(one.code, 1);
  EXPECT_EQ(two.code, 1);
  const std::string message = "without stiffness while its boundary is held: weight";
  EXPECT_THAT(one.text, HasSubstr(message));
  ASSERT_THAT(two.text, HasSubstr(message));
  EXPECT_THAT(two.text.substr(two.text.find(message) + 1), Not(HasSubstr(message)));
  EXPECT_FALSE(std::filesystem::exists(folder / "x.superelement.h5"));
}

TEST_F(Ranks, CommandsThatShareNothingRunOnce) {
  const Outcome help = call(2, "--help");
  EXPECT_EQ(help.code, 0);
  const std::string line = "part.yaml -> mesh -> S, M -> modes";
  ASSERT_THAT(help.text, HasSubstr(line));
  EXPECT_THAT(help.text.substr(help.text.find(line) + 1), Not(HasSubstr(line)));
  EXPECT_EQ(call(2, "rum x").code, 2);
  EXPECT_THAT(call(2, "run " + (folder / "no.part.yaml").string()).text,
              HasSubstr("no.part.yaml: cannot open the file"));
}

// Each process reads the part itself: if one cannot, that one says so and none waits for it.
TEST_F(Ranks, AFollowerWithoutThePartEndsAll) {
  const std::string part = (folder / "plate.part.yaml").string();
  std::filesystem::copy_file(source + "/tests/benchmarks/spider_plate.part.yaml", part);
  const std::string reducer = TISSERAND_BINARY_DIR "/bin/reducer run ", log = (folder / "log").string();
  const std::string cut = " --set 'plates.sheet.elements=[24, 24]' -o " + (folder / "x.superelement.h5").string();
  const auto both = [&](const std::string& second) {
    const int status = std::system(
        (launcher() + " -n 1 " + reducer + part + cut + " : -n 1 " + reducer + second + cut + " > " + log + " 2>&1")
            .c_str());
    std::ifstream file(log);
    std::stringstream text;
    text << file.rdbuf();
    return Outcome{WEXITSTATUS(status), text.str()};
  };
  const Outcome missing = both((folder / "other.part.yaml").string());
  EXPECT_NE(missing.code, 0);
  EXPECT_THAT(missing.text, HasSubstr("rank 1: " + (folder / "other.part.yaml").string() + ": cannot open the file"));
  const Outcome other = both(part + " --set points.c='[1, 1.1, 0]'");
  EXPECT_NE(other.code, 0);
  EXPECT_THAT(other.text, HasSubstr("this process made a mesh that differs from the mesh of the first process"));
  EXPECT_FALSE(std::filesystem::exists(folder / "x.superelement.h5"));
}

TEST_F(Ranks, SolveIsShared) {
  const std::string part = "solve " + plate +
                           " --set 'supports={west: all}' --set 'load_cases={tip: {forces: {east: [0, 0, -10]}}}' "
                           "--modes 4 -o ";
  /// Displacements, stresses, energy and frequencies; reactions that are zero differ by round-off, and a slow machine
  /// prints its progress ("modes ... 2 s").
  const auto table = [&](int ranks) {
    const Outcome run = call(ranks, part + (folder / std::to_string(ranks)).string());
    EXPECT_EQ(run.code, 0) << run.text;
    std::stringstream lines(run.text.substr(0, run.text.find("\nwritten ")));
    std::string text, line;
    const std::regex varies("reaction|equilibrium|residual| \\.\\.\\. [0-9]+ s");
    while (std::getline(lines, line))
      if (!std::regex_search(line, varies)) text += line + "\n";
    return text;
  };
  const std::string one = table(1);
  EXPECT_THAT(one, AllOf(HasSubstr("strain energy"), HasSubstr("89.6186")));
  EXPECT_EQ(table(2), one);
}

}  // namespace
}  // namespace tisserand::testing::ranks_test
