// SPDX-License-Identifier: GPL-3.0-or-later
// Matrix Market files, fmx files and the table of rows: all forms, errors, and the way out and back bit for bit.
#include "reducer/exchange/matrix_market.hpp"

#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reducer/exchange/fmx.hpp"
#include "reducer/exchange/rows_table.hpp"
#include "tests/reducer/exchange/exchange_files.hpp"

namespace tisserand::reducer::exchange::matrix_market_test {
namespace {

using testing::error_of;
using testing::Files;
using ::testing::HasSubstr;

const std::string rows = "row,node,component,x,y,z\n1,a,x,0,0,0\n2,7,rz,1,0.5,0\n3,,mode\n";
const std::string header = "%%MatrixMarket matrix ";
const std::string unit = header + "coordinate real symmetric\n3 3 3\n1 1 1\n2 2 1\n3 3 1\n";

ReducedMatrices read(const std::string& stiffness, const std::string& table) {
  const Files files;
  return read_matrix_market(
      {files.write("s.mtx", stiffness), files.write("m.mtx", unit), files.write("rows.csv", table)});
}

std::string error_in(const std::string& stiffness, const std::string& table) {
  return error_of([&] { static_cast<void>(read(stiffness, table)); });
}

TEST(MatrixMarket, AllForms) {
  const Eigen::Matrix3d expected = (Eigen::Matrix3d() << 4, -1, 0, -1, 5, 2, 0, 2, 6).finished();
  const std::vector<std::string> texts{
      "coordinate real symmetric\n% comment\n\n3 3 5\n1 1 4.0\n2 1 -1\n2 2 5e0\n3 2 2\n3 3 6\n",
      "coordinate integer general\n3 3 7\n1 1 4\n1 2 -1\n2 1 -1\n2 2 5\n2 3 2\n3 2 2\n3 3 6\n",
      "array real symmetric\n3 3\n4\n-1\n0\n5\n2\n6\n", "array double general\n3 3\n4 -1 0\n-1 5 2\n0 2 6\n"};
  for (const std::string& text : texts) {
    const ReducedMatrices m = read(header + text, rows);
    EXPECT_EQ(m.stiffness, expected) << text;
    EXPECT_EQ(m.rows, (std::vector<RowKey>{{1, 0}, {2, 5}, {3, scalar_component}}));
    EXPECT_EQ(m.places.at(1).name, "a");
    EXPECT_EQ(m.places.at(2).name, "n7");
    EXPECT_EQ(m.places.at(2).position, Eigen::Vector3d(1, 0.5, 0));
  }
}

TEST(MatrixMarket, Errors) {
  const std::string good = header + "coordinate real symmetric\n3 3 1\n1 1 4\n";
  EXPECT_THAT(error_in("3 3 1\n1 1 4\n", rows), HasSubstr("%%MatrixMarket"));
  EXPECT_THAT(error_in(header + "coordinate complex symmetric\n3 3 0\n", rows), HasSubstr("'complex'"));
  EXPECT_THAT(error_in(header + "coordinate pattern general\n3 3 0\n", rows), HasSubstr("'pattern'"));
  EXPECT_THAT(error_in(header + "coordinate real skew-symmetric\n3 3 0\n", rows), HasSubstr("'skew-symmetric'"));
  EXPECT_THAT(error_in(header + "coordinate real symmetric\n2 2 0\n", rows),
              HasSubstr("is 2 x 2, but the table names 3"));
  EXPECT_THAT(error_in(header + "coordinate real symmetric\n3 3 2\n1 1 4\n", rows), HasSubstr("ends after 1 of 2"));
  EXPECT_THAT(error_in(header + "coordinate real symmetric\n3 3 99999999999\n", rows),
              HasSubstr("the number of entries is 99999999999"));
  EXPECT_THAT(error_in(header + "coordinate real symmetric\n3 3 1\n4 1 4\n", rows), HasSubstr("row or column is 4"));
  EXPECT_THAT(error_in(header + "coordinate real symmetric\n3 3 2\n1 1 4\n1 1 4\n", rows), HasSubstr("given twice"));
  EXPECT_THAT(error_in(good + "2 2 1\n", rows), HasSubstr("more lines than the line of sizes announces"));
  EXPECT_THAT(error_in(header + "array real general\n3 3\n1 2 3 4\n", rows),
              HasSubstr("ends before row 2 of column 2"));
  EXPECT_THAT(error_in(header + "coordinate real symmetric\n3 3 1\n1 1 nan\n", rows), HasSubstr("s.mtx:3"));
  EXPECT_THAT(error_in(header + "coordinate real general\n3 3 1\n2 1 4\n", rows), HasSubstr("not symmetric"));
  EXPECT_THAT(error_in(good, ""), HasSubstr("has no rows"));
  EXPECT_THAT(error_in(good, "2,a,x,0,0,0\n"), HasSubstr("the number of the row is 2, expected 1"));
  EXPECT_THAT(error_in(good, "1,a,w,0,0,0\n"), HasSubstr("component 'w'"));
  EXPECT_THAT(error_in(good, "1,a,x,0,0\n"), HasSubstr("5 cells, expected 6"));
  EXPECT_THAT(error_in(good, "1,a b,x,0,0,0\n"), HasSubstr("'a b' is not a valid name of a node"));
  EXPECT_THAT(error_in(good, "1,a,x,0,0,0\n2,a,y,0,0,1\n"), HasSubstr("a different position in an earlier row"));
  EXPECT_THAT(error_in(good, "1,a,x,0,0,0\n2,a,1,0,0,0\n3,,mode\n"), HasSubstr("which is already an earlier row"));
}

/// Seventeen digits give every double back, and what is canonical is not touched.
TEST(MatrixMarket, ThereAndBackIsBitEqual) {
  const formats::Superelement beam = testing::reduced_beam();
  const Files files;
  const Imported back =
      to_superelement(read_matrix_market({files.write("b.S.mtx", matrix_market_text(beam.stiffness, "beam")),
                                          files.write("b.M.mtx", matrix_market_text(beam.mass, "beam")),
                                          files.write("b.rows.csv", rows_text(beam))}),
                      testing::options_named("beam"));
  EXPECT_EQ(back.element.content_id, beam.content_id);
  EXPECT_FALSE(back.certificate.filtered);
  EXPECT_TRUE(back.certificate.canonical);
}

TEST(Fmx, ThereAndBackIsBitEqual) {
  const formats::Superelement beam = testing::reduced_beam();
  const Files files;
  const Imported back =
      to_superelement(read_fmx({files.write("b_S.fmx", fmx_bytes(FmxKind::stiffness, 0, beam.stiffness)),
                                files.write("b_M.fmx", fmx_bytes(FmxKind::mass, 0, beam.mass)),
                                files.write("b.rows.csv", rows_text(beam))}),
                      testing::options_named("beam"));
  EXPECT_EQ(back.element.content_id, beam.content_id);
}

/// The layout byte for byte, as writeTagDB() and FFaTag_write() of openfedem make it: tag of 30 characters, 0x1234, two
/// 32-bit words 0 and checksum, ";1.0;\n", values.
TEST(Fmx, Layout) {
  const std::string bytes =
      fmx_bytes(FmxKind::gravity, 0x01020304u, (Eigen::Matrix<double, 2, 1>() << 1.5, -2).finished());
  ASSERT_EQ(bytes.size(), 30u + 2 + 8 + 6 + 16);
  EXPECT_EQ(bytes.substr(0, 30), "#FEDEM gravity force vectors  ");
  EXPECT_EQ(bytes.substr(30, 10), std::string("\x34\x12\0\0\0\0\x04\x03\x02\x01", 10));
  EXPECT_EQ(bytes.substr(40, 6), ";1.0;\n");
  double second = 0.0;
  std::memcpy(&second, bytes.data() + 54, sizeof second);
  EXPECT_EQ(second, -2.0);
}

TEST(Fmx, Errors) {
  const Files files;
  const std::string table = files.write("rows.csv", "1,a,x,0,0,0\n2,a,y,0,0,0\n");
  const std::string good = fmx_bytes(FmxKind::stiffness, 0, Eigen::Matrix2d::Identity());
  const std::string mass = files.write("m.fmx", fmx_bytes(FmxKind::mass, 0, Eigen::Matrix2d::Identity()));
  const auto error_in = [&](const std::string& bytes) {
    const std::string path = files.write("s.fmx", bytes);
    return error_of([&] { static_cast<void>(read_fmx({path, mass, table})); });
  };
  std::string swapped = good, version = good;
  std::swap(swapped[30], swapped[31]);
  version[41] = '7';
  EXPECT_EQ(error_in(good), "no error");
  EXPECT_THAT(error_in(swapped), HasSubstr("opposite byte order"));
  EXPECT_THAT(error_in(version), HasSubstr("does not have version 1.0"));
  EXPECT_THAT(error_in(good.substr(0, good.size() - 1)), HasSubstr("bytes, expected 78"));
  EXPECT_THAT(error_in(good.substr(0, 20)), HasSubstr("expected '#FEDEM stiffness matrix'"));
  EXPECT_THAT(error_of([&] {
                static_cast<void>(read_fmx({mass, mass, table}));
              }),
              HasSubstr("begins with '#FEDEM mass"));
}

}  // namespace
}  // namespace tisserand::reducer::exchange::matrix_market_test
