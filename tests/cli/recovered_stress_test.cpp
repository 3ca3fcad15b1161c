// SPDX-License-Identifier: GPL-3.0-or-later
// Stress recovered from runs with second order and from bases that lack the shapes of their load, end to end: reduced,
// run, recovered, against closed forms (tests/verification/references/trials, table B of the trials of November 2026).
#include <cmath>
#include <filesystem>
#include <numbers>

#include "formats/results/results.hpp"
#include "tests/cli/scenes.hpp"

namespace tisserand::cli::recovered_stress_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

class RecoveredStress : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(program("reducer"))) GTEST_SKIP() << "built without the reducer";
    where.folder = folder.path().string();
  }

  void take(const std::string& name) const {
    fs::copy_file(fs::path(TISSERAND_SOURCE_DIR "/tests/verification/references/trials") / name, folder.file(name),
                  fs::copy_options::overwrite_existing);
  }
  Outcome reduce(const std::string& part, std::vector<std::string> more = {}) const {
    take(part + ".part.yaml");
    std::vector<std::string> words{program("reducer"), "run", part + ".part.yaml"};
    words.insert(words.end(), more.begin(), more.end());
    return call(words, where);
  }
  void run(const std::string& scene, const std::vector<std::string>& settings) const {
    take(scene + ".scene.yaml");
    std::vector<std::string> words{program("mechanism"), "run", scene + ".scene.yaml", "-o", "run.results.h5"};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    const Outcome outcome = call(words, where);
    ASSERT_EQ(outcome.code, 0) << outcome.error;
  }
  std::string recover(const std::string& part) const {
    const Outcome outcome =
        call({program("reducer"), "recover", part + ".recovery.h5", "run.results.h5", "-o", "out"}, where);
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    return outcome.out;
  }
  /// The number behind `what` in the lines of recover.
  static double reported(const std::string& text, const std::string& what) {
    const std::size_t at = text.find(what);
    return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + what.size()));
  }
  double beam_stress(const std::string& part, const std::string& scene,
                     const std::vector<std::string>& settings) const {
    run(scene, settings);
    return reported(recover(part), "largest stress of beams");
  }

  test_support::TemporaryFolder folder;
  Surroundings where;
};

// 17.5 N m on a square bar of 10 mm: M/W = 105 MPa, whatever the frame; the deflection is five thicknesses.
TEST_F(RecoveredStress, OfABentCantileverIsThatOfItsMoment) {
  ASSERT_EQ(reduce("stress_cantilever").code, 0);
  for (const char* setting : {"bodies.bar.frame=karcher", "bodies.bar.frame={node: base}",
                              "bodies.bar.frame={node: tip}", "bodies.bar.second_order=off", "bodies.bar.modes=4"}) {
    run("stress_cantilever", {setting});
    const std::string text = recover("stress_cantilever");
    EXPECT_NEAR(reported(text, "largest stress of beams"), 105e6, 0.002 * 105e6) << setting;
    EXPECT_THAT(text, AllOf(HasSubstr("stress omitted by modes"), Not(HasSubstr("note")))) << setting;
    // The place is the middle of an element on the x axis of the part; all twenty bear the same moment.
    EXPECT_THAT(text, ::testing::ContainsRegex(
                          "largest stress of beams +[0-9.e+]+ Pa at 0 s at beam [0-9]+ of 'axis' \\([0-9.]+, 0, 0\\)"))
        << setting;
  }
}

// M(x) = M cos(k(L - x)) / cos(kL), k² = P/EI [Timoshenko and Gere, Theory of elastic stability, 1.12]: P/A + M(0)/W.
TEST_F(RecoveredStress, OfACompressedColumnGrowsWithItsDeflection) {
  ASSERT_EQ(reduce("stress_cantilever").code, 0);
  const double EI = 2.1e11 * 1e-8 / 12.0, P = 215.8977, k = std::sqrt(P / EI);
  const double exact = P / 1e-4 + 5.0 / std::cos(k) / (1e-6 / 6.0);
  EXPECT_NEAR(k, std::numbers::pi / 2.0 * std::sqrt(0.5), 1e-5);
  for (const char* setting : {"bodies.bar.frame=karcher", "bodies.bar.frame={node: base}"})
    EXPECT_NEAR(beam_stress("stress_cantilever", "stress_column", {setting}), exact, 0.005 * exact) << setting;
}

// 6 P (L - x)/(b t²), membrane stress about nothing: as the linear run has it, also at the free tip.
TEST_F(RecoveredStress, OfABentStripOfShellsIsThatOfTheLinearRun) {
  ASSERT_EQ(reduce("stress_strip").code, 0);
  const auto stress = [&](const std::string& second_order) {
    run("stress_strip", {"bodies.c.second_order=" + second_order});
    return reported(recover("stress_strip"), "largest von Mises of shells");
  };
  const double linear = stress("off");
  EXPECT_NEAR(linear, 145.8e6, 0.005 * 145.8e6);
  EXPECT_NEAR(stress("on"), linear, 0.01 * linear);
}

// N/A = ρ Ω² L²/2 = 39.0 MPa at the hub, less the share of the first node: 1 - h²/(3 L²) of 20 elements.
TEST_F(RecoveredStress, OfASpinningBarDoesNotDependOnItsModes) {
  const double exact = 39.0e6 * (1.0 - 0.05 * 0.05 / 3.0);
  for (const std::vector<std::string>& basis :
       {std::vector<std::string>{}, {"--set", "modes=20"}, {"--set", "moments=6"}, {"--set", "moments=12"}}) {
    ASSERT_EQ(reduce("spinning_bar", basis).code, 0);
    for (const char* setting :
         {"bodies.c.modes=3", "bodies.c.mirror=yz", "bodies.c.frame={node: b}", "bodies.c.frame=karcher"})
      EXPECT_NEAR(beam_stress("spinning_bar", "spinning_bar", {setting}), exact, 0.002 * exact) << setting;
  }
}

// A clamped plate under pressure. Timoshenko and Woinowsky-Krieger, Theory of plates and shells, 1959, table 35:
// deflection 0.00126 q a⁴/D; 24 x 24 shells bend 0.9 % more. The stress is that of `reducer solve`, with moment
// vectors, without, and without modes.
TEST_F(RecoveredStress, OfAPlateUnderPressureIsThatOfStatics) {
  for (const std::vector<std::string>& basis :
       {std::vector<std::string>{}, {"--set", "moments=0"}, {"--set", "moments=0", "--set", "modes=0"}}) {
    ASSERT_EQ(reduce("pressed_plate", basis).code, 0);
    const Outcome solved = call({program("reducer"), "solve", "pressed_plate.part.yaml"}, where);
    ASSERT_EQ(solved.code, 0) << solved.error;
    const double largest = reported(solved.out, "von Mises, shells  largest");
    for (const char* setting : {"bodies.p.second_order=on", "bodies.p.second_order=off", "bodies.p.mirror=xy"}) {
      if (basis.size() > 2 && std::string(setting) == "bodies.p.second_order=on") continue;  // nothing deforms
      run("pressed_plate", {setting});
      const std::string text = recover("pressed_plate");
      EXPECT_NEAR(reported(text, "largest von Mises of shells"), largest, 1e-5 * largest) << setting << basis.size();
      EXPECT_THAT(text, AllOf(HasSubstr("inertia, weight and load cases"), Not(HasSubstr("note")))) << setting;
      EXPECT_NEAR(reported(text, "largest displacement"), 1.310e-4, 0.015 * 1.310e-4) << setting;  // 0.00126 q a⁴/D
    }
  }
}

// A flat plate that a spider holds has modes that only bend; a cylinder of R/t = 1e4 has stresses a million times those
// that bend it. Both had refused the companion file that the program itself had made.
TEST_F(RecoveredStress, ThinPartsReduceWithTheirCompanion) {
  for (const char* part : {"thin_plate_companion", "thin_cylinder_companion"}) {
    const Outcome outcome = reduce(part);
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    EXPECT_TRUE(fs::exists(folder.file(std::string(part) + ".companion.h5"))) << part;
  }
}

// Nodes on a line turn about it without stress: a diagonal of round-off, by which rows had entries up to 1e67.
TEST_F(RecoveredStress, TrappedStressOfAHingedSheetIsNoRoundOff) {
  fs::copy_file(TISSERAND_SOURCE_DIR "/meshes/square.step", folder.file("square.step"));
  for (const char* size : {"mesh.size=50", "mesh.size=40", "mesh.size=25"}) {
    const Outcome outcome = reduce(
        "double_curvature", {"--set", "double_curvature=20", "--set", size, "-o", "double_curvature.superelement.h5"});
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    run("double_curvature", {"analyses.open.type=statics"});
  }
}

// Files of versions 1.0 and 1.9 (tests/compatibility): the stress of before, 192.6 MPa, and what it lacks.
TEST_F(RecoveredStress, FilesOfBeforeAreReadWithNotes) {
  const std::string before = TISSERAND_SOURCE_DIR "/tests/compatibility/";
  const Outcome outcome = call({program("reducer"), "recover", before + "bar_1.0.recovery.h5",
                                before + "bar_1.9.results.h5", "-o", "out", "--frame", "part"},
                               where);
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_NEAR(reported(outcome.out, "largest stress of beams"), 192.604e6, 1e3);
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("written before version 1.10"), HasSubstr("no static answers to inertia loads")));
}

/// Peak memory of a program in MB.
double peak_memory(const std::vector<std::string>& words, const Surroundings& where) {
  const pid_t child = start(words, where);
  int status = 0;
  struct rusage usage {};
  ::wait4(child, &status, 0, &usage);
  EXPECT_EQ(status, 0) << read_text(where.folder + "/.err");
  return 1e-3 * static_cast<double>(usage.ru_maxrss);
}

// 300 instants are more than the program holds at once. Of 9000 more it keeps the time and the row, 24 bytes each: less
// than what the allocator differs by.
TEST_F(RecoveredStress, MemoryOfAnEnvelopeDoesNotGrowWithTheRun) {
  ASSERT_EQ(reduce("spinning_bar").code, 0);
  write_text(folder.file("turning.scene.yaml"), R"yaml(scene: turning bar
bodies: {c: {type: superelement, file: spinning_bar.superelement.h5}}
joints: {hub: {type: revolute, a: ground, b: c/a, axis: [0, 0, 1]}}
loads: {push: {type: force, at: c/b, value: [0, 10, 0]}}
integrator: {step: 0.001, end: 9.3}
)yaml");
  std::vector<double> peaks;
  for (const char* end : {"integrator.end=0.3", "integrator.end=9.3"}) {
    const Outcome outcome =
        call({program("mechanism"), "run", "turning.scene.yaml", "-o", "run.results.h5", "--set", end}, where);
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    peaks.push_back(peak_memory({program("reducer"), "recover", "spinning_bar.recovery.h5", "run.results.h5", "-o",
                                 "out", "--envelope", "--point", "b", "--element", "1", "--group", "x"},
                                where));
  }
  EXPECT_LT(peaks[1], peaks[0] + 3.0);
  EXPECT_FALSE(fs::exists(folder.file("out/c.pvd")));
  for (const char* ending : {"_envelope.csv", "_envelope.vtu", "_points.csv", "_elements.csv", "_groups.csv"})
    EXPECT_TRUE(fs::exists(folder.file(std::string("out/c") + ending))) << ending;
}

// Without space on the disk (here: files of 256 bytes at most) there is an error, and no file that is cut short.
TEST_F(RecoveredStress, FullDisksLeaveNoPartOfAFile) {
  const std::string before = TISSERAND_SOURCE_DIR "/tests/compatibility/";
  Surroundings full = where;
  full.file_size = 256;
  for (const bool series : {true, false}) {
    std::vector<std::string> words{program("reducer"),
                                   "recover",
                                   before + "bar_1.0.recovery.h5",
                                   before + "bar_1.9.results.h5",
                                   "-o",
                                   "out",
                                   "--frame",
                                   "part",
                                   "--group",
                                   "axis"};
    if (!series) words.emplace_back("--envelope");
    const Outcome outcome = call(words, full);
    EXPECT_EQ(outcome.code, 1) << outcome.out;
    EXPECT_THAT(outcome.error, HasSubstr("out/"));
    for (const auto& entry : fs::directory_iterator(folder.file("out"))) ADD_FAILURE() << entry.path();
  }
}

// A failure leaves the superelement of before, which refuses the companion of the new one.
TEST_F(RecoveredStress, FilesOfAReductionTakeTheirNamesTogether) {
  ASSERT_EQ(reduce("stress_cantilever").code, 0);
  const auto superelement = read_text(folder.file("stress_cantilever.superelement.h5"));
  const auto companion = read_text(folder.file("stress_cantilever.companion.h5"));
  fs::remove(folder.file("stress_cantilever.superelement.certificate.json"));
  fs::create_directory(folder.file("stress_cantilever.superelement.certificate.json"));
  const Outcome outcome = reduce("stress_cantilever", {"--set", "modes=4"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(read_text(folder.file("stress_cantilever.superelement.h5")), superelement);
  for (const auto& entry : fs::directory_iterator(folder.path()))
    EXPECT_THAT(entry.path().string(), Not(HasSubstr(".tmp-")));
  if (read_text(folder.file("stress_cantilever.companion.h5")) == companion) return;
  take("stress_cantilever.scene.yaml");
  expect_error(call({program("mechanism"), "run", "stress_cantilever.scene.yaml"}, where),
               {"belongs to the superelement"});
}

}  // namespace
}  // namespace tisserand::cli::recovered_stress_test
