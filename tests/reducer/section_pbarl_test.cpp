// SPDX-License-Identifier: GPL-3.0-or-later
// Sections of PBARL: areas and moments by hand, orientation in the element's axes, faults.
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/error.hpp"
#include "reducer/properties/pbarl.hpp"

namespace tisserand::reducer::section_pbarl_test {
namespace {

using formats::Section;

Section section(const std::string& type, const std::vector<double>& sizes) {
  return pbarl_section(type, sizes, "deck.bdf:3");
}

/// Area, I1 = ∫y² (y up in the figures) and I2 = ∫z² (z to the right), by rectangles on paper; 0: not worked out.
struct ByHand {
  std::vector<double> sizes;
  double area, I1, I2;
};

double cube(double x) { return x * x * x; }

TEST(Pbarl, AreasAndMoments) {
  const std::map<std::string, ByHand> cases{
      {"ROD", {{2}, 4 * M_PI, 4 * M_PI, 4 * M_PI}},
      {"TUBE", {{2, 1}, 3 * M_PI, 15 * M_PI / 4, 15 * M_PI / 4}},
      {"TUBE2", {{2, 1}, 3 * M_PI, 15 * M_PI / 4, 15 * M_PI / 4}},
      {"BAR", {{2, 3}, 6, 2 * 27.0 / 12, 3 * 8.0 / 12}},
      {"BOX", {{4, 6, 0.5, 0.25}, 24 - 3.5 * 5, (4 * 216 - 3.5 * 125) / 12, (6 * 64 - 5 * cube(3.5)) / 12}},
      {"BOX1", {{4, 6, 0.5, 0.5, 0.25, 0.25}, 24 - 3.5 * 5, (4 * 216 - 3.5 * 125) / 12, (6 * 64 - 5 * cube(3.5)) / 12}},
      {"I", {{6, 4, 4, 0.5, 1, 1}, 10, (4 * 216 - 3.5 * 64) / 12, (2 * 64 + 4 * 0.125) / 12}},
      {"I1", {{3.5, 0.5, 4, 6}, 10, (4 * 216 - 3.5 * 64) / 12, (2 * 64 + 4 * 0.125) / 12}},
      {"H", {{4, 2, 4, 0.5}, 10, (2 * 64 + 4 * 0.125) / 12, (4 * 216 - 3.5 * 64) / 12}},
      {"CHAN",
       {{4, 6, 0.5, 1},
        10,
        (4 * 216 - 3.5 * 64) / 12,
        8 * 4.0 / 3 + 8 * 4 + 2.0 * 0.25 / 12 + 2 * 0.0625 - 10 * 1.65 * 1.65}},
      {"CHAN1",
       {{3.5, 0.5, 4, 6},
        10,
        (4 * 216 - 3.5 * 64) / 12,
        8 * 4.0 / 3 + 8 * 4 + 2.0 * 0.25 / 12 + 2 * 0.0625 - 10 * 1.65 * 1.65}},
      {"CHAN2",
       {{1, 0.5, 4, 6},
        10,
        8 * 4.0 / 3 + 8 * 4 + 2.0 * 0.25 / 12 + 2 * 0.0625 - 10 * 1.65 * 1.65,
        (4 * 216 - 3.5 * 64) / 12}},
      {"T",
       {{4, 5, 1, 0.5},
        6,
        (4 * 1 + 0.5 * 64) / 12 + 4 * 20.25 + 2 * 4 - 6 * std::pow(22.0 / 6, 2),
        (64 + 4 * 0.125) / 12}},
      {"T2",
       {{4, 5, 1, 0.5},
        6,
        (4 * 1 + 0.5 * 64) / 12 + 4 * 20.25 + 2 * 4 - 6 * std::pow(22.0 / 6, 2),
        (64 + 4 * 0.125) / 12}},
      {"T1",
       {{4, 4, 1, 0.5},
        6,
        (64 + 4 * 0.125) / 12,
        (4 * 1 + 0.5 * 64) / 12 + 4 * 20.25 + 2 * 4 - 6 * std::pow(22.0 / 6, 2)}},
      {"CROSS", {{3, 1, 6, 0.5}, 7.5, (216 + 3 * 0.125) / 12, (0.5 * 64 + 5.5) / 12}},
      {"HEXA", {{1, 4, 3}, 9, 2 * 27.0 / 12 + 27.0 / 24, 3 * 8.0 / 12 + 3.0 / 18 + 3 * 16.0 / 9}},
      {"Z", {{2, 1, 4, 6}, 10, (216 + 2 * 2) / 12.0 + 4 * 6.25, (4 * 1 + 2 * 27) / 12.0 + 6}},
      {"HAT", {{3, 0.5, 4, 1}, 5.5, 0, 0}},
      {"L", {{4, 5, 1, 0.5}, 6, (4 * 1 + 0.5 * 64) / 12 + 4 * 20.25 + 2 * 4 - 6 * std::pow(22.0 / 6, 2), 0}},
      {"DBOX", {{8, 3, 3, .5, .5, .5, .25, .25, .25, .25}, 24 - 2.5 * (2.25 + 4.25), 0, 0}}};
  for (const auto& [type, c] : cases) {
    SCOPED_TRACE(type);
    const Section s = section(type, c.sizes);
    EXPECT_EQ(static_cast<int>(c.sizes.size()), pbarl_sizes(type));
    EXPECT_NEAR(s.area, c.area, 1e-12 * c.area);
    if (c.I1 > 0.0) {
      EXPECT_NEAR(s.second_moment_z, c.I1, 1e-10 * c.I1);
    }
    if (c.I2 > 0.0) {
      EXPECT_NEAR(s.second_moment_y, c.I2, 1e-10 * c.I2);
    }
    EXPECT_GT(s.torsion_constant, 0.0);
    EXPECT_LE(s.torsion_constant, s.polar_moment * (1.0 + 1e-12));
    EXPECT_GT(s.shear_area_y, 0.0);
    EXPECT_LT(s.shear_area_y, s.area);
  }
}

/// The figures look along the element with yelem up and zelem to the right.
TEST(Pbarl, Orientation) {
  EXPECT_LT(section("CHAN", {4, 6, 0.5, 1}).shear_center_z, -1.65);  // beyond the web at the left
  EXPECT_LT(section("CHAN1", {3.5, 0.5, 4, 6}).shear_center_z, -1.65);
  EXPECT_LT(section("CHAN2", {1, 0.5, 4, 6}).shear_center_y, -1.65);  // web at the bottom
  EXPECT_GT(section("T", {4, 5, 1, 0.5}).shear_center_y, 0.0);
  EXPECT_LT(section("T2", {4, 5, 1, 0.5}).shear_center_y, 0.0);
  EXPECT_GT(section("T1", {4, 4, 1, 0.5}).shear_center_z, 0.0);
  EXPECT_GT(section("HAT", {3, 0.5, 4, 1}).shear_center_y, 0.0);
  EXPECT_LT(section("L", {4, 5, 1, 0.5}).second_moment_yz, 0.0);  // corner at the lower left
  EXPECT_LT(section("Z", {2, 1, 4, 6}).second_moment_yz, 0.0);    // upper flange to the left
  // BOX1: DIM6 is the left wall; the shear centre moves to the thicker one.
  EXPECT_LT(section("BOX1", {4, 6, 0.5, 0.5, 0.25, 0.75}).shear_center_z, 0.0);
  EXPECT_GT(section("I", {6, 2, 4, 0.5, 1, 1}).shear_center_y, 0.0);  // DIM3 is the upper flange
}

TEST(Pbarl, AxesOfBarsAndBeams) {
  const Section s = section("CHAN", {4, 6, 0.5, 1});
  const Section bar = on_bar_axis(s), beam = on_shear_axis(s);
  EXPECT_EQ(bar.shear_center_z, 0.0);
  EXPECT_EQ(bar.centroid_z, 0.0);
  EXPECT_EQ(bar.second_moment_y, s.second_moment_y);
  EXPECT_DOUBLE_EQ(beam.centroid_z, -s.shear_center_z);
  EXPECT_DOUBLE_EQ(beam.centroid_z + beam.shear_center_z, 0.0);
}

std::string error_of(const std::string& type, const std::vector<double>& sizes) {
  try {
    section(type, sizes);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Pbarl, FaultsAreNamed) {
  EXPECT_EQ(error_of("L", {4, 5, 6, 0.5}),
            "deck.bdf:3: section type L: flange 6 is not less than height 5; DIM1 = 4, DIM2 = 5, DIM3 = 6, DIM4 = 0.5; "
            "correct the sizes; their order is that of the figures for PBARL in the manual of Nastran");
  EXPECT_EQ(error_of("ELL", {1}).find("deck.bdf:3: section type 'ELL' is not known; known are BAR, BOX"), 0u);
  EXPECT_NE(error_of("BAR", {1}).find("1 sizes instead of 2"), std::string::npos);
  EXPECT_NE(error_of("BAR", {1, std::numeric_limits<double>::quiet_NaN()}).find("DIM2 nan must be positive"), std::string::npos);
  EXPECT_NE(error_of("TUBE", {1, 2}).find("the wall is not inside the radius"), std::string::npos);
  EXPECT_NE(error_of("HEXA", {2, 4, 1}).find("DIM2 must exceed 2 DIM1"), std::string::npos);
  EXPECT_NE(error_of("Z", {2, 1, 6, 6}).find("DIM4 must exceed DIM3"), std::string::npos);
  EXPECT_NE(error_of("I1", {1, 1, 6, 6}).find("must be positive"), std::string::npos);
  EXPECT_EQ(pbarl_sizes("BEAM"), 0);
  EXPECT_DOUBLE_EQ(section("TUBE", {2, 0}).torsion_constant, 8 * M_PI);
}

}  // namespace
}  // namespace tisserand::reducer::section_pbarl_test
