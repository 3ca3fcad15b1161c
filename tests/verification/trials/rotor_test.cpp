// SPDX-License-Identifier: GPL-3.0-or-later
// Modes of rotors in axes at rest and in axes that turn with them. Frequencies of the beams are those of an independent
// finite element rotor, which they meet to 3e-5: second forward whirl 137.35, 150.82, 160.26 Hz at 300, 600, 1000
// rad/s.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scenes/trial.hpp"

namespace tisserand::mechanism::rotor_test {
namespace {

using test_support::Trial;
using ::testing::HasSubstr;
using ::testing::Not;

/// The rotor of 24 beams with the given changes of its section, as the scene gives them.
std::vector<double> beams(const std::vector<std::string>& settings) {
  return Trial("rotor_beams", settings).frequencies();
}

class Rotor : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(TISSERAND_BINARY_DIR "/bin/reducer"))
      GTEST_SKIP() << "built without the reducer, which makes the superelement";
    reduce("");
  }
  /// The rotor's part with a setting more.
  void reduce(const std::string& setting) {
    const std::string command =
        fmt::format(TISSERAND_BINARY_DIR "/bin/reducer run " TISSERAND_SOURCE_DIR
                                         "/tests/verification/references/trials/rotor.part.yaml {} -o {} > {} 2>&1",
                    setting, folder.file("rotor.superelement.h5"), folder.file("log"));
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }
  Trial superelement(double spin, double axes, std::vector<std::string> settings = {}) const {
    settings.push_back("bodies.sh.file=" + folder.file("rotor.superelement.h5"));
    settings.push_back(fmt::format("bodies.sh.angular_velocity=[{}, 0, 0]", spin));
    settings.push_back(fmt::format("bodies.disc.angular_velocity=[{}, 0, 0]", spin));
    settings.push_back(fmt::format("modes.rotation=[{}, 0, 0]", axes));
    return Trial("rotor_modes", settings);
  }
  test_support::TemporaryFolder folder;
};

// Twelve internal modes leave 0.2 % of the whirls below 200 Hz (more modes, less).
TEST_F(Rotor, SuperelementInAxesAtRestIsTheBeams) {
  for (const auto& [spin, whirl] : {std::pair{300.0, 137.35}, {600.0, 150.82}, {1000.0, 160.26}}) {
    const Trial trial = superelement(spin, 0.0);
    const std::vector<double> f = trial.frequencies(), right = beams({fmt::format("parameters.W={}", spin)});
    EXPECT_NEAR(right.at(4), whirl, 2e-4 * whirl) << spin;
    for (std::size_t k = 1; k < 6; ++k) EXPECT_NEAR(f.at(k), right.at(k), 2e-3 * right.at(k)) << spin << " mode " << k;
    EXPECT_THAT(trial.report().doubts, ::testing::IsEmpty());
    EXPECT_THAT(trial.report().notes, ::testing::Each(Not(HasSubstr("grow"))));
  }
}

// The same whirls seen from axes that turn: |f ± Ω/2π|.
TEST_F(Rotor, TurningAxesShiftTheFrequencies) {
  const double spin = 1000.0, turns = spin / (2.0 * std::numbers::pi);
  const std::vector<double> rest = superelement(spin, 0.0).frequencies(),
                            turning = superelement(spin, spin).frequencies();
  for (std::size_t k = 1; k < 6; ++k)
    EXPECT_THAT(turning,
                ::testing::Contains(::testing::AnyOf(::testing::DoubleNear(std::abs(rest.at(k) - turns), 1e-6 * turns),
                                                     ::testing::DoubleNear(rest.at(k) + turns, 1e-6 * turns))))
        << rest.at(k);
}

// An undamped round rotor is neutrally stable: no mode grows, up to the highest.
TEST_F(Rotor, NothingGrowsInTurningAxes) {
  const Trial trial("rotor_beams", {"parameters.R=1000", "modes.count=400"});
  EXPECT_THAT(trial.report().notes, ::testing::Each(Not(HasSubstr("grow"))));
  EXPECT_THAT(trial.report().doubts, ::testing::IsEmpty());
}

// A spin that turns nothing before the lowest mode has swung is none: a drive that begins at rest leaves 1e-9 rad/s.
TEST_F(Rotor, RoundOffDoesNotSpin) {
  const Trial trial = superelement(1e-7, 0.0, {"bushings.bl.stiffness=[0, 5e6, 1e6, 0, 0, 0]"});
  EXPECT_THAT(trial.report().doubts, ::testing::IsEmpty());
  EXPECT_THAT(trial.report().table.front(), Not(HasSubstr("turning axes")));
}

// Bearings that are softer to one side leave axes at rest as the only ones with constant coefficients; a shaft that is
// softer to one side, those that turn with it. The other axes are told as doubts.
TEST_F(Rotor, UnevenBearingsOrShaft) {
  const std::string soft = "[0, 5e6, 1e6, 0, 0, 0]";
  const std::vector<std::string> bearings{"bushings.bl.stiffness=" + soft, "bushings.br.stiffness=" + soft};
  const std::vector<double> f = superelement(1000.0, 0.0, bearings).frequencies(), right = beams(bearings);
  for (std::size_t k = 1; k < 8; ++k) EXPECT_NEAR(f.at(k), right.at(k), 2e-3 * right.at(k)) << k;
  EXPECT_THAT(superelement(1000.0, 0.0, bearings).report().doubts, ::testing::IsEmpty());
  EXPECT_THAT(superelement(1000.0, 1000.0, bearings).report().doubts,
              ::testing::ElementsAre(HasSubstr("use axes at rest")));
  reduce("--set sections.s.Iz=0.8e-7");
  EXPECT_THAT(superelement(1000.0, 0.0).report().doubts,
              ::testing::ElementsAre(HasSubstr("`modes: {rotation: [1000, 0, 0]}`")));
  EXPECT_THAT(superelement(1000.0, 1000.0).report().doubts, ::testing::IsEmpty());
}

// A bar that a drive turns at 100 rad/s: from a rest its modes are of no steady state, which the remedy is. 18.07 Hz is
// what the trials had with it.
TEST(DrivenBar, ModesNameTheRemedy) {
  if (!std::filesystem::exists(TISSERAND_BINARY_DIR "/bin/reducer"))
    GTEST_SKIP() << "built without the reducer, which makes the superelement";
  const test_support::TemporaryFolder folder;
  const std::string file = folder.file("spinning_bar.superelement.h5");
  const std::string command = fmt::format(
      TISSERAND_BINARY_DIR "/bin/reducer run " TISSERAND_SOURCE_DIR
                           "/tests/verification/references/trials/spinning_bar.part.yaml -o {} > {} 2>&1",
      file, folder.file("log"));
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  const Trial frozen("modes_of_driven", {"bodies.c.file=" + file});
  EXPECT_THAT(frozen.report("tones").doubts, ::testing::Contains(HasSubstr("`modes: {rotation: [0, 0, 100]}`")));
  const Trial turning("modes_of_driven", {"bodies.c.file=" + file,
                                          "analyses.rest.statics={rotation: {angular_velocity: [0, 0, 100]}}"});
  EXPECT_NEAR(turning.frequencies("tones").front(), 18.07, 5e-3);
  EXPECT_THAT(turning.report("tones").doubts, ::testing::IsEmpty());
}

}  // namespace
}  // namespace tisserand::mechanism::rotor_test
