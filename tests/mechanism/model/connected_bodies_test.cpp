// SPDX-License-Identifier: GPL-3.0-or-later
// Loops of joints: by hand, and by their property that forces which cancel do so within each loop.
#include "mechanism/model/connected_bodies.hpp"

#include <algorithm>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/SVD>

#include "mechanism/equations/increments.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/bodies/lumped_bodies.hpp"
#include "tests/support/bodies/modal_known_answers.hpp"
#include "tests/support/scenes/virtual_bodies.hpp"

namespace tisserand::mechanism::connected_bodies_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::JointKind;
using test_support::joint;

void add_body(const std::string& name, const Vector3d& at, formats::Scene& scene) {
  scene.bodies.push_back(test_support::rigid_body(name, 1.0, at, {0.1, 0.1, 0.1}));
}

/// Names of the joints and couplings of each loop.
std::vector<std::vector<std::string>> loop_names(const Model& model) {
  std::vector<std::vector<std::string>> names;
  for (const Loop& loop : model.loops) {
    names.emplace_back();
    for (const int i : loop.joints) names.back().push_back(model.joints[i].name);
    for (const int i : loop.couplings) names.back().push_back(model.couplings[i].name);
  }
  return names;
}

// A lever on the ground, a four-bar of the ground and three bodies, a pair of hinges that carries a door from the
// four-bar's coupler, and a pendulum below the door.
TEST(Loops, HoldWhatOneCycleContains) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  for (const char* name : {"lever", "left", "coupler", "right", "door", "pendulum"}) add_body(name, {1, 2, 3}, scene);
  const auto hinge = [&](const char* name, const char* a, const char* b, const Vector3d& at) {
    scene.joints.push_back(joint(name, JointKind::revolute, a, b, at, Vector3d::UnitZ()));
  };
  hinge("pivot", "ground", "lever", {5, 0, 0});
  hinge("A", "ground", "left", {0, 0, 0});
  hinge("B", "left", "coupler", {0, 1, 0});
  hinge("upper", "coupler", "door", {2, 1, 1});
  hinge("C", "coupler", "right", {1, 1, 0});
  hinge("lower", "coupler", "door", {2, 1, -1});
  hinge("D", "right", "ground", {1, 0, 0});
  hinge("string", "door", "pendulum", {3, 1, 0});
  const BuiltModel built = build_model(scene, {});
  EXPECT_THAT(loop_names(built.model),
              ::testing::ElementsAre(::testing::ElementsAre("pivot"), ::testing::ElementsAre("A", "B", "C", "D"),
                                     ::testing::ElementsAre("upper", "lower"), ::testing::ElementsAre("string")));
}

TEST(Loops, UniteAllJointsThatACouplingDrives) {
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  for (const char* name : {"left", "right", "free"}) add_body(name, {1, 2, 3}, scene);
  for (const char* name : {"left", "right", "free"})
    scene.joints.push_back(
        joint(std::string("hinge_") + name, JointKind::revolute, "ground", name, {0, 0, 0}, {0, 0, 1}));
  scene.motions.push_back(test_support::drive("hinge_left", "t"));
  const BuiltModel built = build_model(scene, {});
  EXPECT_THAT(
      loop_names(built.model),
      ::testing::UnorderedElementsAre(::testing::ElementsAre("hinge_left", "motion drive_hinge_left"),
                                      ::testing::ElementsAre("hinge_right"), ::testing::ElementsAre("hinge_free")));
}

/// Multipliers without force, the columns: the null space of Bᵀ by singular values.
MatrixXd null_space(const Model& model, const Evaluation& evaluation) {
  const int rows = model.sizes.constraints;
  MatrixXd Bt(model.sizes.boundary, rows);
  VectorXd column(model.sizes.boundary);
  for (int row = 0; row < rows; ++row) {
    apply_transposed_jacobian(model, evaluation, VectorXd::Unit(rows, row), column);
    Bt.col(row) = column;
  }
  const Eigen::JacobiSVD<MatrixXd> svd(Bt, Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  while (rank < svd.singularValues().size() && svd.singularValues()[rank] > 1e-9 * svd.singularValues()[0]) ++rank;
  return svd.matrixV().rightCols(rows - rank);
}

/// The part of each multiplier without force in one loop has none either. Returns the number of these multipliers.
Eigen::Index expect_separate_loops(const formats::Scene& scene, const BodyFiles& files) {
  const BuiltModel built = build_model(scene, files);
  const Model& model = built.model;
  Evaluation evaluation(model);
  evaluate(model, built.state, evaluation);
  const MatrixXd null = null_space(model, evaluation);
  VectorXd force(model.sizes.boundary);
  std::size_t joints = 0, couplings = 0;
  for (const Loop& loop : model.loops) {
    joints += loop.joints.size(), couplings += loop.couplings.size();
    for (Eigen::Index k = 0; k < null.cols(); ++k) {
      VectorXd part = VectorXd::Zero(null.rows());
      for (const int i : loop.joints)
        part.segment(model.joints[i].row, model.joints[i].size()) =
            null.col(k).segment(model.joints[i].row, model.joints[i].size());
      for (const int i : loop.couplings) part[model.couplings[i].row] = null(model.couplings[i].row, k);
      apply_transposed_jacobian(model, evaluation, part, force);
      EXPECT_LT(force.cwiseAbs().maxCoeff(), 1e-9);
    }
  }
  EXPECT_EQ(joints, model.joints.size());
  EXPECT_EQ(couplings, model.couplings.size());
  return null.cols();
}

TEST(Loops, SeparateTheForcesThatCancelInRandomMechanisms) {
  constexpr JointKind kinds[] = {JointKind::fixed, JointKind::revolute, JointKind::spherical, JointKind::cylindrical};
  std::mt19937 random(47);
  const auto number = [&](int below) { return static_cast<int>(random() % static_cast<unsigned>(below)); };
  const auto vector = [&] { return Vector3d(number(1000), number(1000), number(1000) + 1) / 500.0; };
  Eigen::Index found = 0;
  for (int trial = 0; trial < 100; ++trial) {
    formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
    const int bodies = 3 + number(6);
    for (int i = 0; i < bodies; ++i) add_body("b" + std::to_string(i), vector(), scene);
    const auto place = [&](int body) { return body < 0 ? std::string("ground") : "b" + std::to_string(body); };
    for (int i = 0; i < bodies + number(4); ++i) {
      const int b = i < bodies ? i : number(bodies);
      int a = number(bodies + 1) - 1;
      if (a == b) a = -1;
      const std::string name = "j" + std::to_string(i);
      const JointKind kind = kinds[number(4)];
      scene.joints.push_back(joint(name, kind, place(a), place(b), vector(), vector()));
      if (kind == JointKind::revolute && number(4) == 0) scene.motions.push_back(test_support::drive(name, "t"));
    }
    found += expect_separate_loops(scene, {});
  }
  EXPECT_GT(found, 300);
}

// Two rigid bodies lie along a flexible one, each fixed to both of its ends: a force from one to the other through the
// ends cancels on every node, so the two are one loop although each closes one of its own.
TEST(Loops, PassThroughTheNodesOfFlexibleBodies) {
  BodyFiles files;
  test_support::BeamData beam;
  beam.length = 0.3;
  test_support::add_file("rod", test_support::craig_bampton_beam(beam, 4), files.superelements);
  const test_support::Rod lumped{0.0, 0.3, 4e-4, 2e11, 8e10, 1.3e-8, 7800.0, 8};
  files.modal_bodies["rod"].body =
      test_support::modal_body(test_support::lumped_rod(lumped), test_support::rod_conditions(8), 8);
  for (const bool modal : {false, true}) {
    formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
    if (modal)
      scene.bodies.push_back(test_support::modal_spec("rod", "rod"));
    else
      scene.bodies.push_back(test_support::superelement_body("rod", "rod"));
    for (const char* name : {"upper", "lower"}) {
      add_body(name, {0.15, 0, 0}, scene);
      for (const char* end : {"start", "end"})
        scene.joints.push_back(joint(
            std::string(name) + "_" + end, JointKind::fixed,
            std::string("rod/") + (end == std::string("start") ? (modal ? "n0" : "base") : (modal ? "n8" : "tip")),
            name, {end == std::string("start") ? 0.0 : 0.3, 0, 0}, {0, 0, 1}));
    }
    EXPECT_EQ(expect_separate_loops(scene, files), 6) << modal;
  }
}

}  // namespace
}  // namespace tisserand::mechanism::connected_bodies_test
