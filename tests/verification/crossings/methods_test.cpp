// SPDX-License-Identifier: GPL-3.0-or-later
// Two ways to the same motion of combined capabilities: formulations and methods, and a superelement that is rigid
// against the rigid body of its mass.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/crossings/history.hpp"
#include "tests/support/crossings/ingredients.hpp"
#include "tests/support/crossings/pairs.hpp"

namespace tisserand::test_support::crossings::methods_test {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

Ingredients cell_of(const Choice& c) {
  return {static_cast<Arm>(c[0]), static_cast<Hinge>(c[1]), static_cast<Action>(c[2]), static_cast<Scheme>(c[3])};
}

std::string name_of(const Ingredients& in) {
  return crossings::name_of(in.arm) + " on " + crossings::name_of(in.hinge) + " with " + crossings::name_of(in.action) +
         " by " + crossings::name_of(in.scheme);
}

/// What a run switches by itself jumps at other instants with other steps.
bool is_choice(const Choice& choice) {
  const Ingredients in = cell_of(choice);
  return is_sensible(in) && refusal_of(in).empty() && in.arm != Arm::automatic;
}

History run_with(const Ingredients& in, Scheme scheme, double finer) {
  Ingredients other = in;
  other.scheme = scheme;
  formats::Scene scene = dynamics_scene(other);
  scene.integrator.step /= finer;
  const Similarity same;
  return run_history(scene, scene, same, arm_files());
}

/// By Radau's method, of order 5, where it takes the arm; else by generalised alpha, whose errors fall with the square
/// of the step, with an eighth of it. The vibrations of this arm are quick: errors fall from an eighth of the step on.
History reference(const Ingredients& in) {
  return in.arm == Arm::second_order ? run_with(in, Scheme::index_2, 128.0) : run_with(in, Scheme::radau, 4.0);
}
double first_step(const Ingredients& in) { return in.arm == Arm::second_order ? 8.0 : 1.0; }

/// Halving the step takes three quarters of the error of methods of order 2 away, where nothing is rough; methods that
/// choose their steps hold what they promise.
void expect_near(const Ingredients& in) {
  SCOPED_TRACE(name_of(in));
  const History exact = reference(in), coarse = run_with(in, in.scheme, first_step(in)),
                fine = run_with(in, in.scheme, 2.0 * first_step(in));
  for (const History* one : {&exact, &coarse, &fine}) {
    EXPECT_EQ(one->refusal, "");
    EXPECT_EQ(one->report.outcome, mechanism::RunOutcome::completed) << one->report.reason;
  }
  const Difference error = compare_histories(exact, coarse, {Family::place});
  const Difference finer = compare_histories(exact, fine, {Family::place});
  const bool rough = in.action == Action::stop || in.action == Action::friction ||
                     in.action == Action::torsion_spring ||
                     (in.arm == Arm::second_order && in.scheme == Scheme::damped);  // which takes its vibrations away
  if (in.scheme == Scheme::controlled || in.scheme == Scheme::controlled_index_3)
    EXPECT_LT(error.largest, 2e-3) << error.of;  // tolerance 1e-3 of the size, 1.3 m
  else if (in.scheme == Scheme::bdf || in.scheme == Scheme::controlled_radau)
    EXPECT_LT(error.largest, 1e-5) << error.of;
  else
    EXPECT_LT(finer.largest, (rough ? 0.6 : 0.35) * error.largest + 1e-7) << error.largest << ' ' << error.of;
}

TEST(CrossingMethods, TenCellsAgreeWithEachOther) {
  const std::vector<Choice> all = pairwise({arms, hinges, actions, schemes}, is_choice);
  for (std::size_t i = 0; i < 10; ++i) expect_near(cell_of(all[i * all.size() / 10]));
}

TEST(CrossingMethods, AllCellsAgreeWithEachOther) {
  for (const Choice& choice : pairwise({arms, hinges, actions, schemes}, is_choice)) expect_near(cell_of(choice));
}

/// Mass and inertia that the rigid motions of its nodes show of a superelement of nodes with six coordinates each.
formats::RigidBodySpec rigid_body_of(const formats::Superelement& element) {
  const Eigen::Index n = element.mass.rows();
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(n, 6);
  for (std::size_t k = 0; k < element.node_name.size(); ++k) {
    const Eigen::Vector3d p = element.node_position.row(static_cast<Eigen::Index>(k)).transpose();
    const auto at = static_cast<Eigen::Index>(6 * k);
    motion.block<3, 3>(at, 0).setIdentity();
    motion.block<3, 3>(at + 3, 3).setIdentity();
    for (int axis = 0; axis < 3; ++axis)
      motion.block<3, 1>(at, 3 + axis) = Eigen::Vector3d(Eigen::Vector3d::Unit(axis).cross(p));
  }
  const Eigen::Matrix<double, 6, 6> M = motion.transpose() * element.mass * motion;
  formats::RigidBodySpec body;
  body.name = "arm";
  body.mass = M(0, 0);
  body.center_of_mass = Eigen::Vector3d(M(1, 5), M(2, 3), M(0, 4)) / body.mass;
  const Eigen::Vector3d& c = body.center_of_mass;
  body.inertia =
      M.bottomRightCorner<3, 3>() - body.mass * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
  body.inertia = (0.5 * (body.inertia + body.inertia.transpose())).eval();
  for (std::size_t k = 0; k < element.node_name.size(); ++k)
    body.nodes.push_back(
        {element.node_name[k],
         {element.node_position.row(static_cast<Eigen::Index>(k)).transpose(), Eigen::Quaterniond::Identity()}});
  return body;
}

// The superelement has three nodes and no coordinates when it is rigid; internal coordinates carry no rigid motion.
TEST(CrossingMethods, ARigidSuperelementIsTheRigidBodyOfItsMass) {
  const auto sensible = [](const Choice& choice) { return static_cast<Action>(choice[1]) != Action::part_load; };
  for (const Choice& choice : pairwise({hinges, actions, schemes}, sensible)) {
    const Ingredients in{Arm::use_rigid, static_cast<Hinge>(choice[0]), static_cast<Action>(choice[1]),
                         static_cast<Scheme>(choice[2])};
    SCOPED_TRACE(name_of(in));
    const formats::Scene scene = dynamics_scene(in);
    formats::Scene other = scene;
    formats::RigidBodySpec body = rigid_body_of(arm_files().superelements.at("frame").superelement);
    std::visit([&](const auto& spec) { body.start = spec.start; }, scene.bodies.front());
    if (in.action == Action::own_gravity)
      body.gravity = std::get<formats::SuperelementBodySpec>(scene.bodies.front()).gravity;
    other.bodies.front() = body;
    const Similarity same;
    const History before = run_history(scene, scene, same, arm_files());
    const History after = run_history(other, scene, same, arm_files());
    EXPECT_EQ(before.refusal, "");
    Limits limits;
    // Steps that the error chooses feel the last digits.
    if (in.scheme >= Scheme::bdf) limits = {1e-5, 1e-3, never, never, 1e-3};
    EXPECT_EQ(disagreement(before, after, limits), "");
  }
}

}  // namespace
}  // namespace tisserand::test_support::crossings::methods_test
