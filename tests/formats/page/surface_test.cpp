// SPDX-License-Identifier: GPL-3.0-or-later
// Solids, thinning and few modes: what pages draw of a body.
#include "formats/page/surface.hpp"

#include <cmath>
#include <numbers>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/page/deformation.hpp"

namespace tisserand::formats::surface_test {
namespace {

using Eigen::Vector3d;

/// Sum of the tetrahedra from the origin to each triangle: positive where triangles turn counter-clockwise seen from
/// outside (Gauss).
double volume(const Surface& surface) {
  double sum = 0.0;
  for (const auto& [a, b, c] : surface.triangles)
    sum += surface.vertices[a].dot(surface.vertices[b].cross(surface.vertices[c])) / 6.0;
  return sum;
}

ShapeSpec solid(ShapeKind kind) {
  ShapeSpec shape;
  shape.kind = kind;
  shape.size = {1.0, 2.0, 3.0};
  shape.radius = shape.end_radius = 0.5;
  shape.from = {1.0, 0.0, 0.0};
  shape.to = {1.0, 0.0, 2.0};
  shape.points = {{0, 0, 0}, {0, 0, 1}, {0, 0, 3}};
  return shape;
}

TEST(Surface, SolidsHaveTheirVolume) {
  // A regular polygon of n corners has the area n/2 sin(2 pi/n) r^2.
  const double circle = 12.0 * std::sin(2.0 * std::numbers::pi / 24.0) * 0.25;
  ShapeSpec box = solid(ShapeKind::box);
  box.position = {5.0, 6.0, 7.0};
  box.orientation = Eigen::AngleAxisd(0.3, Vector3d(1, 2, 3).normalized());
  EXPECT_NEAR(volume(surface_of(box)), 6.0, 1e-12);
  EXPECT_NEAR(volume(surface_of(solid(ShapeKind::cylinder))), 2.0 * circle, 1e-12);
  EXPECT_NEAR(volume(surface_of(solid(ShapeKind::tube))), 3.0 * circle, 1e-12);
  ShapeSpec cone = solid(ShapeKind::cone);
  cone.end_radius = 0.0;
  EXPECT_NEAR(volume(surface_of(cone)), 2.0 * circle / 3.0, 1e-12);
  // Of a sphere by 11 rings of 24 corners and two poles: inside the sphere and not much smaller.
  const double ball = volume(surface_of(solid(ShapeKind::sphere))), exact = std::numbers::pi / 6.0;
  EXPECT_LT(ball, exact);
  EXPECT_GT(ball, 0.95 * exact);
}

TEST(Surface, OutlinesHaveTheAreaOfTheirSections) {
  formats::Section section;
  section.area = 9.0;
  section.second_moment_y = section.second_moment_z = 6.75;  // of a square of side 3
  const auto area = [](const Outline& outline) {
    double sum = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const auto &a = outline[i], &b = outline[(i + 1) % outline.size()];
      sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
    return sum;
  };
  EXPECT_NEAR(area(outline_of(section, 1.0)), 9.0, 1e-12);
  section.shape = "hollow_rectangle";
  section.sizes = {2.0, 4.0, 0.1};
  EXPECT_NEAR(area(outline_of(section, 1.0)), 8.0, 1e-12);  // the outer contour
  section.shape = "I";
  section.sizes = {2.0, 1.0, 0.1, 0.2, 1.0, 0.2};
  EXPECT_NEAR(area(outline_of(section, 1.0)), 2.0 * 0.2 * 1.0 + 0.1 * 1.6, 1e-12);
}

// Places that differ by round-off only: the difference is no range of its own, whose steps would be below the digits.
TEST(PageBlocks, PositionsOfOnePlaneButForRoundOff) {
  PageRows places(2, 3);
  places << 1.65, 0.0, 2.0, std::nextafter(1.65, 2.0), 1.0, 2.0;
  PageBlocks blocks;
  const Json stored = blocks.add_positions(places);
  EXPECT_EQ(stored["shape"], Json({2, 3}));
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 2; ++r) {  // what the page reads: whole steps from the offset
      const double offset = stored["offset"][c], step = stored["scale"][c];
      EXPECT_NEAR(offset + step * std::rint((places(r, c) - offset) / step), places(r, c), 1e-4);
    }
}

TEST(Surface, LeastTreeJoinsNeighbours) {
  const std::vector<Vector3d> points{{0, 0, 0}, {3, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  std::set<std::array<int, 2>> lines;
  for (std::array<int, 2> line : least_tree(points)) {
    std::ranges::sort(line);
    lines.insert(line);
  }
  EXPECT_EQ(lines, (std::set<std::array<int, 2>>{{0, 2}, {2, 3}, {1, 3}}));
  EXPECT_TRUE(least_tree({Vector3d::Zero()}).empty());
}

TEST(Surface, ThinningKeepsTheSolidAndNoMoreVertices) {
  // A plate of 101 x 101 vertices, unit square.
  Surface plate;
  for (int i = 0; i <= 100; ++i)
    for (int k = 0; k <= 100; ++k) plate.vertices.emplace_back(0.01 * i, 0.01 * k, 0.0);
  for (int i = 0; i < 100; ++i)
    for (int k = 0; k < 100; ++k) {
      const int a = 101 * i + k;
      plate.triangles.push_back({a, a + 101, a + 1});
      plate.triangles.push_back({a + 1, a + 101, a + 102});
    }
  const Thinned few = thinned(plate, 500);
  EXPECT_LE(few.kept.size(), 500u);
  EXPECT_GE(few.kept.size(), 300u);  // the grid is refined until it would keep more than 500; 22 x 22 = 484
  double area = 0.0;
  for (const auto& [a, b, c] : few.triangles) {
    const Vector3d p = plate.vertices[few.kept[a]], q = plate.vertices[few.kept[b]], r = plate.vertices[few.kept[c]];
    area += 0.5 * (q - p).cross(r - p).z();
  }
  // Border vertices lie inside by half a cell, 1/44 on each side.
  EXPECT_GT(area, std::pow(1.0 - 2.0 / 22.0, 2));
  EXPECT_LE(area, 1.0 + 1e-12);
  EXPECT_EQ(thinned(plate, 20000).kept.size(), plate.vertices.size());
}

TEST(FewModes, KeepsWhatTheRunVisitedWithinTheStatedError) {
  // 40 coordinates, of which the run moves three combinations: 1, 0.1 and 4e-4 large.
  const Eigen::MatrixXd modes = Eigen::MatrixXd::Random(300, 40);
  const Eigen::MatrixXd directions = Eigen::MatrixXd::Random(40, 3);
  Eigen::MatrixXd motion(200, 3);
  for (int t = 0; t < 200; ++t) motion.row(t) << std::sin(0.1 * t), 0.1 * std::cos(0.37 * t), 4e-4 * std::sin(0.9 * t);
  const Deformation d{modes, motion * directions.transpose()};
  const FewModes few = few_modes(d, 1e-3, 1.0);
  EXPECT_EQ(few.count(), 2);
  Eigen::MatrixXd read = Eigen::MatrixXd::Zero(300, 200);
  for (int k = 0; k < few.count(); ++k)
    for (int v = 0; v < 100; ++v)
      read.middleRows<3>(3 * v) +=
          few.modes.row(k * 100 + v).transpose() * few.amplitudes.col(k).cast<double>().transpose();
  const Eigen::MatrixXd exact = modes * d.amplitudes.transpose();
  double largest = 0.0, error = 0.0;
  for (int t = 0; t < 200; ++t)
    for (int v = 0; v < 100; ++v) {
      largest = std::max(largest, exact.block<3, 1>(3 * v, t).norm());
      error = std::max(error, (read - exact).block<3, 1>(3 * v, t).norm());
    }
  EXPECT_NEAR(few.largest, largest, 1e-12 * largest);
  EXPECT_NEAR(few.error, error, 1e-9 * largest);
  EXPECT_LE(error, 1e-3 * largest);
  EXPECT_EQ(few_modes(d, 1e-4, 1.0).count(), 3);
  EXPECT_EQ(few_modes({modes, Eigen::MatrixXd::Zero(200, 40)}, 1e-3, 1.0).count(), 0);
}

}  // namespace
}  // namespace tisserand::formats::surface_test
