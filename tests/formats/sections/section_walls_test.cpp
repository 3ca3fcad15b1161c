// SPDX-License-Identifier: GPL-3.0-or-later
// Thin-walled constants against closed formulas, solid sections with thin walls, and laws of the theory.
#include "formats/sections/walls.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "formats/sections/profiles.hpp"

namespace tisserand::formats::section_walls_test {
namespace {

void expect_relative(double value, double expected, double tolerance) {
  EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
}

/// Shear centre 3b² t_f/(6 b t_f + h t_w) from the web (Timoshenko, Strength of Materials II; Gere, Mechanics of
/// Materials, 6.9) and warping constant b³h²t (3b t_f + 2 h t_w)/(12 (6 b t_f + h t_w)) (Pilkey 2005, Formulas for
/// Stress, Strain and Structural Matrices, table 2-6), both of thin walls.
TEST(SectionWalls, Channel) {
  const double b = 0.06, h = 0.1, tf = 0.004, tw = 0.003;
  const std::vector<WallLine> walls{{{{b, 0}, {0, 0}}, tf}, {{{0, 0}, {0, h}}, tw}, {{{0, h}, {b, h}}, tf}};
  const Section s = walls_section(walls);
  const double e = 3 * b * b * tf / (6 * b * tf + h * tw);
  expect_relative(-(walls_centroid(walls).x() + s.shear_center_y), e, 1e-12);
  EXPECT_EQ(s.shear_center_z, 0.0);
  expect_relative(s.torsion_constant, (2 * b * tf * tf * tf + h * tw * tw * tw) / 3, 1e-12);
  expect_relative(s.warping_constant, b * b * b * h * h * tf * (3 * b * tf + 2 * h * tw) / (12 * (6 * b * tf + h * tw)),
                  1e-12);
}

/// I: J = Σ b t³/3, warping constant Iz h²/4 (the same sources), A_s along the web between h t and its area.
TEST(SectionWalls, DoublySymmetricI) {
  const double b = 0.1, h = 0.2, t = 0.005;
  const Section s = walls_section(
      {{{{-b / 2, 0}, {0, 0}, {b / 2, 0}}, t}, {{{0, 0}, {0, h}}, t}, {{{-b / 2, h}, {0, h}, {b / 2, h}}, t}});
  expect_relative(s.torsion_constant, (2 * b + h) * t * t * t / 3, 1e-12);
  expect_relative(s.warping_constant, b * b * b * t / 6 * h * h / 4, 1e-12);
  // I²/∫S²/t ds with S = b t h/2 + t (h²/4 − z²)/2 in the web and t h/2 x in the flanges, by hand:
  const double I = b * t * h * h / 2 + t * h * h * h / 12;
  const double web = t * h * (b * b * h * h / 4 + b * h * h * h / 12 + h * h * h * h / 120);
  const double flanges = 4 * t * h * h / 4 * b * b * b / 24;
  expect_relative(s.shear_area_z, I * I / (web + flanges), 1e-12);
  EXPECT_EQ(s.shear_coupling, 0.0);
}

/// Bredt: J = 4 A_m²/∮ds/t, plus the walls themselves. Two equal cells side by side: the wall between them is free of
/// flow. Cells b x h and 2b x h: solved by hand from 2 A_i = q_i ∮ds/t − q_j s_ij/t.
TEST(SectionWalls, Cells) {
  const double b = 0.1, h = 0.07, t = 0.002;
  const std::vector<WallLine> box{{{{0, 0}, {b, 0}, {b, h}, {0, h}, {0, 0}}, t}};
  const double own = 2 * (b + h) * t * t * t / 3;
  expect_relative(walls_section(box).torsion_constant, 4 * b * b * h * h * t / (2 * (b + h)) + own, 1e-12);

  std::vector<WallLine> two{{{{0, 0}, {b, 0}, {2 * b, 0}, {2 * b, h}, {b, h}, {0, h}, {0, 0}}, t}};
  const double single = walls_section(two).torsion_constant;
  two.push_back({{{b, 0}, {b, h}}, 3 * t});
  expect_relative(walls_section(two).torsion_constant, single + h * 27 * t * t * t / 3, 1e-12);

  const Section uneven =
      walls_section({{{{0, 0}, {b, 0}, {3 * b, 0}, {3 * b, h}, {b, h}, {0, h}, {0, 0}}, t}, {{{b, 0}, {b, h}}, t}});
  const double d1 = 2 * (b + h) / t, d2 = 2 * (2 * b + h) / t, d12 = h / t, A1 = b * h, A2 = 2 * b * h;
  const double determinant = d1 * d2 - d12 * d12;
  const double q1 = 2 * (A1 * d2 + A2 * d12) / determinant, q2 = 2 * (A2 * d1 + A1 * d12) / determinant;
  expect_relative(uneven.torsion_constant, 2 * (A1 * q1 + A2 * q2) + (6 * b + 3 * h) * t * t * t / 3, 1e-12);
}

/// Thin circular tube, closed and slit: shear area πRt, J = 2πR³t and 2πRt³/3, shear centre of the slit tube 2R from
/// the middle on the far side of the slit (Timoshenko and Goodier; Gere 6.9).
TEST(SectionWalls, Tubes) {
  const double R = 0.05, t = 0.001;
  Ring ring;
  constexpr int n = 120;
  for (int i = 0; i <= n; ++i)
    ring.emplace_back(R * std::cos(2 * std::numbers::pi * i / n), R * std::sin(2 * std::numbers::pi * i / n));
  ring.back() = ring.front();
  const Section tube = walls_section({{ring, t}});
  expect_relative(tube.torsion_constant, 2 * std::numbers::pi * R * R * R * t, 2e-3);  // chords: 1e-3
  expect_relative(tube.shear_area_y, std::numbers::pi * R * t, 2e-3);
  ring.front() = Eigen::Vector2d(R * std::cos(0.002), R * std::sin(0.002));
  ring.back() = Eigen::Vector2d(R * std::cos(0.002), -R * std::sin(0.002));
  const Section slit = walls_section({{ring, t}});
  expect_relative(slit.torsion_constant, 2 * std::numbers::pi * R * t * t * t / 3, 2e-3);
  expect_relative(slit.shear_center_y, -2 * R, 5e-3);
}

/// The boundary integral solution of the solid outline, with walls of 1/50: corners count by t/b.
TEST(SectionWalls, AgreesWithTheSolidOutline) {
  const double t = 0.02;
  const Section walls = walls_section({{{{-1, -1}, {0, -1}, {0, 1}, {1, 1}}, t}});
  const Section solid = profile_section("zed", {2 + t, 1 + t / 2, t, t});
  expect_relative(walls.second_moment_yz, solid.second_moment_yz, 0.01);
  expect_relative(walls.torsion_constant, solid.torsion_constant, 0.01);
  expect_relative(walls.shear_area_y, solid.shear_area_y, 0.02);
  expect_relative(walls.shear_area_z, solid.shear_area_z, 0.02);
  expect_relative(walls.shear_coupling, solid.shear_coupling, 0.04);
}

TEST(SectionWalls, DoNotDependOnHowTheyAreDivided) {
  const std::vector<WallLine> whole{{{{0.3, 0}, {0, 0}, {0, 0.2}, {0.1, 0.2}}, 0.01}, {{{0, 0}, {-0.1, -0.2}}, 0.02}};
  const std::vector<WallLine> parts{{{{0.1, 0.2}, {0, 0.2}, {0, 0.15}, {0, 0}}, 0.01},
                                    {{{0, 0}, {0.1, 0}, {0.25, 0}, {0.3, 0}}, 0.01},
                                    {{{-0.1, -0.2}, {-0.05, -0.1}, {0, 0}}, 0.02}};
  const Section a = walls_section(whole), b = walls_section(parts);
  for (const auto value : {&Section::area, &Section::second_moment_y, &Section::second_moment_yz,
                           &Section::torsion_constant, &Section::shear_area_y, &Section::shear_area_z,
                           &Section::shear_center_y, &Section::shear_center_z, &Section::warping_constant})
    expect_relative(a.*value, b.*value, 1e-10);
}

TEST(SectionWalls, FaultsAreNamed) {
  const auto fault = [](const std::vector<WallLine>& lines) { return walls_fault(lines).value_or("none"); };
  EXPECT_EQ(fault({{{{0, 0}, {1, 0}, {1, 1}}, 0.1}}), "none");
  EXPECT_EQ(fault({}), "there is no wall");
  EXPECT_EQ(fault({{{{0, 0}}, 0.1}}), "line 1 has fewer than two points");
  EXPECT_EQ(fault({{{{0, 0}, {1, 0}}, 0.0}}), "line 1: thickness 0 must be positive");
  EXPECT_EQ(fault({{{{0, 0}, {1, 0}, {2, 0}}, 0.1}}), "all walls lie on one straight line");
  EXPECT_EQ(fault({{{{0, 0}, {1, 0}, {1, 0}, {1, 1}}, 0.1}}), "a wall at (1, 0) has no length");
  EXPECT_EQ(fault({{{{0, 0}, {1, 0}}, 0.1}, {{{0, 1}, {1, 1}}, 0.1}}).find("the walls are not connected"), 0u);
}

}  // namespace
}  // namespace tisserand::formats::section_walls_test
