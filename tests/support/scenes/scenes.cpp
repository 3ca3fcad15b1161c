// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of scenes, the scenes of two known mechanisms, and the loop of a run.
#include "tests/support/scenes/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::test_support {

void add_file(const std::string& name, const formats::Superelement& element, mechanism::SuperelementFiles& files) {
  files[name] = {element, formats::check(element, name)};
}

formats::Scene empty_scene(double step, double end) {
  formats::Scene scene;
  scene.name = "test";
  scene.file = "test.yaml";
  scene.integrator.step = step;
  scene.integrator.end = end;
  return scene;
}

formats::RigidBodySpec rigid_body(const std::string& name, double mass, const Eigen::Vector3d& center_of_mass,
                                  const Eigen::Vector3d& principal_inertia) {
  formats::RigidBodySpec body;
  body.name = name;
  body.mass = mass;
  body.center_of_mass = center_of_mass;
  body.inertia = principal_inertia.asDiagonal();
  return body;
}

formats::SuperelementBodySpec superelement_body(const std::string& name, const std::string& file) {
  formats::SuperelementBodySpec body;
  body.name = name;
  body.file = file;
  return body;
}

formats::JointSpec joint(const std::string& name, formats::JointKind kind, const std::string& a, const std::string& b,
                         const Eigen::Vector3d& position, const Eigen::Vector3d& axis) {
  formats::JointSpec spec;
  spec.name = name;
  spec.kind = kind;
  spec.a.node = a;
  spec.b.node = b;
  spec.position = position;
  spec.axis = axis;
  return spec;
}

formats::MotionSpec drive(const std::string& coordinate, const std::string& formula,
                          const std::vector<double>& breakpoints) {
  formats::MotionSpec motion;
  motion.name = "drive_" + coordinate;
  motion.coordinate.name = coordinate;
  motion.value = formats::TimeExpression{formula, breakpoints, ""};
  return motion;
}

formats::LoadSpec constant_load(const std::string& name, formats::LoadKind kind, const std::string& node,
                                const Eigen::Vector3d& value) {
  formats::LoadSpec load;
  load.name = name;
  load.kind = kind;
  load.at.node = node;
  load.components = {value.x(), value.y(), value.z()};
  return load;
}

double Pendulum::period() {
  return 4.0 * std::sqrt(inertia_about_hinge() / (mass * gravity * arm)) * std::comp_ellint_1(std::sqrt(0.5));
}

formats::Scene pendulum_scene(double step, double end) {
  formats::Scene scene = empty_scene(step, end);
  scene.gravity = {0, -Pendulum::gravity, 0};
  formats::RigidBodySpec body =
      rigid_body("pendulum", Pendulum::mass, {-Pendulum::arm, 0, 0}, {0.05, 0.2, Pendulum::inertia});
  scene.bodies.push_back(body);
  scene.joints.push_back(joint("hinge", formats::JointKind::revolute, "ground", "pendulum", Eigen::Vector3d::Zero(),
                               Eigen::Vector3d::UnitZ()));
  return scene;
}

formats::Scene heavy_top_scene(double step, double end) {
  formats::Scene scene = empty_scene(step, end);
  scene.gravity = {0, 0, -9.81};
  formats::RigidBodySpec top = rigid_body("top", 15.0, {0, 1, 0}, {0.234375, 0.46875, 0.234375});
  top.start.angular_velocity = {0, 150, -4.61538};
  scene.bodies.push_back(top);
  scene.joints.push_back(joint("pivot", formats::JointKind::spherical, "ground", "top", Eigen::Vector3d::Zero(),
                               Eigen::Vector3d::UnitZ()));
  return scene;
}

Simulation::Simulation(formats::Scene scene_to_run, const mechanism::BodyFiles& files)
    : scene(std::move(scene_to_run)),
      built(mechanism::build_model(scene, files)),
      workspace(built.model),
      schedule(scene, built.model.breakpoints),
      stepper(built.model, scene.integrator) {}

void Simulation::start() { started = mechanism::start(scene, mechanism::StartFrom::poses, built, workspace); }

bool Simulation::step() {
  while (true) {
    const double before = state().time();
    report = stepper.advance(schedule.next(before), state(), workspace);
    schedule_size = state().time() - before;
    iterations += report.iterations;
    factorisations += report.factorisations;
    if (report.outcome == mechanism::StepOutcome::accepted) break;
    ++rejected;
    failure = mechanism::explain(built.model, report);
    if (!schedule.retry(before, report)) return false;
  }
  ++steps;
  largest_constraint = std::max(largest_constraint, report.constraint);
  schedule.adapt(report, schedule_size);
  if (schedule.accept(state().time()).breakpoint) {
    mechanism::pass_breakpoint(built.model, scene, state(), workspace);
    stepper.pass_jump();
  }
  return true;
}

void Simulation::run(double time) {
  run(time, [] {});
}

mechanism::Energy Simulation::energy() {
  mechanism::evaluate(built.model, built.state, workspace.now);
  return mechanism::evaluate_energy(built.model, workspace.now);
}

int Simulation::node(const std::string& name) const {
  for (std::size_t i = 0; i < built.model.nodes.size(); ++i)
    if (built.model.nodes[i].name == name) return static_cast<int>(i);
  throw std::runtime_error("no node " + name);
}

Eigen::Vector3d Simulation::position(const std::string& name) { return state().x().col(node(name)); }

Eigen::Quaterniond Simulation::rotation(const std::string& name) {
  const Eigen::Vector4d q = state().Q().col(node(name));
  return {q[0], q[1], q[2], q[3]};
}

Eigen::Vector3d Simulation::velocity(const std::string& name) {
  return mechanism::translation_at(built.model, state().v(), built.model.nodes[node(name)].translation);
}

Eigen::Vector3d Simulation::Omega(const std::string& name) {
  return mechanism::rotation_at(built.model, state().v(), built.model.nodes[node(name)].rotation);
}

}  // namespace tisserand::test_support
