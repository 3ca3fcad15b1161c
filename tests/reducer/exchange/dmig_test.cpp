// SPDX-License-Identifier: GPL-3.0-or-later
// DMIG cards: every field form, what the header may say, coordinate systems, scalar points, errors, the way out and
// back.
#include "reducer/exchange/dmig.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "reducer/decks/nastran/fields.hpp"
#include "tests/reducer/exchange/exchange_files.hpp"

namespace tisserand::reducer::exchange::dmig_test {
namespace {

using testing::distance;
using testing::error_of;
using testing::Files;
using ::testing::HasSubstr;

const std::string grids = "GRID    1               0.0     0.0     0.0\nGRID    2               2.0     0.0     0.0\n";

ReducedMatrices read(const std::string& text) {
  const Files files;
  return read_dmig({files.write("part.pch", text), "", "KAAX", "MAAX"});
}

std::string error_in(const std::string& text) {
  return error_of([&] { static_cast<void>(read(text)); });
}

/// Two translations along x joined by a spring of 3e5, masses 1.5 and 2: small, large and free field.
TEST(Dmig, FieldForms) {
  const std::string mass = "DMIG,MAAX,0,6,2,0\nDMIG,MAAX,1,1,,1,1,1.5D0\nDMIG,MAAX,2,1,,2,1,2.0\n";
  const std::string small =
      "DMIG    KAAX    0       6       1       0\n"
      "DMIG    KAAX    1       1               1       1       3.+5\n"
      "        2       1       -3.0E5\n"
      "DMIG    KAAX    2       1               2       1       300000.\n";
  const std::string large =
      "DMIG    KAAX           0       6       2       0                        \n"
      "DMIG*   KAAX                           1               1\n"
      "*                      1               1 3.000000000D+05\n"
      "*                      2               1-3.000000000D+05\n"
      "DMIG*   KAAX                           2               1\n"
      "*                      2               1 3.000000000D+05\n";
  const std::string free = "DMIG,KAAX,0,6,2\nDMIG,KAAX,1,1,,1,1,3.0+5,,\n,2,1,-3.+5\nDMIG,KAAX,2,1,,2,1,3e5\n";
  for (const std::string& stiffness : {small, large, free}) {
    const ReducedMatrices m = read("$ comment\n" + grids + stiffness + mass);
    ASSERT_EQ(m.rows, (std::vector<RowKey>{{1, 0}, {2, 0}})) << stiffness;
    EXPECT_EQ(m.stiffness, (Eigen::Matrix2d() << 3e5, -3e5, -3e5, 3e5).finished()) << stiffness;
    EXPECT_EQ(m.mass, (Eigen::Matrix2d() << 1.5, 0, 0, 2).finished());
    EXPECT_EQ(m.places.at(2).position, Eigen::Vector3d(2, 0, 0));
  }
}

TEST(Dmig, SquareFormGivesBothTriangles) {
  const ReducedMatrices m = read(grids +
                                 "DMIG,KAAX,0,1,2\nDMIG,KAAX,1,1,,1,1,4.\n,2,1,-3.\nDMIG,KAAX,2,1,,1,1,-3.\n,2,1,5.\n"
                                 "DMIG,MAAX,0,1,2\nDMIG,MAAX,1,1,,1,1,1.\nDMIG,MAAX,2,1,,2,1,1.\n");
  EXPECT_EQ(m.stiffness, (Eigen::Matrix2d() << 4, -3, -3, 5).finished());
  EXPECT_EQ(m.stiffness_asymmetry, 0.0);
}

TEST(Dmig, ScalarPointsComeLastWhateverTheirNumber) {
  const std::string matrices =
      "DMIG,KAAX,0,6,2\nDMIG,KAAX,1,0,,1,0,7.\nDMIG,KAAX,5,1,,5,1,3.\n"
      "DMIG,MAAX,0,6,2\nDMIG,MAAX,1,0,,1,0,1.\n,5,1,0.5\nDMIG,MAAX,5,1,,5,1,2.\n";
  for (const std::string points : {"SPOINT,1\n", "EPOINT  1       THRU    1\n", ""}) {
    const ReducedMatrices m = read("GRID,5,,1.,2.,3.\n" + points + matrices);
    ASSERT_EQ(m.rows, (std::vector<RowKey>{{5, 0}, {1, scalar_component}})) << points;
    EXPECT_EQ(m.stiffness, (Eigen::Matrix2d() << 3, 0, 0, 7).finished());
    EXPECT_EQ(m.mass, (Eigen::Matrix2d() << 2, 0.5, 0.5, 1).finished());
  }
}

TEST(Dmig, GridsMayStandInASecondFile) {
  const Files files;
  const std::string punch =
      files.write("a.pch", "DMIG,KAAX,0,6,2\nDMIG,KAAX,2,3,,2,3,3.\nDMIG,MAAX,0,6,2\nDMIG,MAAX,2,3,,2,3,1.\n");
  const ReducedMatrices m = read_dmig({punch, files.write("model.bdf", grids), "kaax", "maax"});
  EXPECT_EQ(m.rows, (std::vector<RowKey>{{2, 2}}));
  EXPECT_EQ(m.places.at(2).position.x(), 2.0);
}

/// The cards of an external superelement as MSC Nastran punches them (EXTSEOUT): GRID* with CD = 10, CORD2R*, EXTRN and
/// SPOINT, as in pyyeti/tests/nas2cam_extseout/inboard.pch of twmacro/pyyeti (BSD-3-Clause); here in few words.
TEST(Dmig, PunchOfAnExternalSuperelement) {
  const ReducedMatrices m = read(
      "$ THE FOLLOWING BULK DATA ENTRIES RELATED TO EXT. SUPERELEMENT      102\nBEGIN SUPER      102\n"
      "CORD2R*               10               0 0.000000000E+00 0.000000000E+00\n"
      "*        0.000000000E+00 0.100000000E+01 0.000000000E+00 0.000000000E+00\n"
      "*        0.000000000E+00 0.100000000E+01 0.000000000E+00\n"
      "EXTRN         11  123456 2995001       0\n"
      "GRID*                 11               0 0.600000000E+03 0.300000000E+03\n"
      "*        0.300000000E+03              10               0               0\n"
      "ASET          11  123456\nASET     2995001       0\n"
      "SPOINT   2995001\n"
      "DMIG    KAAX           0       6       2       0                       \n"
      "DMIG*   KAAX                          11               1\n"
      "*                     11               1 3.000000000D+00\n"
      "DMIG*   KAAX                     2995001               0\n"
      "*                2995001               0 9.000000000D+00\n"
      "DMIG    MAAX           0       6       2       0                       \n"
      "DMIG*   MAAX                          11               1\n"
      "*                     11               1 1.000000000D+00\n");
  EXPECT_EQ(m.rows, (std::vector<RowKey>{{11, 0}, {2995001, scalar_component}}));
  EXPECT_EQ(m.places.at(11).position, Eigen::Vector3d(600, 300, 300));
  // z along x of the part, x along its y: the system of the punch.
  EXPECT_TRUE(m.places.at(11).axes.col(2).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(m.places.at(11).axes.col(0).isApprox(Eigen::Vector3d::UnitY()));
}

TEST(Dmig, Errors) {
  const std::string mass = "DMIG,MAAX,0,6,2\nDMIG,MAAX,1,1,,1,1,1.\n";
  const auto stiffness = [](const std::string& header, const std::string& column) {
    return "DMIG,KAAX," + header + "\nDMIG,KAAX," + column + "\n";
  };
  const std::vector<std::pair<std::string, std::string>> cases{
      {grids + mass, "no DMIG matrix KAAX, only MAAX"},
      {grids + stiffness("0,2,2", "1,1,,1,1,1.") + mass, "IFO is 2"},
      {grids + stiffness("0,6,4", "1,1,,1,1,1.") + mass, "TIN is 4"},
      {grids + stiffness("0,6,2", "1,1,,1,1,1.,2.") + mass, "imaginary"},
      {grids + stiffness("0,6,2", "1,7,,1,1,1.") + mass, "component 7"},
      {grids + stiffness("0,6,2", "1,0,,1,1,1.") + mass, "component 0 of GRID 1"},
      {grids + "SPOINT,9\n" + stiffness("0,6,2", "8,0,,8,0,1.") + mass, "point 8 with component 0 is not an SPOINT"},
      {grids + "SPOINT,9\n" + stiffness("0,6,2", "9,2,,9,2,1.") + mass, "component 2 of scalar point 9"},
      {grids + "SPOINT,2\n" + stiffness("0,6,2", "1,1,,1,1,1.") + mass, "point 2 is both a GRID and a scalar point"},
      {grids + stiffness("0,6,2", "1,1,,1,1,nan") + mass, "nan"},
      {grids + stiffness("0,6,2", "1,1,,1,1,1.,,\n,1,1,2.") + mass, "given twice"},
      {grids + "DMIG,KAAX,1,1,,1,1,1.\n" + mass, "before its header"},
      {grids + stiffness("0,6,2", "1,1,,1,1,1.") + "DMIG,KAAX,0,6,2\n" + mass, "has a second header"},
      {grids + "DMIG,KAAX,0,6,2\n" + mass, "KAAX has no entries"},
      {grids + stiffness("0,1,2", "1,1,,1,1,4.,,\n,2,1,-3.") + mass, "not symmetric"},
  };
  for (const auto& [text, expected] : cases) EXPECT_THAT(error_in(text), HasSubstr(expected)) << text;
  EXPECT_THAT(error_in(grids + stiffness("0,2,2", "1,1,,1,1,1.") + mass), HasSubstr("part.pch:3"));
}

/// A wrong value is told once, with the number of cards that have it besides.
TEST(Dmig, OneFaultForOneWrongValue) {
  const std::string mass = "DMIG,MAAX,0,6,2\nDMIG,MAAX,1,1,,1,1,1.\n";
  const std::string columns = "DMIG,KAAX,1,1,,1,1,1.\nDMIG,KAAX,1,2,,1,2,1.\nDMIG,KAAX,1,3,,1,3,1.\n";
  const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n') + 1; };
  const std::string header = error_in(grids + "DMIG,KAAX,0,2,2\n" + columns + mass);
  EXPECT_THAT(header, HasSubstr("IFO is 2"));
  EXPECT_EQ(lines(header), 1) << header;
  const std::string without = error_in(grids + columns + mass);
  EXPECT_THAT(without,
              HasSubstr("part.pch:3: DMIG KAAX: this column of KAAX comes before its header (and 2 more cards)"));
  EXPECT_EQ(lines(without), 1) << without;
  const std::string unknown =
      error_in(grids + "SPOINT,9\nDMIG,KAAX,0,6,2\nDMIG,KAAX,1,1,,8,0,1.\nDMIG,KAAX,1,2,,8,0,1.\n" + mass);
  EXPECT_THAT(unknown, HasSubstr("point 8 with component 0 is not an SPOINT or EPOINT (and 1 more cards)"));
  EXPECT_EQ(lines(unknown), 1) << unknown;
  EXPECT_THAT(error_in(grids + mass), HasSubstr("--matrices K,M"));
}

/// A text of this program that lost a line is still a legal one: the count of terms in a comment tells.
TEST(Dmig, LostLinesAreFoundByTheCount) {
  const std::string text = dmig_text(testing::reduced_beam());
  EXPECT_EQ(error_in(text), "no error");
  const std::size_t matrix = text.find("DMIG    MAAX"), line = text.find("\n*", matrix) + 1;
  ASSERT_NE(matrix, std::string::npos);
  std::string cut = text;
  cut.erase(line, text.find('\n', line) + 1 - line);
  EXPECT_THAT(error_in(cut), HasSubstr("terms, but the comment before it says"));
  const std::size_t comment = cut.find("$ MAAX below has ");
  cut.erase(comment, cut.find('\n', comment) + 1 - comment);
  EXPECT_EQ(error_in(cut), "no error");
}

/// A beam whose tip has axes turned by 30 degrees about y: the import turns it back.
TEST(Dmig, ComponentsAreTurnedFromTheAxesOfTheNode) {
  const formats::Superelement beam = test_support::beam_superelement({});
  const double a = M_PI / 6;
  const Eigen::Matrix3d axes = Eigen::AngleAxisd(a, Eigen::Vector3d::UnitY()).toRotationMatrix();
  Eigen::MatrixXd T = Eigen::MatrixXd::Identity(12, 12);
  T.block<3, 3>(6, 6) = T.block<3, 3>(9, 9) = axes;
  formats::Superelement turned = beam;
  turned.stiffness = T.transpose() * beam.stiffness * T;
  turned.mass = T.transpose() * beam.mass * T;
  std::string text = dmig_text(turned);
  const std::size_t grid = text.find("GRID*   " + std::string(15, ' ') + "2");
  ASSERT_NE(grid, std::string::npos);
  const Eigen::Vector3d z = axes.col(2), x = axes.col(0);
  text.replace(grid, text.find("SPOINT", grid) == std::string::npos ? text.find("ASET1", grid) - grid : 0, "");
  text = fmt::format("CORD2R,7,0,0.,0.,0.,{},{},{},\n,{},{},{}\nGRID,2,,2.,0.,0.,7\n", z.x(), z.y(), z.z(), x.x(),
                     x.y(), x.z()) +
         text;
  const Files files;
  const Imported imported =
      to_superelement(read_dmig({files.write("turned.pch", text), "", "KAAX", "MAAX"}), testing::options_named("t"));
  // Ten digits, 5e-10, of the larger inertia (bending, 0.24) beside the smaller one (torsion, 1.8e-4) that it mixes
  // with.
  EXPECT_LT(distance(beam.stiffness, imported.element.stiffness), 1e-6);
  EXPECT_LT(distance(beam.mass, imported.element.mass), 1e-6);
}

/// Sixteen characters hold at least ten digits: relative error at most 5e-10.
TEST(Dmig, ThereAndBackKeepsTheDigitsOfTheFormat) {
  const formats::Superelement beam = testing::reduced_beam();
  const Files files;
  const Imported back = to_superelement(read_dmig({files.write("b.pch", dmig_text(beam)), "", "KAAX", "MAAX"}),
                                        testing::options_named("beam"));
  EXPECT_EQ(back.element.dof_component, beam.dof_component);
  EXPECT_EQ(back.element.dof_node, beam.dof_node);
  EXPECT_EQ(back.element.node_position, beam.node_position);
  EXPECT_EQ(back.element.node_name, (std::vector<std::string>{"n1", "n2"}));
  EXPECT_TRUE(back.certificate.canonical);
  EXPECT_LT(distance(beam.stiffness, back.element.stiffness), 1e-9);
  EXPECT_LT(distance(beam.mass, back.element.mass), 1e-9);
  EXPECT_LT(back.report.rigid_residual, 1e-12);
}

TEST(Dmig, RealFieldFillsSixteenCharacters) {
  EXPECT_EQ(real_field(0.0, 'D'), "0.0D0");
  EXPECT_EQ(real_field(-2.0, 'E'), "-2.0E0");
  for (const double value : {M_PI, -M_PI, 1e-9 / 3, -1e22 / 7, -1e-123 / 3, 4.9e-324}) {
    const std::string field = real_field(value, 'E');
    EXPECT_LE(field.size(), 16u) << field;
    EXPECT_NEAR(parse_real(field).value() / value, 1.0, 5e-10) << field;
  }
  // Without its letter where that leaves room for one more digit; Nastran reads 1.5-10 as 1.5e-10.
  EXPECT_EQ(real_field(-1e-9 / 3, 'D'), "-3.3333333333-10");
  EXPECT_EQ(real_field(1e-9 / 3, 'D'), "3.33333333333-10");
  EXPECT_EQ(real_field(-1.5e-10, 'D'), "-1.5D-10");
  EXPECT_EQ(real_field(M_PI, 'D'), "3.14159265359D0");
}

}  // namespace
}  // namespace tisserand::reducer::exchange::dmig_test
