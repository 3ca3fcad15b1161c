// SPDX-License-Identifier: GPL-3.0-or-later
// Loads, springs, bushings, drives, stops, friction, gears and load cases of the cells.
#include "tests/support/crossings/actions.hpp"

#include <algorithm>

#include "tests/support/scenes/scenes.hpp"

namespace tisserand::test_support::crossings {

using Eigen::Vector3d;
using formats::CoordinateRef;
using formats::JointKind;
using formats::Scene;
using formats::TimeExpression;
using formats::TimeTable;

namespace {

formats::LoadSpec load(const std::string& name, formats::LoadKind kind, const std::string& node,
                       formats::LoadAxes axes) {
  formats::LoadSpec spec;
  spec.name = name;
  spec.kind = kind;
  spec.at.node = node;
  spec.axes = axes;
  spec.components = {0.0, 0.0, 0.0};
  return spec;
}

void add_world_loads(const Ingredients& in, Scene& scene) {
  formats::LoadSpec force = load("push", formats::LoadKind::force, tip_node(in.arm), formats::LoadAxes::world);
  force.components = {TimeExpression{"3*sin(20*t) + 1", {}, ""}, -2.0, TimeExpression{"1e1*t", {0.05}, ""}};
  formats::LoadSpec moment = load("twist", formats::LoadKind::moment, "bob/hook", formats::LoadAxes::world);
  moment.components = {0.2, TimeExpression{"0.3*cos(15*t)", {}, ""}, -0.1};
  scene.loads = {force, moment};
}

void add_following_loads(const Ingredients& in, Scene& scene) {
  formats::LoadSpec force = load("push", formats::LoadKind::force, "bob/hook", formats::LoadAxes::body);
  force.at.position = Vector3d(0.05, 0.02, -0.1);
  force.at.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Vector3d(1, 2, 0.5).normalized()));
  force.components = {TimeExpression{"2*sin(20*t) + 1", {}, ""}, -1.5, 0.5};
  formats::LoadSpec moment = load("twist", formats::LoadKind::moment, tip_node(in.arm), formats::LoadAxes::body);
  moment.components = {0.2, TimeTable{{0.0, 0.05, 0.09}, {0.1, 0.5, -0.2}}, -0.1};
  scene.loads = {force, moment};
}

void add_line_spring(const Ingredients& in, Scene& scene) {
  formats::SpringSpec spring;
  spring.name = "strut";
  spring.a = {"ground", tip_place(in.arm) + Vector3d(0.3, 0.4, -0.2), {}, ""};
  spring.b = {"bob", Vector3d(0.1, 0.0, 0.05), {}, ""};
  formats::CurveSpec law;
  law.interpolation = formats::Interpolation::cubic;
  law.x = {-0.2, -0.05, 0.02, 0.1};
  law.y = {-30.0, -5.0, 2.0, 25.0};
  spring.stiffness = law;
  spring.damping = formats::CurveSpec{formats::Interpolation::linear, {-1.0, 0.0, 2.0}, {-3.0, 0.0, 2.0}};
  spring.free = 0.5;
  spring.force = TimeExpression{"0.5*sin(30*t)", {}, ""};
  scene.springs.push_back(spring);
}

void add_torsion_spring(const Ingredients& in, Scene& scene) {
  formats::SpringSpec spring;
  spring.name = "coil";
  spring.kind = formats::SpringKind::torsion;
  spring.a.node = tip_node(in.arm);
  spring.b.node = "bob/hook";
  spring.axis = Vector3d(0.5, -0.7, 0.5).normalized();
  spring.x_axis = Vector3d(1, 0, 0.1);
  spring.stiffness = formats::CurveSpec{formats::Interpolation::cubic, {-0.5, 0.0, 0.3}, {-2.0, 0.0, 3.0}};
  spring.damping = 0.05;
  spring.free = 0.1;
  spring.lower = -0.05;
  spring.stop_stiffness = 20.0;
  spring.stop_damping = 0.1;
  scene.springs.push_back(spring);
}

void add_bushing(const Ingredients& in, bool symmetric, Scene& scene) {
  formats::BushingSpec field;
  field.name = "field";
  field.a = {"ground", tip_place(in.arm) + Vector3d(0.03, -0.02, 0.04), {}, ""};
  field.b = {"bob/hook", Vector3d(0.01, 0.02, 0.0), {}, ""};
  field.axis = Vector3d(-0.2, 0.4, 0.9).normalized();
  field.x_axis = Vector3d(1, 1, 0);
  field.stiffness.diagonal() << 50, 70, 60, 4, 3, 5;
  field.stiffness(0, 4) = field.stiffness(4, 0) = 3.0;
  field.stiffness(1, 3) = field.stiffness(3, 1) = -2.0;
  field.stiffness(0, 1) = field.stiffness(1, 0) = 6.0;
  if (!symmetric) {
    field.stiffness(0, 2) = 7.0;
    field.stiffness(5, 1) = -1.5;
  }
  field.damping = 0.01 * Eigen::Matrix<double, 6, 6>(field.stiffness.diagonal().asDiagonal());
  field.damping(0, 2) = 0.1;
  field.free = Eigen::Matrix<double, 6, 1>();
  *field.free << 0.02, -0.01, 0.03, 0.05, -0.04, 0.02;
  field.preload << 1.0, -0.5, 0.3, 0.05, 0.02, -0.08;
  scene.bushings.push_back(field);
}

void add_channels(const Ingredients& in, Scene& scene) {
  const auto channel = [&](const std::string& name, formats::ChannelKind kind) -> formats::ChannelSpec& {
    formats::ChannelSpec spec;
    spec.name = name;
    spec.kind = kind;
    scene.channels.push_back(spec);
    return scene.channels.back();
  };
  channel("turn", formats::ChannelKind::coordinate).coordinate.name = acted_coordinate(in.hinge);
  channel("speed", formats::ChannelKind::rate).coordinate.name = "wrist";
  formats::ChannelSpec& height = channel("height", formats::ChannelKind::position);
  height.a = {"bob/hook", Vector3d(0.1, 0.0, 0.0), {}, ""};
  height.axis = Vector3d(0.6, 0.0, 0.8);
  height.origin = {0.2, 0.1, -0.4};
  formats::ChannelSpec& drift = channel("drift", formats::ChannelKind::velocity);
  drift.a.node = tip_node(in.arm);
  drift.axis = Vector3d(0.0, 1.0, 0.0);
  formats::ChannelSpec& gap = channel("gap", formats::ChannelKind::distance);
  gap.a = {"ground", Vector3d(2.0, 1.0, -1.0), {}, ""};
  gap.b.node = "bob";
  formats::LoadSpec force = load("control", formats::LoadKind::force, "bob/hook", formats::LoadAxes::world);
  force.components = {TimeExpression{"-0.5*drift - 0.4*height", {}, ""}, TimeExpression{"0.3*gap + 0.2*turn", {}, ""},
                      0.1};
  formats::LoadSpec moment = load("brake", formats::LoadKind::moment, "bob", formats::LoadAxes::body);
  moment.components = {0.0, TimeExpression{"-0.02*speed", {}, ""}, TimeExpression{"-0.1*turn*speed", {}, ""}};
  scene.loads = {force, moment};
}

void add_drive(const Ingredients& in, Scene& scene) {
  scene.motions.push_back(drive(acted_coordinate(in.hinge), "0.8*t + 0.05*(1 - cos(25*t))"));
}

void add_stop(const Ingredients& in, Scene& scene) {
  formats::SpringSpec spring;
  spring.name = "end_stop";
  spring.coordinate = CoordinateRef{acted_coordinate(in.hinge), ""};
  spring.stiffness = 2.0;
  spring.lower = -0.01;
  spring.upper = 0.02;
  spring.stop_stiffness = 300.0;
  spring.stop_damping = 0.5;
  scene.springs.push_back(spring);
}

/// Adds friction to the wrist, and to the hinge if its kind has it. Far supports keep prismatic joints from jamming.
void add_friction(const Ingredients& in, Scene& scene) {
  for (formats::JointSpec& one : scene.joints) {
    const formats::FrictionKeys& keys = formats::joint_kind(one.kind).friction;
    if (!keys.has_friction || one.name == "weld" || in.hinge == Hinge::none) continue;
    formats::FrictionSpec friction;
    friction.coefficient = 0.1;
    friction.static_coefficient = 0.12;
    friction.velocity = 0.05;
    if (keys.radius) friction.radius = 0.03;
    if (keys.arm) friction.arm = 0.5;
    one.friction = friction;
  }
}

/// Adds a flywheel on the ground with a gear to the hinge: a pinion if the hinge's coordinate is a length.
void add_gear(const Ingredients& in, Scene& scene) {
  formats::RigidBodySpec wheel = rigid_body("wheel", 1.0, {0, 0, 0}, {0.02, 0.02, 0.03});
  wheel.start.pose = {{1.0, 2.0, 0.5}, Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 0, 1).normalized()))};
  scene.bodies.emplace_back(wheel);
  formats::JointSpec axle = joint("axle", JointKind::revolute, "ground", "wheel", wheel.start.pose.position,
                                  wheel.start.pose.orientation * Vector3d::UnitZ());
  axle.x_axis = Vector3d(1, 0.2, 0);
  scene.joints.push_back(axle);
  scene.gears.push_back({"pair", {"axle", ""}, {acted_coordinate(in.hinge), ""}, -0.4, ""});
  scene.initial.push_back({});
  scene.initial.back().coordinate.name = acted_coordinate(in.hinge);
  scene.initial.back().rate = 0.8;
}

/// Gives the arm a gravity of its own, different from that of the bob.
void add_own_gravity(Scene& scene) {
  const auto set = [](auto& spec) {
    if constexpr (requires { spec.gravity; }) spec.gravity = Vector3d(-0.5, 1.1, 0.6);
  };
  std::visit(set, scene.bodies.front());
}

void add_tables(const Ingredients& in, Scene& scene) {
  scene.inputs.push_back({"throttle", {{0.0, 0.03, 0.08}, {0.0, 1.0, -0.5}}, formats::Interpolation::linear, ""});
  scene.inputs.push_back({"smooth", {{0.0, 0.05, 0.12}, {0.0, 1.0, 0.2}}, formats::Interpolation::cubic, ""});
  formats::LoadSpec force = load("push", formats::LoadKind::force, "bob", formats::LoadAxes::world);
  force.components = {TimeExpression{"2*throttle", {}, ""}, TimeExpression{"smooth - throttle*t", {}, ""}, 0.0};
  scene.loads = {force};
  formats::SpringSpec spring;
  spring.name = "actuator";
  spring.coordinate = CoordinateRef{acted_coordinate(in.hinge), ""};
  spring.force = TimeTable{{0.01, 0.04, 0.10}, {0.0, 1.0, 0.3}};
  spring.damping = 0.1;
  scene.springs.push_back(spring);
}

void add_tether(Scene& scene) {
  formats::JointSpec tether = joint("tether", JointKind::distance, "ground", "bob/hook", Vector3d::Zero(), {0, 0, 1});
  tether.position.reset();
  tether.axis.reset();
  tether.a.position = Vector3d(2.5, -1.0, 0.5);
  scene.joints.push_back(tether);
}

/// Repeats the hinge at the same place, or the wrist if there is none. Both take half of the force then. Elsewhere
/// their shares would depend on the size of the scene, that of its box along world axes.
void add_second_hinge(Scene& scene) {
  formats::JointSpec second = scene.joints.front().name == "weld" ? scene.joints[1] : scene.joints.front();
  second.name += "_2";
  scene.joints.push_back(second);
}

/// Gives initial values to all coordinates. Bodies would otherwise stand at the nearest place, which depends on the
/// size of the scene.
void add_initial_value(const Ingredients& in, Scene& scene) {
  std::vector<std::string> names = coordinates_of(in.hinge);
  if (in.hinge == Hinge::screw) names.pop_back();
  names.push_back("wrist");
  double value = 0.15;
  for (const std::string& name : names) {
    formats::InitialSpec initial;
    initial.coordinate.name = name;
    initial.value = value;
    if (name == names.front()) initial.rate = 0.7;
    scene.initial.push_back(initial);
    value -= 0.06;
  }
}

void add_part_load(Scene& scene) {
  formats::PartLoadSpec spec;
  spec.name = "pressure";
  spec.body = "arm";
  spec.load_case = "push";
  spec.value = TimeExpression{"1 + sin(12*t)", {}, ""};
  scene.part_loads.push_back(spec);
}

}  // namespace

std::string acted_coordinate(Hinge hinge) {
  const std::vector<std::string> all = coordinates_of(hinge);
  return all.empty() ? "wrist" : all.front();
}

void add_action(const Ingredients& in, Scene& scene) {
  switch (in.action) {
    case Action::nothing:
      return;
    case Action::world_loads:
      return add_world_loads(in, scene);
    case Action::following_loads:
      return add_following_loads(in, scene);
    case Action::line_spring:
      return add_line_spring(in, scene);
    case Action::torsion_spring:
      return add_torsion_spring(in, scene);
    case Action::bushing:
    case Action::unsymmetric_bushing:
      return add_bushing(in, in.action == Action::bushing, scene);
    case Action::channels:
      return add_channels(in, scene);
    case Action::drive:
      return add_drive(in, scene);
    case Action::stop:
      return add_stop(in, scene);
    case Action::friction:
      return add_friction(in, scene);
    case Action::gear:
      return add_gear(in, scene);
    case Action::own_gravity:
      return add_own_gravity(scene);
    case Action::tables:
      return add_tables(in, scene);
    case Action::tether:
      return add_tether(scene);
    case Action::second_hinge:
      return add_second_hinge(scene);
    case Action::initial_value:
      return add_initial_value(in, scene);
    case Action::part_load:
      return add_part_load(scene);
  }
}

}  // namespace tisserand::test_support::crossings
