// SPDX-License-Identifier: GPL-3.0-or-later
// `effects` of scenes: switches of all and of bodies, their places, errors.
#include "formats/scene/effects.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/scene/scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::formats::effects_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* head = R"(scene: arm
bodies: {arm: {type: rigid, mass: 1, inertia: [1, 1, 1]}, friction: {type: rigid, mass: 1, inertia: [1, 1, 1]}}
integrator: {step: 0.01, end: 1}
)";

Scene read(const std::string& text, const std::vector<Override>& changes = {}) {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.file("a.scene.yaml")) << head << text;
  return read_scene(folder.file("a.scene.yaml"), changes);
}

std::string error_of(const std::string& text) {
  return test_support::error_of([&text] { static_cast<void>(read(text)); });
}

TEST(SceneEffects, AreSwitchesOfAllAndOfBodies) {
  EXPECT_TRUE(read("").effects.empty());
  const Scene scene = read("effects: {friction: off, arm: {gravity: on, damping: off}}\n", {{"effects.stops", "off"}});
  ASSERT_EQ(scene.effects.size(), 4U);
  EXPECT_EQ(scene.effects[0].effect, Effect::friction);
  EXPECT_EQ(scene.effects[0].owner, "");
  EXPECT_FALSE(scene.effects[0].on);
  EXPECT_THAT(scene.effects[0].where, HasSubstr("a.scene.yaml:4:11"));
  EXPECT_EQ(scene.effects[1].effect, Effect::damping);  // in the order of the effects
  EXPECT_EQ(scene.effects[1].owner, "arm");
  EXPECT_EQ(scene.effects[2].effect, Effect::gravity);
  EXPECT_TRUE(scene.effects[2].on);
  EXPECT_EQ(scene.effects[3].effect, Effect::stops);
  EXPECT_THAT(scene.effects[3].where, HasSubstr("--set effects.stops=off"));
}

// A body may have the name of an effect: a map is a body, a word a switch.
TEST(SceneEffects, DistinguishBodiesFromEffectsByTheirValues) {
  const Scene scene = read("effects: {friction: {gravity: off}}\n");
  ASSERT_EQ(scene.effects.size(), 1U);
  EXPECT_EQ(scene.effects[0].owner, "friction");
  EXPECT_EQ(scene.effects[0].effect, Effect::gravity);
}

TEST(SceneEffects, EveryEffectHasAWordThatIsRead) {
  for (const Effect effect : all_effects) {
    const Scene scene = read("effects: {" + effect_word(effect) + ": off}\n");
    ASSERT_EQ(scene.effects.size(), 1U);
    EXPECT_EQ(scene.effects[0].effect, effect);
  }
}

TEST(SceneEffects, AreAutomaticWhereARunCanChooseThem) {
  const Scene scene = read("effects: {flexibility: auto, tolerance: 0.01, arm: {stiffening: auto}}\n");
  ASSERT_EQ(scene.effects.size(), 2U);
  for (const EffectSwitch& one : scene.effects) EXPECT_TRUE(one.on && one.automatic);
  EXPECT_EQ(scene.effects[1].owner, "arm");
  EXPECT_EQ(scene.automatic.tolerance, 0.01);
  EXPECT_EQ(read("effects: {flexibility: auto}\n").automatic.tolerance, 1e-3);
  EXPECT_FALSE(read("effects: {flexibility: on}\n").effects[0].automatic);
}

TEST(SceneEffects, AreNotAutomaticWhereNoRunCanChooseThem) {
  EXPECT_THAT(error_of("effects: {gravity: auto}\n"),
              AllOf(HasSubstr("a.scene.yaml:4:20: effects: 'gravity' cannot be 'auto'"),
                    HasSubstr("auto is allowed for flexibility, stiffening")));
  EXPECT_THAT(error_of("effects: {arm: {damping: auto}}\n"), HasSubstr("'damping' cannot be 'auto'"));
  EXPECT_THAT(error_of("effects: {tolerance: -1}\n"), HasSubstr("'tolerance' must be positive, not -1"));
}

TEST(SceneEffects, AreRefusedWithPlaceAndRemedy) {
  EXPECT_THAT(error_of("effects: {gravty: off}\n"),
              AllOf(HasSubstr("a.scene.yaml:4:11: effects: there is no effect 'gravty'"),
                    HasSubstr("did you mean 'gravity'?"), HasSubstr("if it is a body, write gravty: {damping: off}")));
  EXPECT_THAT(error_of("effects: {tolerence: 0.01}\n"), HasSubstr("did you mean 'tolerance'?"));
  EXPECT_THAT(
      error_of("effects: {gravity: ought}\n"),
      AllOf(HasSubstr("a.scene.yaml:4:20"), HasSubstr("unknown value of 'gravity' 'ought'"), HasSubstr("off, on")));
  EXPECT_THAT(error_of("effects: {amr: {gravity: off}}\n"),
              AllOf(HasSubstr("there is no body 'amr'"), HasSubstr("did you mean 'arm'?")));
  EXPECT_THAT(error_of("effects: {arm: {friction: off}}\n"), HasSubstr("effects: friction: there is no joint 'arm'"));
  EXPECT_THAT(error_of("effects: {arm: {stops: off}}\n"), HasSubstr("effects: stops: there is no spring 'arm'"));
  EXPECT_THAT(error_of("effects: {\"\": {gravity: off}}\n"), HasSubstr("there is no body ''"));
  EXPECT_THAT(error_of("effects: {arm: {gravty: off}}\n"), HasSubstr("unknown key 'gravty'"));
  EXPECT_THAT(error_of("effects: {arm: {gravity: [off]}}\n"), HasSubstr("must be one word"));
  EXPECT_THAT(error_of("effects: [gravity]\n"), HasSubstr("must be a map"));
}

}  // namespace
}  // namespace tisserand::formats::effects_test
