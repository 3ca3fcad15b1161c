// SPDX-License-Identifier: GPL-3.0-or-later
// What a flexible body swings with, whatever kind of body it is: scenes of runs that switch effects by themselves.
#pragma once

#include <string>

#include "tests/support/scenes/scenes.hpp"

namespace tisserand::test_support {

/// The body of the scene, 2 long along x from the origin, on a hinge about z at its `first` node that a moment turns
/// from t = 0.1 to 0.4, with a bob on a ball joint at its `last`.
inline void hang(formats::Scene& scene, const std::string& first, const std::string& last, double moment) {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  formats::RigidBodySpec bob = rigid_body("bob", 1.0, Eigen::Vector3d::Zero(), {0.01, 0.01, 0.01});
  bob.start.pose.position = {2, 0, 0};
  scene.bodies.emplace_back(bob);
  scene.joints = {joint("hinge", formats::JointKind::revolute, "ground", first, Eigen::Vector3d::Zero(), z),
                  joint("ball", formats::JointKind::spherical, last, "bob", {2, 0, 0}, z)};
  formats::SpringSpec motor;
  motor.name = "motor";
  motor.coordinate = formats::CoordinateRef{"hinge", ""};
  motor.force = formats::TimeTable{{0.0, 0.1, 0.2, 0.3, 0.4, 1.2}, {0.0, 0.0, moment, moment, 0.0, 0.0}};
  scene.springs = {motor};
}

}  // namespace tisserand::test_support
