// SPDX-License-Identifier: GPL-3.0-or-later
// One motion, whatever solves its linear systems; what the report says about them.
#include <array>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/scenes/andrews.hpp"

namespace tisserand::mechanism::solvers_test {
namespace {

using formats::LinearSolver;
using test_support::Simulation;

constexpr LinearSolver solvers[] = {LinearSolver::automatic, LinearSolver::klu, LinearSolver::umfpack,
                                    LinearSolver::dense, LinearSolver::qr};

// 84 coordinates and constraints, 7 revolutions of the crank: agreement to the tolerance of Newton's iteration.
TEST(Solvers, AndrewsMechanismMovesAlikeWithEach) {
  Eigen::Matrix3Xd first;
  for (const LinearSolver solver : solvers) {
    formats::Scene scene = test_support::andrews(2e-5);
    scene.integrator.linear_solver = solver;
    Simulation run(scene, {});
    run.start();
    run.run(0.004);
    if (first.size() == 0) first = run.state().x();
    EXPECT_LT((run.state().x() - first).cwiseAbs().maxCoeff(), 1e-9) << static_cast<int>(solver);
    const SolverHealth& health = run.workspace.matrix.health();
    EXPECT_GT(health.reciprocal_condition, 1e-14);
    EXPECT_LT(health.reciprocal_condition, 0.1);
    EXPECT_GT(health.reciprocal_growth, 1e-6);
    EXPECT_LT(health.backward_error, 1e-10);
  }
}

TEST(Solvers, FlexibleFrameMovesAlikeWithEach) {
  SuperelementFiles files;
  test_support::add_file("frame", test_support::test_superelement("frame"), files);
  Eigen::Matrix3Xd first;
  for (const LinearSolver solver : solvers) {
    formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
    scene.gravity = {0, 0, -9.81};
    scene.bodies.push_back(test_support::superelement_body("frame", "frame"));
    scene.joints.push_back(
        test_support::joint("hinge", formats::JointKind::revolute, "ground", "frame/n0", {0, 0, 0}, {0, 1, 0}));
    scene.integrator.linear_solver = solver;
    Simulation run(scene, files);
    run.start();
    run.run(0.1);
    if (first.size() == 0) first = run.state().x();
    EXPECT_LT((run.state().x() - first).cwiseAbs().maxCoeff(), 1e-8) << static_cast<int>(solver);
  }
}

// UMFPACK bounds its flops from above, KLU's count forgets that zeros on the diagonal forbid its pivots: for a chain
// the bounds alone speak for UMFPACK, which takes twice the time; the trial of KLU speaks for KLU.
TEST(Solvers, AutoTakesKluForALongChain) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  const std::string ground = "ground";
  for (int i = 0; i < 1000; ++i) {
    const std::string name = fmt::format("link_{}", i);
    scene.bodies.push_back(test_support::rigid_body(name, 1.0, {0.5, 0, 0}, {0.01, 0.1, 0.1}));
    std::get<formats::RigidBodySpec>(scene.bodies.back()).start.pose.position = {double(i), 0, 0};
    scene.joints.push_back(test_support::joint(fmt::format("pin_{}", i), formats::JointKind::spherical,
                                               i == 0 ? ground : fmt::format("link_{}", i - 1), name, {double(i), 0, 0},
                                               {0, 0, 1}));
  }
  const Simulation run(scene, {});
  EXPECT_EQ(run.model().solver.kind, SolverKind::klu) << describe(run.model().solver);
}

/// Four-bars side by side: uprights from (i, 0) to (i, 1) that turn with -1 rad/s, links along x between their tips.
formats::Scene windows(int count) {
  formats::Scene scene = test_support::empty_scene(1e-3, 4.0);
  scene.integrator.rho = 0.95;
  scene.integrator.linear_solver = LinearSolver::klu;
  scene.gravity = {0, -9.81, 0};
  const Eigen::Vector3d inertia = Eigen::Vector3d::Constant(1.0 / 12.0), z(0, 0, 1);
  const auto pin = [&](const std::string& name, const std::string& a, const std::string& b, double x, double y) {
    scene.joints.push_back(test_support::joint(name, formats::JointKind::revolute, a, b, {x, y, 0}, z));
  };
  const auto rod = [&](const std::string& name, double x, double y) -> formats::RigidBodySpec& {
    scene.bodies.push_back(test_support::body_at(name, 1.0, {x, y, 0}, inertia));
    return std::get<formats::RigidBodySpec>(scene.bodies.back());
  };
  for (int i = 0; i <= count; ++i) {
    formats::RigidBodySpec& upright = rod(fmt::format("u{}", i), i, 0.5);
    upright.start.angular_velocity = -z;
    upright.start.velocity = {0.5, 0, 0};
    pin(fmt::format("a{}", i), "ground", fmt::format("u{}", i), i, 0);
  }
  for (int i = 0; i < count; ++i) {
    rod(fmt::format("h{}", i), i + 0.5, 1.0).start.velocity = {1, 0, 0};
    pin(fmt::format("b{}", i), fmt::format("u{}", i), fmt::format("h{}", i), i, 1);
    pin(fmt::format("c{}", i), fmt::format("u{}", i + 1), fmt::format("h{}", i), i + 1, 1);
  }
  return scene;
}

// Where the uprights lie flat (0.73 s) other rows are solved for, with zeros on other places of the diagonal: in KLU's
// first order the factors then fill 5.5 times for 10 windows and 8 for 20. A chain has an order whose fill does not
// depend on its length.
TEST(Solvers, FillStaysThatOfAChainAfterAChangeOfRows) {
  std::array<double, 2> fill{};
  for (std::size_t i = 0; i < fill.size(); ++i) {
    Simulation run(windows(i == 0 ? 10 : 20), {});
    run.start();
    const Eigen::VectorXd rows = run.state().active();
    run.run(1.0);
    EXPECT_NE(run.state().active(), rows);
    fill[i] = run.workspace.matrix.health().fill;
  }
  EXPECT_GT(fill[0], 1.0);
  EXPECT_LT(fill[0], 3.0);
  EXPECT_LT(fill[1], 1.2 * fill[0]);
}

}  // namespace
}  // namespace tisserand::mechanism::solvers_test
