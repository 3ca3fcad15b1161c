// What results say about force elements, against the laws of these at a known state.
#include <gtest/gtest.h>

#include "formats/scene/scene.hpp"
#include "mechanism/run/output.hpp"
#include "tests/formats/yaml/text_input.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::force_output_test {
namespace {

using Eigen::Vector3d;

struct Stored {
  formats::ResultsLayout layout;
  formats::ResultsRow row;
};

/// The row at the start.
Stored at_start(const std::string& text) {
  const formats::Folder folder;
  test_support::Simulation run(formats::read_scene(folder.file("scene.yaml", text), {}), {});
  run.start();
  Stored stored{results_layout(run.model(), run.scene), {}};
  stored.row.resize(stored.layout);
  fill_row(run.model(), run.state(), run.workspace.now, stored.row);
  return stored;
}

const std::string head = "scene: test\ngravity: [0, 0, -10]\nintegrator: {step: 0.01, end: 1}\n";

// A distance of 1.2 with free length 1 and an upper stop at 1.1; the force on b is negative where it pulls b to a.
TEST(ForceOutput, SpringsAndTheirStops) {
  const Stored stored = at_start(head + R"(
bodies: {b: {type: rigid, mass: 2, inertia: [1, 1, 1], pose: {position: [0, 0, 1.2]}, velocity: [0, 0, 0.5]}}
joints: {guide: {type: prismatic, a: ground, b: b, axis: [0, 0, 1]}}
springs:
  plain: {coordinate: guide, stiffness: 30, free: -0.1, damping: 4}
  stopped: {a: ground, b: b, stiffness: 50, free: 1, upper: 1.1, stop_stiffness: 700, stop_damping: 2, force: 3}
  turn: {type: torsion, a: ground, b: b, axis: [1, 0, 0], stiffness: 5, free: 0.2}
)");
  ASSERT_EQ(stored.layout.springs.size(), 3u);
  EXPECT_TRUE(stored.layout.springs[1].length);
  EXPECT_FALSE(stored.layout.springs[2].length);
  ASSERT_EQ(stored.layout.stops.size(), 1u);
  EXPECT_EQ(stored.layout.stops[0].name, "stopped");
  const double stop = -700.0 * 0.1 * (1.0 + 2.0 * 0.5);
  EXPECT_NEAR(stored.row.spring_force[0], -30.0 * 0.1 - 4.0 * 0.5, 1e-11);
  EXPECT_NEAR(stored.row.stop_force[0], stop, 1e-11);
  EXPECT_NEAR(stored.row.spring_force[1], -50.0 * 0.2 + 3.0 + stop, 1e-11);
  EXPECT_NEAR(stored.row.spring_force[2], 5.0 * 0.2, 1e-12);
}

// At the deflection 0 the wrench on b is K free + preload, in the axes of a: z along the world's x, x along its y.
TEST(ForceOutput, BushingsInAxesOfA) {
  const Stored stored = at_start(head + R"(
bodies: {b: {type: rigid, mass: 2, center_of_mass: [0.3, 0.1, -0.2], inertia: [1, 1, 1]}}
bushings:
  mount: {a: ground, b: {node: b, position: [0.4, 0.5, 0.6]}, axis: [1, 0, 0], x_axis: [0, 1, 0],
          stiffness: [10, 20, 30, 4, 5, 6], free: [0.1, 0.2, 0.3, 0.01, 0, 0], preload: [1, 2, 3, 0, 0.5, 0]}
)");
  EXPECT_EQ(stored.layout.bushings, std::vector<std::string>{"mount"});
  EXPECT_LT((stored.row.bushing_force.col(0) - Vector3d(1 + 1, 4 + 2, 9 + 3)).norm(), 1e-12);
  EXPECT_LT((stored.row.bushing_moment.col(0) - Vector3d(0.04, 0.5, 0)).norm(), 1e-12);
}

// A block slides along x with N = m g: the friction is μ m g against it, along z of marker a.
TEST(ForceOutput, FrictionBesideTheReaction) {
  const Stored stored = at_start(head + R"(
bodies: {block: {type: rigid, mass: 2, inertia: [1, 1, 1], velocity: [0.7, 0, 0]}}
joints: {rail: {type: prismatic, a: ground, b: block, axis: [1, 0, 0], friction: {coefficient: 0.3, velocity: 0.01}}}
)");
  EXPECT_EQ(stored.layout.frictions, std::vector<std::string>{"rail"});
  EXPECT_LT((stored.row.friction_force.col(0) - Vector3d(0, 0, -0.3 * 2 * 10)).norm(), 1e-8);
  EXPECT_LT(stored.row.friction_moment.col(0).norm(), 1e-8);
  EXPECT_NEAR(stored.row.joint_force.col(0).norm(), 20.0, 1e-8);
}

TEST(ForceOutput, NothingWhereThereIsNone) {
  const Stored stored = at_start(head + "bodies: {b: {type: rigid, mass: 2, inertia: [1, 1, 1]}}\n");
  EXPECT_TRUE(stored.layout.springs.empty() && stored.layout.stops.empty() && stored.layout.bushings.empty() &&
              stored.layout.frictions.empty());
}

}  // namespace
}  // namespace tisserand::mechanism::force_output_test
