// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of a metre that stand 1e6 m from the origin move as at the origin.
#include <algorithm>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "mechanism/histories/series.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::far_scene_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;

const Vector3d away(1e6, -1e6, 3e6);
/// Double numbers from 2^21 to 2^22 are 2^-31 apart, those around 1e6 2^-33: poses typed there and positions stored
/// there are off by half of it at most.
constexpr double rounding = 0x1p-32;

/// The scene as one would type it in other axes of the world.
formats::Scene moved(formats::Scene scene, const Vector3d& by) {
  const auto move_ground = [&](formats::MarkerSpec& marker, bool always) {
    if (marker.node == "ground" && (marker.position || always))
      marker.position = marker.position.value_or(Vector3d::Zero()) + by;
  };
  const auto move_pair = [&](formats::MarkerPairSpec& pair, bool always) {
    if (pair.position) *pair.position += by;
    move_ground(pair.a, always);
    move_ground(pair.b, always);
  };
  for (formats::BodySpec& body : scene.bodies) std::visit([&](auto& spec) { spec.start.pose.position += by; }, body);
  for (formats::JointSpec& one : scene.joints) move_pair(one, one.kind == JointKind::distance);
  for (formats::SpringSpec& spring : scene.springs) move_pair(spring, spring.kind == formats::SpringKind::line);
  for (formats::ChannelSpec& channel : scene.channels) channel.origin += by;
  if (scene.statics.rotation) scene.statics.rotation->about += by;
  return scene;
}

class FarScene : public ::testing::Test {
 protected:
  Series history(const formats::Scene& scene, const std::string& name, const std::string& channel) {
    const std::string results = folder_.file(name + ".results.h5");
    if (!done_.contains(name)) {
      reports_[name] = simulate(scene, results, RunControl{});
      EXPECT_EQ(reports_[name].outcome, RunOutcome::completed) << reports_[name].reason;
      EXPECT_EQ(reports_[name].rejected, 0);
      done_.insert(name);
    }
    return read_series({{results}, {}, {channel}, {}}).front();
  }
  /// Largest difference of the channel, which is `offset` larger far away.
  double difference(const formats::Scene& scene, const std::string& channel, double offset) {
    const Series near = history(scene, "near", channel), far = history(moved(scene, away), "far", channel);
    EXPECT_EQ(near.y.size(), far.y.size());
    double largest = 0.0;
    for (std::size_t i = 0; i < std::min(near.y.size(), far.y.size()); ++i)
      largest = std::max(largest, std::abs(far.y[i] - offset - near.y[i]));
    return largest;
  }
  std::map<std::string, RunReport> reports_;
  std::set<std::string> done_;
  test_support::TemporaryFolder folder_;
};

/// On a rod to a point of the ground, pushed by a force that depends on where it is, and drawn by a spring.
formats::Scene pendulum() {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.gravity = {0, -9.81, 0};
  formats::RigidBodySpec bob = test_support::rigid_body("bob", 1.0, {0, 0, 0}, {0.1, 0.1, 0.1});
  bob.start.pose.position = {-1, 0, 0};
  scene.bodies.push_back(bob);
  formats::JointSpec rod;
  rod.name = "rod";
  rod.kind = JointKind::distance;
  rod.a.node = "ground";
  rod.b.node = "bob";
  scene.joints.push_back(rod);
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.a.node = "ground";
  spring.a.position = Vector3d(-2, 0, 0.5);
  spring.b.node = "bob";
  spring.stiffness = 3.0;
  spring.free = 0.5;
  scene.springs.push_back(spring);
  formats::ChannelSpec height;
  height.name = "height";
  height.kind = formats::ChannelKind::position;
  height.a.node = "bob";
  height.axis = Vector3d::UnitY();
  scene.channels.push_back(height);
  formats::LoadSpec push = test_support::constant_load("push", formats::LoadKind::force, "bob", {0, 0, 0});
  push.components[0] = formats::TimeExpression{"2 * height", {}, ""};
  scene.loads.push_back(push);
  scene.output.interval = 0.02;
  return scene;
}

TEST_F(FarScene, PendulumMovesAsAtTheOrigin) {
  const formats::Scene scene = pendulum();
  const Series y = history(scene, "near", "nodes/position/bob/y");
  EXPECT_LT(*std::ranges::min_element(y.y), -0.9);  // it has swung through
  EXPECT_LT(difference(scene, "nodes/position/bob/x", away.x()), rounding);
  EXPECT_LT(difference(scene, "nodes/position/bob/y", away.y()), rounding);
  EXPECT_LT(difference(scene, "nodes/position/bob/z", away.z()), 4.0 * rounding);
  EXPECT_LT(difference(scene, "nodes/velocity/bob/x", 0.0), 1e-11);
  EXPECT_LT(difference(scene, "energy/total", 0.0), 1e-11);
  EXPECT_THAT(reports_["far"].notes, ::testing::Contains(::testing::HasSubstr("times its size away from the origin")));
  EXPECT_THAT(reports_["near"].notes, ::testing::IsEmpty());
}

// Poses and joints typed there leave gaps of the rounding, which the start closes: the motion may differ by a few times
// as much, relative to the crank 2e-9.
TEST_F(FarScene, FlexibleSliderCrankMovesAsAtTheOrigin) {
  formats::Scene scene =
      formats::read_scene(TISSERAND_SOURCE_DIR "/examples/slider_crank/beams.scene.yaml",
                          {formats::parse_override("integrator.end=0.01"), formats::parse_override("output.every=5")});
  scene.output.channels.clear();
  EXPECT_LT(difference(scene, "nodes/position/rod/16/x", away.x()), 4.0 * rounding);
  EXPECT_LT(difference(scene, "nodes/position/rod/8/x", away.x()), 4.0 * rounding);
  EXPECT_LT(difference(scene, "nodes/position/rod/8/y", away.y()), 4.0 * rounding);
  const Series kinetic = history(scene, "near", "energy/kinetic");
  EXPECT_LT(difference(scene, "energy/kinetic", 0.0), 1e-7 * kinetic.y.front());
}

TEST_F(FarScene, SteadyRotationGoesAboutAPointOfTheWorld) {
  formats::Scene scene =
      formats::read_scene(TISSERAND_SOURCE_DIR "/examples/flexible_benchmarks/spin_up_steady.scene.yaml", {});
  scene.output.channels.clear();
  EXPECT_LT(difference(scene, "nodes/position/beam/8/x", away.x()), 4.0 * rounding);
  EXPECT_LT(difference(scene, "nodes/position/beam/8/y", away.y()), 4.0 * rounding);
  scene.motions.clear();  // nothing holds the angle of the rotation
  try {
    (void)inspect(moved(scene, away), {});
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("nothing holds coordinate 'root'"));
  }
}

}  // namespace
}  // namespace tisserand::mechanism::far_scene_test
