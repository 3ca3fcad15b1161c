// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes written in code, and a runner that starts and advances them as a run does, for tests of the mechanism core.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "formats/scene/scene.hpp"
#include "formats/superelement/superelement.hpp"
#include "mechanism/analyses/start.hpp"
#include "mechanism/build/build_model.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/run/schedule.hpp"
#include "mechanism/run/stepper.hpp"
#include "mechanism/step/step.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::test_support {

/// A checked element under its name, as read_superelements() would give it for a file of that name.
void add_file(const std::string& name, const formats::Superelement& element, mechanism::SuperelementFiles& files);

formats::Scene empty_scene(double step, double end);

formats::RigidBodySpec rigid_body(const std::string& name, double mass, const Eigen::Vector3d& center_of_mass,
                                  const Eigen::Vector3d& principal_inertia);

formats::SuperelementBodySpec superelement_body(const std::string& name, const std::string& file);

/// "drive_<coordinate>": the formula in t along a joint coordinate.
formats::MotionSpec drive(const std::string& coordinate, const std::string& formula,
                          const std::vector<double>& breakpoints = {});

/// From a to b; world position and z axis of both markers where the nodes leave them open.
formats::JointSpec joint(const std::string& name, formats::JointKind kind, const std::string& a, const std::string& b,
                         const Eigen::Vector3d& position, const Eigen::Vector3d& axis);

formats::LoadSpec constant_load(const std::string& name, formats::LoadKind kind, const std::string& node,
                                const Eigen::Vector3d& value);

/// Physical pendulum: mass 1.5, centre of mass 0.8 from the hinge about z, inertia 0.2 about it; starts at rest with
/// the centre of mass at (-0.8, 0), gravity 9.81 along -y.
struct Pendulum {
  static constexpr double mass = 1.5, arm = 0.8, inertia = 0.2, gravity = 9.81;
  static double inertia_about_hinge() { return inertia + mass * arm * arm; }
  /// 4 K(sin(amplitude/2)) / w0, amplitude 90 degrees.
  static double period();
};

formats::Scene pendulum_scene(double step, double end);

/// Heavy top of Cardona & Geradin as in [BCA12] 5.1: tip at the origin, centre of mass at (0, 1, 0), 150 rad/s about y.
formats::Scene heavy_top_scene(double step, double end);

/// A run in memory: the loop of simulate() without files.
class Simulation {
 public:
  Simulation(formats::Scene scene_to_run, const mechanism::BodyFiles& files);

  /// Rank, projection, accelerations. Throws Error.
  void start();

  /// One accepted step, with halvings; false when the step cannot be taken (`failure` says why).
  bool step();

  /// Steps until `time`, with `visit` after each.
  template <class Visit>
  void run(double time, Visit visit) {
    while (state().time() < time - 1e-6 * scene.integrator.step) {
      if (!step()) throw std::runtime_error(failure);
      visit();
    }
  }
  void run(double time);

  mechanism::State& state() { return built.state; }
  const mechanism::Model& model() const { return built.model; }

  mechanism::Energy energy();
  int node(const std::string& name) const;
  Eigen::Vector3d position(const std::string& name);
  Eigen::Quaterniond rotation(const std::string& name);
  Eigen::Vector3d velocity(const std::string& name);
  Eigen::Vector3d Omega(const std::string& name);

  formats::Scene scene;
  mechanism::BuiltModel built;
  mechanism::Workspace workspace;
  mechanism::Schedule schedule;
  mechanism::Stepper stepper;
  mechanism::StartReport started;
  mechanism::StepReport report;
  long steps = 0, iterations = 0, factorisations = 0, rejected = 0;
  double largest_constraint = 0.0, schedule_size = 0.0;
  std::string failure;
};

}  // namespace tisserand::test_support
