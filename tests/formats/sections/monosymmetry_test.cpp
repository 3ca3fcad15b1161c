// SPDX-License-Identifier: GPL-3.0-or-later
// Third moments of area and Wagner's β: closed forms of rectangles, symmetry, turning, a published approximation.
#include "formats/sections/monosymmetry.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/sections/profiles.hpp"
#include "formats/sections/report.hpp"
#include "formats/sections/shapes.hpp"

namespace tisserand::formats::monosymmetry_test {
namespace {

using Eigen::Vector2d;

Ring rectangle_ring(double y, double z, double width, double height) {
  return {{y, z}, {y + width, z}, {y + width, z + height}, {y, z + height}};
}

/// ∫z (y² + z²) dA of a rectangle with its centre at z0 on the axis of symmetry: A (z0³ + z0 h²/4 + z0 w²/12).
double rectangle_moment(double z0, double width, double height) {
  return width * height * z0 * (z0 * z0 + height * height / 4.0 + width * width / 12.0);
}

// A tee of two rectangles, flange 5 x 0.6 on top of a web 0.5 x 5.4.
TEST(Monosymmetry, TeeIsTheSumOfItsRectangles) {
  const double web = 0.5 * 5.4, flange = 5.0 * 0.6, middle = (web * 2.7 + flange * 5.7) / (web + flange);
  const double exact = rectangle_moment(2.7 - middle, 0.5, 5.4) + rectangle_moment(5.7 - middle, 5.0, 0.6);
  const Section tee = profile_section("tee", {6.0, 5.0, 0.5, 0.6});
  const Vector2d third = third_moments(tee).value();
  EXPECT_NEAR(third.y(), exact, 1e-12 * std::abs(exact));
  EXPECT_NEAR(third.x(), 0.0, 1e-12 * std::abs(exact));
  const Monosymmetry beta = known_monosymmetry(tee);
  EXPECT_NEAR(beta.beta_y, exact / tee.second_moment_y - 2.0 * tee.shear_center_z, 1e-12);
  EXPECT_EQ(beta.beta_z, 0.0);
}

// Two axes of symmetry, or symmetry to a point, leave nothing.
TEST(Monosymmetry, SymmetricSectionsHaveNone) {
  for (const Section& section :
       {circle_section(1.0), hollow_rectangle_section(2.0, 3.0, 0.1),
        profile_section("I", {4.0, 2.0, 0.1, 0.2, 2.0, 0.2}), profile_section("cross", {4.0, 2.0, 0.1, 0.2}),
        profile_section("zed", {4.0, 2.0, 0.1, 0.2})}) {
    const Monosymmetry beta = known_monosymmetry(section);
    EXPECT_NEAR(beta.beta_y, 0.0, 1e-12) << section.shape;
    EXPECT_NEAR(beta.beta_z, 0.0, 1e-12) << section.shape;
    EXPECT_FALSE(lacks_monosymmetry(section));
  }
}

// A hole is subtracted, either sense of turning counts alike, and a quarter turn takes z to −y.
TEST(Monosymmetry, PolygonsWithHolesTurn) {
  SectionPolygon polygon{rectangle_ring(0.0, 0.0, 3.0, 2.0), {rectangle_ring(0.5, 0.5, 1.0, 0.7)}};
  const Vector2d third = third_moments(polygon);
  SectionPolygon turned;
  const auto turn = [](const Ring& ring) {
    Ring result;
    for (const Vector2d& corner : ring) result.emplace_back(-corner.y(), corner.x());
    return result;
  };
  turned.outer = turn(polygon.outer);
  turned.holes = {turn(polygon.holes[0])};
  const Vector2d other = third_moments(turned);
  EXPECT_NEAR(other.x(), -third.y(), 1e-12);
  EXPECT_NEAR(other.y(), third.x(), 1e-12);
  std::ranges::reverse(polygon.outer);
  EXPECT_NEAR((third_moments(polygon) - third).norm(), 0.0, 1e-12);
  Section section = polygon_section(polygon);
  remember_outline(polygon, section);
  EXPECT_NEAR((third_moments(section).value() - third).norm(), 0.0, 1e-12);
}

// Walls are rectangles along their middle lines: of a channel, the sum over web and flanges.
TEST(Monosymmetry, WallsAreTheirRectangles) {
  const std::vector<WallLine> channel{{{{2.0, -3.0}, {0.0, -3.0}, {0.0, 3.0}, {2.0, 3.0}}, 0.1}};
  const Vector2d third = third_moments(channel);
  const double middle = walls_centroid(channel).x();
  const double web = rectangle_moment(-middle, 6.0, 0.1);  // its height is along y here
  const double y0 = 1.0 - middle, flange = 0.2 * y0 * (y0 * y0 + 1.0 + 9.0 + 0.01 / 12.0);
  EXPECT_NEAR(third.x(), web + 2.0 * flange, 1e-12);
  EXPECT_NEAR(third.y(), 0.0, 1e-12);
  Section section = walls_section(channel);
  remember_outline(channel, section);
  EXPECT_NEAR((third_moments(section).value() - third).norm(), 0.0, 1e-12);
}

// Kitipornchai and Trahair 1980, of I sections with unequal flanges h apart: β = 0.9 h (2 ρ − 1) (1 − (I_z/I_y)²),
// ρ = I_z of the compressed flange over I_z, within some per cent.
TEST(Monosymmetry, IsThatOfUnequalFlanges) {
  const double height = 0.4, top = 0.2, bottom = 0.12, flange = 0.012;
  const Section s = profile_section("I", {height, top, 0.008, flange, bottom, flange});
  const double rho = std::pow(top, 3) / (std::pow(top, 3) + std::pow(bottom, 3));
  const double ratio = s.second_moment_z / s.second_moment_y;
  const double published = 0.9 * (height - flange) * (2.0 * rho - 1.0) * (1.0 - ratio * ratio);
  // Compression of the upper flange is a positive M_y here; its β stiffens then.
  EXPECT_NEAR(std::abs(known_monosymmetry(s).beta_y) / published, 1.0, 0.05);
}

TEST(Monosymmetry, IsUnknownOfConstants) {
  Section s;
  s.name = "given";
  s.area = 1.0;
  s.second_moment_y = s.second_moment_z = 1.0;
  EXPECT_FALSE(third_moments(s));
  EXPECT_FALSE(lacks_monosymmetry(s));  // it may well be symmetric
  s.shear_center_z = 0.5;
  EXPECT_TRUE(lacks_monosymmetry(s));
  EXPECT_NEAR(known_monosymmetry(s).beta_y, -1.0, 1e-15);
  EXPECT_THAT(section_report({s}, Units::si()),
              ::testing::HasSubstr("not known for a section that is given by constants"));
  EXPECT_THAT(section_report({profile_section("tee", {6.0, 5.0, 0.5, 0.6})}, Units::si()),
              ::testing::HasSubstr("Wagner's beta of moments about y   beta_y"));
}

}  // namespace
}  // namespace tisserand::formats::monosymmetry_test
