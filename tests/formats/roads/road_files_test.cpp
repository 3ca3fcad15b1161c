// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of heights and OpenCRG files: what they say, and every way in which they can be wrong.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/roads/crg.hpp"
#include "formats/roads/height_grid_file.hpp"
#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::road_files_test {
namespace {

using ::testing::HasSubstr;

const std::string with_axes = "# measured\nx\\y, -1, 0.5, 2\n0, 0.1, 0.2, 0.3\n2.5, +1, -2e-1, 3\n";

RoadHeights grid(const std::string& text, const std::optional<RegularGrid>& regular = {}) {
  const Folder folder;
  return read_height_grid(folder.file("road.csv", text), regular);
}

std::string grid_error(const std::string& text, const std::optional<RegularGrid>& regular = {}) {
  const Folder folder;
  const std::string path = folder.file("road.csv", text);
  return error_of(folder, [&] { (void)read_height_grid(path, regular); });
}

TEST(HeightGridFile, HasItsAxesInTheFirstLineAndColumn) {
  for (const char separator : {',', ';', '\t', ' '}) {
    std::string text = replaced_all(with_axes, ", ", std::string(1, separator));
    const RoadHeights road = grid(text);
    EXPECT_EQ(road.along, (std::vector<double>{0.0, 2.5}));
    EXPECT_EQ(road.across, (std::vector<double>{-1.0, 0.5, 2.0}));
    EXPECT_EQ(road.height, (HeightTable(2, 3) << 0.1, 0.2, 0.3, 1.0, -0.2, 3.0).finished());
    EXPECT_EQ(road.line.cols(), 0);
  }
  EXPECT_EQ(grid(replaced(with_axes, "x\\y", "")).across.size(), 3u);
}

TEST(HeightGridFile, HoldsHeightsAloneOnARegularGrid) {
  const RoadHeights road = grid("1, 2, 3\n4, 5, 6\r\n", RegularGrid{10.0, -1.0, 0.25});
  EXPECT_EQ(road.along, (std::vector<double>{10.0, 10.25}));
  EXPECT_EQ(road.across, (std::vector<double>{-1.0, -0.75, -0.5}));
  EXPECT_EQ(road.height(1, 2), 6.0);
}

TEST(HeightGridFile, TellsHolesWithLineAndColumn) {
  EXPECT_EQ(grid_error(replaced(with_axes, "0.2", "nan")),
            "road.csv:3: 'nan' in column 3 is not a finite number; give a height at each point of the grid");
  EXPECT_THAT(grid_error(replaced(with_axes, "0.2", "")), HasSubstr("road.csv:3: '' in column 3 is not a finite"));
  EXPECT_THAT(grid_error(replaced(with_axes, "0.2", "inf")), HasSubstr("'inf' in column 3"));
  EXPECT_THAT(grid_error(replaced(with_axes, ", 0.3", "")), HasSubstr("road.csv:3: the line has 3 cells instead of 4"));
  EXPECT_THAT(grid_error(replaced(with_axes, "0.3\n", "0.3, 4\n")), HasSubstr("the line has 5 cells instead of 4"));
  EXPECT_THAT(grid_error(replaced(with_axes, "0.3\n", "0.3\n\n")),
              HasSubstr("road.csv:4: the line is empty, but lines of heights follow"));
  EXPECT_THAT(grid_error(replaced(with_axes, "2.5, ", "-2.5, ")),
              HasSubstr("road.csv:4: x must increase, but -2.5 follows 0"));
  EXPECT_THAT(grid_error(replaced(with_axes, "0.5", "-5")),
              HasSubstr("road.csv:2: y must increase, but -5 follows -1"));
  EXPECT_THAT(grid_error("0, -1, 1\n0, 0, 0\n1, 0, 0\n"),
              HasSubstr("the line begins with the number 0 instead of a word"));
  EXPECT_THAT(grid_error("x, 1\n1, 2\n2, 3\n"), HasSubstr("the line gives fewer than two values of y"));
  EXPECT_THAT(grid_error("x, 1, 2\n1, 2, 3\n"), HasSubstr("the grid has 1 x 2 heights"));
  EXPECT_THAT(grid_error(""), HasSubstr("the grid has 0 x 0 heights"));
  EXPECT_THAT(grid_error("1, 2\n3\n", RegularGrid{0, 0, 1}),
              HasSubstr("road.csv:2: the line has 1 cells instead of 2"));
  EXPECT_THAT(grid_error("1, 2\n3, x\n", RegularGrid{0, 0, 1}), HasSubstr("'x' in column 2"));
}

// ---- OpenCRG ----------------------------------------------------------------------------------------------------

/// Written for these tests: heights 1 to 9 at u = 0, 2, 4 and v = -1, 0, 1.
const std::string straight = R"($CT              ! text
three by three, with = and $ in it
$!*****
$ROAD_CRG
REFERENCE_LINE_START_U = 0.0   ! comment
reference_line_increment = 2.0
LONG_SECTION_V_RIGHT = -1.0
LONG_SECTION_V_LEFT = 1.0
LONG_SECTION_V_INCREMENT = 1.0
* comment = 3
$
$KD_DEFINITION
#:LRFI
U:reference line u,m,0,2.0
D:long section 1,m
D:long section 2,m   ! the middle
D:long section 3,m
$
* between sections
$$$$$$$$10$$$$$$$$20
 1.0000000 2.0000000 3.0000000
 4.0000000 5.0000000 6.0000000
 7.0000000 8.0000000-9.0000000
)";

/// Heading, slope, banking and sections in another order; rows of two records.
const std::string curved = R"($CT
$
$ROAD_CRG
REFERENCE_LINE_INCREMENT = 1.0
REFERENCE_LINE_START_X = 10.0
REFERENCE_LINE_START_Y = -5.0
REFERENCE_LINE_START_Z = 2.0
$
$KD_DEFINITION
#:LDFI
D:long section at v = 2.000,m
D:long section at v = -1.000,m
D:reference line phi,rad
D:reference line slope,m/m
D:reference line banking,m/m
$
$$$$
          0.00000000          1.00000000          **unused**          **unused**
          0.02000000
        1.00000D-001           *missing*          0.00000000          0.10000000
          0.03000000
          2.00000000          3.00000000          1.57079632          0.20000000
         -0.04000000
)";

RoadHeights crg(const std::string& text) {
  const Folder folder;
  return read_crg(folder.file("road.crg", text));
}

std::string crg_error(const std::string& from, const std::string& to, const std::string& of = straight) {
  const Folder folder;
  const std::string path = folder.file("road.crg", replaced(of, from, to));
  return error_of(folder, [&] { (void)read_crg(path); });
}

TEST(Crg, ReadsAStraightRoad) {
  for (const std::string& text : {straight, replaced_all(straight, "\n", "\r\n")}) {
    const RoadHeights road = crg(text);
    EXPECT_EQ(road.along, (std::vector<double>{0.0, 2.0, 4.0}));
    EXPECT_EQ(road.across, (std::vector<double>{-1.0, 0.0, 1.0}));
    EXPECT_EQ(road.height, (HeightTable(3, 3) << 1, 2, 3, 4, 5, 6, 7, 8, -9).finished());
    ASSERT_EQ(road.line.cols(), 2);
    EXPECT_EQ(road.line.col(0), Eigen::Vector2d(0.0, 0.0));
    EXPECT_EQ(road.line.col(1), Eigen::Vector2d(4.0, 0.0));
    EXPECT_EQ(fault_of(road), "");
  }
}

// The rules of the format, by hand: points by steps of the increment along the headings (the first belongs to no step),
// heights of the line by the slopes, z = grid + line + banking v.
TEST(Crg, ReadsCurvedSlopedAndBankedRoads) {
  const RoadHeights road = crg(curved);
  EXPECT_EQ(road.across, (std::vector<double>{-1.0, 2.0}));
  ASSERT_EQ(road.line.cols(), 3);
  EXPECT_LT((road.line.col(1) - Eigen::Vector2d(11.0, -5.0)).norm(), 1e-15);
  EXPECT_LT((road.line.col(2) - Eigen::Vector2d(11.0, -4.0)).norm(), 1e-8);
  EXPECT_NEAR(road.height(0, 0), 1.0 + 2.0 - 0.02, 1e-15);
  EXPECT_NEAR(road.height(0, 1), 0.0 + 2.0 + 0.04, 1e-15);
  EXPECT_TRUE(std::isnan(road.height(1, 0)));
  EXPECT_NEAR(road.height(1, 1), 0.1 + 2.1 + 0.06, 1e-15);
  EXPECT_NEAR(road.height(2, 0), 3.0 + 2.3 + 0.04, 1e-15);
  EXPECT_NEAR(road.height(2, 1), 2.0 + 2.3 - 0.08, 1e-15);
}

// An end that the parameters give takes the error of the integral in proportion to the distance.
TEST(Crg, ClosesAtTheEndThatTheParametersGive) {
  const RoadHeights road = crg(replaced(
      curved, "START_Z = 2.0",
      "START_Z = 2.0\nREFERENCE_LINE_END_X = 11.001\nREFERENCE_LINE_END_Y = -4.0\nreference_line_end_z = 2.301"));
  EXPECT_LT((road.line.col(2) - Eigen::Vector2d(11.001, -4.0)).norm(), 1e-12);
  EXPECT_LT((road.line.col(1) - Eigen::Vector2d(11.0005, -5.0)).norm(), 1e-8);
  EXPECT_NEAR(road.height(2, 0), 3.0 + 2.301 + 0.04, 1e-12);
  EXPECT_NEAR(road.height(1, 1), 0.1 + 2.1005 + 0.06, 1e-12);
}

TEST(Crg, TakesConstantsFromItsParameters) {
  const std::string more =
      "$ROAD_CRG\nREFERENCE_LINE_START_S = 0.1\nREFERENCE_LINE_END_S = 0.1\nREFERENCE_LINE_START_B = -0.2\n"
      "REFERENCE_LINE_START_PHI = 3.14159265358979\n";
  const RoadHeights road = crg(replaced(straight, "$ROAD_CRG\n", more));
  EXPECT_NEAR(road.height(2, 0), 7.0 + 0.4 + 0.2, 1e-14);
  EXPECT_NEAR(road.line(0, 1), -4.0, 1e-12);
  const RoadHeights centred = crg(replaced(replaced(straight, "LONG_SECTION_V_RIGHT = -1.0\n", ""), "U:", "* U:"));
  EXPECT_EQ(centred.across, (std::vector<double>{-1.0, 0.0, 1.0}));
}

// Options and modifiers that change nothing here are read over.
TEST(Crg, AllowsSettingsThatChangeNothing) {
  const std::string text =
      replaced(straight, "$KD_DEFINITION",
               "$ROAD_CRG_OPTS\n border_mode_u = 2\nwarn_msgs = -1\nREFLINE_SEARCH_FAR = 1.5\n$\n$ROAD_CRG_MODS\n"
               "scale_z_grid = 1\ngrid_nan_mode = 2.000e+00\nrefpoint_x = 0\n$\n$ROAD_CRG_MPRO\nGELL_NM = "
               "'WGS84'\n$\n$KD_DEFINITION");
  EXPECT_EQ(crg(text).height(0, 0), 1.0);
}

TEST(Crg, TellsWhatItDoesNotReadWithItsLine) {
  EXPECT_EQ(
      crg_error("#:LRFI", "#:KRBI"),
      "road.crg:13: the data are binary (KRBI); convert the file to the text format #:LRFI or #:LDFI, for example with "
      "crg_write of the OpenCRG tools");
  EXPECT_THAT(crg_error("#:LRFI", "#:XXXX"), HasSubstr("road.crg:13: the data format 'XXXX' is not known"));
  EXPECT_THAT(crg_error("$ROAD_CRG\n", "$ROAD_CRG_FILE\n"),
              HasSubstr("refers to another file, which is not supported"));
  EXPECT_THAT(crg_error("$ROAD_CRG\n", "$ROAD_CRX\n"), HasSubstr("road.crg:4: the section $road_crx is not known"));
  EXPECT_THAT(crg_error("LONG_SECTION_V_INCREMENT", "LONG_SECTION_V_INCREMEND"),
              HasSubstr("road.crg:9: the keyword 'long_section_v_incremend' is not known in $road_crg; did you mean "
                        "'long_section_v_increment'?"));
  const std::string mods = "$ROAD_CRG_MODS\n#\n$\n$KD_DEFINITION";
  EXPECT_THAT(crg_error("$KD_DEFINITION", replaced(mods, "#", "SCALE_Z_GRID = 2")),
              HasSubstr("road.crg:13: scale_z_grid = 2 is not supported"));
  EXPECT_THAT(crg_error("$KD_DEFINITION", replaced(mods, "#", "grid_nan_mode = 1")), HasSubstr("grid_nan_mode = 1"));
  EXPECT_THAT(crg_error("$KD_DEFINITION", "$ROAD_CRG_OPTS\nborder_mode_v = 3\n$\n$KD_DEFINITION"),
              HasSubstr("border_mode_v = 3 is not supported"));
  EXPECT_THAT(crg_error("START_Z = 2.0\n$", "START_Z = 2.0\n$\n$ROAD_CRG_MODS\nREFPOINT_X = 0\n$", curved),
              HasSubstr("road.crg:10: the modifiers refpoint_... would move the start"));
  EXPECT_THAT(crg_error("D:long section 2,m", "D:reference line x,m"),
              HasSubstr("road.crg:16: the column 'reference line x' is not known"));
  EXPECT_THAT(crg_error("D:reference line phi,rad", "D:reference line phi,deg", curved),
              HasSubstr("has the unit 'deg' instead of rad"));
}

TEST(Crg, TellsContradictions) {
  EXPECT_THAT(crg_error("u,m,0,2.0", "u,m,0,1.0"), HasSubstr("road.crg:14: the line U: gives 1, but the parameters"));
  EXPECT_THAT(crg_error("increment = 2.0", "increment = -2.0", replaced(straight, "U:", "* U:")),
              HasSubstr("REFERENCE_LINE_INCREMENT -2 must be greater than 1e-6 m"));
  EXPECT_THAT(crg_error("V_LEFT = 1.0", "V_LEFT = 1.5"), HasSubstr("road.crg:8: long_section_v_left = 1.5"));
  EXPECT_THAT(crg_error("$ROAD_CRG\n", "$ROAD_CRG\nREFERENCE_LINE_END_U = 6.0\n"),
              HasSubstr("road.crg:5: reference_line_end_u = 6, but 3 rows of data end at u = 4"));
  EXPECT_THAT(crg_error("section 2", "section 5"), HasSubstr("long section 5 is given where 2 is expected"));
  EXPECT_THAT(crg_error("section 2", "section at v = 0.0"),
              HasSubstr("some long sections are given by number, others by position"));
  EXPECT_THAT(crg_error("at v = 2.000", "at v = -1.000", curved), HasSubstr("two long sections are at v = -1"));
  EXPECT_THAT(crg_error("$ROAD_CRG\n", "$ROAD_CRG\nREFERENCE_LINE_END_X = 4.5\nREFERENCE_LINE_END_Y = 0\n"),
              HasSubstr("the end computed from the heading is 0.5 m away"));
  EXPECT_THAT(crg_error("$ROAD_CRG\n", "$ROAD_CRG\nREFERENCE_LINE_END_X = 4\n"), HasSubstr("only one of"));
  EXPECT_THAT(crg_error("$ROAD_CRG\n", "$ROAD_CRG\nREFERENCE_LINE_END_B = 0.1\n"),
              HasSubstr("reference_line_end_b = 0.1 differs from reference_line_start_b = 0"));
  EXPECT_THAT(crg_error("START_U", "INCREMENT"), HasSubstr("is given twice"));
}

TEST(Crg, TellsDamageWithItsLine) {
  EXPECT_THAT(crg_error(" 5.0000000", " 5.0x00000"), HasSubstr("road.crg:22:11: '5.0x00000' is not a finite number"));
  EXPECT_THAT(crg_error(" 6.0000000", ""), HasSubstr("road.crg:22:21: '' is not a finite number"));
  EXPECT_THAT(crg_error(" 4.0000000 5", "\n 4.0000000 5"),
              HasSubstr("road.crg:22: the line is empty, but data follow"));
  EXPECT_THAT(crg_error(" 4.0000000 5.0000000 6.0000000\n 7.0000000 8.0000000-9.0000000\n", ""),
              HasSubstr("the number of rows of data is 1"));
  EXPECT_THAT(crg_error("         -0.04000000\n", "", curved),
              HasSubstr("the file ends inside a row: it has 4 of 5 columns"));
  EXPECT_THAT(crg_error("1.57079632", "*bad*     ", curved), HasSubstr("the reference line phi is missing"));
  EXPECT_THAT(crg_error("0.03000000", "*bad*     ", curved), HasSubstr("the reference line banking is missing"));
  EXPECT_THAT(crg_error("-9.0000000\n", "-9.0000000" + std::string(60, '1') + "\n"),
              HasSubstr("the line has 90 characters"));
  EXPECT_THAT(crg_error("$CT", "$CT", straight.substr(0, straight.find("$$$$"))),
              HasSubstr("no line begins with $$$$"));
  EXPECT_THAT(crg_error("D:long section 1,m\nD:long section 2,m   ! the middle\n", ""),
              HasSubstr("the number of long sections (columns of heights) is 1"));
  EXPECT_THAT(crg_error("$ROAD_CRG\n", "x = 3\n$ROAD_CRG\n"),
              HasSubstr("road.crg:4: the line is outside all sections"));
  EXPECT_THAT(crg_error("* comment = 3\n$", "* comment = 3"),
              HasSubstr("section $kd_definition begins inside section $road_crg"));
  EXPECT_THAT(crg_error("increment = 2.0", "increment = two"), HasSubstr("'two' is not a finite number"));
  EXPECT_THAT(crg_error("increment = 2.0", "increment"),
              HasSubstr("reference_line_increment has no value; write reference_line_increment = <number>"));
}

TEST(Crg, HasAHeightAtLeast) {
  const std::string head = straight.substr(0, straight.find(" 1.0000000")), row = " *missing* *missing*       nan\n";
  EXPECT_THAT(crg_error("$CT", "$CT", head + row + row), HasSubstr("all heights are missing"));
  EXPECT_EQ(crg(head + row + " *missing* 3.0000000**nothing*\n").height(1, 1), 3.0);
}

// Numbers that are finite but beyond all roads, and axes that hardly ascend, would overflow later.
TEST(RoadHeights, HaveFaultsThatAreReported) {
  const RoadHeights good = crg(straight);
  const auto fault = [&good](auto change) {
    RoadHeights road = good;
    change(road);
    return fault_of(road);
  };
  EXPECT_THAT(fault([](RoadHeights& r) {
                r.along = {0.0, 1.0, 1.0};
              }),
              HasSubstr("they must increase by more than 1e-09"));
  EXPECT_THAT(fault([](RoadHeights& r) {
                r.along = {1e9, 1e9 + 0.5, 1e9 + 2.0};
              }),
              HasSubstr("they must increase by more than 1e-09"));
  EXPECT_THAT(fault([](RoadHeights& r) { r.across.pop_back(); }), HasSubstr("3 x 3 heights for 3 x 2 positions"));
  EXPECT_THAT(fault([](RoadHeights& r) { r.across = {0.0}; }), HasSubstr("has 1 positions across the road"));
  EXPECT_THAT(fault([](RoadHeights& r) { r.height(1, 1) = 1e300; }), HasSubstr("a height of 1e+300"));
  EXPECT_THAT(fault([](RoadHeights& r) { r.height.setConstant(std::nan("")); }), HasSubstr("has no heights"));
  EXPECT_THAT(fault([](RoadHeights& r) { r.line(0, 1) = std::numeric_limits<double>::infinity(); }),
              HasSubstr("a reference line that reaches inf"));
}

}  // namespace
}  // namespace tisserand::formats::road_files_test
