// SPDX-License-Identifier: GPL-3.0-or-later
// Section constants by boundary integral equations against closed solutions, [Pil02] and laws of the theory.
#include "formats/sections/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "formats/sections/profiles.hpp"
#include "formats/sections/shapes.hpp"

namespace tisserand::formats::section_polygon_test {
namespace {

using Eigen::Vector2d;

Ring box_ring(double left, double bottom, double right, double top) {
  return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
}

Ring ellipse(double a, double b, int n) {
  Ring ring;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    ring.emplace_back(a * std::cos(angle), b * std::sin(angle));
  }
  return ring;
}

void expect_relative(double value, double expected, double tolerance) {
  EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
}

/// Saint-Venant's series and 5/6 A (Cowper, nu = 0) from square to strip. The collocation errs by about 1e-5 of J.
TEST(SectionPolygon, Rectangles) {
  for (const double h : {1.0, 1.7, 5.0, 50.0}) {
    const Section section = polygon_section({box_ring(3.0, -1.0, 4.0, h - 1.0), {}}), exact = rectangle_section(1.0, h);
    SCOPED_TRACE(h);
    expect_relative(section.torsion_constant, exact.torsion_constant, 5e-5);
    expect_relative(section.second_moment_y, exact.second_moment_y, 1e-12);
    expect_relative(section.shear_area_y, exact.shear_area_y, 1e-5);
    expect_relative(section.shear_area_z, exact.shear_area_z, 1e-5);
    EXPECT_EQ(section.shear_center_y, 0.0);
    EXPECT_EQ(section.second_moment_yz, 0.0);
    EXPECT_EQ(section.shear_coupling, 0.0);
  }
  expect_relative(polygon_section({box_ring(0, 0, 1, 1), {}}).torsion_constant, 0.140577, 5e-5);
}

/// Equilateral triangle: J = √3 a⁴/80 (Timoshenko and Goodier, section 105); ω is then a cubic polynomial, which the
/// panels hold exactly.
TEST(SectionPolygon, Triangle) {
  const Section section = polygon_section({{{0, 0}, {2, 0}, {1, std::sqrt(3.0)}}, {}});
  expect_relative(section.torsion_constant, std::sqrt(3.0) / 5.0, 1e-12);
  expect_relative(section.shear_area_y, section.shear_area_z, 1e-12);
}

/// J = π a³b³/(a² + b²); inscribed polygon: I and J fall short by about 2 (2π/n)²/6 each.
TEST(SectionPolygon, EllipseAndTubeAsManyCorners) {
  const Section section = polygon_section({ellipse(2.0, 1.0, 120), {}});
  expect_relative(section.torsion_constant, std::numbers::pi * 8.0 / 5.0, 2.5e-3);
  EXPECT_LT(section.torsion_constant, std::numbers::pi * 8.0 / 5.0);
  const Section tube = polygon_section({ellipse(1.0, 1.0, 90), {ellipse(0.7, 0.7, 90)}});
  const Section exact = hollow_circle_section(1.0, 0.3);
  expect_relative(tube.torsion_constant, exact.torsion_constant, 5e-3);
  expect_relative(tube.shear_area_y / tube.area, exact.shear_area_y / exact.area, 1e-3);
}

/// Semicircle of radius a: J = 0.298 a⁴ (Roark's Formulas for Stress and Strain, 7th ed., table 10.1, printed digits).
TEST(SectionPolygon, Semicircle) {
  Ring ring;
  constexpr int n = 90;
  for (int i = 0; i <= n; ++i)
    ring.emplace_back(std::cos(std::numbers::pi * i / n), std::sin(std::numbers::pi * i / n));
  const Section section = polygon_section({ring, {}});
  expect_relative(section.torsion_constant, 0.298, 3e-3);
  // Shear centre at 8 (3 + 4 nu) a/(15 π (1 + nu)) from the diameter (Timoshenko and Goodier, section 125), nu = 0.
  const double centroid = area_moments({ring, {}}).centroid.y();
  expect_relative(centroid + section.shear_center_z, 8.0 / (5.0 * std::numbers::pi), 2e-3);
}

/// [Pil02] example 6.6 (page 267), nu = 0: trapezium without symmetry; shear coefficients α = A/A_s, printed to six
/// digits, by a fine mesh of nine-node elements.
TEST(SectionPolygon, TrapeziumOfPilkey) {
  const Section s = polygon_section({{{-0.5, -1.0}, {0.5, -1.0}, {0.5, 2.0}, {-0.5, 1.0}}, {}});
  expect_relative(s.area / s.shear_area_y, 1.313417, 1e-4);
  expect_relative(s.area / s.shear_area_z, 1.169516, 1e-4);
  expect_relative(s.area * s.shear_coupling, -0.063785, 1e-3);
  expect_relative(s.shear_center_y, -0.069460, 1e-3);
  expect_relative(s.shear_center_z, -0.072013, 1e-3);
}

/// [Pil02] example 6.7 (page 268), nu = 0: angles 10.5 x 10.5 and 10.5 x 15.5, thickness 1. His finite elements give J
/// from above and A/A_s from below, which the re-entrant corner makes visible: by 0.2 %; the coupling is a difference
/// of two such values.
TEST(SectionPolygon, AnglesOfPilkey) {
  struct Case {
    double height, J, alpha_y, alpha_z, coupling, y, z;
  };
  for (const Case& c : {Case{10.5, 6.539189, 2.301059, 2.301059, 0.014969, -2.464750, -2.464750},
                        Case{15.5, 8.211705, 3.058207, 1.898375, 0.039510, -1.997641, -4.423925}}) {
    const Section s = profile_section("angle", {c.height, 10.5, 1.0, 1.0});
    SCOPED_TRACE(c.height);
    EXPECT_LT(s.torsion_constant, c.J);
    EXPECT_GT(s.torsion_constant, c.J * (1.0 - 2.5e-3));
    EXPECT_GT(s.area / s.shear_area_y, c.alpha_y);
    EXPECT_LT(s.area / s.shear_area_y, c.alpha_y * (1.0 + 2.5e-3));
    EXPECT_GT(s.area / s.shear_area_z, c.alpha_z);
    EXPECT_LT(s.area / s.shear_area_z, c.alpha_z * (1.0 + 2.5e-3));
    EXPECT_NEAR(s.area * s.shear_coupling, c.coupling, 2.5e-3);
    expect_relative(s.shear_center_y, c.y, 1e-3);
    expect_relative(s.shear_center_z, c.z, 1e-3);
  }
}

/// [Pil02] examples 6.2, 6.3 (channel of wall c/10, nu = 0) and B.2 (18 x 8, wall 1).
TEST(SectionPolygon, ChannelsOfPilkey) {
  const Section s = profile_section("channel", {2.1, 1.05, 0.1, 0.1});
  expect_relative(s.shear_center_y, -0.62055, 1e-3);
  expect_relative(s.area / s.shear_area_y, 3.09621, 1e-3);
  expect_relative(s.area / s.shear_area_z, 2.34102, 1e-3);
  expect_relative(s.torsion_constant, 0.00133, 5e-3);
  const Section b2 = profile_section("channel", {19.0, 8.5, 1.0, 1.0});
  expect_relative(b2.area, 34.0, 1e-12);
  expect_relative(b2.second_moment_y, 1787.83333, 1e-8);
  expect_relative(b2.second_moment_z, 223.30208, 1e-7);
  // From the middle of the web, at 0.5; the centroid is at 1.875 from there. Printed for nu = 1/3 and by Trefftz.
  expect_relative(1.875 + b2.shear_center_y, -2.86759, 1e-3);
  expect_relative(b2.torsion_constant, 11.28862, 2.5e-3);  // from above, as for the angles
}

/// [Pil02] example B.3: angle without symmetry, second moments to seven digits.
TEST(SectionPolygon, MomentsOfPilkeysAngle) {
  const AreaMoments m = area_moments(profile_polygon("angle", {8.0, 6.0, 0.75, 0.75}));
  expect_relative(m.area, 9.9375, 1e-12);
  expect_relative(m.centroid.x() - 0.375, 1.18868, 1e-5);
  expect_relative(m.centroid.y() - 0.375, 2.18868, 1e-5);
  expect_relative(m.second_moment_y, 63.42455, 1e-6);
  expect_relative(m.second_moment_z, 30.72142, 1e-6);
  expect_relative(m.second_moment_yz, -25.85377, 1e-6);
}

SectionPolygon moved(SectionPolygon polygon, double angle, double scale, const Vector2d& shift) {
  const Eigen::Matrix2d R{{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}};
  const auto move = [&](Ring& ring) {
    for (Vector2d& p : ring) p = scale * (R * p) + shift;
  };
  move(polygon.outer);
  for (Ring& hole : polygon.holes) move(hole);
  return polygon;
}

/// Shifting, turning, scaling and the sense of the corners change nothing but the axes.
TEST(SectionPolygon, InvariantUnderMotionAndScale) {
  const SectionPolygon polygon{{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 4}, {0, 4}}, {box_ring(0.3, 0.3, 0.7, 0.8)}};
  const Section a = polygon_section(polygon);
  SectionPolygon other = moved(polygon, 0.6, 1e-3, {5.0, -2.0});
  std::reverse(other.outer.begin(), other.outer.end());
  const Section b = polygon_section(other);
  expect_relative(b.area, 1e-6 * a.area, 1e-9);
  expect_relative(b.torsion_constant, 1e-12 * a.torsion_constant, 1e-7);
  expect_relative(b.polar_moment, 1e-12 * a.polar_moment, 1e-8);
  const double c = std::cos(0.6), s = std::sin(0.6);
  EXPECT_NEAR(b.shear_center_y, 1e-3 * (c * a.shear_center_y - s * a.shear_center_z), 1e-8);
  EXPECT_NEAR(b.shear_center_z, 1e-3 * (s * a.shear_center_y + c * a.shear_center_z), 1e-8);
  const double trace = 1.0 / a.shear_area_y + 1.0 / a.shear_area_z;
  expect_relative(1e-6 * (1.0 / b.shear_area_y + 1.0 / b.shear_area_z), trace, 1e-6);
}

/// J of open walls tends to Σ b t³/3 (Timoshenko and Goodier, section 108), the shear centre of a channel to 3b²/(6b +
/// h) from the middle of its web (equal walls; b, h along the middle lines), a box to Bredt.
TEST(SectionPolygon, ThinWallsInTheLimit) {
  const double b = 1.0, h = 2.0;
  double previous = 1.0;
  for (const double t : {0.08, 0.04, 0.02}) {
    const SectionPolygon channel = profile_polygon("channel", {h + t, b + 0.5 * t, t, t});
    const Section s = polygon_section(channel);
    const double thin = (2.0 * b + h) * t * t * t / 3.0, error = std::abs(s.torsion_constant / thin - 1.0);
    EXPECT_LT(error, 0.6 * previous);
    previous = error;
    const double eccentricity = 0.5 * t - area_moments(channel).centroid.x() - s.shear_center_y;
    EXPECT_NEAR(eccentricity, 3.0 * b * b / (6.0 * b + h), 2.0 * t * t);
    const Section box = profile_section("box", {h + t, b + t, t, t, t, t});
    expect_relative(box.torsion_constant, 4.0 * b * b * h * h * t / (2.0 * (b + h)), 1.0 * t);
  }
  EXPECT_LT(previous, 0.003);
}

TEST(SectionPolygon, FaultsAreNamed) {
  const auto fault = [](const SectionPolygon& polygon) { return polygon_fault(polygon).value_or("none"); };
  EXPECT_EQ(fault({box_ring(0, 0, 1, 1), {box_ring(0.2, 0.2, 0.8, 0.8)}}), "none");
  EXPECT_EQ(fault({{{0, 0}, {1, 0}}, {}}), "2 corners do not enclose an area");
  EXPECT_EQ(fault({{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, {}}),
            "the side from (0, 0) to (1, 1) touches or crosses the side from (1, 0) to (0, 1)");
  EXPECT_EQ(fault({{{0, 0}, {0, 0}, {1, 0}, {0, 1}}, {}}), "two neighbouring corners coincide at (0, 0)");
  EXPECT_EQ(fault({{{0, 0}, {2, 0}, {1, 0}, {0, 1}}, {}}), "the sides at the corner (2, 0) fold back onto each other");
  EXPECT_EQ(fault({box_ring(0, 0, 1, 1), {box_ring(2, 2, 3, 3)}}), "hole 1 is not inside the outline");
  EXPECT_EQ(fault({box_ring(0, 0, 9, 9), {box_ring(1, 1, 8, 8), box_ring(2, 2, 3, 3)}}), "hole 2 is inside hole 1");
  EXPECT_EQ(fault({box_ring(0, 0, std::numeric_limits<double>::quiet_NaN(), 1), {}}),
            "a corner is not a finite number");
  EXPECT_EQ(fault({ellipse(1, 1, 201), {}}), "201 corners exceed the limit of 200");
}

TEST(SectionProfiles, FaultsAreNamed) {
  EXPECT_EQ(profile_fault("I", {0.2, 0.1, 0.006, 0.009, 0.1, 0.009}), std::nullopt);
  EXPECT_EQ(profile_fault("I", {0.2, 0.1, 0.3, 0.009, 0.1, 0.009}), "web 0.3 is not less than width 0.1");
  EXPECT_EQ(profile_fault("I", {0.2, 0.1, 0.01, 0.1, 0.1, 0.1}),
            "flange 0.1 + bottom_flange 0.1 is not less than height 0.2");
  EXPECT_EQ(profile_fault("hat", {0.2, 0.1, -0.01, 0.01}), "brim -0.01 must be positive");
  EXPECT_EQ(profile_fault("tee", {0.2, 0.1, std::numeric_limits<double>::quiet_NaN(), 0.01}),
            "web nan must be positive");
}

/// Every profile is one outline without fault, with the area of its walls.
TEST(SectionProfiles, HaveTheirAreas) {
  const double h = 10, b = 6, w = 0.5, f = 0.8;
  const std::vector<std::pair<SectionPolygon, double>> cases{
      {profile_polygon("I", {h, b, w, f, 4, 1}), b * f + 4 * 1 + (h - f - 1) * w},
      {profile_polygon("channel", {h, b, w, f}), 2 * b * f + (h - 2 * f) * w},
      {profile_polygon("angle", {h, b, w, f}), b * f + (h - f) * w},
      {profile_polygon("tee", {h, b, w, f}), b * f + (h - f) * w},
      {profile_polygon("zed", {h, b, w, f}), 2 * b * f + (h - 2 * f) * w},
      {profile_polygon("box", {h, b, 1, 0.9, 0.5, 0.4}), h * b - (h - 1.9) * (b - 0.9)},
      {profile_polygon("hat", {h, b, 2, w}), w * (2 * h + b - 2 * w + 4)},
      {profile_polygon("cross", {h, b, w, f}), h * w + b * f - w * f}};
  for (const auto& [polygon, area] : cases) {
    EXPECT_EQ(polygon_fault(polygon), std::nullopt);
    expect_relative(area_moments(polygon).area, area, 1e-12);
  }
}

}  // namespace
}  // namespace tisserand::formats::section_polygon_test
