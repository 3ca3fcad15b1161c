// SPDX-License-Identifier: GPL-3.0-or-later
// Findings on badly shaped solid elements: each fault by name, good elements without any.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reducer/elements/element_matrices.hpp"
#include "reducer/elements/solid/quadrature.hpp"
#include "tests/support/meshes/solid_mesh.hpp"

namespace tisserand::reducer::solid_check_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ShapeFindings findings_of(SolidShape shape, const Eigen::Matrix3Xd& x) {
  const Mesh mesh = one_solid(shape, x, {isotropic_solid(1.0, 0.3, 1.0), formats::MassMatrix::consistent, "test"});
  ShapeFindings findings;
  check_shape(mesh, mesh.solids.front(), findings);
  return findings;
}

class SolidCheck : public ::testing::TestWithParam<SolidShape> {};

TEST_P(SolidCheck, ReferenceElementHasNoFindings) {
  const ShapeFindings findings = findings_of(GetParam(), natural_nodes(GetParam()));
  EXPECT_THAT(findings.errors, IsEmpty());
  EXPECT_THAT(findings.warnings, IsEmpty());
}

TEST_P(SolidCheck, MirroredElementIsInverted) {
  Eigen::Matrix3Xd x = natural_nodes(GetParam());
  x.row(0) *= -1.0;
  EXPECT_THAT(findings_of(GetParam(), x).errors, ElementsAre(HasSubstr("inverted: volume -")));
}

TEST_P(SolidCheck, FlatElementIsCollapsed) {
  Eigen::Matrix3Xd x = natural_nodes(GetParam());
  x.row(2) *= 1e-10;
  EXPECT_THAT(findings_of(GetParam(), x).errors, ElementsAre(HasSubstr("collapsed: volume")));
}

TEST_P(SolidCheck, RepeatedNodeIsNamed) {
  Mesh mesh = one_solid(GetParam(), natural_nodes(GetParam()),
                        {isotropic_solid(1.0, 0.3, 1.0), formats::MassMatrix::consistent, "test"});
  mesh.solids[0].nodes[3] = mesh.solids[0].nodes[1];
  ShapeFindings findings;
  check_shape(mesh, mesh.solids[0], findings);
  EXPECT_THAT(findings.errors, ElementsAre(HasSubstr("it contains node 2 twice (positions 2 and 4)")));
}

TEST_P(SolidCheck, PositionThatIsNotANumberIsAnError) {
  Eigen::Matrix3Xd x = natural_nodes(GetParam());
  x(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(findings_of(GetParam(), x).errors.size(), 1U);
}

INSTANTIATE_TEST_SUITE_P(Shapes, SolidCheck, ::testing::ValuesIn(all_solid_shapes),
                         [](const auto& shape) { return solid_name(shape.param); });

/// The corner 7 of a hexahedron is pushed through the opposite face diagonal: its Jacobian changes sign there.
TEST(SolidCheck, FoldedCornerIsNamed) {
  Eigen::Matrix3Xd x = natural_nodes(SolidShape::hexahedron8);
  x.col(6) = Eigen::Vector3d(-0.6, -0.6, -0.6);
  EXPECT_THAT(findings_of(SolidShape::hexahedron8, x).errors,
              ElementsAre(::testing::AllOf(HasSubstr("folded"), HasSubstr("at node 7"))));
}

/// A middle node past a quarter of its edge: Jacobian 0 at the near corner of a quadratic edge.
TEST(SolidCheck, MiddleNodeNearACornerIsFolded) {
  Eigen::Matrix3Xd x = natural_nodes(SolidShape::tetrahedron10);
  x.col(4) = Eigen::Vector3d(0.2, 0.0, 0.0);
  EXPECT_THAT(findings_of(SolidShape::tetrahedron10, x).errors,
              ElementsAre(::testing::AllOf(HasSubstr("folded"), HasSubstr("at node 1"))));
}

TEST(SolidCheck, SliversLongAndFlatElementsAreWarnedAbout) {
  Eigen::Matrix3Xd x = natural_nodes(SolidShape::tetrahedron4);
  x.row(2) *= 1e-3;
  EXPECT_THAT(findings_of(SolidShape::tetrahedron4, x).warnings, ::testing::Contains(HasSubstr("sliver")));
  x = natural_nodes(SolidShape::hexahedron8);
  x.row(2) *= 1e-3;
  EXPECT_THAT(findings_of(SolidShape::hexahedron8, x).warnings, ElementsAre(HasSubstr("aspect 1e+03")));
  x = natural_nodes(SolidShape::prism6);
  x.row(2) *= 0.1;
  EXPECT_THAT(findings_of(SolidShape::prism6, x).warnings, ElementsAre(HasSubstr("flat six-node prism")));
  EXPECT_THAT(findings_of(SolidShape::prism15, natural_nodes(SolidShape::prism15)).warnings, IsEmpty());
}

double integral(const auto& rule, int i, int j, int k) {
  double sum = 0.0;
  for (std::size_t q = 0; q < rule.point.size(); ++q)
    sum +=
        rule.weight[q] * std::pow(rule.point[q][0], i) * std::pow(rule.point[q][1], j) * std::pow(rule.point[q][2], k);
  return sum;
}

double factorial(int n) { return std::tgamma(n + 1.0); }
double line_integral(int k) { return k % 2 == 1 ? 0.0 : 2.0 / (k + 1.0); }

/// Monomials: i! j! k!/(i + j + k + 3)! on the tetrahedron, products of triangle i! j!/(i + j + 2)! and line on the
/// others.
TEST(SolidQuadrature, RulesIntegrateTheirDegree) {
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; i + j <= 5; ++j)
      for (int k = 0; k <= 5; ++k) {
        const double triangle = factorial(i) * factorial(j) / factorial(i + j + 2) * line_integral(k);
        EXPECT_NEAR(integral(mass_rule<SolidShape::prism15>(), i, j, k), triangle, 1e-14);
        if (i + j <= 2) {
          EXPECT_NEAR(integral(stiffness_rule<SolidShape::prism15>(), i, j, k), triangle, 1e-14);
        }
        const double cube = line_integral(i) * line_integral(j) * line_integral(k);
        EXPECT_NEAR(integral(mass_rule<SolidShape::hexahedron20>(), i, j, k), cube, 1e-14);
        if (std::max({i, j, k}) <= 3) {
          EXPECT_NEAR(integral(stiffness_rule<SolidShape::hexahedron8>(), i, j, k), cube, 1e-14);
        }
        const double tetrahedron = factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3);
        if (i + j + k <= 5) {
          EXPECT_NEAR(integral(mass_rule<SolidShape::tetrahedron10>(), i, j, k), tetrahedron, 1e-16);
        }
        if (i + j + k <= 2) {
          EXPECT_NEAR(integral(stiffness_rule<SolidShape::tetrahedron10>(), i, j, k), tetrahedron, 1e-16);
        }
      }
}

}  // namespace
}  // namespace tisserand::reducer::solid_check_test
