// SPDX-License-Identifier: GPL-3.0-or-later
// What leaves the plane of a planar scene is named with its value.
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "tests/support/scenes/planar_scenes.hpp"

namespace tisserand::mechanism::planar_errors_test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::JointKind;
using test_support::flexible_slider_crank;
using test_support::modal_rod_files;
using test_support::modal_slider_crank;
using test_support::rigid_slider_crank;
using test_support::rod_files;
using test_support::upright;
using test_support::with_planar;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string error_of(const formats::Scene& scene, const BodyFiles& files = {}) {
  try {
    (void)build_model(with_planar(scene), files);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

std::string error_after(const std::function<void(formats::Scene&)>& change) {
  formats::Scene scene = rigid_slider_crank(upright).scene;
  change(scene);
  return error_of(scene);
}

formats::RigidBodySpec& body_of_scene(formats::Scene& scene, std::size_t i) {
  return std::get<formats::RigidBodySpec>(scene.bodies[i]);
}

TEST(PlanarErrors, WhatLeavesThePlaneIsNamed) {
  EXPECT_EQ(error_after([](formats::Scene&) {}), "");
  EXPECT_THAT(error_after([](formats::Scene& s) {
                s.gravity = {0, -9.81, 0.5};
              }),
              AllOf(HasSubstr("scene.yaml:3:5"), HasSubstr("gravity of body 'crank' has a component of 0.5"),
                    HasSubstr("planar: off")));
  EXPECT_THAT(error_after([](formats::Scene& s) {
                body_of_scene(s, 1).inertia(0, 2) = body_of_scene(s, 1).inertia(2, 0) = 1e-3;
              }),
              AllOf(HasSubstr("inertia of body 'rod'"), HasSubstr("0.001"), HasSubstr("products of inertia")));
  EXPECT_THAT(error_after([](formats::Scene& s) {
                body_of_scene(s, 2).start.velocity = {-0.6, 0, 0.1};
              }),
              HasSubstr("velocity of body 'slider' has a component of 0.1"));
  EXPECT_THAT(error_after([](formats::Scene& s) {
                body_of_scene(s, 0).start.angular_velocity = {0, 0.2, 3};
              }),
              HasSubstr("angular velocity of body 'crank' has a component of 0.2"));
  EXPECT_THAT(error_after([](formats::Scene& s) { s.joints[1].axis = Vector3d(0, 0.1, 1); }), HasSubstr("joint 'pin'"));
  EXPECT_THAT(error_after([](formats::Scene& s) { s.joints[3].axis = Vector3d(1, 0, 0.1); }),
              HasSubstr("joint 'guide'"));
  EXPECT_THAT(error_after([](formats::Scene& s) { s.joints[1].position = Vector3d(0, 0.2, 0.03); }),
              AllOf(HasSubstr("joint 'pin'"), HasSubstr("0.03")));
  EXPECT_THAT(error_after([](formats::Scene& s) { s.loads[1].components[2] = 2.0; }),
              AllOf(HasSubstr("force 'pull'"), HasSubstr("2")));
  EXPECT_THAT(error_after([](formats::Scene& s) {
                s.loads[1].components[2] = formats::TimeExpression{"0 * t", {}, "h"};
              }),
              AllOf(HasSubstr("component z of force 'pull' varies, and 1 of it acts out of the plane"),
                    HasSubstr("the number 0")));
  EXPECT_THAT(error_after([](formats::Scene& s) { s.loads[2].components[0] = 1.0; }), HasSubstr("moment 'twist'"));
}

// A coordinate out of the plane is not in the model: neither its value nor its rate would be the one that is given.
TEST(PlanarErrors, InitialValuesOutOfThePlaneAreNamed) {
  EXPECT_THAT(error_after([](formats::Scene& s) {
                s.joints[1].kind = JointKind::cylindrical;
                formats::InitialSpec spec;
                spec.coordinate = {"pin/z", ""};
                spec.value = 0.1;
                s.initial = {spec};
              }),
              AllOf(HasSubstr("initial 'pin/z'"), HasSubstr("planar: off")));
}

// Gyroscopic and centrifugal terms of such a turn push out of the plane.
TEST(PlanarErrors, SteadyRotationsAboutAnAxisInThePlaneAreNamed) {
  EXPECT_THAT(error_after([](formats::Scene& s) {
                s.analysis = formats::AnalysisKind::modes;
                s.modes.rotation = Vector3d(20, 0, 0);
              }),
              HasSubstr("modes: rotation has a component of 20"));
  EXPECT_THAT(error_after([](formats::Scene& s) {
                s.analysis = formats::AnalysisKind::statics;
                s.statics.rotation = formats::RotationSpec{{0, 1e-6, 20}, Vector3d::Zero()};
              }),
              HasSubstr("statics: the angular velocity has a component of 1e-06"));
  EXPECT_EQ(error_after([](formats::Scene& s) {
              s.analysis = formats::AnalysisKind::modes;
              s.modes.rotation = Vector3d(0, 0, 20);
            }),
            "");
}

TEST(PlanarErrors, TyresThatPullOutOfThePlaneAreNamed) {
  const auto error_of_wheel = [](const std::function<void(formats::Scene&)>& change) {
    formats::Scene scene = test_support::braked_wheel(upright, std::nullopt, true).scene;
    change(scene);
    return error_of(scene);
  };
  EXPECT_EQ(error_of_wheel([](formats::Scene&) {}), "");
  EXPECT_THAT(error_of_wheel([](formats::Scene& s) { s.tyres[0].axis = Vector3d(0.1, 0, -1); }),
              HasSubstr("the axle of tyre"));
  EXPECT_THAT(error_of_wheel([](formats::Scene& s) {
                s.tyres[0].wheel.position = {0, 0.2, 0};
              }),
              AllOf(HasSubstr("tyre 'tyre0' rolls"), HasSubstr("0.2 away from the plane")));
  EXPECT_THAT(error_of_wheel([](formats::Scene& s) {
                s.roads[0].pose.orientation =
                    s.roads[0].pose.orientation * Quaterniond(Eigen::AngleAxisd(0.1, Vector3d::UnitX()));
              }),
              HasSubstr("the normal of road 'road'"));
  EXPECT_THAT(error_of_wheel([](formats::Scene& s) {
                s.roads[0].transition = 0.5;
                s.roads[0].right = s.roads[0].left;
              }),
              HasSubstr("away from the middle of road 'road'"));
}

TEST(PlanarErrors, ModalBodiesThatLeaveThePlaneAreNamed) {
  formats::Scene scene = modal_slider_crank(upright).scene;
  BodyFiles files = modal_rod_files(6);
  formats::ModalBody& rod = files.modal_bodies["rod"].body;
  rod.integrals.P1[5] += 1e-3;  // zy of the first mode
  EXPECT_THAT(error_of(scene, files), AllOf(HasSubstr("modal body 'rod'"), HasSubstr("out of the plane")));
  BodyFiles beside = modal_rod_files(6);
  beside.modal_bodies["rod"].body.node_position(4, 2) = 0.05;
  scene.joints.pop_back();
  scene.loads = {test_support::constant_load("push", formats::LoadKind::force, "rod/n4", {0, 1, 0})};
  EXPECT_THAT(error_of(scene, beside), AllOf(HasSubstr("load 'push' is on node 'n4'"), HasSubstr("0.05 away from")));
}

TEST(PlanarErrors, ASuperelementThatBendsOutOfThePlaneIsNamed) {
  formats::Scene scene = flexible_slider_crank(upright, formats::InertiaOption::B).scene;
  auto& rod = std::get<formats::SuperelementBodySpec>(scene.bodies[1]);
  // Unequal second moments, turned about the axis of the beam: bending in the plane bends it out of it.
  rod.start.pose.orientation = Quaterniond(Eigen::AngleAxisd(0.3, Vector3d::UnitX()));
  EXPECT_THAT(error_of(scene, rod_files(4)),
              AllOf(HasSubstr("superelement 'rod'"), HasSubstr("couples motion in the plane")));
}

}  // namespace
}  // namespace tisserand::mechanism::planar_errors_test
