// SPDX-License-Identifier: GPL-3.0-or-later
// Effects of a scene from the command line: what runs tell of switches, and `mechanism ledger`.
#include <regex>

#include "tests/cli/scenes.hpp"

namespace tisserand::cli::effects_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Effects : public Folder {};

TEST_F(Effects, AreReportedByCheckAndInTheReportOfARun) {
  EXPECT_THAT(with("check", {}).out, HasSubstr("effects          flexibility, rotary_inertia, gyroscopic, gravity\n"));
  const Outcome bare = with("run", {"effects.rod.gravity=off", "effects.rod.rotary_inertia=off"});
  ASSERT_EQ(bare.code, 0) << bare.error;
  EXPECT_THAT(bare.out, HasSubstr("flexibility, gyroscopic, gravity; off: rotary_inertia, gravity of 'rod'"));
}

// A superelement that nothing holds falls by ½ g t², also as a rigid body; its own channels are gone then.
TEST_F(Effects, ARigidSuperelementHasNoDeformationInTheResults) {
  const Outcome run = with("run", {"effects.se.flexibility=off", "integrator.end=0.05"});
  ASSERT_EQ(run.code, 0) << run.error;
  const Outcome channels = mechanism({"channels", "arm.results.h5"});
  EXPECT_THAT(channels.out, AllOf(HasSubstr("nodes/position/se/tip"), Not(HasSubstr("superelements/y"))));
}

TEST_F(Effects, ALedgerSizesThemLineByLine) {
  const Outcome reported = mechanism({"ledger", "arm.scene.yaml", "--windows", "2", "--share", "1", "--repeats", "1"});
  ASSERT_EQ(reported.code, 0) << reported.error;
  EXPECT_THAT(reported.out, HasSubstr("arm.scene.yaml: arm: 2 windows of 0.05 s; "));
  for (const char* subject : {"flexibility of 'se'", "rotary_inertia of 'rod'", "gyroscopic of 'block'",
                              "gravity of 'rod'", "gravity of 'block'", "gravity of 'se'"})
    EXPECT_TRUE(std::regex_search(
        reported.out,
        std::regex(std::string("  ") + subject +
                   ": on; off would change .* by .* %( in the whole run)?, (cost|save) [0-9]+ % per step")))
        << subject << "\n"
        << reported.out;
  EXPECT_THAT(reported.out, HasSubstr("inertia of 'se': B; A would change"));
  EXPECT_THAT(names(), Not(::testing::Contains(HasSubstr("results"))));  // nothing is stored
}

TEST_F(Effects, ALedgerTakesChosenOnesAndStoredStates) {
  ASSERT_EQ(with("run", {}).code, 0);
  const Outcome json = mechanism({"ledger", "arm.scene.yaml", "--results", "arm.results.h5", "--effect", "gravity",
                                  "--of", "rod", "-c", "nodes/position/rod/end/z", "--json"});
  ASSERT_EQ(json.code, 0) << json.error;
  EXPECT_THAT(json.out, AllOf(HasSubstr("\"of\": \"nodes/position/rod/end/z\""), HasSubstr("\"of\": \"rod\""),
                              Not(HasSubstr("\"of\": \"block\"")), HasSubstr("\"windows\": 5")));
}

TEST_F(Effects, ALedgerSaysWhatIsWrong) {
  const auto reported = [this](std::vector<std::string> words) {
    words.insert(words.begin(), {"ledger", "arm.scene.yaml"});
    return mechanism(words);
  };
  EXPECT_EQ(reported({"--share", "2"}).code, 2);
  EXPECT_EQ(reported({"--windows", "0"}).code, 2);
  expect_error(reported({"--effect", "gravty"}), {"no effect 'gravty'", "did you mean 'gravity'?"});
  expect_error(reported({"--of", "blok"}), {"no body, joint or spring 'blok'", "did you mean 'block'?"});
  expect_error(reported({"-c", "nodes/position/rod/nd/z"}), {"there is no channel 'nodes/position/rod/nd/z'"});
  expect_error(reported({"--results", "none.results.h5"}), {"none.results.h5"});
  expect_error(reported({"--set", "analysis=statics"}), {"a dynamics analysis"});
  expect_error(reported({"--set", "integrator.max_iterations=1", "--set", "integrator.max_halvings=1"}),
               {"the reference run of the ledger ended early"});
}

}  // namespace
}  // namespace tisserand::cli::effects_test
