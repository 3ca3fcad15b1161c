// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of different kinds in one scene: conservation in free flight, and agreement of the flexible formulations where
// deformations are small.
#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "tests/support/bodies/beam_states.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::mixed_bodies_test {
namespace {

using Eigen::Vector3d;
using formats::InertiaOption;
using formats::JointKind;
using test_support::Simulation;

/// Linear momentum and angular momentum about the world's origin: generalised momenta are what the residual gains by
/// v̇ = v, forces in world axes and moments in node axes.
struct Momentum {
  Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();
};
Momentum momentum(Simulation& run) {
  const Model& model = run.model();
  State with = run.state();
  with.lambda().setZero();
  State without = with;
  with.vdot() = with.v();
  without.vdot().setZero();
  evaluate(model, with, run.workspace.now);
  Eigen::VectorXd p = run.workspace.now.residual;
  evaluate(model, without, run.workspace.now);
  p -= run.workspace.now.residual;
  Momentum sum;
  for (int i = 0; i < model.sizes.nodes; ++i) {
    const Node& node = model.nodes[i];
    if (node.translation >= 0) {
      sum.linear += p.segment<3>(node.translation);
      sum.angular += Vector3d(run.state().x().col(i)).cross(p.segment<3>(node.translation));
    }
    if (node.rotation >= 0) sum.angular += run.workspace.now.motion[i].R * p.segment<3>(node.rotation);
  }
  return sum;
}

/// Superelement, nonlinear beam, and rigid body in a chain (fixed, spherical), turning and translating freely; the part
/// frames are the world, and the joints lie on them.
formats::Scene free_chain(double step, InertiaOption inertia) {
  formats::Scene scene = test_support::empty_scene(step, 0.5);
  scene.integrator.rho = 1.0;
  formats::SuperelementBodySpec frame = test_support::superelement_body("frame", "frame");
  frame.inertia = inertia;
  scene.bodies.push_back(frame);
  formats::BeamBodySpec beam;
  beam.name = "beam";
  beam.from = {1.5, 1.0, 0.7};
  beam.to = {2.5, 1.0, 0.7};
  beam.elements = 2;
  beam.nodes_per_element = 3;
  beam.section = test::rectangle(0.1, 0.1, 1.4e-5, 5.0 / 6.0);
  beam.material = test::material(1e7, 0.3, 100.0);
  scene.bodies.push_back(beam);
  scene.bodies.push_back(test_support::rigid_body("block", 2.0, {2.7, 1.0, 0.7}, {0.3, 0.4, 0.5}));
  for (formats::BodySpec& body : scene.bodies)
    std::visit(
        [](auto& spec) {
          spec.start.velocity = {3.0, 0.0, -1.0};
          spec.start.angular_velocity = {0.3, -0.5, 1.5};
        },
        body);
  scene.joints = {test_support::joint("weld", JointKind::fixed, "frame/n5", "beam/start", {1.5, 1.0, 0.7}, {0, 0, 1}),
                  test_support::joint("ball", JointKind::spherical, "beam/end", "block", {2.5, 1.0, 0.7}, {0, 0, 1})};
  return scene;
}

struct Drift {
  double linear = 0.0, angular = 0.0, energy = 0.0;
};
Drift drift(double step, InertiaOption inertia) {
  SuperelementFiles files;
  test_support::add_file("frame", test_support::test_superelement("frame"), files);
  Simulation run(free_chain(step, inertia), files);
  run.start();
  const Momentum before = momentum(run);
  const double energy = run.energy().total();
  Drift largest;
  run.run(0.5, [&] {
    const Momentum now = momentum(run);
    largest.linear = std::max(largest.linear, (now.linear - before.linear).norm() / before.linear.norm());
    largest.angular = std::max(largest.angular, (now.angular - before.angular).norm() / before.angular.norm());
    largest.energy = std::max(largest.energy, std::abs(run.energy().total() - energy) / energy);
  });
  return largest;
}

// Momenta and energy are those of the exact equations: their errors are those of the step, of order two or better.
TEST(FreeChainOfMixedBodies, KeepsMomentumAndEnergy) {
  for (const InertiaOption inertia : {InertiaOption::A, InertiaOption::B, InertiaOption::M}) {
    SCOPED_TRACE(static_cast<int>(inertia));
    const Drift coarse = drift(4e-3, inertia), fine = drift(2e-3, inertia);
    for (const auto value : {&Drift::linear, &Drift::angular, &Drift::energy}) {
      EXPECT_LT(fine.*value, 2e-3);
      EXPECT_LT(fine.*value, 0.35 * (coarse.*value) + 1e-9);
    }
  }
}

/// Angle of a beam hinged at its base under a moment for 0.2 s, per unit of the moment.
double hinge_angle(const std::string& kind, double torque) {
  SuperelementFiles files;
  test_support::BeamData data;
  data.shear_area_y = data.shear_area_z = 5.0 / 6.0 * data.area;
  formats::Scene scene = test_support::empty_scene(2e-3, 0.4);
  std::string base = "beam/start";
  if (kind == "beams") {
    formats::BeamBodySpec beam;
    beam.name = "beam";
    beam.to = {data.length, 0, 0};
    beam.elements = 12;
    beam.nodes_per_element = 3;
    beam.section.name = "section";
    beam.section.area = data.area;
    beam.section.second_moment_y = data.Iy;
    beam.section.second_moment_z = data.Iz;
    beam.section.torsion_constant = data.J;
    beam.section.polar_moment = data.Iy + data.Iz;
    beam.section.shear_area_y = data.shear_area_y;
    beam.section.shear_area_z = data.shear_area_z;
    beam.material = test::material(data.young, data.young / (2 * data.shear_modulus) - 1.0, data.density);
    scene.bodies.push_back(beam);
  } else {
    test_support::add_file("beam", test_support::craig_bampton_beam(data, 8), files);
    formats::SuperelementBodySpec body = test_support::superelement_body("beam", "beam");
    body.inertia = kind == "A" ? InertiaOption::A : kind == "B" ? InertiaOption::B : InertiaOption::M;
    scene.bodies.push_back(body);
    base = "beam/base";
  }
  scene.joints.push_back(test_support::joint("hinge", JointKind::revolute, "ground", base, {0, 0, 0}, {0, 0, 1}));
  formats::LoadSpec load = test_support::constant_load("torque", formats::LoadKind::moment, base, {0, 0, 0});
  load.components[2] = formats::TimeTable{{0.0, 0.1, 0.2}, {0.0, torque, 0.0}};
  scene.loads.push_back(load);
  Simulation run(scene, files);
  run.start();
  run.run(0.4);
  return run.state().hinges()[0] / torque;
}

// Per unit of the load the formulations differ by the discretisation (modes left out, elements: below 1e-3) plus what
// falls with the square of the load. 1 N m turns the beam by 0.01, 100 N m by one radian at 6 rad/s.
TEST(FlexibleFormulations, AgreeInTheLimitOfSmallDeformation) {
  const double beams = hinge_angle("beams", 1.0);
  for (const char* kind : {"A", "B", "M"}) {
    SCOPED_TRACE(kind);
    EXPECT_NEAR(hinge_angle(kind, 1.0) / beams, 1.0, 1e-3);
  }
}

// Simo and Vu-Quoc's flying beam ("spaghetti"): L = 10, EA = GA = 1e4, EI = 100, mass per length 1, rotary inertia per
// length 10, which no section of one material has: it is set in the elements. Positions computed: geometrically exact
// plane beam, 64 quadratic elements, h = 0.00125; 32 elements with h = 0.0025 differ by 0.0009 up to 2.5, 0.0033 up
// to 5, 0.0048 up to 10, 0.0066 up to 15.
TEST(FlyingBeam, FollowsTheReferenceAndKeepsItsMomentum) {
  formats::Scene scene = test_support::empty_scene(0.0025, 15.0);
  formats::BeamBodySpec beam;
  beam.name = "beam";
  beam.from = {6, 0, 0};
  beam.to = {0, 8, 0};
  beam.elements = 24;
  beam.nodes_per_element = 3;
  beam.section.name = "section";
  beam.section.area = 1.0;
  beam.section.second_moment_y = beam.section.second_moment_z = 0.01;
  beam.section.torsion_constant = beam.section.polar_moment = 0.02;
  beam.section.shear_area_y = beam.section.shear_area_z = 2.0;
  beam.material = test::material(1e4, 0.0, 1.0);
  scene.bodies.push_back(beam);
  scene.loads = {test_support::constant_load("force", formats::LoadKind::force, "beam/start", {0, 0, 0}),
                 test_support::constant_load("torque", formats::LoadKind::moment, "beam/start", {0, 0, 0})};
  scene.loads[0].components[0] = formats::TimeExpression{"t < 2.5 ? 8 : 0", {2.5}, ""};
  scene.loads[1].components[2] = formats::TimeExpression{"t < 2.5 ? -80 : 0", {2.5}, ""};
  Simulation run(scene, {});
  for (BeamElement3& element : run.built.model.beams3)
    for (Eigen::Matrix3d& inertia : element.inertia) inertia *= 10.0 / 0.01;
  run.start();
  const auto ends = [&](double time) {
    run.run(time);
    Eigen::Vector4d out;
    out << run.position("beam/0").head<2>(), run.position("beam/48").head<2>();
    return out;
  };
  EXPECT_LT((ends(2.5) - Eigen::Vector4d(4.9631, 4.4759, 3.5832, 6.1119)).cwiseAbs().maxCoeff(), 0.005);
  EXPECT_LT((momentum(run).linear - Vector3d(20, 0, 0)).norm(), 1e-6 * 20);
  EXPECT_LT((ends(5.0) - Eigen::Vector4d(9.784, 8.204, 8.074, 1.759)).cwiseAbs().maxCoeff(), 0.02);
  EXPECT_LT((ends(10.0) - Eigen::Vector4d(22.971, 6.412, 21.325, 3.610)).cwiseAbs().maxCoeff(), 0.03);
  EXPECT_LT((ends(15.0) - Eigen::Vector4d(29.064, 6.609, 33.936, 5.236)).cwiseAbs().maxCoeff(), 0.05);
  EXPECT_LT((momentum(run).linear - Vector3d(20, 0, 0)).norm(), 1e-6 * 20);
}

}  // namespace
}  // namespace tisserand::mechanism::mixed_bodies_test
