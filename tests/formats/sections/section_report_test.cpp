// SPDX-License-Identifier: GPL-3.0-or-later
// The table of section constants: principal moments against [Pil02], and what it says.
#include "formats/sections/report.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/sections/profiles.hpp"
#include "formats/sections/shapes.hpp"

namespace tisserand::formats::section_report_test {
namespace {

/// [Pil02] example B.3 (page 441): I1 = 77.66369, I2 = 16.48228, axis turned by 28.84407°.
TEST(SectionReport, PrincipalMomentsOfPilkeysAngle) {
  const PrincipalMoments p = principal_moments(profile_section("angle", {8.0, 6.0, 0.75, 0.75}));
  EXPECT_NEAR(p.larger, 77.66369, 1e-5);
  EXPECT_NEAR(p.smaller, 16.48228, 1e-5);
  EXPECT_NEAR(p.angle * 180.0 / M_PI, 28.84407, 1e-5);
}

TEST(SectionReport, TellsEveryConstantWithItsUnit) {
  Section tall = rectangle_section(1.0, 2.0);
  tall.name = "tall";
  Section angle = profile_section("angle", {8.0, 6.0, 0.75, 0.75});
  angle.name = "corner";
  const std::string text = section_report({tall, angle}, {length_unit("m"), mass_unit("kg"), time_unit("s")});
  EXPECT_THAT(text, ::testing::HasSubstr("section 'tall' (rectangle)\n"));
  EXPECT_THAT(text, ::testing::HasSubstr("  second moment, bends in x-z        Iy          0.666667 m^4\n"));
  EXPECT_THAT(text, ::testing::HasSubstr("\n\nsection 'corner' (angle)\n"));
  EXPECT_THAT(text, ::testing::HasSubstr("28.8441 deg"));
  EXPECT_THAT(text, ::testing::HasSubstr("shear coupling of y and z, times A"));
  EXPECT_EQ(text.find("warping"), std::string::npos);
}

}  // namespace
}  // namespace tisserand::formats::section_report_test
