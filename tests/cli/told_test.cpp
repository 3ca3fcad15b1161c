// SPDX-License-Identifier: GPL-3.0-or-later
// What runs tell of what they have derived: velocities at the start with the first row, damping of modes.
#include <sstream>

#include "tests/cli/scenes.hpp"

namespace tisserand::cli::reported_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Reported : public Folder {
 protected:
  /// The value of a channel in the first row.
  double first(const std::string& results, const std::string& channel) const {
    const Outcome csv = mechanism({"export", results, "-c", channel, "-o", "/dev/stdout"});
    EXPECT_EQ(csv.code, 0) << csv.error;
    std::istringstream lines(csv.out);
    std::string line;
    std::getline(lines, line);
    std::getline(lines, line);
    return std::stod(line.substr(line.rfind(',') + 1));
  }
};

// A crank of length 1 is driven at 2 rad/s, a bar (m = 2, J = 0.2, its centre of mass a = 0.5 behind the pin) hangs on
// it and has no velocity written. Least energy: w = -2 m a/(J + m a^2) about y. At this start nothing turns the bar
// faster, so its pin carries m (-4 - w^2 a) along x.
TEST_F(Reported, StartOfADriveFromRestAndItsFirstRow) {
  write_text(file("crank.scene.yaml"), R"yaml(scene: crank
bodies:
  crank: {type: rigid, mass: 1, inertia: [1, 1, 1], nodes: {tip: {position: [1, 0, 0]}}}
  bar: {type: rigid, mass: 2, inertia: [0.2, 0.2, 0.2], pose: {position: [1.5, 0, 0]}}
joints:
  hinge: {type: revolute, a: ground, b: crank, axis: [0, 1, 0]}
  pin: {type: revolute, a: crank/tip, b: bar, position: [1, 0, 0], axis: [0, 1, 0]}
motions: {turn: {coordinate: hinge, value: "2*t"}}
integrator: {step: 0.001, end: 0.002}
)yaml");
  const Outcome run = mechanism({"run", "crank.scene.yaml"});
  ASSERT_EQ(run.code, 0) << run.error;
  EXPECT_THAT(run.out, AllOf(HasSubstr("initial velocities of "), HasSubstr("'bar'"),
                             HasSubstr("were computed from joints, drives and given velocities with the smallest "
                                       "kinetic energy, 3.143")));
  const double m = 2.0, J = 0.2, a = 0.5, w = -2.0 * m * a / (J + m * a * a), v = -2.0 - w * a;
  EXPECT_NEAR(first("crank.results.h5", "nodes/angular_velocity/bar/y"), w, 1e-9);
  EXPECT_NEAR(first("crank.results.h5", "energy/kinetic"), 2.0 + 0.5 * m * v * v + 0.5 * J * w * w, 1e-9);
  EXPECT_NEAR(first("crank.results.h5", "joints/force/pin/x"), m * (-4.0 - w * w * a), 1e-7);
}

// k = 100, J = 4: 5 rad/s; c = 1: c/(2 sqrt(k J)) = 0.025.
TEST_F(Reported, DampingOfTheModes) {
  write_text(file("wheel.scene.yaml"), R"yaml(scene: wheel
analysis: modes
bodies: {wheel: {type: rigid, mass: 1, inertia: [4, 4, 4]}}
joints: {hinge: {type: revolute, a: ground, b: wheel, axis: [0, 0, 1]}}
springs: {spring: {coordinate: hinge, stiffness: 100, damping: 1}}
)yaml");
  const Outcome run = mechanism({"run", "wheel.scene.yaml"});
  ASSERT_EQ(run.code, 0) << run.error;
  EXPECT_THAT(run.out, AllOf(HasSubstr("damping"), ::testing::ContainsRegex("0\\.79[0-9]* +0\\.025 ")));
}

}  // namespace
}  // namespace tisserand::cli::reported_test
