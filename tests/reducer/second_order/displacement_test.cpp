// SPDX-License-Identifier: GPL-3.0-or-later
// Displacement of second order inside parts whose boundary is moved as that of a bar bent to a circle.
//
// A straight bar of length L under end moments is an arc of radius R: the point s of its axis is at R sin(s/R) along
// and at R (1 − cos(s/R)) across, its section turns by s/R (Euler's elastica). Its ends are moved so; what recovery
// gives inside is compared. Φ y alone misses along the axis (s³ − s L²)/(6 R²), whose largest value is 0.3849 θ² L/6
// with θ = L/R. With u₂ what is left is of third order: a cubic between the ends misses s² (L − s)²/(24 R³) across, at
// most θ³ L/384. That is all where the boundary has rotations and the frame is between the ends. Elsewhere it is more,
// but of third order.
#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "formats/recovery/second_order.hpp"
#include "reducer/properties/laminate.hpp"
#include "reducer/properties/solid_material.hpp"
#include "reducer/sources/build_mesh.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/recovery/recovered.hpp"
#include "tests/support/meshes/shell_grids.hpp"
#include "tests/support/meshes/small_model.hpp"
#include "tests/support/meshes/solid_mesh.hpp"

namespace tisserand::testing::displacement_test {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using reducer::Mesh;
using Motion = Eigen::Matrix<double, 6, 1>;

constexpr double length = 1.0, thickness = 0.01;
constexpr double missed_by_cubic = 1.0 / 384.0, missed_by_linear = 0.3849 / 6.0;  // of θ³ L, of θ² L

/// Motion of the point X of a bar along x bent by the angle θ about −y and then turned about y by `turn` around the
/// middle of the chord: translation and rotation vector.
Motion circle(const Vector3d& X, double theta, double turn) {
  const double R = length / theta, phi = X.x() / R;
  const Vector3d at(R * std::sin(phi) - X.z() * std::sin(phi), X.y(),
                    R * (1.0 - std::cos(phi)) + X.z() * std::cos(phi));
  const Matrix3d Q = Eigen::AngleAxisd(turn, Vector3d::UnitY()).toRotationMatrix();
  const Vector3d middle(0.5 * R * std::sin(theta), 0.0, 0.5 * R * (1.0 - std::cos(theta)));
  Motion motion;
  motion << Q * (at - middle) + Vector3d(0.5 * length, 0.0, 0.0) - X, Vector3d(0.0, turn - phi, 0.0);
  return motion;
}

/// Largest distances of inner nodes from where the circle has them, without u₂ and with it.
struct Misses {
  double linear = 0.0, both = 0.0;
};

Misses misses(const Recovered& r, double theta, double turn) {
  const VectorXd y = boundary_motion(r, [&](const Vector3d& X) { return circle(X, theta, turn); });
  const VectorXd linear = r.of(formats::RecoveryField::translation) * y;
  const VectorXd u = linear + r.second_order[0] * formats::second_order_amplitudes(r.tables.second_order->of_shape, y);
  Misses largest;
  for (Index n = 0; n < r.tables.position.cols(); ++n) {
    const Vector3d exact = circle(r.tables.position.col(n), theta, turn).head<3>();
    largest.linear = std::max(largest.linear, (linear.segment<3>(3 * n) - exact).norm());
    largest.both = std::max(largest.both, (u.segment<3>(3 * n) - exact).norm());
  }
  return largest;
}

/// What is missed without u₂ is of second order, and with it of third: in the frames of both ends, in the mean frame
/// and in one that is turned.
void expect_third_order(const Recovered& r, double most) {
  ASSERT_TRUE(r.tables.second_order);
  for (const double share : {0.0, 0.5, 1.0, -0.5}) {
    const Misses half = misses(r, 0.2, share * 0.2), whole = misses(r, 0.4, share * 0.4);
    EXPECT_NEAR(whole.linear / half.linear, 4.0, 0.3) << share;
    EXPECT_NEAR(whole.both / half.both, 8.0, 0.7) << share;
    EXPECT_LT(whole.both, most * std::pow(0.4, 3) * length) << share;
  }
  const Misses small = misses(r, 0.02, 0.0);  // two thicknesses of a hundredth of the length
  EXPECT_NEAR(small.linear, missed_by_linear * 0.02 * 0.02, 0.05 * missed_by_linear * 0.02 * 0.02);
  EXPECT_LT(small.both, 0.02 * small.linear);
}

/// The error of the cubic and nothing else.
void expect_cubic(const Recovered& r, double tolerance) {
  for (const double share : {0.0, 0.5, 1.0})
    for (const double theta : {0.1, 0.2, 0.4}) {
      const double cubic = missed_by_cubic * std::pow(theta, 3) * length;
      EXPECT_NEAR(misses(r, theta, share * theta).both, cubic, tolerance * cubic) << theta << ' ' << share;
    }
}

Mesh bar(int elements) {
  return reducer::build_mesh(plain_beam(Vector3d::Zero(), Vector3d(length, 0.0, 0.0), elements, 0));
}

TEST(SecondOrderDisplacement, OfBentBeamsIsThatOfTheCircle) {
  const Recovered r = recovered(bar(20), 0);
  expect_third_order(r, 0.03);
  expect_cubic(r, 0.1);
}

TEST(SecondOrderDisplacement, BetweenThreeNodesOfABeamIsThatOfTheCircle) {
  Mesh mesh = bar(20);
  for (int n = 0; n < mesh.nodes(); ++n)
    if (std::abs(mesh.position(0, n) - 0.5 * length) < 1e-9) mesh.boundary.push_back({"middle", n, true, true});
  ASSERT_EQ(mesh.boundary.size(), 3u);
  const Recovered r = recovered(mesh, 0);
  const Misses missed = misses(r, 0.4, 0.2);  // of halves as long that bend by half the angle
  EXPECT_NEAR(missed.both, missed_by_cubic / 16.0 * 0.064, 0.1 * missed_by_cubic / 16.0 * 0.064);
  EXPECT_NEAR(missed.linear, missed_by_linear / 8.0 * 0.16, 0.05 * missed_by_linear / 8.0 * 0.16);
  EXPECT_NEAR(misses(r, 0.4, 0.0).both / misses(r, 0.2, 0.0).both, 8.0, 0.7);
}

/// A strip along x whose end edges are at the boundary; without Poisson's ratio it stays a cylinder.
TEST(SecondOrderDisplacement, OfABentStripOfShellsIsThatOfTheCircle) {
  for (const auto facets : {reducer::Facets::quadrilaterals, reducer::Facets::triangles}) {
    const reducer::GridShape grid{24, 2, facets, false};
    Mesh mesh = reducer::shell_grid(
        grid,
        [](double a, double b) -> Vector3d {
          return {length * a, 0.1 * (b - 0.5), 0.0};
        },
        reducer::isotropic_shell(2.1e11, 0.0, 7800.0, thickness, 5.0 / 6.0));
    std::vector<int> ends;
    for (int j = 0; j <= 2; ++j)
      ends.insert(ends.end(), {reducer::grid_node(grid, 0, j), reducer::grid_node(grid, grid.na, j)});
    set_boundary(mesh, ends, true);
    const Recovered r = recovered(mesh, 0);
    expect_third_order(r, 0.03);
    expect_cubic(r, 0.12);
  }
}

/// A bar of bricks whose end faces are at the boundary.
TEST(SecondOrderDisplacement, OfABentBarOfSolidsIsThatOfTheCircle) {
  for (const auto shape : {reducer::SolidShape::hexahedron20, reducer::SolidShape::hexahedron8}) {
    Mesh mesh = reducer::solid_block({shape, {24, 1, 1}, {length, 2.0 * thickness, 2.0 * thickness}, 0.0},
                                     {reducer::isotropic_solid(2.1e11, 0.0, 7800.0), {}, "body"});
    mesh.position.row(1).array() -= thickness;
    mesh.position.row(2).array() -= thickness;
    std::vector<int> ends;
    for (int n = 0; n < mesh.nodes(); ++n)
      if (mesh.position(0, n) < 1e-9 || mesh.position(0, n) > length - 1e-9) ends.push_back(n);
    set_boundary(mesh, ends, false);
    expect_third_order(recovered(mesh, 0), 0.15);
  }
}

// Internal coordinates that second order moves, such as the lowest stretch of a bar whose bending modes come first,
// have their own forms: what they do not move is in the shapes, and together they are what a basis without modes has.
TEST(SecondOrderDisplacement, DoesNotDependOnTheInternalCoordinates) {
  const Recovered bare = recovered(bar(20), 0), rich = recovered(bar(20), 40);
  ASSERT_FALSE(rich.tables.second_order->coordinate.empty());
  const double theta = 0.2;
  const auto moved = [&](const Recovered& r) {
    const VectorXd y = boundary_motion(r, [&](const Vector3d& X) { return circle(X, theta, 0.5 * theta); });
    const formats::SecondOrderForms& forms = *r.tables.second_order;
    VectorXd more = VectorXd::Zero(y.size());
    const VectorXd of_coordinate = formats::second_order_amplitudes(forms.of_coordinate, y);
    for (std::size_t k = 0; k < forms.coordinate.size(); ++k)
      more[forms.coordinate[k]] = of_coordinate[static_cast<Index>(k)];
    return VectorXd(r.second_order[0] * formats::second_order_amplitudes(forms.of_shape, y) +
                    r.of(formats::RecoveryField::translation) * more);
  };
  const VectorXd expected = moved(bare), found = moved(rich);
  const double exact = missed_by_linear * theta * theta / 8.0;  // of halves as long that bend by half the angle
  EXPECT_NEAR(expected.cwiseAbs().maxCoeff(), exact, 0.05 * exact);
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 0.02 * expected.cwiseAbs().maxCoeff());
}

TEST(SecondOrderDisplacement, IsNotMadeWithoutACompanion) {
  formats::Part part;
  part.name = "part";
  part.file = "part.yaml";
  part.units = Units::si();
  part.modes.count = 2;
  part.second_order = formats::SecondOrder::no;
  EXPECT_FALSE(recovered(bar(4), part).tables.second_order);
}

}  // namespace
}  // namespace tisserand::testing::displacement_test
