// SPDX-License-Identifier: GPL-3.0-or-later
// Floating frames of every kind keep their length and their meaning while a body turns all the way round.
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::turning_frame_test {
namespace {

using Eigen::Vector3d;
using test_support::Simulation;

struct Frame {
  std::string name;
  std::string element;
  formats::FrameKind kind;
};

class TurningFrame : public ::testing::TestWithParam<Frame> {};
INSTANTIATE_TEST_SUITE_P(Frames, TurningFrame,
                         ::testing::Values(Frame{"Pair", "beam", formats::FrameKind::karcher},
                                           Frame{"Incremental", "beam", formats::FrameKind::paper},
                                           Frame{"Karcher", "three", formats::FrameKind::karcher},
                                           Frame{"IncrementalOfThree", "three", formats::FrameKind::paper},
                                           Frame{"Polar", "network", formats::FrameKind::karcher}),
                         [](const ::testing::TestParamInfo<Frame>& given) { return given.param.name; });

formats::Superelement element(const std::string& name) {
  using test_support::Keep;
  if (name == "beam") return test_support::craig_bampton_beam(test_support::soft_beam(), 2);
  if (name == "three")
    return test_support::craig_bampton(
        test_support::bent_frame(), {Keep::all, Keep::nothing, Keep::all, Keep::nothing, Keep::nothing, Keep::all}, 2);
  return test_support::craig_bampton(
      test_support::spring_network(),
      {Keep::translations, Keep::translations, Keep::translations, Keep::translations, Keep::nothing, Keep::nothing},
      2);
}

// A free body that starts turned by 60 degrees and turns on at 1 rad/s, all the way round in 6.28 s. A reference
// rotation whose length drifts (by tan²(θ/2) a step) makes the energy explode between 90 and 120 degrees; the deformed
// rotating body keeps it but for the numerical dissipation of its start, which is of the size of its strain energy:
// (ω/ω₁)² of the kinetic energy.
TEST_P(TurningFrame, KeepsEnergyAllTheWayRound) {
  SuperelementFiles files;
  test_support::add_file("body", element(GetParam().element), files);
  formats::Scene scene = test_support::empty_scene(1e-3, 6.5);
  formats::SuperelementBodySpec body = test_support::superelement_body("body", "body");
  body.frame = GetParam().kind;
  body.start.pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 3, Vector3d::UnitZ()));
  body.start.angular_velocity = {0, 0, 1};
  scene.bodies.push_back(body);
  Simulation run(scene, files);
  run.start();
  const double kinetic = run.energy().total();
  double largest_strain = 0.0, largest_error = 0.0;
  run.run(6.5, [&] {
    const Energy now = evaluate_energy(run.model(), run.workspace.now);
    largest_strain = std::max(largest_strain, now.strain);
    largest_error = std::max(largest_error, std::abs(now.total() - kinetic));
  });
  EXPECT_LE(largest_error, largest_strain + 1e-9 * kinetic);
  EXPECT_LE(largest_strain, 0.05 * kinetic);
  EXPECT_EQ(run.rejected, 0);
  for (Eigen::Index i = 0; i < run.state().frames().cols(); ++i)
    EXPECT_NEAR(run.state().frames().col(i).norm(), 1.0, 1e-15);
}

// x = ½ f/m t² from the jump on, whatever the size of other loads.
TEST(LoadJump, IsSeenBesideLoadsOfAnySize) {
  formats::Scene scene = test_support::empty_scene(0.1, 1.0);
  scene.bodies.push_back(test_support::rigid_body("block", 2.0, Vector3d::Zero(), {1, 1, 1}));
  formats::LoadSpec jump = test_support::constant_load("jump", formats::LoadKind::force, "block", Vector3d::Zero());
  jump.components[0] = formats::TimeExpression{"t < 0.5 ? 0 : 5", {0.5}, ""};
  scene.loads.push_back(jump);
  scene.loads.push_back(test_support::constant_load("large", formats::LoadKind::moment, "block", {1e7, 0, 0}));
  scene.loads.push_back(test_support::constant_load("opposite", formats::LoadKind::moment, "block", {-1e7, 0, 0}));
  Simulation run(scene, {});
  run.start();
  run.run(1.0);
  EXPECT_NEAR(run.position("block").x(), 0.5 * 2.5 * 0.25, 1e-9);
}

}  // namespace
}  // namespace tisserand::mechanism::turning_frame_test
