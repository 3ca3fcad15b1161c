// SPDX-License-Identifier: GPL-3.0-or-later
// Units that a user asks for: what is converted, by which factor, and what is refused.
#include "mechanism/histories/shown_units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/thrown.hpp"

namespace tisserand::mechanism::shown_units_test {
namespace {

using test_support::error_of;

using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Series one(const std::string& channel, const std::string& unit, double value) {
  Series series;
  series.channel = channel;
  series.unit = unit;
  series.x_unit = "s";
  series.x = {0.5};
  series.y = {value};
  return series;
}

double shown(const std::string& unit, double value, const std::string& as) {
  std::vector<Series> series{one("a", unit, value)};
  show_in(parse_shown_units({as}), series);
  EXPECT_EQ(series[0].unit, as);
  return series[0].y[0];
}

// Factors are definitions: SI prefixes, 1 in = 25.4 mm, 1 lb = 0.45359237 kg, g = 9.80665 m/s^2.
TEST(ShownUnits, AreExactFactors) {
  EXPECT_DOUBLE_EQ(shown("m", 0.25, "mm"), 250.0);
  EXPECT_DOUBLE_EQ(shown("Pa", 3.94e8, "MPa"), 394.0);
  EXPECT_DOUBLE_EQ(shown("rad", std::numbers::pi, "deg"), 180.0);
  EXPECT_DOUBLE_EQ(shown("rad s^-1", std::numbers::pi, "rpm"), 30.0);
  EXPECT_DOUBLE_EQ(shown("m s^-1", 10.0, "km/h"), 36.0);
  EXPECT_DOUBLE_EQ(shown("m s^-2", 2.0, "mm/s^2"), 2000.0);
  EXPECT_DOUBLE_EQ(shown("N m", 1.5, "N mm"), 1500.0);
  EXPECT_DOUBLE_EQ(shown("t mm s^-2", 1.0, "N"), 1.0);
  EXPECT_DOUBLE_EQ(shown("in", 2.0, "mm"), 50.8);
  EXPECT_DOUBLE_EQ(shown("N", 0.45359237 * 9.80665, "lbf"), 1.0);
  EXPECT_DOUBLE_EQ(shown("1", 0.07, "%"), 7.0);
}

TEST(ShownUnits, ChangeTimeAndLeaveOtherQuantitiesAlone) {
  std::vector<Series> series{one("nodes/position/a/x", "m", 2.0), one("energy/total", "J", 3.0)};
  show_in(parse_shown_units({"mm,ms"}), series);
  EXPECT_THAT(series[0].y, ElementsAre(DoubleEq(2000.0)));
  EXPECT_THAT(series[0].x, ElementsAre(DoubleEq(500.0)));
  EXPECT_EQ(series[1].x_unit, "ms");
  EXPECT_EQ(series[1].unit, "J");
  EXPECT_THAT(series[1].y, ElementsAre(3.0));
}

// A moment and an energy have the same powers of length, mass and time; so have a frequency and a rate.
TEST(ShownUnits, EnergiesAreNoMomentsAndFrequenciesNoRates) {
  std::vector<Series> series{one("joints/moment/a/x", "N m", 2.0), one("energy/total", "J", 3.0)};
  show_in(parse_shown_units({"kJ"}), series);
  EXPECT_THAT(series[0].y, ElementsAre(2.0));
  EXPECT_THAT(series[1].y, ElementsAre(DoubleEq(0.003)));
  std::vector<Series> rate{one("modes/eigenvalue/real", "s^-1", 2.0)};
  EXPECT_THAT(error_of([&] { show_in(parse_shown_units({"kHz"}), rate); }),
              HasSubstr("no quantity in the plot can be shown in kHz, a unit of frequency"));
}

TEST(ShownUnits, AReferenceWithoutUnitsIsInThoseOfTheRun) {
  std::vector<Series> series{one("nodes/position/a/x", "m", 2.0), one("x", "", 1.0)};
  series[1].kind = SeriesKind::reference;
  series[1].x_unit = "";
  show_in(parse_shown_units({"length=mm", "time=ms"}), series);
  EXPECT_THAT(series[1].y, ElementsAre(DoubleEq(1000.0)));
  EXPECT_THAT(series[1].x, ElementsAre(DoubleEq(500.0)));
  EXPECT_EQ(series[1].unit, "mm");
}

TEST(ShownUnits, FaultsNameTheRemedy) {
  const auto fault = [](const std::string& text) { return error_of([&] { (void)parse_shown_units({text}); }); };
  EXPECT_THAT(fault("furlong"), HasSubstr("unknown unit 'furlong'"));
  EXPECT_THAT(fault(""), HasSubstr("unknown unit ''"));
  EXPECT_THAT(fault("mm,"), HasSubstr("unknown unit ''"));
  EXPECT_THAT(fault("m/s/s"), HasSubstr("unknown unit"));
  EXPECT_THAT(fault("m^999999999999"), HasSubstr("unknown unit"));
  EXPECT_THAT(fault("length=MPa"), HasSubstr("MPa is not a unit of length; it is a unit of stress"));
  EXPECT_THAT(fault("size=mm"), HasSubstr("unknown quantity 'size'"));
  EXPECT_THAT(fault("mm,in"), HasSubstr("mm and in are units of the same quantity"));
  std::vector<Series> unnamed{one("nodes/position/a/x", "", 2.0)};
  unnamed[0].x_unit = "";
  EXPECT_THAT(error_of([&] { show_in(parse_shown_units({"mm"}), unnamed); }), HasSubstr("runs without named units"));
}

}  // namespace
}  // namespace tisserand::mechanism::shown_units_test
