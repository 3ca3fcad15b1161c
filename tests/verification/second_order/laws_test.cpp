// SPDX-License-Identifier: GPL-3.0-or-later
// Laws that a second-order superelement obeys in motion: momenta, positive mass, order of nodes, modes of stretch,
// frequencies under load.
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "formats/companion/operations.hpp"
#include "mechanism/analyses/modes.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/bodies/superelement/evaluate.hpp"
#include "tests/support/bodies/uncondensed_tangent.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/second_order_scenes.hpp"

namespace tisserand::mechanism::second_order_laws_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using formats::InertiaOption;
using formats::JointKind;
using formats::LoadKind;
using formats::StiffeningOption;
using test_support::constant_load;
using test_support::empty_scene;
using test_support::files_of;
using test_support::joint;
using test_support::Simulation;

const Vector3d z = Vector3d::UnitZ();

/// Length 10, EI 100 and 200; two boundary nodes, the first and `last`.
test_support::SecondOrderBody beam(double EA, int elements, int modes, int last) {
  const test_support::SectionData section = test_support::slender_section(EA);
  return test_support::second_order_beam(test_support::bernoulli_beam(section, 10.0, elements), {0, last}, modes);
}

formats::Scene tumbling(double step) {
  formats::Scene scene = empty_scene(step, 50.0);
  scene.integrator.rho = 1.0;
  formats::SuperelementBodySpec body = test_support::superelement_body("beam", "beam");
  body.start.angular_velocity = Vector3d(0.1, 0.4, 0.5);
  body.start.velocity = Vector3d(1.0, -0.5, 0.3);
  scene.bodies.push_back(body);
  return scene;
}

/// Momentum, and angular momentum about the origin, at the latest evaluation.
struct Momenta {
  Vector3d P, L;
};

Momenta momenta(const Simulation& run) {
  const SuperelementScratch& scratch = run.workspace.now.superelements[0];
  const auto& t = scratch.forces.inertia;
  const Vector3d P = scratch.motion.R0 * t.pi_v;
  return {P, scratch.motion.x0.cross(P) + scratch.motion.R0 * t.pi_O};
}

/// Least eigenvalue of ∂²T/∂q̇² relative to the largest, coordinates in their units.
double least_mass(const Simulation& run) {
  const SuperelementBody& body = body_of(run.model(), 0);
  MatrixXd A;
  test_support::uncondensed_tangent(body, run.workspace.now.superelements[0],
                                    nodes_of(run.model(), 0, run.workspace.now), Vector3d::Zero(), {1.0, 0.0, 0.0},
                                    TangentKind::step, A);
  const auto unit = coordinate_units(body);
  const Eigen::VectorXd all =
      Eigen::SelfAdjointEigenSolver<MatrixXd>(unit.asDiagonal() * (0.5 * (A + A.transpose())) * unit.asDiagonal())
          .eigenvalues();
  return all[0] / all[all.size() - 1];
}

struct Drift {
  double P = 0.0, L = 0.0;             ///< largest changes, relative
  double first = 0.0, last = 0.0;      ///< means of |L|/|L(0)| − 1 over the first and last tenth
  double mass = 1.0, mass_rest = 0.0;  ///< least eigenvalues
};

Drift drift_of(double step, double end) {
  // With a node at each end the motion is symmetric, and the momentum is that of the nodes: exact in any scheme.
  Simulation run(tumbling(step), files_of(beam(1e4, 12, 4, 9)));
  run.start();
  evaluate(run.model(), run.state(), run.workspace.now);
  const Momenta before = momenta(run);
  Drift drift;
  drift.mass_rest = least_mass(run);
  int count_first = 0, count_last = 0;
  run.run(end, [&] {
    evaluate(run.model(), run.state(), run.workspace.now);
    const Momenta now = momenta(run);
    drift.P = std::max(drift.P, (now.P - before.P).norm() / before.P.norm());
    drift.L = std::max(drift.L, (now.L - before.L).norm() / before.L.norm());
    const double length = now.L.norm() / before.L.norm() - 1.0;
    if (run.state().time() < 0.1 * end) drift.first += length, ++count_first;
    if (run.state().time() > 0.9 * end) drift.last += length, ++count_last;
    if (run.steps % 50 == 0) drift.mass = std::min(drift.mass, least_mass(run));
  });
  drift.first /= count_first;
  drift.last /= count_last;
  return drift;
}

// Without forces the continuous equations keep both exactly, so that what changes is the integrator's error: of order
// two, without drift. An independent program has 6.8e-4 and 3.7e-5 of the angular momentum at these two steps. Kinetic
// energies in which N and T stand outside of the square lost a positive mass in this motion after 2 s.
TEST(SecondOrderLaws, FreeBeamKeepsItsMomentaAndAPositiveMass) {
  const Drift coarse = drift_of(0.005, 50.0);
  EXPECT_LT(coarse.P, 1e-3);
  EXPECT_LT(coarse.L, 2e-3);
  EXPECT_NEAR(coarse.first, coarse.last, 2e-4);
  EXPECT_GT(coarse.mass_rest, 0.0);
  EXPECT_GT(coarse.mass, 0.5 * coarse.mass_rest);
  const Drift fine = drift_of(0.0025, 10.0), same = drift_of(0.005, 10.0);
  EXPECT_LT(fine.L, 0.4 * same.L);
  EXPECT_LT(fine.P, 0.4 * same.P);
}

/// The rows of the file with its two nodes in the other order.
test_support::SecondOrderBody exchanged(const test_support::SecondOrderBody& body) {
  test_support::SecondOrderBody out = body;
  const Eigen::Index n = body.element.size();
  MatrixXd A = MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) A(i, i < 12 ? (i + 6) % 12 : i) = 1.0;
  out.element.stiffness = A.transpose() * body.element.stiffness * A;
  out.element.mass = A.transpose() * body.element.mass * A;
  std::swap(out.element.node_name[0], out.element.node_name[1]);
  out.element.node_position.row(0).swap(out.element.node_position.row(1));
  formats::congruence(out.companion, A);
  out.companion.weights.reverseInPlace();
  return out;
}

Eigen::VectorXd after_two_seconds(const BodyFiles& files) {
  Simulation run(tumbling(0.005), files);
  run.start();
  run.run(2.0);
  Eigen::VectorXd out(12);
  out << run.position("beam/n0"), run.position("beam/n12"), run.velocity("beam/n0"), run.velocity("beam/n12");
  return out;
}

// Newton's tolerance is all that differs.
TEST(SecondOrderLaws, OrderOfNodesDoesNotMatter) {
  const auto body = beam(1e4, 12, 4, 12);
  const Eigen::VectorXd expected = after_two_seconds(files_of(body)),
                        found = after_two_seconds(files_of(exchanged(body)));
  EXPECT_LT((found - expected).norm(), 1e-8 * expected.norm());
}

/// The lowest frequencies [rad/time] of a cantilever of `modes` modes that turns about its root.
std::vector<double> turning(int modes, StiffeningOption stiffening) {
  // Clamped at both ends: bending 22.4, 61.7, 121, 200 and 299 in both planes, then stretch 314, torsion 3142.
  const test_support::SectionData section{.EA = 1e4,
                                          .GJ = 1,
                                          .EI_y = 1,
                                          .EI_z = 1,
                                          .mass = 1,
                                          .torsional_inertia = 1e-6,
                                          .rotary_y = 1e-9,
                                          .rotary_z = 1e-9};
  formats::Scene scene = empty_scene(1e-3, 1.0);
  formats::SuperelementBodySpec body = test_support::superelement_body("beam", "beam");
  body.inertia = InertiaOption::F;
  body.stiffening = stiffening;
  scene.bodies.push_back(body);
  scene.analysis = formats::AnalysisKind::statics;
  scene.joints.push_back(joint("hub", JointKind::revolute, "ground", "beam/n0", Vector3d::Zero(), z));
  scene.motions.push_back(test_support::drive("hub", "6 * t"));
  scene.statics.rotation = formats::RotationSpec{Vector3d(0, 0, 6), Vector3d::Zero()};
  Simulation run(
      scene, files_of(test_support::second_order_beam(test_support::bernoulli_beam(section, 1.0, 20), {0, 20}, modes)));
  run.start();
  EXPECT_EQ(solve_statics(run.model(), scene.statics, {}, run.state(), run.workspace).outcome, StepOutcome::accepted);
  formats::ModesSpec spec;
  spec.rotation = Vector3d(0, 0, 6);
  std::vector<double> found;
  for (const Mode& mode : solve_modes(run.model(), run.state(), spec, run.workspace.now).modes)
    if (found.size() < 4) found.push_back(std::abs(mode.eigenvalue));
  return found;
}

// A mode of stretch shortens with the bending; N and T leave it out of what they hold, so that nothing is counted
// twice, and nothing is missing without it. An independent program: 1e-3. Without N and T the mode changes them by 2 %.
TEST(SecondOrderLaws, ModesOfStretchAddNothing) {
  const auto bending = turning(10, StiffeningOption::full), stretch = turning(11, StiffeningOption::full);
  const auto bending_alone = turning(10, StiffeningOption::stress), both = turning(11, StiffeningOption::stress);
  double with = 0.0, without = 0.0;
  for (std::size_t i = 0; i < bending.size(); ++i) {
    with = std::max(with, std::abs(stretch[i] / bending[i] - 1.0));
    without = std::max(without, std::abs(both[i] / bending_alone[i] - 1.0));
  }
  EXPECT_LT(with, 1e-3);
  EXPECT_GT(without, 3.0 * with);
}

/// ω² of the softest bending of the pinned beam under an axial load at its tip (compression > 0).
double pinned_frequency(const BodyFiles& files, double compression) {
  formats::Scene scene = empty_scene(1e-3, 1.0);
  scene.bodies.push_back(test_support::superelement_body("beam", "beam"));
  scene.analysis = formats::AnalysisKind::statics;
  formats::JointSpec base = joint("base", JointKind::generic, "ground", "beam/n0", Vector3d::Zero(), z);
  base.hold = {true, true, true, true, false, false};
  formats::JointSpec tip = joint("tip", JointKind::generic, "ground", "beam/n16", {10, 0, 0}, z);
  tip.hold = {false, true, true, false, false, false};
  scene.joints = {base, tip};
  scene.loads.push_back(constant_load("axial", LoadKind::force, "beam/n16", {-compression, 0, 0}));
  Simulation run(scene, files);
  run.start();
  EXPECT_EQ(solve_statics(run.model(), scene.statics, {}, run.state(), run.workspace).outcome, StepOutcome::accepted);
  const auto modes = solve_modes(run.model(), run.state(), {}, run.workspace.now).modes;
  return std::norm(modes.at(0).eigenvalue) * (modes.at(0).eigenvalue.real() > 1e-6 ? -1.0 : 1.0);
}

// ω² = ω₀² (1 − P/P_E), P_E = π² EI/L²: the shape of buckling is that of the vibration (the rotary inertia scales
// both).
TEST(SecondOrderLaws, FrequenciesUnderLoadAndTheBucklingLoad) {
  const BodyFiles files = files_of(beam(1e6, 16, 2, 16));
  const double euler = std::numbers::pi * std::numbers::pi;  // EI/L² = 1
  const double free = pinned_frequency(files, 0.0);
  EXPECT_NEAR(std::sqrt(free), 0.1 * euler, 1e-3 * euler);  // π² √(EI/m)/L², a beam of slenderness 100
  for (const double part : {-3.0, -1.0, 0.3, 0.6, 0.9})
    EXPECT_NEAR(pinned_frequency(files, part * euler) / free, 1.0 - part, 1e-3 * (1.0 + std::abs(part))) << part;
  // The frequency is zero at the buckling load.
  const double a = pinned_frequency(files, 0.98 * euler), b = pinned_frequency(files, 0.995 * euler);
  EXPECT_NEAR(0.98 + 0.015 * a / (a - b), 1.00016, 3e-4);
}

}  // namespace
}  // namespace tisserand::mechanism::second_order_laws_test
