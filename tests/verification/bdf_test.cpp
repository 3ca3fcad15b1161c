// SPDX-License-Identifier: GPL-3.0-or-later
// method: bdf: accelerations of index 1 with CVODE against exact and published solutions; drift; flexible bodies.
#include "mechanism/bdf/bdf.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/scenes/andrews.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::bdf_test {
namespace {

using Eigen::Vector3d;
using test_support::Pendulum;
using test_support::Simulation;

/// A started simulation whose steps are CVODE's.
class BdfRun {
 public:
  BdfRun(formats::Scene scene, const SuperelementFiles& files) : simulation_(with_method(std::move(scene)), files) {
    simulation_.start();
    bdf_ = std::make_unique<Bdf>(simulation_.scene, simulation_.model(), simulation_.state(), simulation_.workspace);
  }
  /// Steps until the solver is past `time`, then interpolates.
  void run(double time) {
    const double end = simulation_.scene.integrator.end;
    while (reached_ < time) {
      const std::string failure = bdf_->step({end, end});
      ASSERT_EQ(failure, "");
      reached_ = simulation_.state().time();
      drift_ = std::max(drift_, bdf_->violation());
    }
    bdf_->go_to(time);
  }
  Simulation& operator*() { return simulation_; }
  Simulation* operator->() { return &simulation_; }
  Bdf& solver() { return *bdf_; }
  double drift() const { return drift_; }

 private:
  static formats::Scene with_method(formats::Scene scene) {
    scene.integrator.method = formats::Method::bdf;
    scene.integrator.step = 1e-6;
    return scene;
  }
  Simulation simulation_;
  std::unique_ptr<Bdf> bdf_;
  double reached_ = 0.0, drift_ = 0.0;
};

formats::Scene with(formats::Scene scene, double tolerance) {
  scene.integrator.bdf.relative_tolerance = tolerance;
  scene.integrator.bdf.absolute_tolerance = 0.01 * tolerance;
  return scene;
}

class WithCvode : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!bdf_available()) GTEST_SKIP() << "this build has no CVODE";
  }
};

TEST(Bdf, WithoutCvodeTheErrorSaysWhatToInstall) {
  if (bdf_available()) GTEST_SKIP() << "this build has CVODE";
  try {
    BdfRun run(test_support::pendulum_scene(1e-3, 1.0), {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("libsundials-dev"));
  }
}

// After one period the pendulum is at rest again. Global errors stay within 1000 local tolerances and fall with them.
TEST_F(WithCvode, PendulumHasTheExactPeriod) {
  double previous = 0.0;
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    BdfRun run(with(test_support::pendulum_scene(1e-3, 2 * Pendulum::period()), tolerance), {});
    run.run(Pendulum::period());
    const double acceleration = Pendulum::mass * Pendulum::gravity * Pendulum::arm / Pendulum::inertia_about_hinge();
    const double error = std::abs(run->Omega("pendulum").z()) / acceleration / Pendulum::period();
    EXPECT_LT(error, 1e3 * tolerance) << tolerance;
    if (previous > 0.0) {
      EXPECT_LT(error, 0.1 * previous) << tolerance;
    }
    previous = error;
    EXPECT_LT(run.drift(), 1e-11);
  }
}

// Reference of tests/verification/references: positions, angular velocities and support forces at its instants.
TEST_F(WithCvode, HeavyTopMeetsTheReference) {
  BdfRun run(with(test_support::heavy_top_scene(1e-3, 0.6), 1e-8), {});
  for (const std::vector<double>& row : test_support::reference_rows("heavy_top.csv")) {
    if (row[0] > 0.5) break;
    run.run(row[0]);
    const Vector3d x(row[1], row[2], row[3]), Omega(row[4], row[5], row[6]), force(row[11], row[12], row[13]);
    EXPECT_LT((run->position("top") - x).norm(), 1e-5) << row[0];
    EXPECT_LT((run->Omega("top") - Omega).norm(), 1e-3) << row[0];
    EXPECT_LT((-run->state().lambda() - force).norm(), 2e-4 * force.norm()) << row[0];
  }
  EXPECT_GE(run.solver().counts().order, 3);
}

// Published reference solution of the IVP test set: beta(0.03 s) = 15.81077119629904, gamma = 0.04082224013073.
TEST_F(WithCvode, AndrewsMechanismMeetsThePublishedSolution) {
  BdfRun run(with(test_support::andrews(1e-5), 1e-7), {});
  const auto angle = [&run](const std::string& name) {
    evaluate(run->model(), run->state(), run->workspace.now);
    evaluate_coordinates(run->model(), run->state(), run->workspace.now);
    for (std::size_t i = 0; i < run->model().coordinates.size(); ++i)
      if (run->model().coordinates[i].name == name) return run->workspace.now.coordinates[i].value;
    return 0.0;
  };
  run.run(0.03);
  EXPECT_NEAR(test_support::Andrews::be + angle("O"), 15.81077119629904, 2e-4);
  EXPECT_NEAR(test_support::Andrews::ga + angle("B"), 0.04082224013073, 2e-4);
}

// A flexible pendulum: BDF and generalised alpha with a small tolerance are two ways to one motion. Its energy balance
// closes: work and dissipation are integrated with the motion.
TEST_F(WithCvode, FlexibleBodyMovesAsWithGeneralisedAlpha) {
  SuperelementFiles files;
  test_support::add_file("beam", test_support::test_superelement("beam"), files);
  formats::Scene scene = test_support::empty_scene(2e-4, 0.2);
  scene.gravity = {0, 0, -9.81};
  formats::SuperelementBodySpec body = test_support::superelement_body("beam", "beam");
  body.damping.stiffness = 1e-3;
  scene.bodies.push_back(body);
  scene.joints.push_back(
      test_support::joint("hinge", formats::JointKind::revolute, "ground", "beam/base", {-0.2, 0, 0.1}, {0, 1, 0}));
  Simulation reference(scene, files);
  reference.start();
  reference.run(0.2);
  BdfRun run(with(scene, 1e-7), files);
  run.run(0.2);
  EXPECT_LT((run->position("beam/tip") - reference.position("beam/tip")).norm(), 2e-5);
  EXPECT_LT((run->velocity("beam/tip") - reference.velocity("beam/tip")).norm(), 2e-3);
  const double balance = run->energy().total() - run->state().initial_energy() + run->state().dissipated();
  EXPECT_NEAR(balance, 0.0, 1e-5 * std::abs(run->energy().kinetic));
  EXPECT_GT(run->state().dissipated(), 0.0);
}

// A pendulum in a dry bearing, whose friction follows from the reaction and adds to it: BDF and generalised alpha with
// a small step (error below 1e-6 by comparing steps) are two ways to one motion, through two stops of the swing.
TEST_F(WithCvode, FrictionOfABearingIsThatOfGeneralisedAlpha) {
  formats::Scene scene = test_support::pendulum_scene(1e-4, 2.0);
  scene.joints[0].friction = formats::FrictionSpec{0.3, {}, 0.01, 0.05, 0.2};
  Simulation reference(scene, {});
  reference.start();
  reference.run(2.0);
  BdfRun run(with(scene, 1e-8), {});
  run.run(2.0);
  EXPECT_LT((run->position("pendulum") - reference.position("pendulum")).norm(), 1e-5);
  EXPECT_LT((run->Omega("pendulum") - reference.Omega("pendulum")).norm(), 5e-5);
  EXPECT_LT((run->state().lambda() - reference.state().lambda()).norm(), 1e-4 * reference.state().lambda().norm());
  EXPECT_GT(run->state().dissipated(), 0.5);
  EXPECT_NEAR(run->energy().total() - run->state().initial_energy() + run->state().dissipated(), 0.0, 1e-5);
}

// A shaft without inertia on a torsional spring: implicit methods find its equilibrium, an acceleration it has not.
TEST_F(WithCvode, MasslessDirectionsAreRefused) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.push_back(test_support::rigid_body("rod", 1.0, {0, 0, 0}, {1, 1, 0}));
  scene.joints.push_back(
      test_support::joint("hinge", formats::JointKind::revolute, "ground", "rod", {0, 0, 0}, {0, 0, 1}));
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.coordinate = formats::CoordinateRef{"hinge", ""};
  spring.stiffness = 5.0;
  scene.springs.push_back(spring);
  try {
    BdfRun run(scene, {});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("rod"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("generalised_alpha"));
  }
}

// Loads that jump: the solver starts anew on the far side of a breakpoint. v = 0.55 + 0.45·3.
TEST_F(WithCvode, AJumpOfALoadIsABreakpoint) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.integrator.method = formats::Method::bdf;
  scene.bodies.push_back(test_support::rigid_body("body", 1.0, {0, 0, 0}, {1, 1, 1}));
  scene.loads.push_back(test_support::constant_load("push", formats::LoadKind::force, "body", {0, 0, 0}));
  scene.loads.back().components[0] = formats::TimeExpression{"t < 0.55 ? 1 : 3", {0.55}, ""};
  Simulation run(scene, {});
  run.start();
  Bdf bdf(run.scene, run.model(), run.state(), run.workspace);
  while (run.state().time() < 0.55) ASSERT_EQ(bdf.step({0.55, 0.55 - 1e-12}), "");
  bdf.restart(0.55 + 1e-12);
  EXPECT_NEAR(run.state().vdot()[0], 3.0, 1e-12);
  while (run.state().time() < 1.0) ASSERT_EQ(bdf.step({1.0, 1.0}), "");
  EXPECT_NEAR(run.velocity("body").x(), 0.55 + 0.45 * 3, 1e-6);
  EXPECT_NEAR(run.state().work(), 0.5 * run.velocity("body").squaredNorm(), 1e-5);
}

// Two links that swing in the x-z plane: to the tolerance of both solvers (1e-7 per step), through some hundred steps.
TEST_F(WithCvode, PlanarScenesMoveAsInSpace) {
  formats::Scene scene = with(test_support::empty_scene(1e-3, 1.0), 1e-7);
  scene.gravity = {0, 0, -9.81};
  for (const char* name : {"a", "b"}) {
    formats::RigidBodySpec link = test_support::rigid_body(name, 1.5, {0.5, 0, 0}, {0.02, 0.03, 0.04});
    link.start.pose.position = {name[0] == 'a' ? 0.0 : 1.0, 0, 0};
    scene.bodies.emplace_back(link);
  }
  const Vector3d y = Vector3d::UnitY();
  scene.joints = {test_support::joint("main", formats::JointKind::revolute, "ground", "a", Vector3d::Zero(), y),
                  test_support::joint("mid", formats::JointKind::revolute, "a", "b", {1, 0, 0}, y)};
  BdfRun spatial(scene, {});
  scene.effects = {{formats::Effect::planar, "", true, "scene"}};
  BdfRun flat(scene, {});
  ASSERT_TRUE(flat->model().planar);
  spatial.run(1.0);
  flat.run(1.0);
  EXPECT_LT(spatial->position("b").z(), -0.5);
  for (const char* name : {"a", "b"})  // in the axes of the plane
    EXPECT_LT((flat->model().axes * flat->position(name) - spatial->position(name)).norm(), 1e-4) << name;
}

// The whole way of a scene: rows at the instants of `interval` and the end, counts in the report.
TEST_F(WithCvode, ASceneRunsToItsResults) {
  const test_support::TemporaryFolder folder;
  formats::Scene scene = with(test_support::pendulum_scene(1e-5, 1.05), 1e-6);
  scene.integrator.method = formats::Method::bdf;
  scene.output.interval = 0.1;
  const RunReport report = simulate(scene, folder.file("pendulum.results.h5"), RunControl{});
  EXPECT_EQ(report.outcome, RunOutcome::completed) << report.reason;
  EXPECT_EQ(report.rows, 12);  // 0, 0.1, ..., 1.0, 1.05
  EXPECT_GT(report.steps, 20);
  EXPECT_LT(report.steps, 2000);
  EXPECT_GT(report.greatest_step, 10 * report.least_step);
  EXPECT_LT(report.largest_balance, 1e-4 * report.energy_reference);
}

}  // namespace
}  // namespace tisserand::mechanism::bdf_test
