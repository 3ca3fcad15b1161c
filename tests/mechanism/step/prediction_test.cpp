// SPDX-License-Identifier: GPL-3.0-or-later
// Prediction of a step by the trend of the last one: less work, the same motion, none of it after a jump.
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::prediction_test {
namespace {

using Eigen::Vector3d;
using test_support::Simulation;

/// Three rigid links that fall from the horizontal.
formats::Scene falling_chain() {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.gravity = {0.0, 0.0, -9.81};
  for (int i = 0; i < 3; ++i) {
    const std::string name = "link" + std::to_string(i), last = "link" + std::to_string(i - 1);
    formats::RigidBodySpec body = test_support::rigid_body(name, 1.0, {0.5, 0.0, 0.0}, {0.01, 0.1, 0.1});
    body.start.pose.position = {static_cast<double>(i), 0.0, 0.0};
    scene.bodies.push_back(body);
    scene.joints.push_back(test_support::joint("joint" + std::to_string(i), formats::JointKind::spherical,
                                               i == 0 ? "ground" : last, name, body.start.pose.position,
                                               Vector3d::UnitZ()));
  }
  return scene;
}

struct Fall {
  long iterations = 0;
  double cost = 0.0;  ///< of iterations and factorisations, in iterations
  Eigen::Matrix3Xd x;
};

enum class Prediction { trend, constant };

enum class Reuse { always, by_cost };

Fall fall(Prediction prediction, Reuse reuse) {
  Simulation run(falling_chain(), {});
  run.start();
  run.run(0.5, [&] {
    if (prediction == Prediction::constant) run.workspace.memory.predictor.forget();
    if (reuse == Reuse::always) run.workspace.memory.reuse = {.spent = std::numeric_limits<double>::infinity()};
  });
  const auto iterations = static_cast<double>(run.iterations), factorisations = static_cast<double>(run.factorisations);
  return {run.iterations, iterations + run.model().solver.renewal * factorisations, run.state().x()};
}

TEST(Prediction, TrendSavesIterationsWithKeptFactors) {
  const long trend = fall(Prediction::trend, Reuse::always).iterations;
  const long constant = fall(Prediction::constant, Reuse::always).iterations;
  EXPECT_LT(static_cast<double>(trend), 0.8 * static_cast<double>(constant));
}

TEST(Prediction, TrendMakesASmoothMotionCheaper) {
  const Fall trend = fall(Prediction::trend, Reuse::by_cost), constant = fall(Prediction::constant, Reuse::by_cost);
  EXPECT_LT(trend.cost, constant.cost);
  // Both meet the tolerance of 1e-8 of the largest force, 30 m/s² times the mass; in 0.5 s that moves 1e-8 · 30 ·
  // 0.5²/2.
  EXPECT_LT((trend.x - constant.x).cwiseAbs().maxCoeff(), 4e-8);
}

TEST(Prediction, NothingIsPredictedAfterAJump) {
  formats::Scene scene = falling_chain();
  formats::LoadSpec push = test_support::constant_load("push", formats::LoadKind::force, "link2", {0.0, 50.0, 0.0});
  push.components[1] = formats::TimeExpression{"t < 0.1 ? 0 : 50", {0.1}, ""};
  scene.loads.push_back(push);
  Simulation run(scene, {});
  run.start();
  run.run(0.1);
  EXPECT_FALSE(run.workspace.memory.predictor.known);
  run.run(0.11);
  EXPECT_TRUE(run.workspace.memory.predictor.smooth);
}

}  // namespace
}  // namespace tisserand::mechanism::prediction_test
