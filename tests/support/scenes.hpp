// Scenes written in code, and a runner that starts and advances them as a run does, for tests of the mechanism core.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "formats/scene.hpp"
#include "formats/superelement.hpp"
#include "mechanism/build_model.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/initial.hpp"
#include "mechanism/integrator.hpp"
#include "mechanism/schedule.hpp"
#include "mechanism/workspace.hpp"

namespace tisserand::test_support {

/// A checked element under its name, as read_superelements() would give it for a file of that name.
inline void add_file(const std::string& name, const formats::Superelement& element,
                     mechanism::SuperelementFiles& files) {
  files[name] = {element, formats::check(element, name)};
}

inline formats::Scene empty_scene(double step, double end) {
  formats::Scene scene;
  scene.name = "test";
  scene.file = "test.yaml";
  scene.integrator.step = step;
  scene.integrator.end = end;
  return scene;
}

inline formats::RigidBodySpec rigid_body(const std::string& name, double mass, const Eigen::Vector3d& center_of_mass,
                                         const Eigen::Vector3d& principal_inertia) {
  formats::RigidBodySpec body;
  body.name = name;
  body.mass = mass;
  body.center_of_mass = center_of_mass;
  body.inertia = principal_inertia.asDiagonal();
  return body;
}

inline formats::SuperelementBodySpec superelement_body(const std::string& name, const std::string& file) {
  formats::SuperelementBodySpec body;
  body.name = name;
  body.file = file;
  return body;
}

/// From a to b; world position and z axis of both markers where the nodes leave them open.
inline formats::JointSpec joint(const std::string& name, formats::JointKind kind, const std::string& a,
                                const std::string& b, const Eigen::Vector3d& position, const Eigen::Vector3d& axis) {
  formats::JointSpec spec;
  spec.name = name;
  spec.kind = kind;
  spec.a.node = a;
  spec.b.node = b;
  spec.position = position;
  spec.axis = axis;
  return spec;
}

inline formats::LoadSpec constant_load(const std::string& name, formats::LoadKind kind, const std::string& node,
                                       const Eigen::Vector3d& value) {
  formats::LoadSpec load;
  load.name = name;
  load.kind = kind;
  load.at.node = node;
  load.components = {value.x(), value.y(), value.z()};
  return load;
}

/// Physical pendulum: mass 1.5, centre of mass 0.8 from the hinge about z, inertia 0.2 about it; starts at rest with
/// the centre of mass at (-0.8, 0), gravity 9.81 along -y.
struct Pendulum {
  static constexpr double mass = 1.5, arm = 0.8, inertia = 0.2, gravity = 9.81;
  static double inertia_about_hinge() { return inertia + mass * arm * arm; }
  /// 4 K(sin(amplitude/2)) / w0, amplitude 90 degrees.
  static double period() {
    return 4.0 * std::sqrt(inertia_about_hinge() / (mass * gravity * arm)) * std::comp_ellint_1(std::sqrt(0.5));
  }
};

inline formats::Scene pendulum_scene(double step, double end) {
  formats::Scene scene = empty_scene(step, end);
  scene.gravity = {0, -Pendulum::gravity, 0};
  formats::RigidBodySpec body =
      rigid_body("pendulum", Pendulum::mass, {-Pendulum::arm, 0, 0}, {0.05, 0.2, Pendulum::inertia});
  scene.bodies.push_back(body);
  scene.joints.push_back(joint("hinge", formats::JointKind::revolute, "ground", "pendulum", Eigen::Vector3d::Zero(),
                               Eigen::Vector3d::UnitZ()));
  return scene;
}

/// Heavy top of Cardona & Geradin as in [BCA12] 5.1: tip at the origin, centre of mass at (0, 1, 0), 150 rad/s about y.
inline formats::Scene heavy_top_scene(double step, double end) {
  formats::Scene scene = empty_scene(step, end);
  scene.gravity = {0, 0, -9.81};
  formats::RigidBodySpec top = rigid_body("top", 15.0, {0, 1, 0}, {0.234375, 0.46875, 0.234375});
  top.start.angular_velocity = {0, 150, -4.61538};
  scene.bodies.push_back(top);
  scene.joints.push_back(joint("pivot", formats::JointKind::spherical, "ground", "top", Eigen::Vector3d::Zero(),
                               Eigen::Vector3d::UnitZ()));
  return scene;
}

/// A run in memory: the loop of simulate() without files.
class Simulation {
 public:
  Simulation(formats::Scene scene_to_run, const mechanism::BodyFiles& files)
      : scene(std::move(scene_to_run)),
        built(mechanism::build_model(scene, files)),
        workspace(built.model),
        schedule(scene, built.model.breakpoints) {}

  /// Rank, projection, accelerations. Throws Error.
  void start() { started = mechanism::start(scene, built.model, built.state, workspace); }

  /// One accepted step, with halvings; false when the step cannot be taken (`failure` says why).
  bool step() {
    while (true) {
      const double before = state().time();
      report = mechanism::advance(built.model, scene.integrator, schedule.next(before), state(), workspace);
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
    if (schedule.accept(state().time()).breakpoint) mechanism::pass_breakpoint(built.model, scene, state(), workspace);
    return true;
  }

  /// Steps until `time`, with `visit` after each.
  template <class Visit>
  void run(double time, Visit visit) {
    while (state().time() < time - 1e-6 * scene.integrator.step) {
      if (!step()) throw std::runtime_error(failure);
      visit();
    }
  }
  void run(double time) {
    run(time, [] {});
  }

  mechanism::State& state() { return built.state; }
  const mechanism::Model& model() const { return built.model; }

  mechanism::Energy energy() {
    mechanism::evaluate(built.model, built.state, workspace);
    return mechanism::evaluate_energy(built.model, workspace);
  }

  int node(const std::string& name) const {
    for (std::size_t i = 0; i < built.model.nodes.size(); ++i)
      if (built.model.nodes[i].name == name) return static_cast<int>(i);
    throw std::runtime_error("no node " + name);
  }
  Eigen::Vector3d position(const std::string& name) { return state().x().col(node(name)); }
  Eigen::Quaterniond rotation(const std::string& name) {
    const Eigen::Vector4d q = state().Q().col(node(name));
    return {q[0], q[1], q[2], q[3]};
  }
  Eigen::Vector3d velocity(const std::string& name) {
    return state().v().segment<3>(built.model.nodes[static_cast<std::size_t>(node(name))].translation);
  }
  Eigen::Vector3d Omega(const std::string& name) {
    return state().v().segment<3>(built.model.nodes[static_cast<std::size_t>(node(name))].rotation);
  }

  formats::Scene scene;
  mechanism::BuiltModel built;
  mechanism::Workspace workspace;
  mechanism::Schedule schedule;
  mechanism::StartReport started;
  mechanism::StepReport report;
  long steps = 0, iterations = 0, factorisations = 0, rejected = 0;
  double largest_constraint = 0.0, schedule_size = 0.0;
  std::string failure;
};

}  // namespace tisserand::test_support
