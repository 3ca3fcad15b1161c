// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes with virtual bodies, run to the motion of every place and the reactions of every joint.
#pragma once

#include <algorithm>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "mechanism/run/output.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::test_support {

inline formats::VirtualBodySpec virtual_body(const std::string& name, const Eigen::Vector3d& position) {
  formats::VirtualBodySpec body;
  body.name = name;
  body.start.pose.position = position;
  return body;
}

/// A fixed joint where the bodies are at the start.
inline formats::JointSpec fixed_joint(const std::string& name, const std::string& a, const std::string& b) {
  formats::JointSpec spec;
  spec.name = name;
  spec.kind = formats::JointKind::fixed;
  spec.a.node = a;
  spec.b.node = b;
  return spec;
}

/// Newton to round-off, so that what is left is the difference of the models.
inline formats::Scene precise_scene(formats::Formulation formulation) {
  formats::Scene scene = empty_scene(1e-3, 1.0);
  scene.integrator.formulation = formulation;
  scene.integrator.tolerance = 1e-12;
  scene.integrator.constraint_tolerance = 1e-14;
  return scene;
}

/// What a run gives: motion of the places and reactions of the joints by name.
struct Outcome {
  std::map<std::string, Eigen::VectorXd> motion;
  std::map<std::string, Eigen::VectorXd> reaction;
};

/// At the present state of a run.
inline Outcome outcome_of(const formats::Scene& scene, Simulation& run) {
  const formats::ResultsLayout layout = mechanism::results_layout(run.model(), scene);
  formats::ResultsRow row;
  row.resize(layout);
  mechanism::fill_row(run.model(), run.state(), run.workspace.now, row);
  Outcome outcome;
  for (std::size_t i = 0; i < layout.nodes.size(); ++i) {
    const auto c = static_cast<Eigen::Index>(i);
    const Eigen::Vector4d q = row.node_rotation.col(c);
    Eigen::VectorXd& motion = outcome.motion[layout.nodes[i]];
    motion.resize(18);
    motion << row.node_position.col(c), row.node_velocity.col(c), row.node_angular_velocity.col(c),
        Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix().reshaped();
  }
  for (std::size_t i = 0; i < layout.joints.size(); ++i) {
    Eigen::VectorXd& reaction = outcome.reaction[layout.joints[i]];
    reaction.resize(6);
    reaction << row.joint_force.col(i), row.joint_moment.col(i);
  }
  return outcome;
}

inline Outcome run_scene(const formats::Scene& scene, const mechanism::BodyFiles& files, double time) {
  Simulation run(scene, files);
  run.start();
  run.run(time);
  return outcome_of(scene, run);
}

inline double largest(const std::map<std::string, Eigen::VectorXd>& all) {
  double value = 0.0;
  for (const auto& [name, vector] : all) value = std::max(value, vector.cwiseAbs().maxCoeff());
  return value;
}

inline void expect_equal(const std::map<std::string, Eigen::VectorXd>& a,
                         const std::map<std::string, Eigen::VectorXd>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [name, vector] : a) {
    ASSERT_TRUE(b.contains(name)) << name;
    EXPECT_LT((vector - b.at(name)).cwiseAbs().maxCoeff(), tolerance * largest(a)) << name;
  }
}

}  // namespace tisserand::test_support
