// One motion, whatever solves its linear systems; what the report says about them.
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

}  // namespace
}  // namespace tisserand::mechanism::solvers_test
