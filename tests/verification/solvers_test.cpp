// One motion, whatever solves its linear systems; what the report says about them.
#include <gtest/gtest.h>

#include "tests/support/andrews.hpp"
#include "tests/support/reduced_frames.hpp"

namespace tisserand::mechanism {
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
    const SolverHealth& health = run.workspace.solver.health();
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

}  // namespace
}  // namespace tisserand::mechanism
