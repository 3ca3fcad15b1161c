// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of --set: paths, typed values, and errors that name the override.
#include "formats/yaml/override.hpp"

#include <gtest/gtest.h>

#include "formats/scene/scene.hpp"
#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::override_test {
namespace {

const std::string scene_text = R"(scene: swing
bodies:
  block: {type: rigid, mass: 1, inertia: [1, 1, 1]}
  rod: {type: superelement, file: rod.superelement.h5}
joints:
  ball: {type: spherical, a: ground, b: block}
loads:
  push: {type: force, at: block, value: [0, 0, {table: [[0, 0], [1, 5]]}]}
integrator: {step: 0.01, end: 1}
)";

Scene read(const std::vector<std::string>& changes) {
  const Folder folder;
  return read_scene(folder.file("scene.yaml", scene_text), overrides(changes));
}

std::string error(const std::vector<std::string>& changes) {
  const Folder folder;
  const std::string path = folder.file("scene.yaml", scene_text);
  return error_of(folder, [&] { read_scene(path, overrides(changes)); });
}

TEST(Override, SplitsAtTheFirstEqualsSign) {
  const Override change = parse_override("loads.push.value.2=\"t=1\"");
  EXPECT_EQ(change.path, "loads.push.value.2");
  EXPECT_EQ(change.value, "\"t=1\"");
}

TEST(Override, RejectsWhatIsNoOverride) {
  const Folder folder;
  EXPECT_EQ(error_of(folder, [] { parse_override("step"); }), "--set step: has no '='; write --set path.to.key=value");
  EXPECT_EQ(error_of(folder, [] { parse_override("=3"); }),
            "--set =3: path '' has an empty key; write --set path.to.key=value");
  EXPECT_EQ(error_of(folder, [] { parse_override("a..b=3"); }),
            "--set a..b=3: path 'a..b' has an empty key; write --set path.to.key=value");
}

TEST(Override, SetsValuesThatAreThere) {
  const Scene scene =
      read({"integrator.step=0.005", "loads.push.value.2.table.1.1=7", "bodies.block.inertia=[1, 2, 2]"});
  EXPECT_EQ(scene.integrator.step, 0.005);
  EXPECT_EQ(std::get<TimeTable>(scene.loads[0].components[2]).value[1], 7.0);
  EXPECT_EQ(std::get<RigidBodySpec>(scene.bodies[0]).inertia(2, 2), 2.0);
}

TEST(Override, SetsValuesThatAreAbsentButLegal) {
  const Scene scene = read({"bodies.rod.modes=2", "output.every=5", "bodies.block.pose.position=[1, 0, 0]",
                            "gravity=[0, 0, -9.81]", "joints.second={type: fixed, a: ground, b: rod/tip}"});
  EXPECT_EQ(std::get<SuperelementBodySpec>(scene.bodies[1]).modes, 2);
  EXPECT_EQ(scene.output.every, 5);
  EXPECT_EQ(std::get<RigidBodySpec>(scene.bodies[0]).start.pose.position.x(), 1.0);
  EXPECT_EQ(scene.gravity.z(), -9.81);
  EXPECT_EQ(scene.joints.at(1).name, "second");
}

TEST(Override, LaterOnesWin) { EXPECT_EQ(read({"integrator.step=0.5", "integrator.step=0.25"}).integrator.step, 0.25); }

TEST(Override, ErrorsNameTheOverride) {
  EXPECT_EQ(error({"integrator.stpe=0.005"}),
            "--set integrator.stpe=0.005: integrator: unknown key 'stpe'; did you mean 'step'?");
  EXPECT_EQ(error({"integrator.step=fast"}),
            "--set integrator.step=fast: integrator: step must be a number, not 'fast'");
  EXPECT_EQ(error({"integrator.step=-1"}), "--set integrator.step=-1: integrator: step -1 must be positive");
  EXPECT_EQ(error({"integrator.step="}), "--set integrator.step=: integrator: step must be a number, not nothing");
  EXPECT_EQ(error({"bodies.rdo.modes=2"}),
            "--set bodies.rdo.modes=2: 'bodies' has no entry 'rdo'; did you mean 'rod'?");
  EXPECT_EQ(error({"bodies.crankshaft.modes=2"}),
            "--set bodies.crankshaft.modes=2: 'bodies' has no entry 'crankshaft'; use one of block, rod");
  EXPECT_EQ(
      error({"loads.push.value.3=1"}),
      "--set loads.push.value.3=1: 'loads.push.value' has 3 entries; there is no index 3; use an index from 0 to 2");
  EXPECT_EQ(error({"loads.push.value.x=1"}),
            "--set loads.push.value.x=1: 'loads.push.value' is a list; 'x' is neither an index nor the name of an "
            "entry; use an index from 0 to 2");
  EXPECT_EQ(error({"scene.x=1"}), "--set scene.x=1: 'scene' is 'swing', not a map; set 'scene' itself");
  EXPECT_EQ(error({"gravity=[0, 0"}).find("--set gravity=[0, 0: not valid YAML: "), 0u);
}

TEST(Override, AllErrorsAtOnce) {
  EXPECT_EQ(error({"integrator.step=0", "initial_tolerance=0"}),
            "--set integrator.step=0: integrator: step 0 must be positive\n"
            "--set initial_tolerance=0: initial_tolerance 0 must be positive");
}

}  // namespace
}  // namespace tisserand::formats::override_test
