// SPDX-License-Identifier: GPL-3.0-or-later
// Effects that a scene switches: what is off is not in the model, what is not there is an error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "mechanism/build/effects.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/second_order_scenes.hpp"

namespace tisserand::mechanism::effects_test {
namespace {

using Eigen::Vector3d;
using formats::Effect;
using formats::JointKind;
using test_support::Simulation;
using ::testing::AllOf;
using ::testing::HasSubstr;

formats::EffectSwitch off(Effect effect, const std::string& body = "") { return {effect, body, false, "switch"}; }
formats::EffectSwitch on(Effect effect, const std::string& body = "") { return {effect, body, true, "switch"}; }

formats::Section bar() {
  formats::Section section;
  section.name = "bar";
  section.area = 1e-4;
  section.second_moment_y = section.second_moment_z = 1e-9;
  section.torsion_constant = section.polar_moment = 2e-9;
  section.shear_area_y = section.shear_area_z = 8e-5;
  return section;
}

formats::BeamBodySpec beam(const std::string& name) {
  formats::BeamBodySpec spec;
  spec.name = name;
  spec.to = {1, 0, 0};
  spec.elements = 2;
  spec.section = bar();
  spec.material.youngs_modulus = 2e11;
  spec.material.poisson_ratio = 0.3;
  spec.material.density = 8000;
  return spec;
}

/// A block that slides with friction and a stop, a damped superelement and a beam, under gravity.
formats::Scene mixed_scene() {
  formats::Scene scene = test_support::empty_scene(1e-3, 0.1);
  scene.gravity = {0, -9.81, 0};
  formats::RigidBodySpec block = test_support::rigid_body("block", 2.0, Vector3d::Zero(), {0.01, 0.02, 0.03});
  block.start.velocity = Vector3d(1, 0, 0);
  scene.bodies.emplace_back(block);
  formats::SuperelementBodySpec arm = test_support::superelement_body("arm", "bar");
  arm.damping.ratio = 0.01;
  arm.start.pose.position = {0, 5, 0};
  scene.bodies.emplace_back(arm);
  formats::BeamBodySpec rod = beam("rod");
  rod.start.pose.position = {0, 10, 0};
  scene.bodies.emplace_back(rod);
  scene.joints = {test_support::joint("slide", JointKind::prismatic, "ground", "block", Vector3d::Zero(), {1, 0, 0}),
                  test_support::joint("hinge", JointKind::revolute, "ground", "arm/base", {0, 5, 0}, {0, 0, 1}),
                  test_support::joint("clamp", JointKind::fixed, "ground", "rod/start", {0, 10, 0}, {0, 0, 1})};
  scene.joints[0].friction = formats::FrictionSpec{0.2, std::nullopt, 1e-3, 0.0, std::nullopt};
  formats::SpringSpec stop;
  stop.name = "stop";
  stop.coordinate = formats::CoordinateRef{"slide", ""};
  stop.upper = 0.05;
  stop.stop_stiffness = 1e4;
  scene.springs = {stop};
  return scene;
}

BodyFiles mixed_files() {
  BodyFiles files;
  test_support::add_file("bar", test_support::beam_superelement({}), files.superelements);
  return files;
}

Model model_of(formats::Scene scene, const std::vector<formats::EffectSwitch>& switches, const BodyFiles& files) {
  scene.effects = switches;
  return build_model(scene, files).model;
}

std::string error_of(formats::Scene scene, const std::vector<formats::EffectSwitch>& switches, const BodyFiles& files) {
  try {
    (void)model_of(std::move(scene), switches, files);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(Effects, WhatIsOffIsNotInTheModel) {
  const BodyFiles files = mixed_files();
  const formats::Scene scene = mixed_scene();
  const Model whole = model_of(scene, {}, files);
  ASSERT_EQ(whole.frictions.size(), 1U);
  ASSERT_TRUE(whole.springs[0].upper.has_value());
  ASSERT_TRUE(whole.superelement_bodies[0].damping.active);
  ASSERT_GT(whole.superelement_bodies[0].damping.BB.size(), 0);
  ASSERT_GT(whole.beams2[0].inertia[0].norm(), 0.0);

  const Model bare = model_of(scene,
                              {off(Effect::friction), off(Effect::stops), off(Effect::gravity), off(Effect::damping),
                               off(Effect::rotary_inertia, "rod"), off(Effect::gyroscopic, "block")},
                              files);
  EXPECT_TRUE(bare.frictions.empty());
  EXPECT_FALSE(bare.springs[0].upper.has_value());
  EXPECT_FALSE(bare.superelement_bodies[0].damping.active);
  EXPECT_EQ(bare.superelement_bodies[0].damping.BB.size(), 0);
  EXPECT_FALSE(bare.beams2[0].rotary);
  EXPECT_EQ(bare.beams2[0].inertia[0].norm(), 0.0);
  EXPECT_FALSE(bare.rigid_bodies[0].gyroscopic);
  for (const Vector3d& gravity : {bare.rigid_bodies[0].gravity, bare.superelements[0].gravity, bare.beams2[0].gravity})
    EXPECT_EQ(gravity.norm(), 0.0);
  // no new entry
  EXPECT_LE(bare.pattern->nonzeros(), whole.pattern->nonzeros());
}

// A superelement with both nodes has 12 coordinates, a rigid body 6.
TEST(Effects, FlexibilityOffLeavesARigidBodyOfTheSameMass) {
  const BodyFiles files = mixed_files();
  const Model whole = model_of(mixed_scene(), {}, files);
  const Model rigid = model_of(mixed_scene(), {off(Effect::flexibility, "arm"), off(Effect::damping)}, files);
  EXPECT_TRUE(rigid.superelements.empty());
  EXPECT_TRUE(rigid.superelement_bodies.empty());
  EXPECT_EQ(rigid.sizes.boundary, whole.sizes.boundary - 6);
  ASSERT_EQ(rigid.rigid_bodies.size(), 2U);
  EXPECT_EQ(rigid.rigid_bodies[1].name, "arm");
  EXPECT_DOUBLE_EQ(rigid.rigid_bodies[1].mass, 7800.0 * 4e-4 * 2.0);  // of BeamData
  EXPECT_EQ(rigid.rigid_bodies[1].gravity, whole.superelements[0].gravity);
}

TEST(Effects, StiffeningOffKeepsTheInertiaOfTheCompanion) {
  const auto beam = test_support::bernoulli_beam(test_support::slender_section(1e4), 1.0, 4);
  const BodyFiles files = test_support::files_of(test_support::second_order_beam(beam, {0, 4}, 2));
  formats::Scene scene = test_support::empty_scene(1e-3, 0.1);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  const Model whole = model_of(scene, {}, files), linear = model_of(scene, {off(Effect::stiffening)}, files);
  EXPECT_TRUE(whole.superelement_bodies[0].second_order.stiffening.has_value());
  EXPECT_FALSE(linear.superelement_bodies[0].second_order.stiffening.has_value());
  EXPECT_TRUE(linear.superelement_bodies[0].second_order.inertia.has_value());
  EXPECT_EQ(linear.superelement_bodies[0].inertia, formats::InertiaOption::F);
  EXPECT_EQ(effects_text(effects_of(scene, files), false), "flexibility, stiffening");
}

TEST(Effects, OfABodyCountBeforeThoseOfTheScene) {
  const Model model = model_of(mixed_scene(), {on(Effect::gravity, "arm"), off(Effect::gravity)}, mixed_files());
  EXPECT_EQ(model.superelements[0].gravity, Vector3d(0, -9.81, 0));
  EXPECT_EQ(model.rigid_bodies[0].gravity, Vector3d(0, 0, 0));
}

std::vector<double> end_of(formats::Scene scene, const std::vector<formats::EffectSwitch>& switches) {
  scene.effects = switches;
  Simulation run(scene, mixed_files());
  run.start();
  run.run(0.08);  // beyond the stop
  return run.state().block();
}

TEST(Effects, ThatAreOnChangeNoBit) {
  const std::vector<double> given = end_of(mixed_scene(), {});
  EXPECT_EQ(given,
            end_of(mixed_scene(), {on(Effect::friction), on(Effect::stops), on(Effect::gravity), on(Effect::damping),
                                   on(Effect::gyroscopic, "block"), on(Effect::flexibility)}));
  EXPECT_NE(given, end_of(mixed_scene(), {off(Effect::friction)}));
}

// Without weight, friction and stop the block goes on at 1 m/s.
TEST(Effects, OffDoNotAct) {
  formats::Scene scene = mixed_scene();
  scene.effects = {off(Effect::friction), off(Effect::stops), off(Effect::gravity)};
  Simulation run(scene, mixed_files());
  run.start();
  run.run(0.1);
  EXPECT_NEAR(run.position("block").x(), 0.1, 1e-12);
  EXPECT_EQ(run.state().dissipated(), 0.0);
}

// J Ω̇ = 0: the material angular velocity stays, where Euler's equations let it tumble.
TEST(Effects, WithoutTheGyroscopicTermABodySpinsOn) {
  formats::Scene scene = test_support::empty_scene(1e-3, 0.5);
  formats::RigidBodySpec body = test_support::rigid_body("top", 1.0, Vector3d::Zero(), {1, 2, 3});
  const Vector3d spin(3, 4, 5);
  body.start.angular_velocity = spin;
  scene.bodies.emplace_back(body);
  const auto end = [&](const std::vector<formats::EffectSwitch>& switches) {
    scene.effects = switches;
    Simulation run(scene, BodyFiles{});
    run.start();
    run.run(0.5);
    return Vector3d(run.Omega("top"));
  };
  EXPECT_LT((end({off(Effect::gyroscopic)}) - spin).norm(), 1e-12 * spin.norm());
  EXPECT_GT((end({}) - spin).norm(), 0.1 * spin.norm());
}

// T = ½ ρ (Iy + Iz) L ω² of a beam that turns about its own axis.
TEST(Effects, RotaryInertiaIsThatOfTheSections) {
  formats::Scene scene = test_support::empty_scene(1e-3, 0.1);
  formats::BeamBodySpec rod = beam("rod");
  rod.start.angular_velocity = Vector3d(50, 0, 0);
  rod.start.velocity = Vector3d::Zero();
  scene.bodies.emplace_back(rod);
  const auto kinetic = [&](const std::vector<formats::EffectSwitch>& switches) {
    scene.effects = switches;
    Simulation run(scene, BodyFiles{});
    evaluate(run.model(), run.state(), run.workspace.now);
    return evaluate_energy(run.model(), run.workspace.now).kinetic;
  };
  EXPECT_NEAR(kinetic({}), 0.5 * 8000 * 2e-9 * 50 * 50, 1e-14);
  EXPECT_EQ(kinetic({off(Effect::rotary_inertia)}), 0.0);
}

TEST(Effects, ThatAreNotThereAreErrorsWithARemedy) {
  const BodyFiles files = mixed_files();
  const formats::Scene scene = mixed_scene();
  EXPECT_THAT(error_of(scene, {off(Effect::stiffening, "arm")}, files),
              AllOf(HasSubstr("switch: effects: body 'arm' has no stiffening to switch off"),
                    HasSubstr("write a companion file")));
  EXPECT_THAT(error_of(scene, {on(Effect::damping, "block")}, files), HasSubstr("'block' has no damping to switch on"));
  EXPECT_THAT(error_of(scene, {off(Effect::friction, "hinge")}, files),
              AllOf(HasSubstr("joint 'hinge' has no friction to switch off"), HasSubstr("give a joint 'friction'")));
  EXPECT_THAT(error_of(scene, {off(Effect::flexibility)}, files),
              AllOf(HasSubstr("flexibility of body 'rod' cannot be switched"), HasSubstr("make it a rigid body")));
  EXPECT_THAT(
      error_of(scene, {off(Effect::rotary_inertia, "arm")}, files),
      AllOf(HasSubstr("rotary_inertia of body 'arm'"), HasSubstr("`rotary_inertia: off` at the beams of the part")));
  formats::Scene free = scene;
  free.joints[0].friction.reset();
  free.springs.clear();
  free.gravity.setZero();
  EXPECT_THAT(error_of(free, {off(Effect::friction), off(Effect::stops), off(Effect::gravity)}, files),
              AllOf(HasSubstr("nothing in the scene has friction to switch off"), HasSubstr("has stops to switch off"),
                    HasSubstr("has gravity to switch off"), HasSubstr("give the scene or the body 'gravity'")));
}

// `auto` of the scene stays off bodies that cannot be switched; where there is no other, it would do nothing.
TEST(Effects, AutoOfTheSceneNeedsABodyThatCanBeSwitched) {
  const formats::EffectSwitch automatic{Effect::flexibility, "", true, "switch", true};
  EXPECT_EQ(error_of(mixed_scene(), {automatic}, mixed_files()), "");
  formats::Scene scene = test_support::empty_scene(1e-3, 0.1);
  scene.bodies.emplace_back(beam("rod"));
  EXPECT_THAT(error_of(scene, {automatic}, {}),
              AllOf(HasSubstr("flexibility of body 'rod' cannot be switched"), HasSubstr("make it a rigid body")));
  EXPECT_EQ(error_of(scene, {on(Effect::flexibility)}, {}), "");
}

TEST(Effects, FrictionAndStopsAreOfOneJointAndOneSpring) {
  formats::Scene scene = mixed_scene();
  scene.joints[1].friction = formats::FrictionSpec{0.2, std::nullopt, 1e-3, 0.01, std::nullopt};
  scene.springs.push_back(scene.springs[0]);
  scene.springs[1].name = "buffer";
  const BodyFiles files = mixed_files();
  const Model all = model_of(scene, {}, files);
  ASSERT_EQ(all.frictions.size(), 2U);
  const Model one = model_of(scene, {off(Effect::friction, "slide"), off(Effect::stops, "buffer")}, files);
  ASSERT_EQ(one.frictions.size(), 1U);
  EXPECT_EQ(one.frictions[0].radius, 0.01);
  EXPECT_TRUE(one.springs[0].upper.has_value());
  EXPECT_FALSE(one.springs[1].upper.has_value());
  EXPECT_EQ(model_of(scene, {off(Effect::friction), on(Effect::friction, "hinge")}, files).frictions.size(), 1U);
  scene.effects = {off(Effect::friction, "slide"), off(Effect::stops)};
  EXPECT_THAT(effects_text(effects_of(scene, files), false),
              HasSubstr("gravity, friction; off: friction of 'slide', stops"));
}

TEST(Effects, AreReportedWithWhatIsOff) {
  formats::Scene scene = mixed_scene();
  const BodyFiles files = mixed_files();
  EXPECT_EQ(effects_text(effects_of(scene, files), false),
            "flexibility, rotary_inertia, gyroscopic, damping, gravity, friction, stops");
  scene.effects = {off(Effect::friction), off(Effect::gravity, "arm")};
  EXPECT_EQ(effects_text(effects_of(scene, files), false),
            "flexibility, rotary_inertia, gyroscopic, damping, gravity, stops; off: gravity of 'arm', friction");
  EXPECT_THAT(effects_text(effects_of(scene, files), true), HasSubstr("stops, planar; off: "));
}

}  // namespace
}  // namespace tisserand::mechanism::effects_test
