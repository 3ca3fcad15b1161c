// Planar scenes: the planar equations give the motion in space, with half the coordinates; what leaves the plane is
// named.
#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/results/results.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/build/effects.hpp"
#include "mechanism/run/output.hpp"
#include "mechanism/step/redundancy.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/second_order_scenes.hpp"

namespace tisserand::mechanism::planar_test {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::Effect;
using formats::JointKind;
using test_support::joint;
using test_support::Simulation;
using ::testing::AllOf;
using ::testing::HasSubstr;

const Quaterniond upright = Quaterniond::Identity();
/// z to −y: the x-z plane.
const Quaterniond on_edge(Eigen::AngleAxisd(0.5 * EIGEN_PI, Vector3d::UnitX()));
const Quaterniond askew(Eigen::AngleAxisd(0.7, Vector3d(1, -2, 0.5).normalized()));

/// A scene of the x-y plane, turned and moved as a whole.
struct Turned {
  Quaterniond q;
  formats::Scene scene;

  explicit Turned(const Quaterniond& turn) : q(turn), scene(test_support::empty_scene(1e-3, 0.2)) {
    scene.gravity = vector({0, -9.81, 0});
    scene.integrator.tolerance = 1e-12;
    scene.integrator.constraint_tolerance = 1e-13;
  }
  Vector3d vector(const Vector3d& v) const { return q * v; }
  void add(formats::BodySpec body, const Vector3d& position, double angle, const Vector3d& velocity, double omega) {
    std::visit(
        [&](auto& spec) {
          spec.start.pose.position = vector(position);
          spec.start.pose.orientation = q * Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
          spec.start.velocity = vector(velocity);
          spec.start.angular_velocity = vector({0, 0, omega});
        },
        body);
    scene.bodies.push_back(std::move(body));
  }
  void hinge(const std::string& name, const std::string& a, const std::string& b, const Vector3d& at) {
    scene.joints.push_back(joint(name, JointKind::revolute, a, b, vector(at), vector({0, 0, 1})));
  }
  void slide(const std::string& name, const std::string& b, const Vector3d& at) {
    scene.joints.push_back(joint(name, JointKind::prismatic, "ground", b, vector(at), vector({1, 0, 0})));
    scene.joints.back().x_axis = vector({0, 1, 0});
  }
};

formats::EffectSwitch planar(bool on) { return {Effect::planar, "", on, "scene.yaml:3:5"}; }

formats::Scene with_planar(formats::Scene scene) {
  scene.effects.push_back(planar(true));
  return scene;
}

/// Crank, rod and slider of rigid bodies, with a spring, a damper, a load that follows and one that does not.
Turned rigid_slider_crank(const Quaterniond& q) {
  Turned t(q);
  t.add(test_support::rigid_body("crank", 1.0, {0.1, 0.02, 0}, {0.01, 0.02, 0.03}), {0, 0, 0}, 0.5 * EIGEN_PI,
        {0, 0, 0}, 3.0);
  const double angle = -std::asin(0.2 / 0.5);
  t.add(test_support::rigid_body("rod", 2.0, {0.25, 0, 0}, {0.01, 0.05, 0.06}), {0, 0.2, 0}, angle, {-0.6, 0, 0}, 0.0);
  const double reach = std::sqrt(0.25 - 0.04);
  t.add(test_support::rigid_body("slider", 0.5, {0, 0, 0}, {0.01, 0.01, 0.01}), {reach, 0, 0}, 0.0, {-0.6, 0, 0}, 0.0);
  t.hinge("main", "ground", "crank", {0, 0, 0});
  t.hinge("pin", "crank", "rod", {0, 0.2, 0});
  t.hinge("wrist", "rod", "slider", {reach, 0, 0});
  t.slide("guide", "slider", {reach, 0, 0});
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.coordinate = formats::CoordinateRef{"guide", ""};
  spring.stiffness = 200.0;
  spring.damping = 3.0;
  t.scene.springs.push_back(spring);
  formats::LoadSpec push = test_support::constant_load("push", formats::LoadKind::force, "rod", {0, -5, 0});
  push.axes = formats::LoadAxes::body;
  push.components[0] = formats::TimeExpression{"3 * sin(20 * t)", {}, "here"};
  formats::LoadSpec pull = test_support::constant_load("pull", formats::LoadKind::force, "slider", t.vector({4, 1, 0}));
  formats::LoadSpec twist =
      test_support::constant_load("twist", formats::LoadKind::moment, "crank", t.vector({0, 0, 0.3}));
  t.scene.loads = {push, pull, twist};
  return t;
}

/// A driven crank, a flexible rod and its guide, as in examples/slider_crank.
Turned flexible_slider_crank(const Quaterniond& q, formats::InertiaOption inertia) {
  Turned t(q);
  t.scene.integrator.step = 5e-4;
  t.scene.integrator.end = 0.05;
  t.add(test_support::rigid_body("crank", 1.0, {0, 0, 0}, {0.02, 0.02, 0.02}), {0, 0, 0}, 0.0, {0, 0, 0}, 30.0);
  formats::SuperelementBodySpec rod = test_support::superelement_body("rod", "rod");
  rod.inertia = inertia;
  rod.damping.ratio = 0.01;
  t.add(rod, {0.3, 0, 0}, 0.0, {0, 9, 0}, -4.5);
  t.hinge("main", "ground", "crank", {0, 0, 0});
  t.scene.joints.push_back(
      joint("pin", JointKind::spherical, "crank", "rod/base", t.vector({0.3, 0, 0}), q * Vector3d::UnitZ()));
  formats::JointSpec guide =
      joint("guide", JointKind::generic, "ground", "rod/tip", t.vector({2.3, 0, 0}), q * Vector3d::UnitZ());
  guide.x_axis = t.vector({1, 0, 0});
  guide.hold = {false, true, true, true, false, false};
  t.scene.joints.push_back(guide);
  t.scene.motions.push_back(test_support::drive("main", "30 * t + 40 * t^2"));
  return t;
}

BodyFiles rod_files(int modes) {
  BodyFiles files;
  test_support::add_file("rod", test_support::craig_bampton_beam({}, modes), files.superelements);
  return files;
}

/// The spin-up of a second-order beam about its root.
Turned spin_up(const Quaterniond& q) {
  Turned t(q);
  t.scene.integrator.step = 2e-3;
  t.scene.integrator.end = 0.2;
  t.add(test_support::superelement_body("beam", "beam"), {0, 0, 0}, 0.0, {0, 0, 0}, 0.0);
  t.hinge("root", "ground", "beam/n0", {0, 0, 0});
  t.scene.motions.push_back(test_support::drive("root", "10 * t^2"));
  return t;
}

BodyFiles second_order_files() {
  const auto beam = test_support::bernoulli_beam(test_support::slender_section(1e5), 2.0, 8);
  return test_support::files_of(test_support::second_order_beam(beam, {0, 4, 8}, 6));
}

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
}

/// Both runs to the end; their sizes for the caller.
void expect_same_run(const Turned& given, const BodyFiles& files, double tolerance = 1e-10) {
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

// Factors of the projection of positions are renewed where bodies have turned far: at the same steps as in space, so
// that not even what they are too old for differs (it was 2e-9 of the length).
TEST(Planar, RenewsTheProjectionOfPositionsAsInSpace) {
  Turned t = spin_up(upright);
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
  Turned t = rigid_slider_crank(askew);
  t.scene.integrator.error_control.active = true;
  t.scene.integrator.error_control.tolerance = 1e-4;
  expect_same_run(t, BodyFiles{});
  Turned flexible = flexible_slider_crank(on_edge, formats::InertiaOption::M);
  flexible.scene.integrator.error_control.active = true;
  flexible.scene.integrator.error_control.tolerance = 1e-3;
  expect_same_run(flexible, rod_files(6));
}

// The parts of the matrix turn with the nodes of flexible bodies in the plane too: without that a rod that turns fast
// took ten times as many iterations.
TEST(Planar, RadauNeedsNoMoreIterationsThanInSpace) {
  Turned t(askew);
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
// other.
TEST(Planar, AJointMayHaveNoEquation) {
  Turned t(askew);
  t.add(test_support::rigid_body("block", 1.0, {0.2, 0, 0}, {0.01, 0.02, 0.03}), {0, 0, 0}, 0.0, {0, 0, 0}, 0.0);
  t.hinge("pin", "ground", "block", {0, 0, 0});
  t.hinge("again", "ground", "block", {0, 0, 0});
  t.scene.joints.push_back(joint("level", JointKind::parallel_axes, "ground", "block", {0, 0, 0}, t.vector({0, 0, 1})));
  Simulation flat(with_planar(t.scene), BodyFiles{});
  flat.start();
  EXPECT_EQ(flat.model().joints[2].size(), 0);
  EXPECT_THAT(joints_without_unique_reaction(flat.model(), flat.workspace.now),
              ::testing::UnorderedElementsAre("pin", "again"));
}

TEST(Planar, StaticsAsInSpace) {
  Turned t(askew);
  t.add(test_support::superelement_body("rod", "rod"), {0, 0, 0}, 0.0, {0, 0, 0}, 0.0);
  t.scene.joints.push_back(joint("clamp", JointKind::fixed, "ground", "rod/base", {0, 0, 0}, t.vector({0, 0, 1})));
  t.scene.loads = {test_support::constant_load("tip", formats::LoadKind::force, "rod/tip", t.vector({0, -30, 0}))};
  t.scene.statics.tolerance = 1e-12;
  const auto solved = [](const formats::Scene& scene) {
    Simulation run(scene, rod_files(4));
    run.start();
    EXPECT_EQ(solve_statics(run.model(), scene.statics, run.state(), run.workspace).outcome, StepOutcome::accepted);
    return row_of(run);
  };
  const formats::ResultsRow flat = solved(with_planar(t.scene)), spatial = solved(t.scene);
  EXPECT_GT(spatial.strain, 0.1);
  expect_same(flat, spatial, 1e-10);
  expect_same_forces(flat, spatial, 1e-8);
}

// --- What leaves the plane.

std::string error_of(const formats::Scene& scene, const BodyFiles& files = {}) {
  try {
    (void)build_model(with_planar(scene), files);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

std::string error_after(const std::function<void(formats::Scene&)>& change) {
  formats::Scene scene = rigid_slider_crank(upright).scene;
  change(scene);
  return error_of(scene);
}

formats::RigidBodySpec& body_of_scene(formats::Scene& scene, std::size_t i) {
  return std::get<formats::RigidBodySpec>(scene.bodies[i]);
}

TEST(Planar, WhatLeavesThePlaneIsNamed) {
  EXPECT_EQ(error_after([](formats::Scene&) {}), "");
  EXPECT_THAT(error_after([](formats::Scene& s) {
                s.gravity = {0, -9.81, 0.5};
              }),
              AllOf(HasSubstr("scene.yaml:3:5"), HasSubstr("gravity of body 'crank' has the part 0.5"),
                    HasSubstr("planar: off")));
  EXPECT_THAT(error_after([](formats::Scene& s) {
                body_of_scene(s, 1).inertia(0, 2) = body_of_scene(s, 1).inertia(2, 0) = 1e-3;
              }),
              AllOf(HasSubstr("inertia of body 'rod'"), HasSubstr("0.001"), HasSubstr("products of inertia")));
  EXPECT_THAT(error_after([](formats::Scene& s) {
                body_of_scene(s, 2).start.velocity = {-0.6, 0, 0.1};
              }),
              HasSubstr("velocity of body 'slider' has the part 0.1"));
  EXPECT_THAT(error_after([](formats::Scene& s) {
                body_of_scene(s, 0).start.angular_velocity = {0, 0.2, 3};
              }),
              HasSubstr("angular velocity of body 'crank' has the part 0.2"));
  EXPECT_THAT(error_after([](formats::Scene& s) { s.joints[1].axis = Vector3d(0, 0.1, 1); }), HasSubstr("joint 'pin'"));
  EXPECT_THAT(error_after([](formats::Scene& s) { s.joints[3].axis = Vector3d(1, 0, 0.1); }),
              HasSubstr("joint 'guide'"));
  EXPECT_THAT(error_after([](formats::Scene& s) { s.joints[1].position = Vector3d(0, 0.2, 0.03); }),
              AllOf(HasSubstr("joint 'pin'"), HasSubstr("0.03")));
  EXPECT_THAT(error_after([](formats::Scene& s) { s.loads[1].components[2] = 2.0; }),
              AllOf(HasSubstr("force 'pull'"), HasSubstr("2")));
  EXPECT_THAT(error_after([](formats::Scene& s) {
                s.loads[1].components[2] = formats::TimeExpression{"0 * t", {}, "h"};
              }),
              AllOf(HasSubstr("component z of force 'pull' is no constant"), HasSubstr("the number 0")));
  EXPECT_THAT(error_after([](formats::Scene& s) { s.loads[2].components[0] = 1.0; }), HasSubstr("moment 'twist'"));
}

// A coordinate out of the plane is not in the model: neither its value nor its rate would be the one that is given.
TEST(Planar, InitialValuesOutOfThePlaneAreNamed) {
  EXPECT_THAT(error_after([](formats::Scene& s) {
                s.joints[1].kind = JointKind::cylindrical;
                formats::InitialSpec spec;
                spec.coordinate = {"pin/z", ""};
                spec.value = 0.1;
                s.initial = {spec};
              }),
              AllOf(HasSubstr("initial 'pin/z'"), HasSubstr("planar: off")));
}

// Gyroscopic and centrifugal terms of such a turn push out of the plane.
TEST(Planar, SteadyRotationsAboutAnAxisInThePlaneAreNamed) {
  EXPECT_THAT(error_after([](formats::Scene& s) {
                s.analysis = formats::AnalysisKind::modes;
                s.modes.rotation = Vector3d(20, 0, 0);
              }),
              HasSubstr("modes: rotation has the part 20"));
  EXPECT_THAT(error_after([](formats::Scene& s) {
                s.analysis = formats::AnalysisKind::statics;
                s.statics.rotation = formats::RotationSpec{{0, 1e-6, 20}, Vector3d::Zero()};
              }),
              HasSubstr("statics: the angular velocity has the part 1e-06"));
  EXPECT_EQ(error_after([](formats::Scene& s) {
              s.analysis = formats::AnalysisKind::modes;
              s.modes.rotation = Vector3d(0, 0, 20);
            }),
            "");
}

TEST(Planar, ASuperelementThatBendsOutOfThePlaneIsNamed) {
  formats::Scene scene = flexible_slider_crank(upright, formats::InertiaOption::B).scene;
  auto& rod = std::get<formats::SuperelementBodySpec>(scene.bodies[1]);
  // Unequal second moments, turned about the axis of the beam: bending in the plane bends it out of it.
  rod.start.pose.orientation = Quaterniond(Eigen::AngleAxisd(0.3, Vector3d::UnitX()));
  EXPECT_THAT(error_of(scene, rod_files(4)), AllOf(HasSubstr("superelement 'rod'"), HasSubstr("couples motion in it")));
}

}  // namespace
}  // namespace tisserand::mechanism::planar_test
