// SPDX-License-Identifier: GPL-3.0-or-later
// Bad shapes of shell elements are told with their measures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "reducer/elements/checks.hpp"
#include "reducer/elements/element_matrices.hpp"
#include "reducer/elements/plausibility.hpp"
#include "tests/reducer/elements/shell_cases.hpp"

namespace tisserand::reducer::shell_shape_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ShapeFindings findings_of(const Mesh& mesh) {
  ShapeFindings findings;
  check_shape(mesh, mesh.shells[0], findings);
  return findings;
}

Eigen::Matrix3Xd moved(int corner, double x, double y, double z) {
  Eigen::Matrix3Xd X = square();
  X.col(corner) << x, y, z;
  return X;
}

TEST(ShellShape, GoodElementsAreSilent) {
  for (const Eigen::Matrix3Xd& corners : {square(), distorted_quad(), triangle()}) {
    const ShapeFindings findings = findings_of(one_shell(somewhere(corners), steel(0.05)));
    EXPECT_THAT(findings.errors, IsEmpty());
    EXPECT_THAT(findings.warnings, IsEmpty());
  }
}

TEST(ShellShape, CollapsedEdgeNamesItsNodes) {
  const ShapeFindings findings = findings_of(one_shell(moved(1, 0.0, 0.0, 0.0), steel(0.05)));
  EXPECT_THAT(findings.errors, ElementsAre(HasSubstr("collapsed: edge 0 long between node 1 and node 2")));
}

TEST(ShellShape, CollapsedAreaIsAnError) {
  Eigen::Matrix3Xd X = triangle();
  X.col(2) = 0.5 * (X.col(0) + X.col(1));
  EXPECT_THAT(findings_of(one_shell(X, steel(0.05))).errors, ElementsAre(HasSubstr("collapsed: area")));
}

TEST(ShellShape, ConcaveAndCrossedElementsAreErrors) {
  const ShapeFindings concave = findings_of(one_shell(moved(2, 0.3, 0.3, 0.0), steel(0.05)));
  ASSERT_THAT(concave.errors, ElementsAre(HasSubstr("at node 3: the element is concave or its nodes cross")));
  EXPECT_THAT(concave.errors[0], HasSubstr("inner angle 223.6°"));  // 360° - acos(-0.42/0.58)
  Eigen::Matrix3Xd crossed = distorted_quad();
  crossed.col(2).swap(crossed.col(3));
  EXPECT_THAT(findings_of(one_shell(crossed, steel(0.05))).errors, ::testing::Not(IsEmpty()));
}

TEST(ShellShape, SharpAnglesAreWarnedAndFlatOnesAreErrors) {
  Eigen::Matrix3Xd X = triangle();
  X.col(2) << 0.5, 0.1, 0.0;
  EXPECT_THAT(findings_of(one_shell(X, steel(0.01))).warnings, ::testing::Contains(HasSubstr("inner angle")));
  X.col(2) << 0.5, 0.05, 0.0;
  EXPECT_THAT(findings_of(one_shell(X, steel(0.01))).errors, ::testing::Contains(HasSubstr("allowed: 1° to 179°")));
}

/// Corner 3 lifted by z: the corners are z/4 off the mean plane of the nearly unchanged unit square.
TEST(ShellShape, WarpIsWarnedAboveFivePercentAndAnErrorAboveThirty) {
  EXPECT_THAT(findings_of(one_shell(moved(2, 1.0, 1.0, 0.16), steel(0.01))).warnings, IsEmpty());
  EXPECT_THAT(findings_of(one_shell(moved(2, 1.0, 1.0, 0.24), steel(0.01))).warnings,
              ElementsAre(HasSubstr("warped: corners are out of its plane by 0.05")));
  Eigen::Matrix3Xd X = square();
  X.row(2) << 0.35, -0.35, 0.35, -0.35;  // off the plane by 0.35 of the side
  EXPECT_THAT(findings_of(one_shell(X, steel(0.01))).errors,
              ElementsAre(HasSubstr("warped: corners are out of its plane by 0.35")));
}

TEST(ShellShape, AspectAndThicknessOfTheWallAreWarned) {
  Eigen::Matrix3Xd X = square();
  X.row(0) *= 30.0;
  EXPECT_THAT(findings_of(one_shell(X, steel(0.01))).warnings, ElementsAre(HasSubstr("aspect ratio 30")));
  // Told once for all shells of a property, by the extent of the wall: √2 here.
  EXPECT_THAT(plausibility_warnings(one_shell(square(), steel(0.3)), Units::si()),
              ElementsAre(HasSubstr("are 0.3 thick and extend over 1.414")));
  EXPECT_THAT(plausibility_warnings(one_shell(square(), steel(0.28)), Units::si()), IsEmpty());
}

TEST(Plausibility, SpidersFarBesideThePartAreReported) {
  Mesh mesh = one_shell(square(), steel(0.01));  // √2 large
  const auto add = [&mesh](const std::string& name, const Eigen::Vector3d& at) {
    mesh.position.conservativeResize(3, mesh.position.cols() + 1);
    mesh.position.rightCols<1>() = at;
    Spider spider;
    spider.name = name;
    spider.reference = static_cast<int>(mesh.position.cols()) - 1;
    spider.nodes = {1, 2};
    mesh.spiders.push_back(spider);
  };
  const Eigen::Vector3d corner = mesh.position.col(1);
  add("hub", corner + Eigen::Vector3d(0.0, 0.0, 0.9));  // an arm shorter than the edge it grabs
  EXPECT_THAT(plausibility_warnings(mesh, Units::si()), IsEmpty());
  add("axle", corner + Eigen::Vector3d(0.0, 0.0, 3.2));
  EXPECT_THAT(plausibility_warnings(mesh, Units::si()),
              ElementsAre(AllOf(HasSubstr("spider 'axle' lies 3.2 m away from the part, which is 1.41 m large"),
                                HasSubstr("unit of its coordinates"))));
  add("pin", corner + Eigen::Vector3d(0.0, 0.0, 320.0));
  EXPECT_THAT(
      plausibility_warnings(mesh, Units::consistent()),
      ElementsAre(HasSubstr("spider 'pin' lies 320 away from the part, which is 1.41 large (and axle also lies")));
}

TEST(Plausibility, InertiaOfAPointMassThatNoBodyHasIsReported) {
  Mesh mesh = one_shell(square(), steel(0.01));
  NodalMass mass;
  mass.name = "tip";
  mass.mass = 2.0;
  mass.inertia = Eigen::Vector3d(1.0, 1.0, 2.0).asDiagonal();  // a flat body
  mesh.masses = {mass};
  EXPECT_THAT(plausibility_warnings(mesh, Units::si()), IsEmpty());
  mesh.masses[0].inertia(2, 2) = 5.0;
  EXPECT_THAT(plausibility_warnings(mesh, Units::si()),
              ElementsAre(AllOf(HasSubstr("point mass 'tip'"), HasSubstr("1, 1, 5 exceeds the sum of the other two"))));
}

TEST(ShellShape, MaterialDirectionMustNotBeTheNormal) {
  Mesh mesh = one_shell(square(), steel(0.05));
  mesh.shells[0].material_x = Eigen::Vector3d(0.0, 0.0, 2.0);
  EXPECT_THAT(findings_of(mesh).errors, ElementsAre(HasSubstr("material direction (0, 0, 2) is normal")));
}

TEST(ShellShape, CoordinatesMustBeFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf})
    EXPECT_THAT(findings_of(one_shell(moved(3, bad, 0.0, 0.0), steel(0.05))).errors,
                ElementsAre(HasSubstr("not finite")));
}

}  // namespace
}  // namespace tisserand::reducer::shell_shape_test
