// SPDX-License-Identifier: GPL-3.0-or-later
// Reactions of least norm against a solution by hand and against the properties that define them.
#include "mechanism/step/redundancy.hpp"

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::redundancy_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;
using test_support::joint;
using test_support::Simulation;

/// A door of mass 6 on two hinges about z at z = ±0.4, its centre of mass at x = 0.5: gravity along −z.
formats::Scene door() {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.gravity = {0, 0, -9.81};
  scene.bodies.push_back(test_support::rigid_body("door", 6.0, {0.5, 0, 0}, {0.3, 0.5, 0.6}));
  scene.joints.push_back(joint("upper", JointKind::revolute, "ground", "door", {0, 0, 0.4}, Vector3d::UnitZ()));
  scene.joints.push_back(joint("lower", JointKind::revolute, "ground", "door", {0, 0, -0.4}, Vector3d::UnitZ()));
  return scene;
}

// Each hinge carries half the weight. The moment M = m g 0.5 about y is shared by a pair of forces ∓f along x, arm 2h,
// and by moments m of the hinges: 2 h f + 2 m = M and f² + m²/L² least give f = M h/(2 (h² + L²)), m = M L²/(2 (h² +
// L²)).
TEST(LeastNormReactions, OfADoorOnTwoHinges) {
  Simulation run(door(), {});
  run.start();
  ASSERT_EQ(run.started.mobility.redundant.size(), 5u);
  ASSERT_TRUE(is_overconstrained(run.state()));
  evaluate(run.model(), run.state(), run.workspace.now);
  const Eigen::VectorXd lambda = least_norm_multipliers(run.model(), run.workspace.now, run.state());
  const double weight = 6.0 * 9.81, M = 0.5 * weight, h = 0.4, L = run.model().length;
  for (const Joint& hinge : run.model().joints) {
    const JointReaction r = joint_reaction(hinge, NodeMotion{}, run.workspace.now.motion[0], lambda.data() + hinge.row);
    const double side = hinge.name == "upper" ? 1.0 : -1.0;
    // In the axes of marker A, whose z is that of the world: turned back.
    const Vector3d force = hinge.a.R * r.force, moment = hinge.a.R * r.moment;
    EXPECT_NEAR(force.z(), 0.5 * weight, 1e-9 * weight) << hinge.name;
    EXPECT_NEAR(force.x(), -side * M * h / (2 * (h * h + L * L)), 1e-9 * weight) << hinge.name;
    EXPECT_NEAR(moment.y(), -M * L * L / (2 * (h * h + L * L)), 1e-9 * weight) << hinge.name;
  }
  EXPECT_THAT(joints_without_unique_reaction(run.model(), run.workspace.now), ::testing::ElementsAre("upper", "lower"));
}

// An arch of 110 links of 500 mm from ground to ground, in millimetres. Two of them meet in a pair of hinges, all
// others in universal joints: 450 rows in one loop. Multipliers of moments are a thousand times those of forces, and
// conjugate gradients leave an error in each; still no other joint is named.
TEST(LeastNormReactions, AreNamedInMillimetresToo) {
  constexpr int links = 110;
  constexpr double length = 500.0, pi = 3.14159265358979323846, radius = links * length / pi;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto vector = [&](double size) {
    return Vector3d(size * Vector3d::NullaryExpr([&] { return normal(random); }));
  };
  std::vector<Vector3d> at;
  for (int i = 0; i <= links; ++i)
    at.push_back(Vector3d(-radius * std::cos(pi * i / links), 0.5 * radius * std::sin(pi * i / links), 0) +
                 vector(30.0));
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  const auto name = [](int i) { return i < 0 || i == links ? std::string("ground") : "link" + std::to_string(i); };
  for (int i = 0; i < links; ++i)
    scene.bodies.push_back(test_support::rigid_body(name(i), 1.0, 0.5 * (at[i] + at[i + 1]), {2e4, 2e4, 2e4}));
  for (int i = 0; i <= links; ++i) {
    if (i != links / 2) {
      scene.joints.push_back(
          joint("joint" + std::to_string(i), JointKind::universal, name(i - 1), name(i), at[i], vector(1.0)));
      scene.joints.back().x_axis = scene.joints.back().axis->unitOrthogonal();
      continue;
    }
    for (const double z : {0.0, -length})
      scene.joints.push_back(joint(z < 0 ? "lower" : "upper", JointKind::revolute, name(i - 1), name(i),
                                   at[i] + Vector3d(0, 0, z), Vector3d::UnitZ()));
  }
  Simulation run(scene, {});
  run.start();
  evaluate(run.model(), run.state(), run.workspace.now);
  EXPECT_THAT(joints_without_unique_reaction(run.model(), run.workspace.now), ::testing::ElementsAre("upper", "lower"));
}

// The same generalised forces Bᵀλ, so the same motion.
TEST(LeastNormReactions, CauseTheSameMotion) {
  Simulation run(door(), {});
  run.start();
  evaluate(run.model(), run.state(), run.workspace.now);
  const Eigen::VectorXd before = run.workspace.now.residual;
  State changed = run.state();
  changed.lambda() = least_norm_multipliers(run.model(), run.workspace.now, run.state());
  EXPECT_GT((changed.lambda() - run.state().lambda()).norm(), 1.0);
  evaluate(run.model(), changed, run.workspace.now);
  EXPECT_LT((run.workspace.now.residual - before).cwiseAbs().maxCoeff(), 1e-11);
}

// λ = K^(-1/2) (Bᵀ K^(-1/2))⁺ Bᵀλ with K = WᵀW, W the wrenches [f; m/L] of unit multipliers, by singular values.
TEST(LeastNormReactions, AreThoseOfThePseudoinverse) {
  formats::Scene scene = door();
  scene.joints.push_back(joint("middle", JointKind::cylindrical, "ground", "door", {0, 0, 0.1}, Vector3d::UnitZ()));
  scene.joints.push_back(joint("stay", JointKind::point_on_plane, "ground", "door", {0.7, 0, 0}, Vector3d::UnitX()));
  Simulation run(scene, {});
  run.start();
  evaluate(run.model(), run.state(), run.workspace.now);
  const Eigen::Index n = run.model().sizes.constraints, size = run.model().sizes.boundary;
  Eigen::MatrixXd Bt = Eigen::MatrixXd::Zero(size, n), W = Eigen::MatrixXd::Zero(6 * n, n);
  for (std::size_t i = 0; i < run.model().joints.size(); ++i) {
    const Joint& one = run.model().joints[i];
    for (int k = 0; k < one.size(); ++k) {
      Eigen::Matrix<double, 6, 1> unit = Eigen::Matrix<double, 6, 1>::Unit(k);
      const JointReaction r = joint_reaction(one, NodeMotion{}, run.workspace.now.motion[0], unit.data());
      W.block<3, 1>(6 * static_cast<Eigen::Index>(i), one.row + k) = r.force;
      W.block<3, 1>(6 * static_cast<Eigen::Index>(i) + 3, one.row + k) = r.moment / run.model().length;
      for (int j = 6; j < 12; ++j)
        Bt(run.model().joints.maps[i].coordinates[j], one.row + k) = run.workspace.now.joints[i].B(k, j);
    }
  }
  const Eigen::MatrixXd root = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(W.transpose() * W).operatorInverseSqrt();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(Bt * root, Eigen::ComputeThinU | Eigen::ComputeThinV);
  Eigen::VectorXd inverse = svd.singularValues();
  for (double& value : inverse) value = value > 1e-10 * svd.singularValues()[0] ? 1.0 / value : 0.0;
  const Eigen::VectorXd expected =
      root * (svd.matrixV() * (inverse.asDiagonal() * (svd.matrixU().transpose() * (Bt * run.state().lambda()))));
  const Eigen::VectorXd found = least_norm_multipliers(run.model(), run.workspace.now, run.state());
  EXPECT_GT((found - run.state().lambda()).norm(), 1.0);
  EXPECT_LT((found - expected).norm(), 1e-10 * expected.norm());
}

TEST(LeastNormReactions, AreAskedForOnlyWhereConstraintsRepeat) {
  Simulation run(test_support::pendulum_scene(1e-3, 1.0), {});
  run.start();
  EXPECT_FALSE(is_overconstrained(run.state()));
}

}  // namespace
}  // namespace tisserand::mechanism::redundancy_test
