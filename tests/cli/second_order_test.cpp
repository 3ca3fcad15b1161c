// SPDX-License-Identifier: GPL-3.0-or-later
// One superelement with a companion file, end to end: reduced, run, ended beyond its range, restarted.
#include "formats/results/results.hpp"
#include "tests/cli/scenes.hpp"

namespace tisserand::cli::second_order_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A strip of length 1 and EI = 8.33 that a moment bends to a circle: its ends turn by M L/(2 EI) against the mean
/// frame.
constexpr const char* strip_part = R"yaml(part: strip
materials: {any: {E: 1e9, nu: 0.3, density: 1000}}
sections: {strip: {shape: rectangle, width: 0.1, height: 0.01}}
points: {base: [0, 0, 0], tip: [1, 0, 0]}
beams: {strip: {from: base, to: tip, section: strip, material: any, elements: 8}}
boundary: [base, tip]
modes: 4
)yaml";

constexpr const char* strip_scene = R"yaml(scene: strip
bodies:
  strip: {type: superelement, file: strip.superelement.h5, damping: {mass: 20}}
joints:
  clamp: {type: fixed, a: ground, b: strip/base}
loads:
  bend: {type: moment, at: strip/tip, value: [0, "2 * 8.33333 * t", 0]}
integrator: {step: 0.005, end: 0.2}
)yaml";

class SecondOrder : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(program("reducer"))) GTEST_SKIP() << "built without the reducer";
    where.folder = folder.path().string();
    write_text(folder.file("strip.part.yaml"), strip_part);
    write_text(folder.file("strip.scene.yaml"), strip_scene);
    ASSERT_EQ(call({program("reducer"), "run", "strip.part.yaml"}, where).code, 0);
    ASSERT_TRUE(std::filesystem::exists(folder.file("strip.companion.h5")));
  }

  Outcome run_to(const std::string& end, std::vector<std::string> more = {}) const {
    std::vector<std::string> words = {program("mechanism"), "run",   "strip.scene.yaml",     "-o",
                                      "strip.results.h5",   "--set", "integrator.end=" + end};
    words.insert(words.end(), more.begin(), more.end());
    return call(words, where);
  }

  test_support::TemporaryFolder folder;
  Surroundings where;
};

// The ends turn by M L/(2 EI) = t/s, as many radians as seconds; their vibration about that is below 0.05 (damped).
TEST_F(SecondOrder, TurnsAreNotedDoubtedAndEndTheRunWithTheRowsUntilThen) {
  const std::string turned = "relative to the floating frame of its body";
  const Outcome small = run_to("0.15");
  EXPECT_EQ(small.code, 0) << small.error;
  EXPECT_THAT(small.out,
              AllOf(HasSubstr("inertia F, stiffening full, from the companion file"), Not(HasSubstr(turned))));

  const Outcome noted = run_to("0.4");
  EXPECT_EQ(noted.code, 0) << noted.error;
  EXPECT_THAT(noted.out, ::testing::ContainsRegex("note +'strip/[a-z]+' turned by up to 0\\.[34]"));
  EXPECT_THAT(noted.out, Not(HasSubstr("warning")));

  const Outcome doubted = run_to("0.56");
  EXPECT_EQ(doubted.code, 0) << doubted.error;
  EXPECT_THAT(doubted.out, ::testing::ContainsRegex("warning +'strip/[a-z]+' turned by up to 0\\.[56]"));

  const Outcome ended = run_to("2");
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.error, AllOf(HasSubstr(turned), HasSubstr("whose stiffening is valid below 0.7 rad"),
                                 HasSubstr("cut the part into several superelements")));
  const formats::ResultsReader results(folder.file("strip.results.h5"));
  EXPECT_FALSE(results.completed());
  EXPECT_GT(results.rows(), 0.56 / 0.005);  // the runs before came further than that
  EXPECT_LT(results.rows(), 2 / 0.005);

  const Outcome linear = run_to("0.8", {"--set", "bodies.strip.second_order=off"});
  EXPECT_EQ(linear.code, 0) << linear.error;
  EXPECT_THAT(linear.out, HasSubstr("whose strain is linear in this angle: cut the part into several superelements"));
}

TEST_F(SecondOrder, ARestartNeedsTheCompanionOfItsCheckpoint) {
  ASSERT_EQ(run_to("0.1", {"--set", "checkpoint.every=10"}).code, 0);
  const std::vector<std::string> restart = {program("mechanism"),  "run", "strip.scene.yaml", "--restart",
                                            "strip.checkpoint.h5", "-o",  "rest.results.h5"};
  const Outcome rest = call(restart, where);
  ASSERT_EQ(rest.code, 0) << rest.error;
  std::filesystem::rename(folder.file("strip.companion.h5"), folder.file("elsewhere.h5"));
  expect_error(call(restart, where),
               {"strip.checkpoint.h5", "whose bodies, joints, superelements or companion files differ"});
  expect_error(run_to("0.2", {"--set", "bodies.strip.second_order=on"}), {"companion", "second_order: yes"});
}

}  // namespace
}  // namespace tisserand::cli::second_order_test
