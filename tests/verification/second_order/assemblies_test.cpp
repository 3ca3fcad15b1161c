// SPDX-License-Identifier: GPL-3.0-or-later
// Second-order superelements among others: several uses of one file, virtual bodies, forces at boundary nodes.
#include <gtest/gtest.h>

#include "mechanism/run/output.hpp"
#include "tests/support/scenes/second_order_scenes.hpp"
#include "tests/support/scenes/virtual_bodies.hpp"

namespace tisserand::mechanism::second_order_assemblies_test {
namespace {

using Eigen::Vector3d;
using formats::Formulation;
using formats::JointKind;
using formats::LoadKind;
using formats::VirtualBodies;
using test_support::constant_load;
using test_support::expect_equal;
using test_support::files_of;
using test_support::fixed_joint;
using test_support::joint;
using test_support::Outcome;
using test_support::precise_scene;
using test_support::run_scene;
using test_support::Simulation;
using test_support::virtual_body;

/// Length 10 along x, EI 100 and 200; boundary nodes n0 and n16, four internal modes.
BodyFiles beam_files() {
  const test_support::SectionData section = test_support::slender_section(1e5);
  return files_of(test_support::second_order_beam(test_support::bernoulli_beam(section, 10.0, 16), {0, 16}, 4));
}

/// A pendulum hinged at `pivot`; under gravity and a force across at its end it bends in both planes and twists.
void add_pendulum(const std::string& name, const Vector3d& pivot, formats::Scene& scene) {
  formats::SuperelementBodySpec body = test_support::superelement_body(name, "beam");
  body.start.pose.position = pivot;
  scene.bodies.push_back(body);
  scene.joints.push_back(joint(name + "_hinge", JointKind::revolute, "ground", name + "/n0", pivot, Vector3d::UnitZ()));
  scene.loads.push_back(constant_load(name + "_push", LoadKind::force, name + "/n16", {0, 0, 2}));
  scene.gravity = {0, -9.81, 0};
}

// Bodies of one file are one set of matrices; without joints between them each moves as it does alone (the equations
// are those of two systems), and one elsewhere moves alike.
TEST(SecondOrderAssemblies, UsesOfOneFileShareItsMatricesAndMoveAsEachAlone) {
  const BodyFiles files = beam_files();
  const Vector3d apart(3.0, -7.0, 2.0);
  formats::Scene alone = precise_scene(Formulation::stabilised_index2), both = alone;
  add_pendulum("left", Vector3d::Zero(), alone);
  add_pendulum("left", Vector3d::Zero(), both);
  add_pendulum("right", apart, both);
  Simulation run(both, files);
  ASSERT_TRUE(body_of(run.model(), 0).second_order.any());
  EXPECT_EQ(&body_of(run.model(), 0), &body_of(run.model(), 1));
  EXPECT_EQ(run.model().superelement_bodies.size(), 1u);
  Outcome of_both = run_scene(both, files, 0.3), of_left = run_scene(alone, files, 0.3);
  for (const char* node : {"n0", "n16"}) {
    const Eigen::VectorXd left = of_both.motion.at(std::string("left/") + node);
    Eigen::VectorXd right = of_both.motion.at(std::string("right/") + node);
    right.head<3>() -= apart;
    EXPECT_LT((left - right).norm(), 1e-9 * left.norm()) << node;
    EXPECT_LT((left - of_left.motion.at(std::string("left/") + node)).norm(), 1e-9 * left.norm()) << node;
  }
  EXPECT_GT(of_left.motion.at("left/n16").segment<3>(3).norm(), 1.0);  // it has moved
}

/// Hinge, beam and a ball of mass on virtual bodies at both ends, a force on the horn of one of them.
formats::Scene carried(Formulation formulation, VirtualBodies treatment) {
  formats::Scene scene = precise_scene(formulation);
  scene.virtual_bodies = treatment;
  scene.gravity = {0, -9.81, 0};
  const Vector3d end(10, 0, 0);
  scene.bodies.push_back(test_support::superelement_body("beam", "beam"));
  scene.bodies.push_back(virtual_body("bearing", Vector3d::Zero()));
  formats::VirtualBodySpec hub = virtual_body("hub", end);
  hub.start.pose.orientation = Eigen::AngleAxisd(0.3, Vector3d::Ones().normalized());
  hub.nodes = {{"horn", {{0.2, 0.3, 0.1}, Eigen::Quaterniond::Identity()}}};
  scene.bodies.push_back(hub);
  formats::RigidBodySpec ball = test_support::rigid_body("ball", 0.5, Vector3d::Zero(), {0.02, 0.03, 0.04});
  ball.start.pose.position = end;
  scene.bodies.push_back(ball);
  scene.joints = {fixed_joint("seat", "beam/n0", "bearing"),
                  joint("hinge", JointKind::revolute, "ground", "bearing", Vector3d::Zero(), Vector3d::UnitZ()),
                  fixed_joint("tie", "beam/n16", "hub"),
                  joint("socket", JointKind::spherical, "hub", "ball", end, Vector3d::UnitZ())};
  scene.loads.push_back(constant_load("push", LoadKind::force, "hub/horn", {1, -2, 3}));
  return scene;
}

// Bodies without mass and freedom of their own: kept and eliminated are the same equations (equations of [GA00]
// section 4, exact form), whatever the inertia of what carries them.
TEST(SecondOrderAssemblies, MoveTheSameWithVirtualBodiesKeptAndEliminated) {
  const BodyFiles files = beam_files();
  for (const Formulation formulation : {Formulation::index3, Formulation::stabilised_index2}) {
    SCOPED_TRACE(static_cast<int>(formulation));
    Outcome kept = run_scene(carried(formulation, VirtualBodies::keep), files, 0.1);
    Outcome eliminated = run_scene(carried(formulation, VirtualBodies::eliminate), files, 0.1);
    EXPECT_GT(kept.reaction.at("tie").norm(), 1.0);
    // Index 3 does not hold velocities to the constraints: those of a kept virtual body are the integrator's.
    if (formulation == Formulation::index3)
      for (const char* name : {"bearing", "hub", "hub/horn"})
        for (Outcome* outcome : {&kept, &eliminated}) outcome->motion.at(name).segment<6>(3).setZero();
    expect_equal(kept.motion, eliminated.motion, 1e-9);
    expect_equal(kept.reaction, eliminated.reaction, 1e-7);
  }
}

// What a boundary node receives from the rest of the mechanism: the load on the free end, the reaction of the joint at
// the other, with the opposite sign of what the joint puts on the ground.
TEST(SecondOrderAssemblies, BoundaryForcesAreThoseOfLoadsAndJoints) {
  formats::Scene scene = precise_scene(Formulation::stabilised_index2);
  add_pendulum("beam", Vector3d::Zero(), scene);
  scene.loads.push_back(constant_load("twist", LoadKind::moment, "beam/n16", {0.5, -0.3, 0.2}));
  Simulation run(scene, beam_files());
  run.start();
  run.run(0.2);
  const formats::ResultsLayout layout = results_layout(run.model(), scene);
  formats::ResultsRow row;
  row.resize(layout);
  fill_row(run.model(), run.state(), run.workspace.now, row);
  ASSERT_EQ(layout.boundary_nodes, (std::vector<std::string>{"n0", "n16"}));
  const double size = row.joint_force.col(0).norm();
  EXPECT_GT(size, 10.0);
  Eigen::Matrix<double, 6, 1> load;
  load << 0, 0, 2, 0.5, -0.3, 0.2;
  EXPECT_LT((row.boundary_force.col(1) - load).norm(), 1e-7 * size);
  EXPECT_LT((row.boundary_force.col(0).head<3>() - row.joint_force.col(0)).norm(), 1e-7 * size);
  EXPECT_LT((row.boundary_force.col(0).tail<3>() - row.joint_moment.col(0)).norm(), 1e-6 * size);
}

}  // namespace
}  // namespace tisserand::mechanism::second_order_assemblies_test
