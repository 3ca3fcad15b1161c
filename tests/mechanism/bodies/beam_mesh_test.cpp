// SPDX-License-Identifier: GPL-3.0-or-later
// Beam bodies of a scene become nodes, section triads and elements.
#include <numbers>

#include <gtest/gtest.h>

#include "common/error.hpp"
#include "tests/support/bodies/beam_states.hpp"
#include "tests/support/bodies/beam_statics.hpp"

namespace tisserand::mechanism::beam_mesh_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using std::numbers::pi;

formats::BeamBodySpec beam(const Vector3d& from, const Vector3d& to) {
  formats::BeamBodySpec spec;
  spec.name = "arm";
  spec.from = from;
  spec.to = to;
  spec.elements = 4;
  spec.section = test::rectangle(0.1, 0.2, 1e-5, 0.8);
  spec.material = test::material(2e11, 0.3, 7800.0);
  spec.where = "scene.yaml:12:3";
  return spec;
}

std::string message(const formats::BeamBodySpec& spec) {
  try {
    mesh_beam(spec, 0);
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "scene.yaml:12:3");
    EXPECT_FALSE(error.remedy().empty());
    return error.message();
  }
  return "no error";
}

TEST(BeamMesh, LineOfTwoAndThreeNodes) {
  formats::BeamBodySpec spec = beam({1, 2, 3}, {1, 2, 7});
  const BeamMesh two = mesh_beam(spec, 10);
  ASSERT_EQ(two.elements2.size(), 4u);
  EXPECT_TRUE(two.elements3.empty());
  ASSERT_EQ(two.position.size(), 5u);
  EXPECT_EQ(two.length, 4.0);
  EXPECT_EQ(two.elements2[3].nodes, (std::array<int, 2>{13, 14}));
  EXPECT_NEAR((two.position[3] - Vector3d(1, 2, 6)).norm(), 0.0, 1e-15);
  EXPECT_EQ(two.elements2[0].length, 1.0);
  EXPECT_NEAR(two.elements2[0].mass, 7800.0 * 0.02, 1e-10);

  spec.nodes_per_element = 3;
  const BeamMesh three = mesh_beam(spec, 10);
  ASSERT_EQ(three.elements3.size(), 4u);
  EXPECT_TRUE(three.elements2.empty());
  ASSERT_EQ(three.position.size(), 9u);
  EXPECT_EQ(three.elements3[3].nodes, (std::array<int, 3>{16, 17, 18}));
}

TEST(BeamMesh, SectionAxesByOrientationOrByTheGlobalAxisMostNearlyNormal) {
  const auto triad = [](const Vector3d& axis, const std::optional<Vector3d>& orientation) {
    formats::BeamBodySpec spec = beam(Vector3d::Zero(), axis);
    spec.orientation = orientation;
    return mesh_beam(spec, 0).section[0];
  };
  const auto y = [&](const Vector3d& axis) { return Vector3d(triad(axis, std::nullopt).col(1)); };
  EXPECT_LT((triad({2, 0, 0}, std::nullopt) - Matrix3d::Identity()).norm(), 1e-15);
  EXPECT_LT((y({0, 3, 0}) - Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_LT((y({0, 0, -3}) - Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT((y({0, 3, 1e-9}) - Vector3d::UnitZ()).norm(), 1e-8);                // ties are decided up to 1e-9
  EXPECT_LT((y({1, 2, 3}) - Vector3d(13, -2, -3).normalized()).norm(), 1e-15);  // x minus its part along the axis
  const Matrix3d D = triad({2, 0, 0}, Vector3d(5, 3, 4));
  EXPECT_LT((D.col(1) - Vector3d(0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_LT((D.col(2) - Vector3d(0, -0.8, 0.6)).norm(), 1e-15);
}

TEST(BeamMesh, ArcThroughThreePoints) {
  // Three quarters of a circle of radius 2 about (1, 1, 0), counterclockwise about z: more than half a turn.
  formats::BeamBodySpec spec = beam({3, 1, 0}, {1, -1, 0});
  spec.through = Vector3d(1, 3, 0);
  spec.elements = 6;
  const BeamMesh mesh = mesh_beam(spec, 0);
  EXPECT_NEAR(mesh.length, 2.0 * 1.5 * pi, 1e-13);
  ASSERT_EQ(mesh.position.size(), 7u);
  for (int i = 0; i <= 6; ++i) {
    const double angle = i * pi / 4;
    const auto k = static_cast<std::size_t>(i);
    EXPECT_LT((mesh.position[k] - Vector3d(1 + 2 * std::cos(angle), 1 + 2 * std::sin(angle), 0)).norm(), 1e-14);
    EXPECT_LT((mesh.section[k].col(0) - Vector3d(-std::sin(angle), std::cos(angle), 0)).norm(), 1e-14);
    EXPECT_LT((mesh.section[k].col(1) - Vector3d::UnitZ()).norm(), 1e-14);  // the normal of the plane
    EXPECT_LT((mesh.section[k].transpose() * mesh.section[k] - Matrix3d::Identity()).norm(), 1e-14);
  }
  // The other way round, clockwise: a quarter.
  spec.through = Vector3d(1 + std::sqrt(2.0), 1 - std::sqrt(2.0), 0);
  EXPECT_NEAR(mesh_beam(spec, 0).length, pi, 1e-13);
}

TEST(BeamMesh, ReferenceOfAnArcIsFreeOfStressWithItsCurvature) {
  formats::BeamBodySpec spec = beam({2, 0, 0}, {0, 2, 0});
  spec.through = Vector3d(std::sqrt(2.0), std::sqrt(2.0), 0);
  for (const int nodes_per_element : {2, 3}) {
    spec.nodes_per_element = nodes_per_element;
    const BeamMesh mesh = mesh_beam(spec, 0);
    Eigen::VectorXd r;
    Eigen::MatrixXd K;
    test::assemble(mesh, test::reference_nodes(mesh), {.mass = 0, .damping = 0, .stiffness = 1}, r, K);
    EXPECT_LT(r.cwiseAbs().maxCoeff(), 1e-15 * K.cwiseAbs().maxCoeff());
    // Section y is along z of the part, section z = x × y is inward; the beam turns about part z = section y by 1/R.
    for (const BeamElement2& e : mesh.elements2) EXPECT_LT((e.initial_kappa[0] - Vector3d(0, 0.5, 0)).norm(), 1e-14);
    for (const BeamElement3& e : mesh.elements3)
      for (const Vector3d& kappa : e.initial_kappa) EXPECT_LT((kappa - Vector3d(0, 0.5, 0)).norm(), 1e-14);
  }
}

TEST(BeamMesh, Errors) {
  EXPECT_NE(message(beam({1, 2, 3}, {1, 2, 3})).find("zero length"), std::string::npos);
  formats::BeamBodySpec spec = beam({0, 0, 0}, {1, 0, 0});
  spec.through = Vector3d(0.5, 0, 0);
  EXPECT_NE(message(spec).find("on a line"), std::string::npos);
  spec.through = spec.from;
  EXPECT_NE(message(spec).find("coincide"), std::string::npos);
  spec = beam({0, 0, 0}, {1, 0, 0});
  spec.orientation = Vector3d(-2, 0, 0);
  EXPECT_NE(message(spec).find("parallel"), std::string::npos);
  spec.orientation = Vector3d::Zero();
  EXPECT_NE(message(spec).find("no direction"), std::string::npos);
  spec = beam({2, 0, 0}, {-2, 0, 0});  // half a circle, orientation in its plane: parallel to the tangent on the way
  spec.through = Vector3d(0, 2, 0);
  spec.orientation = Vector3d(1, 0, 0);
  EXPECT_NE(message(spec).find("parallel"), std::string::npos);
  spec.elements = 5;
  EXPECT_NE(message(spec).find("turns the section over"), std::string::npos);
  spec = beam({0, 0, 0}, {1, 0, 0});
  spec.elements = 0;
  EXPECT_NE(message(spec).find("0 elements"), std::string::npos);
  spec.elements = 1;
  spec.nodes_per_element = 4;
  EXPECT_NE(message(spec).find("4 nodes per element"), std::string::npos);
}

}  // namespace
}  // namespace tisserand::mechanism::beam_mesh_test
