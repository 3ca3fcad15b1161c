// SPDX-License-Identifier: GPL-3.0-or-later
// A rigid rotor with static and dynamic unbalance on a drive of constant speed, and what its bearing must carry.
#pragma once

#include <algorithm>
#include <cmath>

#include "mechanism/run/output.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::test_support {

struct Rotor {
  static constexpr double mass = 2.0, arm = 0.1, product = 0.004, rate = 50.0;

  static formats::Scene scene(double step, double end) {
    formats::Scene scene = empty_scene(step, end);
    formats::RigidBodySpec rotor = rigid_body("rotor", mass, {arm, 0, 0}, {0.02, 0.03, 0.025});
    rotor.inertia(0, 2) = rotor.inertia(2, 0) = product;
    scene.bodies.push_back(rotor);
    scene.joints = {joint("bearing", formats::JointKind::revolute, "ground", "rotor", {0, 0, 0}, {0, 0, 1})};
    scene.motions = {drive("bearing", "50*t")};
    return scene;
  }

  /// Largest relative error of the bearing's load over a run, from `settled` on: Newton and Euler give m r ω² towards
  /// the axis and I_xz ω² across it, whatever the angle.
  static double error(const formats::Scene& scene, double settled) {
    Simulation run(scene, {});
    run.start();
    formats::ResultsRow row;
    row.resize(mechanism::results_layout(run.model(), scene));
    double worst = 0.0;
    for (int i = 1; i <= 60; ++i) {
      const double time = scene.integrator.end * i / 60;
      run.run(time);
      if (time < settled) continue;
      mechanism::fill_row(run.model(), run.state(), run.workspace.now, row);
      const double force = row.joint_force.col(0).norm() / (mass * arm * rate * rate);
      const double moment = row.joint_moment.col(0).head<2>().norm() / (product * rate * rate);
      worst = std::max({worst, std::abs(force - 1.0), std::abs(moment - 1.0)});
    }
    return worst;
  }
};

}  // namespace tisserand::test_support
