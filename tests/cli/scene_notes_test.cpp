// SPDX-License-Identifier: GPL-3.0-or-later
// What several analyses of one command say of the scene that they share.
#include "tests/cli/scenes.hpp"

namespace tisserand::cli::scene_notes_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A door on two hinges of one line: five of the ten equations repeat what the others demand. A weight hangs on it
/// whose pendulum stands on its head, so that both analyses of modes find one mode that grows.
constexpr const char* door = R"yaml(scene: door
gravity: [0, 0, -9.81]
bodies:
  door: {type: rigid, mass: 2, inertia: [0.2, 0.2, 0.2], nodes: {low: {position: [0, 0, -1]}, high: {position: [0, 0, 1]}}}
  weight: {type: rigid, mass: 1, inertia: [0.1, 0.1, 0.1], center_of_mass: [0, 0, 1]}
joints:
  low: {type: revolute, a: ground, b: door/low, axis: [0, 0, 1]}
  high: {type: revolute, a: ground, b: door/high, axis: [0, 0, 1]}
  pivot: {type: revolute, a: door, b: weight, axis: [0, 1, 0]}
analyses:
  first: {type: modes}
  second: {type: modes}
)yaml";

class SceneNotes : public Folder {};

int count(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

// The trial: a car whose two analyses had the same eight joints in a note each.
TEST_F(SceneNotes, AreReportedOnceAndWhatAnAnalysisFindsEachTime) {
  write_text(file("door.scene.yaml"), door);
  const Outcome run = mechanism({"run", "door.scene.yaml"});
  ASSERT_EQ(run.code, 0) << run.error;
  const std::string redundant = "are not unique: those of least norm are stored", found = "1 mode grows";
  EXPECT_EQ(count(run.out, redundant), 1) << run.out;
  EXPECT_EQ(count(run.out, found), 2) << run.out;
  EXPECT_EQ(count(mechanism({"check", "door.scene.yaml"}).out, redundant), 1);
  for (const char* name : {"door.first.results.h5", "door.second.results.h5"})  // each file has them all
    EXPECT_THAT(read_text(file(name)), AllOf(HasSubstr(redundant), HasSubstr(found))) << name;
}

}  // namespace
}  // namespace tisserand::cli::scene_notes_test
