// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies, guides and tyres of the scenes.
#include "tests/support/scenes/wheels.hpp"

#include <cmath>

namespace tisserand::test_support {

using Eigen::Vector3d;
using formats::JointKind;

namespace {

constexpr double g = Wheel::gravity, mass = Wheel::mass, inertia = Wheel::inertia, stiffness = Wheel::stiffness,
                 radius = Wheel::radius;

}  // namespace

formats::TyreSpec tyre_on(const std::string& node, const Vector3d& position) {
  formats::TyreSpec tyre;
  tyre.name = "tyre" + std::to_string(static_cast<int>(std::lround(1e3 * (position.x() + 10.0 * position.y()))));
  tyre.wheel.node = node;
  tyre.wheel.position = position;
  tyre.road = "road";
  tyre.radius = radius;
  tyre.stiffness = stiffness;
  tyre.damping = 500.0;
  tyre.slip_stiffness = 80e3;
  tyre.cornering_stiffness = 60e3;
  tyre.camber_stiffness = 3e3;
  tyre.friction = 0.8;
  tyre.low_speed = 0.1;
  return tyre;
}

formats::RoadSpec slope(double angle) {
  formats::RoadSpec road;
  road.name = "road";
  road.pose.orientation = Eigen::AngleAxisd(angle, Vector3d::UnitY());
  return road;
}

formats::Scene wheel_on_slope(double angle, double speed, bool locked) {
  formats::Scene scene = empty_scene(2e-3, 10.0);
  scene.gravity = {0, 0, -g};
  const Eigen::Quaterniond down(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
  formats::RigidBodySpec wheel = rigid_body("wheel", mass, {0, 0, 0}, {0.9, inertia, 0.9});
  wheel.start.pose.position = down * Vector3d(0, 0, radius - mass * g * std::cos(angle) / stiffness);
  wheel.start.velocity = down * Vector3d(speed, 0, 0);
  wheel.start.angular_velocity = Vector3d::Zero();
  scene.bodies.push_back(wheel);
  formats::JointSpec guide = joint("guide", locked ? JointKind::generic : JointKind::planar, "ground", "wheel",
                                   wheel.start.pose.position, locked ? Vector3d::UnitZ() : Vector3d::UnitY());
  if (locked) {
    guide.x_axis = Vector3d::UnitX();
    guide.hold = {false, true, false, true, true, true};
  }
  scene.joints.push_back(guide);
  scene.roads.push_back(slope(angle));
  scene.tyres.push_back(tyre_on("wheel", Vector3d::Zero()));
  return scene;
}

formats::Scene block_car(double height) {
  formats::Scene scene = empty_scene(1e-3, 10.0);
  scene.gravity = {0, 0, -g};
  formats::RigidBodySpec car = rigid_body("car", 980.0, {-1.308, 0, 0.45}, {300, 1100, 1200});
  car.start.pose.position.z() = height;
  scene.bodies.push_back(car);
  scene.roads.push_back(slope(0.0));
  for (const double side : {1.0, -1.0}) {
    scene.tyres.push_back(tyre_on("car", {0, side * 0.715, 0.3}));
    scene.tyres.push_back(tyre_on("car", {-2.18, side * 0.73, 0.3}));
  }
  return scene;
}

}  // namespace tisserand::test_support
