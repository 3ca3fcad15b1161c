// SPDX-License-Identifier: GPL-3.0-or-later
// Planar scenes: the planar equations give the motion in space, with half the coordinates.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/results/results.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/build/effects.hpp"
#include "mechanism/equations/mobility.hpp"
#include "mechanism/run/output.hpp"
#include "mechanism/step/redundancy.hpp"
#include "tests/support/scenes/planar_scenes.hpp"

namespace tisserand::mechanism::planar_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::JointKind;
using test_support::askew;
using test_support::flexible_slider_crank;
using test_support::joint;
using test_support::modal_rod_files;
using test_support::modal_slider_crank;
using test_support::on_edge;
using test_support::planar;
using test_support::rigid_slider_crank;
using test_support::rod_files;
using test_support::second_order_files;
using test_support::Simulation;
using test_support::spin_up;
using test_support::TurnedScene;
using test_support::upright;
using test_support::with_planar;

formats::ResultsRow row_of(Simulation& run) {
  formats::ResultsRow row;
  row.resize(results_layout(run.model(), run.scene));
  fill_row(run.model(), run.state(), run.workspace.now, row);
  return row;
}

double gap(const MatrixXd& a, const MatrixXd& b) {
  const double size = std::max(1.0, b.size() > 0 ? b.cwiseAbs().maxCoeff() : 0.0);
  return a.size() > 0 ? (a - b).cwiseAbs().maxCoeff() / size : 0.0;
}

/// Positions, velocities, accelerations, reactions and deformations agree, each relative to the largest of its kind.
void expect_same(const formats::ResultsRow& planar, const formats::ResultsRow& spatial, double tolerance) {
  EXPECT_LT(gap(planar.node_position, spatial.node_position), tolerance);
  EXPECT_LT(gap(planar.node_velocity, spatial.node_velocity), tolerance);
  EXPECT_LT(gap(planar.node_angular_velocity, spatial.node_angular_velocity), tolerance);
  for (Eigen::Index i = 0; i < spatial.node_rotation.cols(); ++i)
    EXPECT_NEAR(std::abs(planar.node_rotation.col(i).dot(spatial.node_rotation.col(i))), 1.0, tolerance);
  for (Eigen::Index i = 0; i < spatial.frame_rotation.cols(); ++i)
    EXPECT_NEAR(std::abs(planar.frame_rotation.col(i).dot(spatial.frame_rotation.col(i))), 1.0, tolerance);
  EXPECT_LT(gap(planar.frame_position, spatial.frame_position), tolerance);
  EXPECT_LT(gap(planar.y, spatial.y), tolerance);
  EXPECT_LT(gap(planar.w, spatial.w), tolerance);
  EXPECT_LT(gap(planar.joint_coordinate, spatial.joint_coordinate), tolerance);
  EXPECT_NEAR(planar.total, spatial.total, tolerance * std::max(1.0, std::abs(spatial.kinetic)));
}

/// Reactions are what Newton's iteration leaves of forces: to its tolerance times the stiffness.
void expect_same_forces(const formats::ResultsRow& planar, const formats::ResultsRow& spatial, double tolerance) {
  EXPECT_LT(gap(planar.joint_force, spatial.joint_force), tolerance);
  EXPECT_LT(gap(planar.joint_moment, spatial.joint_moment), tolerance);
  EXPECT_LT(gap(planar.boundary_force, spatial.boundary_force), tolerance);
  EXPECT_LT(gap(planar.motion_force, spatial.motion_force), tolerance);
  EXPECT_LT(gap(planar.spring_force, spatial.spring_force), tolerance);
  EXPECT_LT(gap(planar.tyre_force, spatial.tyre_force), tolerance);
  EXPECT_LT(gap(planar.tyre_moment, spatial.tyre_moment), tolerance);
  EXPECT_LT(gap(planar.tyre_contact, spatial.tyre_contact), tolerance);
  EXPECT_LT(gap(planar.tyre_normal, spatial.tyre_normal), tolerance);
  EXPECT_LT(gap(planar.tyre_deflection, spatial.tyre_deflection), tolerance);
}

/// Both runs to the end; their sizes for the caller.
void expect_same_run(const TurnedScene& given, const BodyFiles& files, double tolerance = 1e-10) {
  Simulation spatial(given.scene, files), flat(with_planar(given.scene), files);
  ASSERT_TRUE(flat.model().planar);
  spatial.start();
  flat.start();
  expect_same(row_of(flat), row_of(spatial), tolerance);
  spatial.run(given.scene.integrator.end);
  flat.run(given.scene.integrator.end);
  EXPECT_EQ(flat.steps, spatial.steps);
  const formats::ResultsRow a = row_of(flat), b = row_of(spatial);
  EXPECT_GT(b.node_velocity.cwiseAbs().maxCoeff(), 0.1);  // it moves
  expect_same(a, b, tolerance);
  expect_same_forces(a, b, 1e2 * tolerance);
  EXPECT_LT(std::abs(a.balance - b.balance), tolerance * std::max(1.0, std::abs(b.kinetic)));
}

TEST(Planar, RigidLinkageMovesAsInSpace) {
  for (const Quaterniond& q : {upright, on_edge, askew}) expect_same_run(rigid_slider_crank(q), BodyFiles{});
}

TEST(Planar, FlexibleSliderCrankMovesAsInSpace) {
  const BodyFiles files = rod_files(6);
  for (const formats::InertiaOption inertia :
       {formats::InertiaOption::A, formats::InertiaOption::B, formats::InertiaOption::M})
    expect_same_run(flexible_slider_crank(upright, inertia), files);
  for (const Quaterniond& q : {on_edge, askew})
    expect_same_run(flexible_slider_crank(q, formats::InertiaOption::M), files);
}

TEST(Planar, SpinUpOfASecondOrderBeamAsInSpace) {
  const BodyFiles files = second_order_files();
  for (const Quaterniond& q : {upright, on_edge, askew}) expect_same_run(spin_up(q), files);
}

// Pairs of modes that bend a round rod are turned apart: one of each stays, the other is out of the plane.
TEST(Planar, ModalBodyMovesAsInSpace) {
  const BodyFiles files = modal_rod_files(6);
  for (const Quaterniond& q : {upright, on_edge, askew}) expect_same_run(modal_slider_crank(q), files);
  const formats::Scene scene = modal_slider_crank(askew).scene;
  EXPECT_EQ(build_model(scene, files).model.sizes.modal, 6);
  EXPECT_EQ(build_model(with_planar(scene), files).model.sizes.modal, 3);
}

TEST(Planar, TyresRollAsInSpace) {
  for (const Quaterniond& q : {upright, on_edge, askew})
    for (const std::optional<double>& relaxation : {std::optional<double>(), std::optional(0.3)})
      for (const bool bump : {false, true})
        expect_same_run(test_support::braked_wheel(q, relaxation, bump), BodyFiles{});
}

// Factors of the projection of positions are renewed where bodies have turned far: at the same steps as in space, so
// that not even what they are too old for differs (it was 2e-9 of the length).
TEST(Planar, RenewsTheProjectionOfPositionsAsInSpace) {
  TurnedScene t = spin_up(upright);
  t.scene.integrator.step = 0.01;
  t.scene.integrator.end = 1.0;
  t.scene.motions = {test_support::drive("root", "t^4")};
  expect_same_run(t, second_order_files(), 1e-12);
}

// Three of six coordinates per rigid body; of a revolute joint two of five equations, of a prismatic one two of five.
TEST(Planar, HasHalfTheCoordinatesAndNoRedundantEquation) {
  const formats::Scene scene = rigid_slider_crank(upright).scene;
  Simulation spatial(scene, BodyFiles{}), flat(with_planar(scene), BodyFiles{});
  EXPECT_EQ(spatial.model().sizes.boundary, 18);
  EXPECT_EQ(spatial.model().sizes.constraints, 20);
  EXPECT_EQ(flat.model().sizes.boundary, 9);
  EXPECT_EQ(flat.model().sizes.constraints, 8);
  spatial.start();
  flat.start();
  EXPECT_GT((spatial.state().active().array() == 0.0).count(), 0);
  EXPECT_EQ((flat.state().active().array() == 0.0).count(), 0);
  const auto gruebler = [](Simulation& run) {
    return count_mobility(run.model(), run.state(), run.workspace.now).gruebler();
  };
  EXPECT_EQ(gruebler(spatial), 6 * 3 - 20);
  EXPECT_EQ(gruebler(flat), 3 * 3 - 8);
}

// Of 12 boundary rows 6; of the internal modes of a straight beam those along it and across it in the plane.
TEST(Planar, SuperelementsKeepTheRowsAndModesOfThePlane) {
  const BodyFiles files = rod_files(18);  // all of three inner nodes: 6 each
  const formats::Scene scene = flexible_slider_crank(upright, formats::InertiaOption::B).scene;
  const Model flat = build_model(with_planar(scene), files).model;
  ASSERT_EQ(flat.superelement_bodies.size(), 1U);
  EXPECT_EQ(flat.superelement_bodies[0].boundary_size, 6);
  EXPECT_EQ(flat.superelement_bodies[0].S_BB.rows(), 6);
  EXPECT_EQ(flat.superelement_bodies[0].modes, 9);
  EXPECT_EQ(flat.sizes.internal, 9);
  EXPECT_EQ(build_model(scene, files).model.sizes.internal, 18);
}

TEST(Planar, OffChangesNoBit) {
  formats::Scene scene = flexible_slider_crank(askew, formats::InertiaOption::M).scene;
  const auto end = [](const formats::Scene& given) {
    Simulation run(given, rod_files(4));
    run.start();
    run.run(0.02);
    return run.state().block();
  };
  const std::vector<double> without = end(scene);
  scene.effects.push_back(planar(false));
  EXPECT_EQ(end(scene), without);
}

// The errors of three coordinates per node choose the steps: those in space, of which three are zero.
TEST(Planar, ErrorControlChoosesTheStepsOfSpace) {
  TurnedScene t = rigid_slider_crank(askew);
  t.scene.integrator.error_control.active = true;
  t.scene.integrator.error_control.tolerance = 1e-4;
  expect_same_run(t, BodyFiles{});
  TurnedScene flexible = flexible_slider_crank(on_edge, formats::InertiaOption::M);
  flexible.scene.integrator.error_control.active = true;
  flexible.scene.integrator.error_control.tolerance = 1e-3;
  expect_same_run(flexible, rod_files(6));
}

// The parts of the matrix turn with the nodes of flexible bodies in the plane too: without that a rod that turns fast
// took ten times as many iterations.
TEST(Planar, RadauNeedsNoMoreIterationsThanInSpace) {
  TurnedScene t(askew);
  t.scene.integrator.method = formats::Method::radau;
  t.scene.integrator.error_control.active = true;
  t.scene.integrator.error_control.tolerance = 1e-6;
  t.scene.integrator.end = 0.5;
  t.add(test_support::superelement_body("rod", "rod"), {0, 0, 0}, 0.0, {0, 0, 0}, 20.0);
  t.hinge("root", "ground", "rod/base", {0, 0, 0});
  const BodyFiles files = rod_files(6);
  Simulation spatial(t.scene, files), flat(with_planar(t.scene), files);
  for (Simulation* run : {&spatial, &flat}) {
    run->start();
    run->run(t.scene.integrator.end);
  }
  EXPECT_LE(flat.iterations, 1.2 * spatial.iterations);
  EXPECT_LE(flat.rejected, spatial.rejected + 2);
}

// Of a joint that holds what leaves the plane alone nothing is left: no row of it is looked at where others repeat each
// other, beside a pin or in a loop of its own.
TEST(Planar, AJointMayHaveNoEquation) {
  TurnedScene t(askew);
  t.add(test_support::rigid_body("block", 1.0, {0.2, 0, 0}, {0.01, 0.02, 0.03}), {0, 0, 0}, 0.0, {0, 0, 0}, 0.0);
  t.hinge("pin", "ground", "block", {0, 0, 0});
  t.hinge("again", "ground", "block", {0, 0, 0});
  t.add(test_support::rigid_body("loose", 1.0, {1.2, 0, 0}, {0.01, 0.02, 0.03}), {0, 0, 0}, 0.0, {0, 0, 0}, 0.0);
  for (const char* body : {"block", "loose"})
    t.scene.joints.push_back(
        joint(std::string("level_") + body, JointKind::parallel_axes, "ground", body, {0, 0, 0}, t.vector({0, 0, 1})));
  Simulation flat(with_planar(t.scene), BodyFiles{});
  flat.start();
  EXPECT_EQ(flat.model().joints[2].size(), 0);
  EXPECT_EQ(flat.model().joints[3].size(), 0);
  EXPECT_THAT(joints_without_unique_reaction(flat.model(), flat.workspace.now),
              ::testing::UnorderedElementsAre("pin", "again"));
}

TEST(Planar, StaticsAsInSpace) {
  TurnedScene t(askew);
  t.add(test_support::superelement_body("rod", "rod"), {0, 0, 0}, 0.0, {0, 0, 0}, 0.0);
  t.scene.joints.push_back(joint("clamp", JointKind::fixed, "ground", "rod/base", {0, 0, 0}, t.vector({0, 0, 1})));
  t.scene.loads = {test_support::constant_load("tip", formats::LoadKind::force, "rod/tip", t.vector({0, -30, 0}))};
  t.scene.statics.tolerance = 1e-12;
  const auto solved = [](const formats::Scene& scene) {
    Simulation run(scene, rod_files(4));
    run.start();
    EXPECT_EQ(solve_statics(run.model(), scene.statics, {}, run.state(), run.workspace).outcome, StepOutcome::accepted);
    return row_of(run);
  };
  const formats::ResultsRow flat = solved(with_planar(t.scene)), spatial = solved(t.scene);
  EXPECT_GT(spatial.strain, 0.1);
  expect_same(flat, spatial, 1e-10);
  expect_same_forces(flat, spatial, 1e-8);
}

}  // namespace
}  // namespace tisserand::mechanism::planar_test
