// SPDX-License-Identifier: GPL-3.0-or-later
// Files of former and present versions (tests/compatibility) are read by every program that reads their kind, with a
// note of what they lack.
#include <filesystem>
#include <numbers>

#include "tests/cli/scenes.hpp"

namespace tisserand::cli::compatibility_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

class Compatibility : public ::testing::Test {
 protected:
  void SetUp() override { where.folder = folder.path().string(); }

  /// Copies a file of the folder under another name.
  void take(const std::string& name, const std::string& as = "") const {
    fs::copy_file(fs::path(TISSERAND_SOURCE_DIR "/tests/compatibility") / name, folder.file(as.empty() ? name : as),
                  fs::copy_options::overwrite_existing);
  }

  test_support::TemporaryFolder folder;
  Surroundings where;
};

// A disc at the end of a shaft that turns: all of its inertia about the shaft is rotary.
TEST_F(Compatibility, CompanionFilesOfAllVersions) {
  take("disc.superelement.h5");
  take("disc.scene.yaml");
  const auto run = [&](const std::string& version) {
    take("disc_" + version + ".companion.h5", "disc.companion.h5");
    const Outcome outcome = call({program("mechanism"), "run", "disc.scene.yaml"}, where);
    EXPECT_EQ(outcome.code, 0) << version << outcome.error;
    return outcome.out + outcome.error;
  };
  for (const std::string version : {"1.0", "1.1"})
    EXPECT_THAT(run(version),
                AllOf(HasSubstr("its companion file has version " + version),
                      HasSubstr("second-order terms of rotary inertia"), HasSubstr("Reduce the part again")));
  EXPECT_THAT(run("1.2"), Not(HasSubstr("companion file has version")));
  // The trial `stress_cantilever` without its companion file: one note.
  fs::remove(folder.file("disc.companion.h5"));
  const Outcome bare = call({program("mechanism"), "run", "disc.scene.yaml"}, where);
  EXPECT_EQ(bare.code, 0) << bare.error;
  const std::string note = "there is no companion file, so the body is linear";
  ASSERT_THAT(bare.out, HasSubstr(note));
  EXPECT_EQ(bare.out.find(note), bare.out.rfind(note));
}

// Stress of a cantilever of radius r at its clamp: 4 F L/(π r³) = 63.66 MPa. Recovery files before version 1.3 lack the
// displacement of second order.
TEST_F(Compatibility, RecoveryAndResultsOfThePresent) {
  if (!fs::exists(program("reducer"))) GTEST_SKIP() << "built without the reducer";
  take("disc_1.1.recovery.h5");
  take("disc_1.10.results.h5");
  take("disc_1.2.recovery.h5");
  Outcome outcome =
      call({program("reducer"), "recover", "disc_1.1.recovery.h5", "disc_1.10.results.h5", "-o", "out"}, where);
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  const std::string note = "has no second-order displacement, because it was written before version 1.3";
  EXPECT_THAT(outcome.out, HasSubstr(note));
  outcome = call({program("reducer"), "recover", "disc_1.2.recovery.h5", "disc_1.10.results.h5", "-o", "out"}, where);
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr(note));
  const std::string label = "largest stress of beams";
  const std::size_t at = outcome.out.find(label);
  ASSERT_NE(at, std::string::npos) << outcome.out;
  const double stress = 4.0 * 100.0 * 0.5 / (std::numbers::pi * 1e-6);
  EXPECT_NEAR(std::stod(outcome.out.substr(at + label.size())), stress, 1e-4 * stress);
  EXPECT_THAT(outcome.out, Not(HasSubstr("results were written before")));
  EXPECT_EQ(call({program("mechanism"), "channels", "disc_1.10.results.h5"}, where).code, 0);
}

TEST_F(Compatibility, ModalBodies) {
  take("disc.modal.h5");
  take("disc_modal.scene.yaml");
  const Outcome outcome = call({program("mechanism"), "run", "disc_modal.scene.yaml"}, where);
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr("1 modal body"));
}

TEST_F(Compatibility, CertificatesOfBefore) {
  if (!fs::exists(program("reducer"))) GTEST_SKIP() << "built without the reducer";
  take("disc.superelement.h5");
  take("disc.superelement.certificate.json");
  const Outcome outcome = call({program("reducer"), "show", "disc.superelement.h5"}, where);
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("error of the mesh  +0.0121 %, +0.0121 %"), HasSubstr("content id")));
}

}  // namespace
}  // namespace tisserand::cli::compatibility_test
