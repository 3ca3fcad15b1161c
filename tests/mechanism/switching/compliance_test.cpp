// SPDX-License-Identifier: GPL-3.0-or-later
// What bodies yield to loads, buckling, and what joints move along with them.
#include <numbers>

#include "mechanism/switching/compliance.hpp"

#include <gtest/gtest.h>

#include "mechanism/build/build_model.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/switching/buckling.hpp"
#include "mechanism/switching/carried_inertia.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/second_order_scenes.hpp"

namespace tisserand::mechanism::compliance_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using test_support::Simulation;

// A free beam under a moment M at both ends: w'' = M/EI, its ends are M L²/(12 EI) from the mean of its mass, and
// turned by M L/EI against each other. Hermite's cubic holds the parabola, its mass the mean; rotary inertia is left
// out.
TEST(Compliance, IsThatOfABeam) {
  test_support::BeamData data;
  data.rotary_inertia = false;
  BodyFiles list;
  test_support::add_file("beam", test_support::beam_superelement(data), list.superelements);
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  const BuiltModel built = build_model(scene, list);
  const SuperelementCompliance compliance(body_of(built.model, 0));
  const double M = 100.0, L = data.length, EI = data.young * data.Iz;
  VectorXd load = VectorXd::Zero(12);
  load[5] = -M;
  load[11] = M;
  const VectorXd y = compliance.deformation(load);
  EXPECT_NEAR(y[11] - y[5], M * L / EI, 1e-9 * M * L / EI);
  EXPECT_NEAR(std::abs(y[1]), M * L * L / (12.0 * EI), 1e-9 * M * L * L / EI);
  EXPECT_NEAR(compliance.strain_energy(y), 0.5 * M * M * L / EI, 1e-9 * M * M * L / EI);
  EXPECT_LT((compliance.without_rigid_motion(y) - y).norm(), 1e-12 * y.norm());
}

/// A straight beam of 2 with EI = 100 about its weaker axis, elastic as it is.
SuperelementBody slender() {
  const auto beam = test_support::bernoulli_beam(test_support::slender_section(1e5), 2.0, 8);
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  const BodyFiles list = test_support::files_of(test_support::second_order_beam(beam, {0, 4, 8}, 6));
  return build_model(scene, list).model.superelement_bodies[0];
}

// Euler's load of hinged ends, π² EI/l²; a beam of eight elements errs by less than 1e-3. Tension buckles nothing.
TEST(Buckling, IsEulersLoad) {
  const SuperelementBody body = slender();
  const SuperelementCompliance compliance(body);
  const Buckling buckling(body, compliance);
  const double euler = std::numbers::pi * std::numbers::pi * 100.0 / 4.0;
  VectorXd load = VectorXd::Zero(body.boundary_size + body.modes);
  load[0] = 0.3 * euler;
  load[12] = -0.3 * euler;
  EXPECT_NEAR(buckling.load_share(compliance.deformation(load)), 0.3, 0.3 * 5e-3);
  EXPECT_GE(buckling.bound(compliance.deformation(load)), 0.3 * (1.0 - 5e-3));
  EXPECT_LT(buckling.load_share(compliance.deformation(-load)), 1e-3);
}

// A beam that bends on a clamp: with y and its rigid motion taken apart, T must be that of the motion with the clamp at
// rest. A bob at the tip adds ½ m v².
TEST(CarriedInertia, IsThatOfTheClampedBeamAndItsBob) {
  BodyFiles list;
  test_support::add_file("beam", test_support::craig_bampton_beam({}, 3), list.superelements);
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  formats::RigidBodySpec bob = test_support::rigid_body("bob", 5.0, Vector3d::Zero(), {1e-9, 1e-9, 1e-9});
  bob.start.pose.position = {2, 0, 0};
  scene.bodies.emplace_back(bob);
  const Vector3d z = Vector3d::UnitZ();
  scene.joints = {test_support::joint("clamp", formats::JointKind::fixed, "ground", "beam/base", Vector3d::Zero(), z),
                  test_support::joint("ball", formats::JointKind::spherical, "beam/tip", "bob", {2, 0, 0}, z)};
  Simulation whole(scene, list);
  whole.start();
  scene.effects = {{formats::Effect::flexibility, "", false, "test"}};
  Simulation rigid(scene, list);
  rigid.start();
  const SuperelementBody& body = body_of(whole.model(), 0);
  const SuperelementCompliance compliance(body);
  // As a cantilever: the base rests.
  VectorXd rate = VectorXd::Zero(body.boundary_size + body.modes);
  const int tip = body.node.back().translation_row;
  rate[tip + 1] = 0.7;
  rate[body.node.back().rotation_row + 2] = 0.5;
  const double expected = compliance.kinetic_energy(rate) + 0.5 * 5.0 * 0.7 * 0.7;
  const VectorXd y = compliance.without_rigid_motion(rate);
  CarriedInertia carried(rigid.model(), whole.model());
  carried.set(rigid.state(), 1e-9);
  Evaluation now(whole.model());
  evaluate(whole.model(), whole.state(), now);
  EXPECT_LT(compliance.kinetic_energy(y), 0.5 * expected);
  EXPECT_TRUE(carried.knows());
  EXPECT_NEAR(compliance.kinetic_energy(y) + carried.energies({y}, now)[0], expected, 1e-6 * expected);

  // Multipliers of other joints say nothing of these.
  scene.joints.pop_back();
  Simulation other(scene, list);
  other.start();
  CarriedInertia unknown(other.model(), whole.model());
  unknown.set(other.state(), 1e-9);
  EXPECT_FALSE(unknown.knows());
  EXPECT_EQ(unknown.energies({y}, now)[0], 0.0);
}

}  // namespace
}  // namespace tisserand::mechanism::compliance_test
