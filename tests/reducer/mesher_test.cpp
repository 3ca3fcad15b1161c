// SPDX-License-Identifier: GPL-3.0-or-later
// Meshing of lines and arcs: places, connections, orientation, and the gmsh file.
#include "reducer/sources/build_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "common/error.hpp"
#include "reducer/mesh/gmsh_file.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::testing::mesher_test {
namespace {

using Eigen::Vector3d;
using test_support::error_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

formats::Part arc(double degrees, int elements) {
  const double a = degrees * std::numbers::pi / 180.0, r = 0.8;
  formats::Part part = plain_beam(Vector3d(r, 0, 0.1), Vector3d(r * std::cos(a), r * std::sin(a), 0.1), elements, 0);
  part.beams[0].through = Vector3d(r * std::cos(0.3 * a), r * std::sin(0.3 * a), 0.1);
  return part;
}

TEST(Mesher, StraightLineIsDividedEqually) {
  const Vector3d from(1, 2, 3), to(4, 0, -1);
  const reducer::Mesh mesh = reducer::build_mesh(plain_beam(from, to, 7, 0));
  ASSERT_EQ(mesh.nodes(), 8);
  ASSERT_EQ(mesh.beams.size(), 7u);
  for (std::size_t e = 0; e < 7; ++e) {
    const Vector3d first = mesh.position.col(mesh.beams[e].first);
    EXPECT_LT((first - (from + (to - from) * (static_cast<double>(e) / 7.0))).norm(), 1e-15 * 10.0);
  }
  EXPECT_EQ(mesh.node_label[0], "base");
  EXPECT_EQ(mesh.node_label[2], "rod[1]");
}

class Arcs : public ::testing::TestWithParam<double> {};

TEST_P(Arcs, NodesAreOnTheCircleAtEqualDistances) {
  const int n = 12;
  const reducer::Mesh mesh = reducer::build_mesh(arc(GetParam(), n));
  ASSERT_EQ(mesh.nodes(), n + 1);
  const double chord = 2.0 * 0.8 * std::sin(0.5 * GetParam() * std::numbers::pi / 180.0 / n);
  for (const reducer::BeamElement& beam : mesh.beams) {
    const Vector3d a = mesh.position.col(beam.first), b = mesh.position.col(beam.second);
    EXPECT_NEAR((b - a).norm(), chord, 1e-14);
    EXPECT_NEAR((a - Vector3d(0, 0, 0.1)).norm(), 0.8, 1e-14);
    EXPECT_LT((beam.R_PE.col(1) - Vector3d::UnitZ()).norm(), 1e-14) << "y: the global axis normal to the whole arc";
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, Arcs, ::testing::Values(20.0, 90.0, 179.0, 180.0, 200.0, 355.0));

// gmsh orders by addresses: the same solid, read by one child process after the other, has the same nodes to the last
// bit.
TEST(Mesher, SolidsHaveTheSameMeshInEveryRun) {
  formats::Part part;
  part.name = "crank";
  part.file = "part.yaml";
  part.units = Units::si();
  part.mesh.file = std::string(TISSERAND_SOURCE_DIR) + "/meshes/crank.step";
  part.mesh.size = 0.02;
  part.mesh.order = 2;
  part.materials = {{"steel", 2.1e11, 0.3, 7800.0, "part.yaml"}};
  part.solids = {{"body", {"all"}, "steel", formats::MassMatrix::consistent, "part.yaml"}};
  part.spiders = {{"hub", formats::SpiderType::rigid, {}, {"face 1"}, {}, formats::SpiderWeights::area, "part.yaml"}};
  part.spiders[0].at.kind = formats::PlaceKind::centroid;
  part.boundary = {{"hub", "hub", true, true, "part.yaml"}};
  const reducer::Mesh first = reducer::build_mesh(part);
  ASSERT_GT(first.solids.size(), 100u);
  for (int again = 0; again < 3; ++again) EXPECT_EQ(reducer::build_mesh(part).position, first.position);
}

/// The trial step_in_metres: sizes of 0.012 and 0.02 failed in metres, 12 and 20 in millimetres did not.
TEST(Mesher, APartInMetresHasTheMeshOfThatInMillimetres) {
  for (const double size : {0.004, 0.012, 0.02}) {
    formats::Part part;
    part.file = TISSERAND_SOURCE_DIR "/meshes/part.yaml";
    part.mesh.file = TISSERAND_SOURCE_DIR "/meshes/bracket.step";
    part.mesh.order = 2;
    part.materials = {{"steel", 2.1e11, 0.3, 7850.0, "part.yaml"}};
    part.solids = {{"body", {"all"}, "steel", formats::MassMatrix::consistent, "part.yaml"}};
    const auto mesh = [&](const Units& units, double length) {  // the trial step_in_inches
      part.units = units;
      part.mesh.size = length;
      return reducer::build_mesh_to_solve(part);
    };
    const reducer::Mesh metres = mesh(Units::si(), size), millimetres = mesh(Units::consistent(), 1e3 * size);
    ASSERT_EQ(metres.nodes(), millimetres.nodes()) << size;
    const reducer::Mesh inches = mesh(Units{{0.0254, "in"}, {1.0, "kg"}, {1.0, "s"}}, size / 0.0254);
    EXPECT_NEAR(inches.nodes(), millimetres.nodes(), 0.01 * millimetres.nodes()) << "the size is rounded";
    EXPECT_LT((25.4 * inches.position.rowwise().maxCoeff() - millimetres.position.rowwise().maxCoeff()).norm(), 1e-5);
    EXPECT_LT((1e3 * metres.position - millimetres.position).cwiseAbs().maxCoeff(), 1e-5) << size << ", of 40";
  }
}

TEST(Mesher, SizeGivesTheNumberOfElements) {
  formats::Part part = plain_beam(Vector3d::Zero(), Vector3d(0, 1, 0), 0, 0);
  part.beams[0].size = 0.25;
  EXPECT_EQ(reducer::build_mesh(part).beams.size(), 4u);  // 1/0.25 exactly, not one more by round-off
  part.beams[0].size = 0.24;
  EXPECT_EQ(reducer::build_mesh(part).beams.size(), 5u);
}

TEST(Mesher, DefaultOrientationIsTheGlobalAxisMostNearlyNormal) {
  const auto y_axis = [](const Vector3d& to) {
    return Vector3d(reducer::build_mesh(plain_beam(Vector3d::Zero(), to, 1, 0)).beams[0].R_PE.col(1));
  };
  EXPECT_LT((y_axis(Vector3d(1, 0, 0)) - Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT((y_axis(Vector3d(0, 1, 0)) - Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_LT((y_axis(Vector3d(0, 0, 1)) - Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT((y_axis(Vector3d(1, 1, 0)) - Vector3d::UnitZ()).norm(), 1e-15);
}

TEST(Mesher, PointsOfOneNameAreOneNode) {
  const reducer::Mesh mesh = reducer::build_mesh(space_frame(0));
  EXPECT_EQ(mesh.nodes(), 5 + 3 + 2 + 2 + 4 + 2);
  reducer::check_connected(mesh, "frame");
}

TEST(Mesher, GmshFileHasNamesAndAllNodes) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.file("frame.msh");
  const reducer::Mesh mesh = reducer::build_mesh(space_frame(0));
  reducer::write_gmsh_file(mesh, path);
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_THAT(text.str(),
              AllOf(HasSubstr("$MeshFormat\n4.1"), HasSubstr("\"bow\""), HasSubstr("\"A\""), HasSubstr("\"lump\"")));
  EXPECT_EQ(mesh.nodes(), 18);
}

TEST(BadParts, SayWhatIsWrong) {
  const Vector3d zero = Vector3d::Zero(), x = Vector3d::UnitX();
  const auto message = [](const formats::Part& part) { return error_of([&] { reducer::build_mesh(part); }); };
  EXPECT_THAT(message(plain_beam(zero, zero, 3, 0)), HasSubstr("beam 'rod' has zero length"));
  formats::Part part = plain_beam(zero, x, 3, 0);
  part.beams.clear();
  EXPECT_THAT(message(part), HasSubstr("no elements"));
  part = plain_beam(zero, x, 3, 0);
  part.boundary.clear();
  EXPECT_THAT(message(part), HasSubstr("no boundary node"));
  part = plain_beam(zero, x, 3, 0);
  part.beams[0].to = "typ";
  EXPECT_THAT(message(part), AllOf(HasSubstr("point 'typ' does not exist"), HasSubstr("'tip'")));
  part = plain_beam(zero, x, 3, 0);
  part.beams[0].section = "squared";
  EXPECT_THAT(message(part), AllOf(HasSubstr("section 'squared' does not exist"), HasSubstr("'square'")));
  part = plain_beam(zero, x, 3, 0);
  part.beams[0].orientation = Vector3d(-3, 0, 0);
  EXPECT_THAT(message(part), HasSubstr("parallel to the beam"));
  part = plain_beam(zero, x, 3, 0);
  part.points.push_back({"loose", Vector3d(0, 1, 0), ""});
  part.boundary.push_back({"loose", "loose", true, true, ""});
  EXPECT_THAT(message(part), HasSubstr("no beam ends at point 'loose'"));
  part = plain_beam(zero, x, 3, 0);
  part.boundary[1].at = "base";
  EXPECT_THAT(message(part), HasSubstr("same point as boundary node 'base'"));
  EXPECT_THAT(message(arc(200.0, 1)), HasSubstr("1 elements are too few for an arc of 200 degrees"));
  part = plain_beam(zero, x, 3, 0);
  part.beams[0].through = 0.4 * x;
  EXPECT_THAT(message(part), HasSubstr("on a straight line"));
}

TEST(BadParts, LoosePieceIsNamedWithItsNearestNeighbour) {
  formats::Part part = plain_beam(Vector3d::Zero(), Vector3d::UnitX(), 4, 0);
  part.points.push_back({"near", Vector3d(1.0 + 1e-7, 0, 0), ""});
  part.points.push_back({"far", Vector3d(2, 0, 0), ""});
  part.beams.push_back(part.beams[0]);
  part.beams[1].name = "second";
  part.beams[1].from = "near";
  part.beams[1].to = "far";
  const reducer::Mesh mesh = reducer::build_mesh(part);
  EXPECT_THAT(error_of([&] { reducer::check_connected(mesh, "p.yaml"); }),
              AllOf(HasSubstr("2 pieces"), HasSubstr("nearest nodes are near and tip, 1e-07 apart")));
}

TEST(BadParts, MotionsThatTheBoundaryLeavesFreeAreNamed) {
  formats::Part part = plain_beam(Vector3d(1, 0, 0), Vector3d(3, 0, 0), 4, 0);
  for (formats::BoundaryNode& b : part.boundary) b.rotations = false;
  const auto message = [](const formats::Part& p) {
    const reducer::Mesh mesh = reducer::build_mesh(p);
    return error_of([&] { reducer::check_boundary_holds(mesh, "p.yaml"); });
  };
  EXPECT_THAT(message(part), AllOf(HasSubstr("base (translations), tip (translations)"),
                                   HasSubstr("turning about the axis (1, 0, 0) through")));
  part.boundary.pop_back();
  EXPECT_THAT(message(part), AllOf(HasSubstr("(1, 0, 0) through (1, 0, 0)"), HasSubstr("(0, 1, 0) through (1, 0, 0)"),
                                   HasSubstr("(0, 0, 1) through (1, 0, 0)")));
  part.boundary[0] = {"base", "base", false, true, ""};
  EXPECT_THAT(message(part), AllOf(HasSubstr("moving along (1, 0, 0)"), HasSubstr("moving along (0, 0, 1)")));
  part.boundary.push_back({"tip", "tip", true, false, ""});
  EXPECT_EQ(message(part), "no error");
}

}  // namespace
}  // namespace tisserand::testing::mesher_test
