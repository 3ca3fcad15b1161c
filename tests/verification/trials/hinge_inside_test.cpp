// SPDX-License-Identifier: GPL-3.0-or-later
// A hinge inside a part, kept by `mechanism: allow`, through both programs.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "tests/support/scenes/trial.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::mechanism::hinge_inside_test {
namespace {

using test_support::Trial;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

// flap.part.yaml: steel bars 0.05 x 0.05 m, an arm of 0.5 m and a flap of 1 m.
constexpr double g = 9.81, arm = 7800.0 * 0.0025 * 0.5, flap = 7800.0 * 0.0025 * 1.0;
constexpr double inertia =
    flap / 3.0 + 7800.0 * 0.05 * 0.05 * 0.05 * 0.05 / 12.0;  ///< about the hinge, rotary part included
constexpr double angular = flap * g * 0.5 / inertia;         ///< of the flap when it is let go

class HingeInside : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(TISSERAND_BINARY_DIR "/bin/reducer")) GTEST_SKIP() << "built without the reducer";
    const std::string part = TISSERAND_SOURCE_DIR "/tests/verification/references/trials/flap.part.yaml";
    const std::string command =
        TISSERAND_BINARY_DIR "/bin/reducer run " + part + " -o " + file_ + " > " + folder_.file("log") + " 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }

  test_support::TemporaryFolder folder_;
  std::string file_ = folder_.file("flap.superelement.h5");
};

// The flap falls about its hinge while the arm is held: its weight times half its length over its inertia gives the
// angular acceleration, and the base bears the arm and what the flap's mass does not fall with (a quarter of its weight
// for a thin rod). Internal damping lets the elastic vibrations of the release die; that of the hinge is 0.
TEST_F(HingeInside, TheFlapFallsAndTheBaseBearsAQuarter) {
  for (const std::string method : {"generalised_alpha", "radau"}) {
    const Trial trial("flap", {"bodies.b.file=" + file_, "bodies.b.damping={ratio_internal: 0.5}",
                               "integrator={end: 0.15, step: 5e-4, method: " + method + "}"});
    EXPECT_NEAR(trial.last("joints/force/j/z"), arm * g + flap * (g - 0.5 * angular), 1e-4 * flap * g) << method;
    // Of unit modal mass: √I times the angle.
    EXPECT_NEAR(std::abs(trial.last("superelements/y/b/6")), std::sqrt(inertia) * 0.5 * angular * 0.15 * 0.15, 1e-3)
        << method;
  }
}

// In its plane the same; the part lies in the x-y plane then.
TEST_F(HingeInside, InThePlaneItIsTheSame) {
  const std::vector<std::string> turned{"bodies.b.file=" + file_, "gravity=[0, 9.81, 0]",
                                        "bodies.b.pose={orientation: {axis: [1, 0, 0], angle_deg: 90}}"};
  std::vector<std::string> planar = turned;
  planar.push_back("effects={planar: on}");
  const double force = Trial("flap", turned).last("joints/force/j/y");
  EXPECT_NEAR(Trial("flap", planar).last("joints/force/j/y"), force, 1e-9 * std::abs(force));
}

// Beyond small turns the run says so; before it does not.
TEST_F(HingeInside, LargeTurnsAreReported) {
  const Trial shortly("flap", {"bodies.b.file=" + file_, "integrator.end=0.1"});
  EXPECT_THAT(shortly.report().doubts, Not(Contains(HasSubstr("a mechanism inside"))));
  const Trial longer("flap", {"bodies.b.file=" + file_, "integrator.end=0.3"});
  EXPECT_THAT(longer.report().doubts, Contains(HasSubstr("a mechanism inside 'b' turns by about")));
}

// Nothing holds the flap in statics; a body without its modes keeps the hinge; modes have it at 0.
TEST_F(HingeInside, StaticsModesAndCuts) {
  EXPECT_THAT(test_support::error_of([&] {
                Trial("flap", {"bodies.b.file=" + file_, "analysis=statics"});
              }),
              HasSubstr("nothing holds b, internal mode 1"));
  const Trial modes("flap", {"bodies.b.file=" + file_, "analysis=modes", "gravity=[0, 0, 0]"});
  EXPECT_LT(modes.frequencies()[0], 1e-3);
  EXPECT_GT(modes.frequencies()[1], 18.0);
  const Trial rigid("flap", {"bodies.b.file=" + file_, "bodies.b.modes=0", "integrator={end: 0.05, step: 5e-4}"});
  EXPECT_NEAR(std::abs(rigid.last("superelements/y/b/6")), std::sqrt(inertia) * 0.5 * angular * 0.05 * 0.05, 2e-3);
  EXPECT_THAT(test_support::error_of([&] {
                Trial("flap", {"bodies.b.file=" + file_, "effects={flexibility: auto}"});
              }),
              HasSubstr("has a mechanism inside"));
}

}  // namespace
}  // namespace tisserand::mechanism::hinge_inside_test
