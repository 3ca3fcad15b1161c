// SPDX-License-Identifier: GPL-3.0-or-later
// `analyses` of scenes: settings of their own and shared ones, what they start from, errors.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/scene/scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::formats::analyses_test {
namespace {

using ::testing::HasSubstr;

constexpr const char* head = R"(scene: arm
bodies: {arm: {type: rigid, mass: 1, inertia: [1, 1, 1]}}
joints: {hinge: {type: revolute, a: ground, b: arm, axis: [0, 1, 0]}}
)";

Scene read(const std::string& text) {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.file("a.scene.yaml")) << head << text;
  return read_scene(folder.file("a.scene.yaml"), {});
}

std::string error_of(const std::string& text) {
  try {
    static_cast<void>(read(text));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Analyses, TakeSharedSettingsUnlessTheyHaveTheirOwn) {
  const Scene scene = read(R"(
integrator: {step: 0.01, end: 2, rho: 0.8}
output: {every: 10}
analyses:
  rest: {type: statics, statics: {rotation: {angular_velocity: [0, 0, 3]}}}
  shake: {type: dynamics, from: rest, integrator: {end: 5}, output: {interval: 0.5}}
  after: {type: dynamics, from: shake, integrator: {end: 7}, checkpoint: {every: 100}}
  tones: {type: modes, from: rest, modes: {count: 4}}
)");
  ASSERT_EQ(scene.analyses.size(), 4u);
  const Analysis& shake = scene.analyses[1];
  EXPECT_EQ(shake.kind, AnalysisKind::dynamics);
  EXPECT_EQ(shake.from, "rest");
  EXPECT_EQ(shake.integrator.step, 0.01);
  EXPECT_EQ(shake.integrator.rho, 0.8);
  EXPECT_EQ(shake.integrator.end, 5.0);
  EXPECT_EQ(shake.integrator.start, 0.0);
  EXPECT_EQ(shake.output.interval, 0.5);
  EXPECT_EQ(scene.analyses[2].integrator.start, 5.0);  // where `shake` ends
  EXPECT_EQ(scene.analyses[2].output.every, 10);
  EXPECT_EQ(scene.analyses[2].checkpoint.every, 100);
  EXPECT_EQ(scene.analyses[3].modes.count, 4);
  EXPECT_EQ(scene.analyses[3].modes.rotation, Eigen::Vector3d(0, 0, 3));  // that of `rest`
  const Scene one = scene_of(scene, shake);
  EXPECT_EQ(one.integrator.end, 5.0);
  EXPECT_TRUE(one.analyses.empty());
}

TEST(Analyses, EveryErrorNamesItsAnalysis) {
  EXPECT_THAT(error_of("analyses: {a: {type: dynamics}}"), HasSubstr("analysis 'a': missing key 'integrator'"));
  EXPECT_THAT(error_of("analyses: {a: {type: statik}}"), HasSubstr("statics"));
  EXPECT_THAT(error_of("analyses: {a: {type: statics, from: b}, b: {type: statics}}"),
              HasSubstr("there is no analysis 'b' before this one"));
  EXPECT_THAT(error_of("analyses: {rest: {type: statics}, b: {type: modes, from: res}}"),
              HasSubstr("did you mean 'rest'?"));
  EXPECT_THAT(error_of("analyses: {a: {type: modes, modes: {count: 0}}}"), HasSubstr("count 0 must be 1 or more"));
  EXPECT_THAT(
      error_of("analyses: {a: {type: dynamics, integrator: {step: 1, end: 2}, checkpoint: {every: 1, interval: 2}}}"),
      HasSubstr("both 'every' and 'interval'"));
  EXPECT_THAT(error_of("analysis: statics\nanalyses: {a: {type: statics}}"),
              HasSubstr("both 'analysis' and 'analyses'"));
}

}  // namespace
}  // namespace tisserand::formats::analyses_test
