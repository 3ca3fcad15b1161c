// SPDX-License-Identifier: GPL-3.0-or-later
// Roads with heights over grids and along lines: polynomials and arcs in closed form, gradients by differences, ends
// and holes.
#include "mechanism/tyres/road.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "mechanism/tyres/tyre.hpp"

namespace tisserand::mechanism::road_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using formats::RoadHeights;

std::vector<double> even(double first, double last, int count) {
  std::vector<double> axis;
  for (int i = 0; i < count; ++i) axis.push_back(first + (last - first) * i / (count - 1));
  return axis;
}

template <class Height>
RoadHeights sampled(const std::vector<double>& along, const std::vector<double>& across, const Height& height) {
  RoadHeights road{along, across, {}, {}};
  road.height.resize(static_cast<Eigen::Index>(along.size()), static_cast<Eigen::Index>(across.size()));
  for (Eigen::Index i = 0; i < road.height.rows(); ++i)
    for (Eigen::Index k = 0; k < road.height.cols(); ++k) road.height(i, k) = height(along[i], across[k]);
  return road;
}

Road road_of(RoadHeights heights) {
  formats::RoadSpec spec;
  spec.name = "road";
  spec.kind = heights.line.cols() > 0 ? formats::RoadKind::crg : formats::RoadKind::grid;
  spec.heights = std::make_shared<const RoadHeights>(std::move(heights));
  return {spec, Vector3d::Zero()};
}

/// Rough ground: independent heights of up to 0.1, on uneven axes.
RoadHeights rough() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> z(-0.1, 0.1);
  return sampled({-1.0, -0.2, 0.0, 0.3, 1.0, 1.5, 3.0}, {-2.0, -1.0, -0.5, 0.7, 1.0},
                 [&](double, double) { return z(random); });
}

// Degree three in each coordinate is what slopes by five points and Hermite cubics reproduce, here on uneven axes with
// four points or more; a plane with two already. Round-off: 1e-13 of heights of size 30.
TEST(HeightGrid, ReproducesPolynomialsOfDegreeThree) {
  const auto z = [](double x, double y) {
    return 0.3 - x + 0.2 * y + x * y - 0.4 * x * x * y * y + 0.1 * x * x * x - 0.05 * x * x * x * y * y * y;
  };
  const auto by_x = [](double x, double y) {
    return -1.0 + y - 0.8 * x * y * y + 0.3 * x * x - 0.15 * x * x * y * y * y;
  };
  const auto by_y = [](double x, double y) { return 0.2 + x - 0.8 * x * x * y - 0.15 * x * x * x * y * y; };
  for (const auto& along :
       {std::vector<double>{-1.0, -0.2, 0.0, 0.3, 1.0, 1.5, 3.0}, std::vector<double>{0, 1, 2, 3}}) {
    const HeightGrid grid(sampled(along, {-2.0, -1.0, -0.5, 0.7, 1.0}, z));
    for (double x = along.front(); x <= along.back(); x += 0.0917)
      for (double y = -2.0; y <= 1.0; y += 0.0731) {
        const GridHeight at = grid.at(x, y);
        EXPECT_NEAR(at.value, z(x, y), 1e-12);
        EXPECT_NEAR(at.by_s, by_x(x, y), 1e-11);
        EXPECT_NEAR(at.by_t, by_y(x, y), 1e-11);
      }
  }
  const HeightGrid plane(sampled({0.0, 5.0}, {-1.0, 3.0}, [](double x, double y) { return 1.0 + 0.1 * x - 0.2 * y; }));
  for (const Vector2d& at : {Vector2d(1, 0), Vector2d(4.9, -0.7), Vector2d(7.0, 8.0), Vector2d(-3.0, -4.0)}) {
    EXPECT_NEAR(plane.at(at.x(), at.y()).value, 1.0 + 0.1 * at.x() - 0.2 * at.y(), 1e-15);
    EXPECT_NEAR(plane.at(at.x(), at.y()).by_s, 0.1, 1e-15);
    EXPECT_NEAR(plane.at(at.x(), at.y()).by_t, -0.2, 1e-15);
  }
}

// Also on rough ground, beyond the borders too. Slopes are of size 1, third derivatives below 1e2: differences with
// 1e-5 err by 1e-8.
TEST(HeightGrid, GradientIsTheDerivativeAndHasNoJump) {
  const RoadHeights ground = rough();
  const HeightGrid grid(ground);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(-1.5, 3.5), y(-2.5, 1.5);
  constexpr double h = 1e-5;
  for (int i = 0; i < 500; ++i) {
    const double s = x(random), t = y(random);
    EXPECT_NEAR(grid.at(s, t).by_s, (grid.at(s + h, t).value - grid.at(s - h, t).value) / (2 * h), 1e-7);
    EXPECT_NEAR(grid.at(s, t).by_t, (grid.at(s, t + h).value - grid.at(s, t - h).value) / (2 * h), 1e-7);
  }
  for (std::size_t i = 0; i < ground.along.size(); ++i)
    for (std::size_t k = 0; k < ground.across.size(); ++k) {
      const double s = ground.along[i], t = ground.across[k];
      EXPECT_NEAR(grid.at(s, t).value, ground.height(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)),
                  1e-15);
      for (const double other : {t + 0.11, t})
        for (const Vector2d& step : {Vector2d(1e-9, 0), Vector2d(0, 1e-9)}) {
          const GridHeight a = grid.at(s - step.x(), other - step.y()), b = grid.at(s + step.x(), other + step.y());
          EXPECT_NEAR(a.by_s, b.by_s, 1e-6);  // curvature of up to 1e2 times 2e-9
          EXPECT_NEAR(a.by_t, b.by_t, 1e-6);
        }
    }
}

// Heights beside a hole are those that polynomials of the rest give; cells that miss a corner are no road.
TEST(HeightGrid, HasHolesWhereHeightsAreMissing) {
  const auto z = [](double x, double y) { return 0.1 * x * x * x - y * y * y + x * y; };
  RoadHeights ground = sampled(even(0, 9, 10), even(0, 9, 10), z);
  ground.height(4, 4) = std::nan("");
  const HeightGrid grid(ground);
  for (double x = 0.05; x < 9.0; x += 0.1)
    for (double y = 0.05; y < 9.0; y += 0.1) {
      const bool hole = x > 3.0 && x < 5.0 && y > 3.0 && y < 5.0;
      ASSERT_EQ(grid.is_hole(x, y), hole) << x << " " << y;
      ASSERT_TRUE(std::isfinite(grid.at(x, y).value));
      ASSERT_TRUE(hole || std::abs(grid.at(x, y).value - z(x, y)) < 1e-11) << x << " " << y;
    }
}

// ---- reference lines --------------------------------------------------------------------------------------------

/// Points of a circle of radius R about (0, R), from the origin along x, a step of the arc apart.
Eigen::Matrix2Xd arc(double R, double angle, int count) {
  Eigen::Matrix2Xd points(2, count);
  for (int i = 0; i < count; ++i) {
    const double a = angle * i / (count - 1);
    points.col(i) << R * std::sin(a), R * (1.0 - std::cos(a));
  }
  return points;
}

TEST(ReferenceLine, IsExactWhereItIsStraight) {
  Eigen::Matrix2Xd points(2, 2);
  points << 100.0, 104.0, -50.0, -47.0;  // 5 long, direction (0.8, 0.6)
  for (const int between : {0, 7}) {
    Eigen::Matrix2Xd line(2, between + 2);
    for (int i = 0; i < between + 2; ++i)
      line.col(i) = points.col(0) + i / (between + 1.0) * (points.col(1) - points.col(0));
    const ReferenceLine road(line, 10.0, 15.0);
    for (const double u : {10.0, 12.3, 15.0, 3.0, 40.0})
      for (const double v : {-2.0, 0.0, 5.0}) {
        const Vector2d at = points.col(0) + (u - 10.0) * Vector2d(0.8, 0.6) + v * Vector2d(-0.6, 0.8);
        const LinePlace place = road.find(at);
        EXPECT_NEAR(place.u, u, 1e-13);
        EXPECT_NEAR(place.v, v, 1e-13);
        EXPECT_LT((place.u_by - Vector2d(0.8, 0.6)).norm(), 1e-13);
        EXPECT_LT((place.v_by - Vector2d(-0.6, 0.8)).norm(), 1e-13);
        EXPECT_LT((road.point(u, v) - at).norm(), 1e-13);
      }
  }
}

// A circle: v is the distance from it, u the angle times R. The spline errs by order 4 of the step h, its direction by
// √3/216 h³/R³, which moves u at v by v/(1 − v/R) of it; looked at away from the ends, whose end condition errs more.
TEST(ReferenceLine, MeasuresAlongAndBesideAnArc) {
  const double R = 20.0, angle = 2.5;
  for (const int count : {51, 101}) {
    const ReferenceLine line(arc(R, angle, count), 0.0, R * angle);
    double largest = 0.0;
    for (double a = 0.8; a < 1.7; a += 0.0137)
      for (const double v : {-3.0, -0.5, 0.0, 3.0}) {
        const Vector2d at((R - v) * std::sin(a), R - (R - v) * std::cos(a));
        const LinePlace place = line.find(at);
        largest = std::max({largest, std::abs(place.u - R * a), std::abs(place.v - v)});
        EXPECT_LT((line.point(place.u, place.v) - at).norm(), 1e-12);
      }
    const double h = R * angle / (count - 1);
    EXPECT_NEAR(largest, std::sqrt(3.0) / 216.0 * std::pow(h / R, 3) * 3.0 / (1.0 - 3.0 / R), 0.05 * largest);
  }
}

/// A line that winds, of many points.
Eigen::Matrix2Xd winding(int count, double step) {
  Eigen::Matrix2Xd points(2, count);
  Vector2d at(3.0, -4.0);
  for (int i = 0; i < count; ++i) {
    points.col(i) = at;
    const double u = i * step, heading = 0.5 + 1.2 * std::sin(0.05 * u) + 0.3 * std::sin(0.21 * u);
    at += step * Vector2d(std::cos(heading), std::sin(heading));
  }
  return points;
}

// Places are found without looking at all points, on both sides and beyond the ends, and their gradients are
// continuous: differences of u and v, and of their gradients across the points of the line.
TEST(ReferenceLine, FindsTheNearestPointAndItsGradients) {
  const ReferenceLine line(winding(2000, 0.1), 5.0, 5.0 + 199.9);
  EXPECT_TRUE(std::isnan(line.sharp_bend(-4.0, 4.0)));
  std::mt19937 random(11);
  std::uniform_real_distribution<double> along(5.0, 204.9), beside(-3.5, 3.5);
  constexpr double h = 1e-6;
  for (int i = 0; i < 1000; ++i) {
    const double u = along(random), v = beside(random);
    const Vector2d at = line.point(u, v);
    const LinePlace place = line.find(at);
    ASSERT_NEAR(place.u, u, 1e-10);
    ASSERT_NEAR(place.v, v, 1e-10);
    for (const int k : {0, 1}) {
      const Vector2d step = h * Vector2d::Unit(k);
      const LinePlace more = line.find(at + step), less = line.find(at - step);
      ASSERT_NEAR(place.u_by[k], (more.u - less.u) / (2 * h), 1e-7);
      ASSERT_NEAR(place.v_by[k], (more.v - less.v) / (2 * h), 1e-7);
    }
  }
  for (int i = 1; i < 1999; i += 37) {
    const double u = 5.0 + 0.1 * i;
    const LinePlace a = line.find(line.point(u - 1e-9, 2.0)), b = line.find(line.point(u + 1e-9, 2.0));
    EXPECT_LT((a.u_by - b.u_by).norm() + (a.v_by - b.v_by).norm(), 1e-7);
  }
}

// A closed circle is driven round: just before the end and just behind the start u differs by its length.
TEST(ReferenceLine, GoesRound) {
  const double R = 30.0, length = 2.0 * std::numbers::pi * R;
  const ReferenceLine line(arc(R, 2.0 * std::numbers::pi, 401), 0.0, length);
  const LinePlace before = line.find({-0.3, 1.0}), behind = line.find({0.3, 1.0});
  EXPECT_NEAR(length - before.u, behind.u, 1e-6);
  EXPECT_NEAR(before.v, behind.v, 1e-6);
  EXPECT_GT(before.u, length - 1.0);
  // 1 − κ v = 1 − 29/30.
  EXPECT_FALSE(std::isnan(line.sharp_bend(-1.0, 29.0)));
  EXPECT_TRUE(std::isnan(line.sharp_bend(-100.0, 25.0)));
}

// ---- roads ------------------------------------------------------------------------------------------------------

/// Along a winding line 8 m wide, with waves and a hole at u = 50, v = 3.
RoadHeights waves_along_a_line() {
  RoadHeights road = sampled(even(5.0, 204.9, 400), even(-4.0, 4.0, 9), [](double u, double v) {
    return 0.02 * std::sin(2.0 * u) + 0.03 * std::cos(u + v) + 0.05 * v;
  });
  road.line = winding(2000, 0.1);
  road.height(90, 7) = std::nan("");  // u = 5 + 90 · 0.501
  return road;
}

TEST(Road, AlongALineHasTheGradientOfItsHeight) {
  const Road road = road_of(waves_along_a_line());
  std::mt19937 random(13);
  std::uniform_real_distribution<double> along(6.0, 204.0), beside(-3.5, 3.5);
  constexpr double h = 1e-5;
  for (int i = 0; i < 500; ++i) {
    const Vector2d at = road.surface->line->point(along(random), beside(random));
    const RoadHeight z = road.at(at.x(), at.y());
    EXPECT_NEAR(z.by_x, (road.at(at.x() + h, at.y()).value - road.at(at.x() - h, at.y()).value) / (2 * h), 1e-7);
    EXPECT_NEAR(z.by_y, (road.at(at.x(), at.y() + h).value - road.at(at.x(), at.y() - h).value) / (2 * h), 1e-7);
  }
}

// A banked bend: z = b v is a cone, of slope b across it: by the circle of the test above, to the error of the spline.
TEST(Road, BankedInABendIsACone) {
  const double R = 20.0, angle = 2.5, banking = 0.1;
  RoadHeights cone =
      sampled(even(0.0, R * angle, 51), even(-4.0, 4.0, 5), [&](double, double v) { return banking * v; });
  cone.line = arc(R, angle, 51);
  const Road road = road_of(std::move(cone));
  for (const double a : {0.9, 1.2345, 1.6})
    for (const double v : {-3.0, 0.2, 2.9}) {
      const Vector2d outward(std::sin(a), -std::cos(a)), at = Vector2d(0.0, R) + (R - v) * outward;
      const RoadHeight z = road.at(at.x(), at.y());
      EXPECT_NEAR(z.value, banking * v, 1e-7);
      EXPECT_NEAR(z.by_x, -banking * outward.x(), 1e-6);
      EXPECT_NEAR(z.by_y, -banking * outward.y(), 1e-6);
    }
}

TEST(Road, SaysWhereItIsMissing) {
  const Road grid = road_of(rough());
  EXPECT_FALSE(grid.lack(0.0, 0.0));
  EXPECT_FALSE(grid.lack(-1.0, 1.0));
  const std::optional<RoadLack> ahead = grid.lack(3.1, 0.0), right = grid.lack(0.0, -2.5);
  ASSERT_TRUE(ahead && right);
  EXPECT_EQ(ahead->axis, 'x');
  EXPECT_EQ(ahead->end, 3.0);
  EXPECT_EQ(right->axis, 'y');
  EXPECT_EQ(right->begin, -2.0);
  EXPECT_EQ(right->at, -2.5);

  const Road road = road_of(waves_along_a_line());
  const auto lack = [&road](double u, double v) {
    const Vector2d at = road.surface->line->point(u, v);
    return road.lack(at.x(), at.y());
  };
  EXPECT_FALSE(lack(6.0, 3.9));
  ASSERT_TRUE(lack(50.1, 2.9));
  EXPECT_TRUE(lack(50.1, 2.9)->hole);
  EXPECT_NEAR(lack(50.1, 2.9)->place.x(), 50.1, 1e-9);
  EXPECT_FALSE(lack(51.0, 2.9));
  ASSERT_TRUE(lack(60.0, 4.1) && lack(4.0, 0.0) && lack(205.5, 0.0));
  EXPECT_EQ(lack(60.0, 4.1)->axis, 'v');
  EXPECT_EQ(lack(4.0, 0.0)->axis, 'u');
  EXPECT_EQ(lack(205.5, 0.0)->end, 204.9);
  // Far away, and from a wheel that lies on its side: finite.
  for (const Vector2d& far : {Vector2d(1e6, -1e6), Vector2d(-1e4, 3.0)}) {
    EXPECT_TRUE(road.lack(far.x(), far.y()));
    EXPECT_TRUE(std::isfinite(road.at(far.x(), far.y()).value));
  }
}

// The tangent of a tyre takes the gradient of the road once through dual numbers: by differences, as in the suite of
// tyres, on rough ground and along a line.
TEST(Tyre, TangentIsTheDerivativeOfTheForceOnGrids) {
  Tyre tyre;
  tyre.radius = 0.31;
  tyre.stiffness = 190e3;
  tyre.damping = 500.0;
  tyre.law = ComprehensiveSlip{80e3, 60e3, 3e3, 1.0, 0.75};
  tyre.rolling_resistance = 0.015;
  tyre.low_speed = 0.1;
  constexpr double h = 1e-7;
  for (const Road& road : {road_of(rough()), road_of(waves_along_a_line())}) {
    const Vector2d at = road.surface->line ? road.surface->line->point(30.0, 1.0) : Vector2d(0.1, 0.3);
    NodeMotion node;
    node.R = Eigen::AngleAxisd(0.3, Vector3d(0.2, 0.3, 1.0).normalized()).toRotationMatrix();
    node.x << at, road.at(at.x(), at.y()).value + tyre.radius - 0.04;
    node.xd = {5.0, 1.0, -0.3};
    node.Omega = {0.2, 14.0, -0.4};
    const Matrix6d K = tangent(tyre, road, node, Tread{}, {0, 0, 1}).topLeftCorner<6, 6>();
    for (int j = 0; j < 6; ++j) {
      Vector6d residual[2];
      for (const int side : {0, 1}) {
        NodeMotion moved = node;
        const Vector6d d = (side == 0 ? -h : h) * Vector6d::Unit(j);
        moved.x += d.head<3>();
        moved.R = node.R * exp_so3<double>(Vector3d(d.tail<3>()));
        TyreTerms terms;
        evaluate(tyre, road, moved, Tread{}, terms);
        ASSERT_GT(terms.penetration, 0.0);
        residual[side] = terms.residual;
      }
      EXPECT_LT((K.col(j) - (residual[1] - residual[0]) / (2 * h)).cwiseAbs().maxCoeff(),
                1e-5 * K.cwiseAbs().maxCoeff());
    }
  }
}

}  // namespace
}  // namespace tisserand::mechanism::road_test
