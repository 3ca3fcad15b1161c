// SPDX-License-Identifier: GPL-3.0-or-later
// Massless chains (benchmark 8.4 of the collection in shared/data): a spring pendulum on 1, 5 and 20 virtual bodies.
#include <gtest/gtest.h>

#include "tests/support/scenes/andrews.hpp"
#include "tests/support/scenes/virtual_bodies.hpp"

namespace tisserand::mechanism::massless_chain_test {
namespace {

using Eigen::Vector3d;
using formats::Formulation;
using formats::JointKind;
using formats::LinearSolver;
using formats::VirtualBodies;
using test_support::body_at;
using test_support::expect_equal;
using test_support::fixed_joint;
using test_support::joint;
using test_support::Outcome;
using test_support::Simulation;
using test_support::virtual_body;

/// 1 kg on a spring of 1000 N/m, 0.8 m long without force and 1 m at the start, that slides on a link; `bodies` virtual
/// bodies welded in series between the link, itself massless, and the hinge at the origin. They sit off the line of the
/// link.
formats::Scene spring_pendulum(int bodies, VirtualBodies treatment) {
  formats::Scene scene = test_support::precise_scene(Formulation::stabilised_index2);
  scene.integrator.step = 2e-3;
  scene.virtual_bodies = treatment;
  scene.gravity = {0, -9.81, 0};
  scene.bodies = {body_at("mass", 1.0, {1, 0, 0}, {0.01, 0.01, 0.01}), virtual_body("link", {0.5, 0, 0})};
  std::string last = "link";
  for (int i = 0; i < bodies; ++i) {
    const std::string name = "v" + std::to_string(i);
    scene.bodies.push_back(virtual_body(name, {0.3 - 0.01 * i, 0.02 * (i % 3), 0.03 * (i % 2)}));
    scene.joints.push_back(fixed_joint("weld" + std::to_string(i), last, name));
    last = name;
  }
  scene.joints.push_back(joint("hinge", JointKind::revolute, "ground", last, Vector3d::Zero(), {0, 0, 1}));
  scene.joints.push_back(joint("slide", JointKind::prismatic, "link", "mass", {1, 0, 0}, {1, 0, 0}));
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.a.node = "ground";
  spring.a.position = Vector3d::Zero();
  spring.b.node = "mass";
  spring.stiffness = 1000.0;
  spring.free = 0.8;
  scene.springs.push_back(spring);
  return scene;
}

/// Motion of the mass and force of the slide after a third of a period of the spring.
Outcome swing(const formats::Scene& scene) {
  Simulation run(scene, {});
  run.start();
  run.run(0.06);
  EXPECT_EQ(run.rejected, 0);
  const Outcome all = test_support::outcome_of(run.scene, run);
  return {{{"mass", all.motion.at("mass")}}, {{"slide", all.reaction.at("slide")}}};
}

class MasslessChain : public ::testing::TestWithParam<std::tuple<Formulation, LinearSolver>> {};
INSTANTIATE_TEST_SUITE_P(Solvers, MasslessChain,
                         ::testing::Combine(::testing::Values(Formulation::index3, Formulation::stabilised_index2),
                                            ::testing::Values(LinearSolver::klu, LinearSolver::umfpack,
                                                              LinearSolver::dense, LinearSolver::qr)));

// A link without mass on a hinge is the plane spring pendulum, whatever is welded between them.
TEST_P(MasslessChain, OfAnyLengthMovesAsTheHingeAlone) {
  const auto [formulation, solver] = GetParam();
  const auto moved = [&, f = formulation, s = solver](int bodies, VirtualBodies treatment) {
    formats::Scene scene = spring_pendulum(bodies, treatment);
    scene.integrator.formulation = f;
    scene.integrator.linear_solver = s;
    return swing(scene);
  };
  const Outcome alone = moved(0, VirtualBodies::keep);
  // It has fallen and swung along the spring.
  EXPECT_LT(alone.motion.at("mass")[1], -0.015);
  EXPECT_GT(alone.motion.at("mass").segment<3>(3).norm(), 2.0);
  for (const int bodies : {1, 5, 20})
    for (const VirtualBodies treatment : {VirtualBodies::keep, VirtualBodies::eliminate}) {
      const Outcome chain = moved(bodies, treatment);
      expect_equal(chain.motion, alone.motion, 1e-9);
      // Of the weight; index 3 has round-off of positions over h² in its multipliers.
      EXPECT_LT((chain.reaction.at("slide") - alone.reaction.at("slide")).norm(), 1e-8 * 9.81);
    }
}

// Index 1: accelerations and reactions at the start, straight from [M Bᵀ; B 0].
TEST(MasslessChain, AcceleratesAsTheHingeAlone) {
  const auto started = [](int bodies, VirtualBodies treatment) {
    Simulation run(spring_pendulum(bodies, treatment), {});
    run.start();
    EXPECT_FALSE(run.started.massless);
    return Vector3d(run.state().vdot().head<3>());
  };
  const Vector3d alone = started(0, VirtualBodies::keep);
  // At rest and level: gravity across the link turns mass and inertia about the hinge.
  EXPECT_NEAR(alone.y(), -9.81 / 1.01, 1e-12);
  for (const int bodies : {1, 5, 20})
    for (const VirtualBodies treatment : {VirtualBodies::keep, VirtualBodies::eliminate})
      EXPECT_LT((started(bodies, treatment) - alone).norm(), 1e-11);
}

}  // namespace
}  // namespace tisserand::mechanism::massless_chain_test
