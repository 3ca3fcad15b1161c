// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies, joints and forces of the scenes.
#include "tests/support/scenes/planar_scenes.hpp"

#include <cmath>
#include <numbers>

#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/bodies/modal_known_answers.hpp"
#include "tests/support/scenes/second_order_scenes.hpp"
#include "tests/support/scenes/wheels.hpp"

namespace tisserand::test_support {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Effect;
using formats::JointKind;

TurnedScene::TurnedScene(const Quaterniond& turn) : q(turn), scene(empty_scene(1e-3, 0.2)) {
  scene.gravity = vector({0, -9.81, 0});
  scene.integrator.tolerance = 1e-12;
  scene.integrator.constraint_tolerance = 1e-13;
}

void TurnedScene::add(formats::BodySpec body, const Vector3d& position, double angle, const Vector3d& velocity,
                      double omega) {
  std::visit(
      [&](auto& spec) {
        spec.start.pose.position = vector(position);
        spec.start.pose.orientation = q * Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
        spec.start.velocity = vector(velocity);
        spec.start.angular_velocity = vector({0, 0, omega});
      },
      body);
  scene.bodies.push_back(std::move(body));
}

void TurnedScene::hinge(const std::string& name, const std::string& a, const std::string& b, const Vector3d& at) {
  scene.joints.push_back(joint(name, JointKind::revolute, a, b, vector(at), vector({0, 0, 1})));
}

void TurnedScene::slide(const std::string& name, const std::string& b, const Vector3d& at) {
  scene.joints.push_back(joint(name, JointKind::prismatic, "ground", b, vector(at), vector({1, 0, 0})));
  scene.joints.back().x_axis = vector({0, 1, 0});
}

formats::EffectSwitch planar(bool on) { return {Effect::planar, "", on, "scene.yaml:3:5"}; }

formats::Scene with_planar(formats::Scene scene) {
  scene.effects.push_back(planar(true));
  return scene;
}

TurnedScene rigid_slider_crank(const Quaterniond& q) {
  TurnedScene t(q);
  t.add(rigid_body("crank", 1.0, {0.1, 0.02, 0}, {0.01, 0.02, 0.03}), {0, 0, 0}, 0.5 * std::numbers::pi, {0, 0, 0},
        3.0);
  const double angle = -std::asin(0.2 / 0.5);
  t.add(rigid_body("rod", 2.0, {0.25, 0, 0}, {0.01, 0.05, 0.06}), {0, 0.2, 0}, angle, {-0.6, 0, 0}, 0.0);
  const double reach = std::sqrt(0.25 - 0.04);
  t.add(rigid_body("slider", 0.5, {0, 0, 0}, {0.01, 0.01, 0.01}), {reach, 0, 0}, 0.0, {-0.6, 0, 0}, 0.0);
  t.hinge("main", "ground", "crank", {0, 0, 0});
  t.hinge("pin", "crank", "rod", {0, 0.2, 0});
  t.hinge("wrist", "rod", "slider", {reach, 0, 0});
  t.slide("guide", "slider", {reach, 0, 0});
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.coordinate = formats::CoordinateRef{"guide", ""};
  spring.stiffness = 200.0;
  spring.damping = 3.0;
  t.scene.springs.push_back(spring);
  formats::LoadSpec push = constant_load("push", formats::LoadKind::force, "rod", {0, -5, 0});
  push.axes = formats::LoadAxes::body;
  push.components[0] = formats::TimeExpression{"3 * sin(20 * t)", {}, "here"};
  formats::LoadSpec pull = constant_load("pull", formats::LoadKind::force, "slider", t.vector({4, 1, 0}));
  formats::LoadSpec twist = constant_load("twist", formats::LoadKind::moment, "crank", t.vector({0, 0, 0.3}));
  t.scene.loads = {push, pull, twist};
  return t;
}

TurnedScene flexible_slider_crank(const Quaterniond& q, formats::InertiaOption inertia) {
  TurnedScene t(q);
  t.scene.integrator.step = 5e-4;
  t.scene.integrator.end = 0.05;
  t.add(rigid_body("crank", 1.0, {0, 0, 0}, {0.02, 0.02, 0.02}), {0, 0, 0}, 0.0, {0, 0, 0}, 30.0);
  formats::SuperelementBodySpec rod = superelement_body("rod", "rod");
  rod.inertia = inertia;
  rod.damping.ratio = 0.01;
  t.add(rod, {0.3, 0, 0}, 0.0, {0, 9, 0}, -4.5);
  t.hinge("main", "ground", "crank", {0, 0, 0});
  t.scene.joints.push_back(
      joint("pin", JointKind::spherical, "crank", "rod/base", t.vector({0.3, 0, 0}), q * Vector3d::UnitZ()));
  formats::JointSpec guide =
      joint("guide", JointKind::generic, "ground", "rod/tip", t.vector({2.3, 0, 0}), q * Vector3d::UnitZ());
  guide.x_axis = t.vector({1, 0, 0});
  guide.hold = {false, true, true, true, false, false};
  t.scene.joints.push_back(guide);
  t.scene.motions.push_back(drive("main", "30 * t + 40 * t^2"));
  return t;
}

mechanism::BodyFiles rod_files(int modes) {
  mechanism::BodyFiles files;
  add_file("rod", craig_bampton_beam({}, modes), files.superelements);
  return files;
}

TurnedScene spin_up(const Quaterniond& q) {
  TurnedScene t(q);
  t.scene.integrator.step = 2e-3;
  t.scene.integrator.end = 0.2;
  t.add(superelement_body("beam", "beam"), {0, 0, 0}, 0.0, {0, 0, 0}, 0.0);
  t.hinge("root", "ground", "beam/n0", {0, 0, 0});
  t.scene.motions.push_back(drive("root", "10 * t^2"));
  return t;
}

TurnedScene modal_slider_crank(const Quaterniond& q) {
  TurnedScene t = flexible_slider_crank(q, formats::InertiaOption::M);
  formats::ModalBodySpec rod = modal_spec("rod", "rod");
  rod.start = std::get<formats::SuperelementBodySpec>(t.scene.bodies[1]).start;
  rod.damping.ratio = 0.01;
  t.scene.bodies[1] = rod;
  t.scene.joints[1].b.node = "rod/n0";
  t.scene.joints[2].b.node = "rod/n4";
  return t;
}

mechanism::BodyFiles modal_rod_files(int modes) {
  const Rod rod{.length = 2.0, .area = 1e-4, .E = 7e10, .G = 2.7e10, .I = 1e-9, .density = 2700, .elements = 4};
  mechanism::BodyFiles files;
  files.modal_bodies["rod"].body = modal_body(lumped_rod(rod), rod_conditions(4), modes);
  return files;
}

TurnedScene braked_wheel(const Quaterniond& q, std::optional<double> relaxation, bool bump) {
  TurnedScene t(q);
  const formats::Scene wheel = wheel_on_slope(0.05, 5.0, false);
  const Quaterniond turn = q * Quaterniond(Eigen::AngleAxisd(-0.5 * std::numbers::pi, Vector3d::UnitX()));  // z to y
  t.scene.integrator.end = 0.3;
  t.scene.bodies = wheel.bodies;
  auto& start = std::get<formats::RigidBodySpec>(t.scene.bodies[0]).start;
  start.pose.position = turn * start.pose.position;
  start.pose.orientation = turn;
  start.velocity = turn * *start.velocity;
  start.angular_velocity = turn * Vector3d(0, 5.0 / Wheel::radius, 0);
  t.scene.joints.push_back(
      joint("guide", JointKind::planar, "ground", "wheel", start.pose.position, turn * Vector3d::UnitY()));
  t.scene.roads = wheel.roads;
  t.scene.roads[0].pose.orientation = turn * t.scene.roads[0].pose.orientation;
  if (bump) {
    t.scene.roads[0].kind = formats::RoadKind::profile;
    t.scene.roads[0].left = {{formats::RoadPieceShape::cosine, 0.3, 0.8, 0.03, 0.0, {}}};
  }
  t.scene.tyres = wheel.tyres;
  t.scene.tyres[0].relaxation_length = relaxation;
  t.scene.loads = {constant_load("brake", formats::LoadKind::moment, "wheel", turn * Vector3d(0, -60, 0))};
  return t;
}

mechanism::BodyFiles second_order_files() {
  const auto beam = bernoulli_beam(slender_section(1e5), 2.0, 8);
  return files_of(second_order_beam(beam, {0, 4, 8}, 6));
}

}  // namespace tisserand::test_support
