// SPDX-License-Identifier: GPL-3.0-or-later
// Units: factors by label, conversions between named units, labels of products, and unnamed units that never mix.
#include "common/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"

namespace tisserand::units_test {
namespace {

TEST(Units, FactorsByLabel) {
  EXPECT_EQ(length_unit("mm").factor, 1e-3);
  EXPECT_EQ(length_unit("in").factor, 0.0254);
  EXPECT_EQ(mass_unit("t").factor, 1e3);
  EXPECT_EQ(time_unit("ms").factor, 1e-3);
  // 14.593903 kg: NIST special publication 811, table B.9.
  EXPECT_NEAR(mass_unit("slug").factor, 14.593903, 1e-6);
  EXPECT_EQ(mass_unit("lb").label, "lb");
}

TEST(Units, UnknownLabelListsTheKnownOnes) {
  try {
    static_cast<void>(length_unit("yard"));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(),
                ::testing::AllOf(::testing::HasSubstr("'yard'"), ::testing::HasSubstr("m, mm, cm, km, in, ft")));
  }
}

TEST(Units, MillimetreTonneSecondToSiKeepsTheNewton) {
  const Units mm_t_s{length_unit("mm"), mass_unit("t"), time_unit("s")};
  const UnitConversion c = convert_units(mm_t_s, Units::si(), "x");
  EXPECT_EQ(c.length, 1e-3);
  EXPECT_EQ(c.mass, 1e3);
  EXPECT_EQ(c.time, 1.0);
  EXPECT_EQ(c.force(), 1.0);  // 1 t mm/s² = 1 N
  const UnitConversion back = convert_units(Units::si(), mm_t_s, "x");
  EXPECT_DOUBLE_EQ(back.length * c.length, 1.0);
}

TEST(Units, UnnamedMixOnlyWithUnnamed) {
  EXPECT_EQ(convert_units(Units::consistent(), Units::consistent(), "x").force(), 1.0);
  for (const auto& [from, to] :
       {std::pair{Units::si(), Units::consistent()}, std::pair{Units::consistent(), Units::si()}}) {
    try {
      static_cast<void>(convert_units(from, to, "beam.superelement.h5"));
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr("beam.superelement.h5"),
                                                 ::testing::HasSubstr("name the units in both")));
    }
  }
}

TEST(Units, LabelsOfProducts) {
  const Units mm{length_unit("mm"), mass_unit("t"), time_unit("s")};
  EXPECT_EQ(unit_label(Units::si(), 1, 1, -2), "N");
  EXPECT_EQ(unit_label(Units::si(), 2, 1, -2), "N m");
  EXPECT_EQ(unit_label(Units::si(), 1, 0, -1), "m s^-1");
  EXPECT_EQ(unit_label(mm, 1, 1, -2), "N");
  EXPECT_EQ(unit_label(mm, 2, 1, -2), "N mm");
  EXPECT_EQ(energy_label(mm), "mJ");
  EXPECT_EQ(unit_label(mm, 2, 1, -3), "mW");
  EXPECT_EQ(unit_label({length_unit("mm"), mass_unit("kg"), time_unit("s")}, 1, 1, -2), "kg mm s^-2");
  EXPECT_EQ(unit_label(Units::si(), -1, 1, -2), "Pa");
  EXPECT_EQ(unit_label(mm, -1, 1, -2), "MPa");
  EXPECT_EQ(unit_label(mm, 0, 0, 0), "");
  EXPECT_EQ(unit_label(Units::consistent(), 1, 1, -2), "");
}

TEST(Units, LabelsInMessages) {
  EXPECT_EQ(after_time(Units::si()), " s");
  EXPECT_EQ(after_time(Units::consistent()), "");
  EXPECT_EQ(turn_rate_label({length_unit("m"), mass_unit("kg"), time_unit("ms")}), "rad/ms");
  EXPECT_EQ(turn_rate_label(Units::consistent()), "rad per unit of time");
}

}  // namespace
}  // namespace tisserand::units_test
