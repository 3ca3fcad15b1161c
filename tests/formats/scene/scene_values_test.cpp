// SPDX-License-Identifier: GPL-3.0-or-later
// Values of a scene as lines, and what differs between two scenes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/scene/expand/values.hpp"
#include "formats/scene/fields.hpp"

namespace tisserand::formats::scene_values_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::string pendulum = R"(scene: pendulum
gravity: [0, 0, -9.81]
bodies:
  arm: {type: rigid, mass: 2, inertia: [1, 1, 1]}
joints:
  hinge: {type: revolute, a: ground, b: arm, axis: [0, 1, 0]}
integrator: {step: 0.01, end: 1}
)";

std::string values(const std::string& text, const ContentsOf& contents = {}) {
  return scene_values(parse_yaml(text, "scene.yaml").root, contents);
}

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  text.replace(text.find(old), old.size(), by);
  return text;
}

/// "key: before -> after" of each difference.
std::vector<std::string> changes(const std::string& before, const std::string& after) {
  std::vector<std::string> texts;
  for (const ValueChange& change : scene_changes(values(before), values(after), scene_key_sets()))
    texts.push_back(change.key + ": " + change.before + " -> " + change.after);
  return texts;
}

TEST(SceneValues, AreOneLineEachWithoutSettings) {
  EXPECT_EQ(values(pendulum),
            "gravity.0: 0\ngravity.1: 0\ngravity.2: -9.81\nbodies.arm.type: rigid\nbodies.arm.mass: 2\n"
            "bodies.arm.inertia.0: 1\nbodies.arm.inertia.1: 1\nbodies.arm.inertia.2: 1\n"
            "joints.hinge.type: revolute\njoints.hinge.a: ground\njoints.hinge.b: arm\n"
            "joints.hinge.axis.0: 0\njoints.hinge.axis.1: 1\njoints.hinge.axis.2: 0\n");
}

TEST(SceneValues, ChangesAreNamedWithBothValues) {
  EXPECT_THAT(changes(pendulum, replaced(pendulum, "mass: 2", "mass: 20")), ElementsAre("bodies.arm.mass: 2 -> 20"));
  EXPECT_THAT(changes(pendulum, replaced(pendulum, "-9.81", "9.81")), ElementsAre("gravity.2: -9.81 -> 9.81"));
  EXPECT_THAT(changes(pendulum, replaced(pendulum, "axis: [0", "position: [0.1, 0, 0], axis: [0")),
              ElementsAre("joints.hinge.position.0: nothing -> 0.1", "joints.hinge.position.1: nothing -> 0",
                          "joints.hinge.position.2: nothing -> 0"));
  EXPECT_THAT(
      changes(replaced(pendulum, "mass: 2", "mass: 2, nodes: {tip: {position: [0, 0, 1]}}"), pendulum),
      ElementsAre("bodies.arm.nodes.tip.position.0: 0 -> nothing", "bodies.arm.nodes.tip.position.1: 0 -> nothing",
                  "bodies.arm.nodes.tip.position.2: 1 -> nothing"));
}

TEST(SceneValues, SettingsNotationAndDefaultsAreNoChange) {
  for (const auto& [old, by] : std::vector<std::pair<std::string, std::string>>{
           {"end: 1", "end: 2, formulation: index3"},
           {"step: 0.01", "method: hht, step: 0.02"},
           {"scene: pendulum", "scene: another"},
           {"integrator:", "output: {every: 2}\ncheckpoint: {every: 3}\nstatics: {tolerance: 1e-9}\nintegrator:"},
           {"integrator:", "initial_tolerance: 1e-3\nintegrator:"},
           {"integrator:", "virtual_bodies: keep\nintegrator:"},
           {"mass: 2", "mass: 2.0"},
           {"mass: 2", "mass: 0.2e1"},
           {"mass: 2", "center_of_mass: [0, 0.0, 0], mass: 2"},
           {"mass: 2", "shape: {type: box, size: [1, 1, 1]}, mass: 2"},
           {"integrator:", "channels: {tip: {type: position, of: arm, axis: z}}\nintegrator:"},
           {"integrator:", "loads: {}\nsprings:\nintegrator:"}}) {
    EXPECT_THAT(changes(pendulum, replaced(pendulum, old, by)), IsEmpty()) << by;
    if (by.find("channels") == std::string::npos) {
      EXPECT_THAT(changes(replaced(pendulum, old, by), pendulum), IsEmpty()) << by;
    }
  }
  const std::string still = replaced(pendulum, "gravity: [0, 0, -9.81]\n", "");
  EXPECT_THAT(changes(still, replaced(pendulum, "-9.81", "0")), IsEmpty());
  EXPECT_THAT(changes(still, pendulum), ElementsAre("gravity.2: nothing -> -9.81"));
}

TEST(SceneValues, ChannelsThatSomethingUsesAreChanges) {
  const std::string with =
      replaced(pendulum, "integrator:", "channels: {tip: {type: position, of: arm, axis: z}}\nintegrator:");
  EXPECT_THAT(changes(with, replaced(with, "axis: z", "axis: x")), ElementsAre("channels.tip.axis: z -> x"));
  const std::string load = "loads: {f: {type: force, at: arm, value: [\"3*t\", 0, 0]}}\nintegrator:";
  const std::string pushed = replaced(with, "integrator:", load);
  EXPECT_THAT(changes(pushed, replaced(pushed, "3*t", "3*tip")), ElementsAre("loads.f.value.0: 3*t -> 3*tip"));
  EXPECT_THAT(changes(pushed, replaced(pushed, "3*t", "3 * t")), IsEmpty());
}

TEST(SceneValues, FilesCountByTheirContents) {
  const std::string table = replaced(pendulum, "integrator:", "inputs: {u: {file: a.csv, value: 2}}\nintegrator:");
  const auto with = [&](const std::string& name, const std::string& id) {
    return values(replaced(table, "a.csv", name),
                  [&](const std::string& key, const std::string&) { return key == "inputs.u.file" ? id : ""; });
  };
  const std::vector<KeySet> keys = scene_key_sets();
  EXPECT_THAT(with("a.csv", "1f"), HasSubstr("inputs.u.file: a.csv\ninputs.u.file (contents): 1f\n"));
  EXPECT_THAT(scene_changes(with("a.csv", "1f"), with("b.csv", "1f"), keys), IsEmpty());
  EXPECT_EQ(changes_text(scene_changes(with("a.csv", "1f"), with("a.csv", "2e"), keys), " "),
            " inputs.u.file: the contents of the file differ");
  EXPECT_THAT(scene_changes(with("a.csv", ""), with("a.csv", "2e"), keys), IsEmpty()) << "written before contents were";
  EXPECT_THAT(changes_text(scene_changes(with("a.csv", "1f"), with("b.csv", "2e"), keys), "\n"),
              HasSubstr("inputs.u.file: a.csv -> b.csv"));
}

TEST(SceneValues, TenChangesAreListed) {
  std::string table = "[";
  for (int i = 0; i < 20; ++i) table += std::to_string(i) + ", ";
  const std::string with = replaced(pendulum, "integrator:", "other: " + table + "1]\nintegrator:");
  const auto found = scene_changes(values(with), values(pendulum), scene_key_sets());
  EXPECT_EQ(found.size(), 21U);
  const std::string text = changes_text(found, "\n");
  EXPECT_THAT(text, HasSubstr("other.9: 9 -> nothing\nand 11 more"));
  EXPECT_THAT(text, Not(HasSubstr("other.10")));
}

}  // namespace
}  // namespace tisserand::formats::scene_values_test
