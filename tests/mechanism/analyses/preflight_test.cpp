// SPDX-License-Identifier: GPL-3.0-or-later
// Pre-flight: counts as rigid bodies, motions that nothing determines, groups, gaps, doubtful masses.
#include "mechanism/analyses/preflight.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::preflight_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;
using test_support::joint;
using test_support::Simulation;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

formats::RigidBodySpec block(const std::string& name, double mass, const Vector3d& center) {
  formats::RigidBodySpec body = test_support::rigid_body(name, mass, Vector3d::Zero(), {0.1, 0.1, 0.1});
  body.start.pose.position = center;
  return body;
}

formats::VirtualBodySpec hub_at(const Vector3d& position) {
  formats::VirtualBodySpec body;
  body.name = "hub";
  body.start.pose.position = position;
  return body;
}

Preflight examined(const formats::Scene& scene, const SuperelementFiles& files) {
  Simulation run(scene, files);
  evaluate(run.model(), run.state(), run.workspace.now);
  return examine(run.model(), run.workspace.now);
}

// A flexible body counts as one rigid part, whatever its nodes: on a hinge it has one degree of freedom then, and on
// two hinges in line one still, although Gruebler's count says 6 - 10 = -4.
TEST(RigidMobility, CountsFlexibleBodiesAsRigid) {
  SuperelementFiles files;
  test_support::add_file("beam", test_support::test_superelement("beam"), files);
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.push_back(test_support::superelement_body("beam", "beam"));
  const Vector3d tip = files.at("beam").superelement.node_position.row(1);
  scene.joints = {joint("one", JointKind::revolute, "ground", "beam/base", {0, 0, 0}, {1, 0, 0})};
  Simulation hinged(scene, files);
  Mobility mobility = count_mobility(hinged.model(), hinged.state(), hinged.workspace.now);
  EXPECT_EQ(mobility.parts, 1);
  EXPECT_EQ(mobility.rigid_mobility, 1);
  EXPECT_GT(mobility.degrees_of_freedom, 1);
  scene.joints.push_back(joint("two", JointKind::revolute, "ground", "beam/tip", tip, {1, 0, 0}));
  Simulation held(scene, files);
  mobility = count_mobility(held.model(), held.state(), held.workspace.now);
  EXPECT_TRUE(mobility.redundant.empty());  // the deformable body meets all ten
  EXPECT_EQ(mobility.rigid_mobility, 1);
}

Mobility named(const formats::Scene& scene) {
  Simulation run(scene, {});
  Mobility mobility = count_mobility(run.model(), run.state(), run.workspace.now);
  find_freedoms(run.model(), run.state(), run.workspace.now, mobility);
  return mobility;
}

// Two links on balls between ground hinges: a four-bar whose hinges are parallel moves; with one across it locks. At
// its dead centre a slider has no rate either, but no loop stands still.
TEST(Freedoms, AreNamedAndLockedLoopsToo) {
  formats::Scene bars = test_support::empty_scene(1e-3, 1.0);
  bars.bodies = {block("crank", 1.0, {0, 0.5, 0}), block("rod", 1.0, {0.5, 1, 0}), block("rocker", 1.0, {1, 0.5, 0})};
  bars.joints = {joint("main", JointKind::revolute, "ground", "crank", {0, 0, 0}, {0, 0, 1}),
                 joint("pin", JointKind::revolute, "crank", "rod", {0, 1, 0}, {0, 0, 1}),
                 joint("ball", JointKind::spherical, "rod", "rocker", {1, 1, 0}, {0, 0, 1}),
                 joint("swing", JointKind::revolute, "ground", "rocker", {1, 0, 0}, {0, 0, 1})};
  EXPECT_EQ(named(bars).free, (std::vector<std::string>{"'main'"}));
  EXPECT_TRUE(named(bars).locked.empty());
  bars.joints[3] = joint("swing", JointKind::revolute, "ground", "rocker", {1, 0, 0}, {1, 0, 1});
  EXPECT_EQ(named(bars).locked, (std::vector<std::string>{"'main'", "'pin'", "'ball'", "'swing'"}));
  EXPECT_TRUE(named(bars).free.empty());

  formats::Scene slider = test_support::empty_scene(1e-3, 1.0);
  slider.bodies = {block("crank", 1.0, {0.5, 0, 0}), block("rod", 1.0, {2, 0, 0}), block("slider", 1.0, {3, 0, 0})};
  slider.joints = {joint("main", JointKind::revolute, "ground", "crank", {0, 0, 0}, {0, 0, 1}),
                   joint("pin", JointKind::revolute, "crank", "rod", {1, 0, 0}, {0, 0, 1}),
                   joint("ball", JointKind::spherical, "rod", "slider", {3, 0, 0}, {0, 0, 1}),
                   joint("slide", JointKind::prismatic, "ground", "slider", {3, 0, 0}, {1, 0, 0})};
  EXPECT_EQ(named(slider).free, (std::vector<std::string>{"'main'"}));
  EXPECT_TRUE(named(slider).locked.empty());

  formats::Scene free = test_support::empty_scene(1e-3, 1.0);
  free.bodies = {block("light", 1.0, {0, 0, 0}), block("heavy", 2.0, {1, 0, 0})};
  free.joints = {joint("ball", JointKind::spherical, "light", "heavy", {0.5, 0, 0}, {0, 0, 1})};
  EXPECT_EQ(named(free).free, (std::vector<std::string>{"a rotation in 'ball'", "a rotation in 'ball'",
                                                        "a rotation in 'ball'", "'heavy' in 6 directions"}));
}

/// Motions that the pre-flight names, with `extra` done to a scene in which `hub` and a block of 1 kg are.
template <class Extra>
std::vector<std::string> undetermined(Extra extra) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.virtual_bodies = formats::VirtualBodies::keep;
  scene.bodies.push_back(block("block", 1.0, {1, 0, 0}));
  scene.bodies.push_back(hub_at({0, 0, 0}));
  extra(scene);
  Simulation run(scene, {});
  evaluate(run.model(), run.state(), run.workspace.now);
  return undetermined_motions(run.model(), run.state(), run.workspace.now);
}

// The violations that [GA00] section 4 is about: a virtual body on a hinge, between balls, on nothing.
TEST(UndeterminedMotion, OfAMasslessBodyIsNamed) {
  EXPECT_THAT(undetermined([](formats::Scene&) {}), ElementsAre("'hub' moves freely"));
  EXPECT_THAT(undetermined([](formats::Scene& scene) {
                scene.joints.push_back(joint("hinge", JointKind::revolute, "block", "hub", {0, 0, 0}, {0, 0, 1}));
              }),
              ElementsAre("'hub' can turn about [0, 0, 1]"));
  EXPECT_THAT(undetermined([](formats::Scene& scene) {
                for (const double x : {0.0, 0.5})
                  scene.joints.push_back(
                      joint("ball" + std::to_string(x), JointKind::spherical, "block", "hub", {x, x, 0}, {0, 0, 1}));
              }),
              ElementsAre("'hub' can turn about [0.707, 0.707, 0]"));
  EXPECT_THAT(undetermined([](formats::Scene& scene) {
                scene.joints.push_back(joint("rail", JointKind::prismatic, "block", "hub", {0, 0, 0}, {0, 1, 0}));
              }),
              ElementsAre("'hub' can move along [0, 1, 0]"));
}

TEST(UndeterminedMotion, IsNoneWhereATieOrASpringHolds) {
  EXPECT_TRUE(undetermined([](formats::Scene& scene) {
                scene.joints.push_back(joint("tie", JointKind::fixed, "block", "hub", {0, 0, 0}, {0, 0, 1}));
              }).empty());
  EXPECT_TRUE(undetermined([](formats::Scene& scene) {
                scene.joints.push_back(joint("hinge", JointKind::revolute, "block", "hub", {0, 0, 0}, {0, 0, 1}));
                formats::SpringSpec spring;
                spring.name = "spring";
                spring.coordinate = formats::CoordinateRef{"hinge", ""};
                spring.stiffness = 3.0;
                scene.springs.push_back(spring);
              }).empty());
}

TEST(UndeterminedMotion, IsAnErrorAtTheStart) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.push_back(block("block", 1.0, {1, 0, 0}));
  scene.bodies.push_back(hub_at({0, 0, 0}));
  scene.joints.push_back(joint("hinge", JointKind::revolute, "block", "hub", {0, 0, 0}, {1, 0, 0}));
  Simulation run(scene, {});
  try {
    run.start();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("'hub' can turn about [1, 0, 0]"));
  }
}

TEST(Groups, AreWhatJointsAndSpringsConnect) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  for (int i = 0; i < 5; ++i) scene.bodies.push_back(block("b" + std::to_string(i), 1.0, Vector3d(i, 0, 0)));
  scene.joints = {joint("j0", JointKind::revolute, "ground", "b0", {0, 0, 0}, {0, 0, 1}),
                  joint("j1", JointKind::spherical, "b2", "b3", {2, 0, 0}, {0, 0, 1})};
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.a.node = "b0";
  spring.b.node = "b1";
  spring.stiffness = 1.0;
  scene.springs.push_back(spring);
  EXPECT_THAT(examined(scene, {}).groups, ::testing::UnorderedElementsAre(ElementsAre("ground", "b0", "b1"),
                                                                          ElementsAre("b2", "b3"), ElementsAre("b4")));
}

TEST(Gaps, OfAllOpenJointsAreMeasured) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  for (const double x : {0.0, 1.0}) {
    const std::string name = x == 0.0 ? "left" : "right";
    scene.bodies.push_back(block(name, 1.0, {x, 0, 0}));
    formats::JointSpec hinge = joint("hinge_" + name, JointKind::revolute, "ground", name, {x, 0, 0}, {0, 0, 1});
    hinge.b.position = Vector3d(0.03 * x, 0.04 * x, 0);
    scene.joints.push_back(hinge);
  }
  scene.joints[0].axis.reset();
  scene.joints[0].a.orientation = Eigen::Quaterniond::Identity();
  scene.joints[0].b.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.02, Vector3d::UnitX()));
  const Preflight preflight = examined(scene, {});
  ASSERT_EQ(preflight.gaps.size(), 2u);
  EXPECT_EQ(preflight.gaps[0].joint, "hinge_left");
  EXPECT_NEAR(preflight.gaps[0].length, 0.0, 1e-15);
  EXPECT_NEAR(preflight.gaps[0].angle, std::sin(0.02), 1e-12);
  EXPECT_NEAR(preflight.gaps[1].length, 0.05, 1e-12);
  Simulation run(scene, {});
  try {
    run.start();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("'hinge_left' by"));
    EXPECT_THAT(error.what(), HasSubstr("'hinge_right' by 0.05"));
  }
}

TEST(Doubts, AreRaisedByMassesAndInertias) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.push_back(block("heavy", 1e8, {0, 0, 0}));
  scene.bodies.push_back(block("light", 1e-6, {1, 0, 0}));
  EXPECT_THAT(examined(scene, {}).doubts,
              ElementsAre(HasSubstr("the masses of 'heavy' (1e+08) and 'light' (1e-06) differ")));
  formats::RigidBodySpec& light = std::get<formats::RigidBodySpec>(scene.bodies[1]);
  light.mass = 1e-3;
  light.inertia = Vector3d(1e4, 1e4, 0.0).asDiagonal();
  EXPECT_THAT(examined(scene, {}).doubts, ElementsAre(HasSubstr("'light' has no inertia about one")));
}

}  // namespace
}  // namespace tisserand::mechanism::preflight_test
