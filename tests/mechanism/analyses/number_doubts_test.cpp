// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of scenes that cannot be meant are named; those of examples, and of their variations, are not.
#include "mechanism/analyses/number_doubts.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/build/build_model.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/varied_numbers.hpp"

namespace tisserand::testing::number_doubts_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> doubts_of(const formats::Scene& scene) {
  const mechanism::BuiltModel built = mechanism::build_model(scene, {});
  mechanism::Evaluation now(built.model);
  mechanism::evaluate(built.model, built.state, now);
  return mechanism::number_doubts(scene, built.model, now);
}

/// The trial unlikely_values.
constexpr const char* slider_crank = R"yaml(scene: slider-crank
gravity: [0, 0, -9.81]
materials: {steel: {E: 2.1e11, nu: 0.3, density: 7800}}
bodies:
  crank: {type: rigid, mass: 1, inertia: [1e-3, 1e-3, 1e-3], center_of_mass: [0.05, 0, 0], nodes: {pin: {position: [0.1, 0, 0]}}}
  rod: {type: beam, from: [0, 0, 0], to: [0.3, 0, 0], elements: 4, section: {shape: circle, radius: 0.01}, material: steel, pose: {position: [0.1, 0, 0]}}
  piston: {type: rigid, mass: 0.5, inertia: [1e-3, 1e-3, 1e-3], pose: {position: [0.4, 0, 0]}}
joints:
  A: {type: revolute, a: ground, b: crank, axis: [0, 0, 1]}
  B: {type: revolute, a: crank/pin, b: rod/start, axis: [0, 0, 1]}
  C: {type: revolute, a: rod/end, b: piston, axis: [0, 0, 1]}
  S: {type: prismatic, a: ground, b: piston, axis: [1, 0, 0]}
motions: {m: {coordinate: A, value: "step5(t,0,0,0.2,10)"}}
integrator: {step: 5e-4, end: 0.3}
)yaml";

std::vector<std::string> doubts_with(const std::vector<std::string>& settings) {
  const test_support::TemporaryFolder folder;
  write_text_file(folder.file("a.scene.yaml"), slider_crank);
  std::vector<formats::Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(formats::parse_override(setting));
  return doubts_of(formats::read_scene(folder.file("a.scene.yaml"), overrides));
}

TEST(NumberDoubts, NameWhatCannotBeMeant) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"materials.steel.E=210", "the modulus looks like GPa (in units of the scene 2.1e+11)"},
      {"materials.steel.density=7.8", "the density looks like g/cm^3 (in units of the scene 7800)"},
      {"bodies.rod.section.radius=10",
       "the section of 'rod' has a radius of gyration of 5 m, but the beam has a length of 0.3 m"},
      {"bodies.crank.inertia=[42632,42632,42632]", "'crank' has a radius of gyration"},
      {"joints.S.friction={coefficient: 15, velocity: 0.01}", "joint 'S' has a coefficient of friction of 15"},
      {"gravity=[0,0,-9810]", "gravity is 9810 m s^-2"},
      {"springs={s: {a: {node: ground, position: [0,0,0]}, b: piston, stiffness: 10, free: 300}}",
       "has a free length of 300 m"},
      {"motions.m.value={table: [[5, 0], [6, 1]]}",
       "the table of motion 'm' covers 5 to 6 s, but the run goes from 0 to 0.3 s"},
      {"output={interval: 2}", "is longer than the run of 0.3 s"}};
  EXPECT_THAT(doubts_with({}), IsEmpty());
  for (const auto& [setting, text] : cases)
    EXPECT_THAT(doubts_with({setting}), ElementsAre(HasSubstr(text))) << setting;
}

TEST(NumberDoubts, AreSilentAboutImbalanceAndConstantTables) {
  EXPECT_THAT(
      doubts_with({"bodies={disc: {type: rigid, mass: 10, inertia: [0.9, 0.45, 0.45], center_of_mass: [0, 1e-5, 0]}}",
                   "joints={axle: {type: revolute, a: ground, b: disc, axis: [1, 0, 0]}}", "motions={}"}),
      IsEmpty());
  EXPECT_THAT(doubts_with({"loads={f: {type: force, at: piston, value: [{table: [[-1, 3], [0, 3]]}, 0, 0]}}"}),
              IsEmpty());
}

// The trial: a rod of 1 m whose centre of mass is 2.5 m from its only hinge. sqrt(0.17/2) = 0.2915 m.
TEST(NumberDoubts, NoteSlenderBodiesFarFromWhatHoldsThem) {
  const auto note_with = [](const std::string& numbers, const std::string& joints) {
    const test_support::TemporaryFolder folder;
    write_text_file(folder.file("a.scene.yaml"), "scene: pendulum\nbodies: {arm: {type: rigid, mass: 2, " + numbers +
                                                     "}}\njoints: {" + joints +
                                                     "}\nintegrator: {step: 0.01, end: 1}\n");
    const formats::Scene scene = formats::read_scene(folder.file("a.scene.yaml"), {});
    return mechanism::far_centres(mechanism::build_model(scene, {}).model);
  };
  const std::string rod = "inertia: [0.17, 0.17, 0.002], center_of_mass: ";
  const std::string hinge = "hinge: {type: revolute, a: ground, b: arm, axis: [0, 1, 0]";
  EXPECT_EQ(note_with(rod + "[0, 0, -0.5]", hinge + "}"), "");
  EXPECT_THAT(note_with(rod + "[0, 0, -2.5]", hinge + "}"),
              ::testing::AllOf(HasSubstr("'arm' 2.5 m (radius of gyration 0.292)"), HasSubstr("`center_of_mass`")));
  // Limits at both sides: 1.45 and 1.47 m are 4.97 and 5.04 radii.
  EXPECT_EQ(note_with(rod + "[0, 0, -1.45]", hinge + "}"), "");
  EXPECT_NE(note_with(rod + "[0, 0, -1.47]", hinge + "}"), "");
  // A part frame far away is none: the hinge is where it is, and without hinge nothing holds the rod.
  EXPECT_EQ(note_with(rod + "[0, 0, -2.5]", hinge + ", position: [0, 0, -2]}"), "");
  EXPECT_EQ(note_with(rod + "[0, 0, -2.5]", ""), "");
  // A ball on an arm without mass is a usual model.
  EXPECT_EQ(note_with("inertia: [1e-4, 1e-4, 1e-4], center_of_mass: [0, 0, -2.5]", hinge + "}"), "");
}

TEST(NumberDoubts, CountWhatIsAlike) {
  std::string springs = "springs={";
  for (int k = 0; k < 9; ++k)
    springs +=
        fmt::format("s{}: {{a: {{node: ground, position: [0, 0, 0]}}, b: piston, stiffness: 10, free: 300}}, ", k);
  const std::vector<std::string> doubts = doubts_with({springs + "}"});
  ASSERT_EQ(doubts.size(), 3u);
  EXPECT_THAT(doubts[2], HasSubstr("(and 6 more like this)"));
}

// Scenes without superelement files, whose variations have open joints, too; what cannot be built is not counted.
TEST(NumberDoubts, AreSilentAboutExamplesAndTheirVariations) {
  const test_support::TemporaryFolder folder;
  namespace fs = std::filesystem;
  fs::copy(fs::path(TISSERAND_SOURCE_DIR) / "examples", folder.file("examples"), fs::copy_options::recursive);
  std::vector<std::string> scenes;
  for (const auto& entry : fs::recursive_directory_iterator(folder.file("examples")))
    if (entry.path().string().ends_with(".scene.yaml")) scenes.push_back(entry.path().string());
  std::ranges::sort(scenes);
  std::mt19937 random(7);
  int reported = 0;
  for (int round = 0; round < 6; ++round)
    for (const std::string& path : scenes) {
      std::ifstream file(path);
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      if (round > 0) write_text_file(path, test_support::varied(text, random));
      try {
        EXPECT_THAT(doubts_of(formats::read_scene(path, {})), IsEmpty()) << path << " round " << round;
        ++reported;
      } catch (const std::exception&) {  // as where a superelement file is missing
      }
      if (round > 0) write_text_file(path, text);
    }
  EXPECT_GT(reported, 100);
}

}  // namespace
}  // namespace tisserand::testing::number_doubts_test
