// SPDX-License-Identifier: GPL-3.0-or-later
// Reduced parts under load in scenes: from a mesh with its companion to equilibrium and modes of a mechanism.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mechanism/analyses/modes.hpp"
#include "mechanism/analyses/statics.hpp"
#include "tests/reducer/second_order/reduced_part.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::preload {

/// The part as the file "part".
inline mechanism::BodyFiles files_of(const testing::ReducedPart& part) {
  mechanism::BodyFiles files;
  test_support::add_file("part", part.element, files.superelements);
  files.companions["part"] = part.companion;
  return files;
}

/// One body "part" that is at rest, for statics.
inline formats::Scene static_scene(bool second_order) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.analysis = formats::AnalysisKind::statics;
  formats::SuperelementBodySpec body = test_support::superelement_body("part", "part");
  body.second_order = second_order;
  scene.bodies.push_back(body);
  return scene;
}

/// Holds the components x y z rx ry rz of a node that stands at `position` in the world.
inline formats::JointSpec support(const std::string& node, const Eigen::Vector3d& position,
                                  const std::array<bool, 6>& hold) {
  formats::JointSpec joint = test_support::joint("support_" + node, formats::JointKind::generic, "ground",
                                                 "part/" + node, position, Eigen::Vector3d::UnitZ());
  joint.hold = hold;
  return joint;
}

inline void solve(test_support::Simulation& run) {
  run.start();
  const mechanism::StaticsReport statics =
      mechanism::solve_statics(run.model(), run.scene.statics, {}, run.state(), run.workspace);
  EXPECT_EQ(statics.outcome, mechanism::StepOutcome::accepted) << statics.explanation;
}

}  // namespace tisserand::preload
