// SPDX-License-Identifier: GPL-3.0-or-later
// Matrix text of Abaqus and CalculiX: user elements, node-component lists, stored matrices, positions, errors.
#include "reducer/exchange/abaqus_matrix.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reducer/exchange/calculix_matrix.hpp"
#include "reducer/exchange/places.hpp"
#include "tests/reducer/exchange/exchange_files.hpp"

namespace tisserand::reducer::exchange::abaqus_matrix_test {
namespace {

using testing::error_of;
using testing::Files;
using ::testing::HasSubstr;

/// Element text of *ELEMENT or *SUBSTRUCTURE MATRIX OUTPUT, OUTPUT FILE=USER DEFINED: its nodes are in a comment.
const std::string element_text =
    "**\n** ELEMENT NUMBER 11 STEP NUMBER 2 INCREMENT NUMBER 1\n*USER ELEMENT, NODES=       2, LINEAR\n"
    "** ELEMENT NODES\n** 101, 103\n1, 2\n2, 1\n";
const std::string stiffness_block = "*MATRIX,TYPE=STIFFNESS\n 4.0 ,\n 1.D0, 5.0\n -2.0, -3.0, 6.0\n";
const std::string mass_block = "*MATRIX,TYPE=MASS\n 1.0,\n 0.0, 2.0\n 0.5, 0.0, 3.0,\n";

TEST(AbaqusMatrix, LinearUserElement) {
  const Files files;
  const ReducedMatrices m =
      read_abaqus_matrices({files.write("sub.mtx", element_text + stiffness_block + mass_block), ""}, {});
  EXPECT_EQ(m.rows, (std::vector<RowKey>{{101, 0}, {101, 1}, {103, 0}}));
  EXPECT_EQ(m.stiffness, (Eigen::Matrix3d() << 4, 1, -2, 1, 5, -3, -2, -3, 6).finished());
  EXPECT_EQ(m.mass, (Eigen::Matrix3d() << 1, 0, 0.5, 0, 2, 0, 0.5, 0, 3).finished());
}

TEST(AbaqusMatrix, NodesFromElementAndMassFromASecondFile) {
  const Files files;
  const std::string head = "*NODE\n7, 1., 2.\n8, 0., 0., 3.\n*USER ELEMENT, NODES=2, LINEAR, TYPE=U1\n1, 2\n2, 1\n";
  const std::string element = "*ELEMENT, TYPE=U1\n900, 7, 8\n";
  const ReducedMatrices m = read_abaqus_matrices(
      {files.write("k.inp", head + stiffness_block + element), files.write("m.inp", head + mass_block + element)}, {});
  EXPECT_EQ(m.rows, (std::vector<RowKey>{{7, 0}, {7, 1}, {8, 0}}));
  EXPECT_EQ(m.mass(0, 2), 0.5);
  EXPECT_EQ(m.places.at(7).position, Eigen::Vector3d(1, 2, 0));
}

TEST(AbaqusMatrix, UnsymmetricStorageOfSymmetricMatrices) {
  const Files files;
  const std::string text =
      "*USER ELEMENT, NODES=1, LINEAR, UNSYMM\n** ELEMENT NODES\n** 4\n1, 3\n*MATRIX,TYPE=STIFFNESS\n1., 2.\n2., 3.\n"
      "*MATRIX,TYPE=MASS\n1., 0., 0., 1.\n";
  const ReducedMatrices m = read_abaqus_matrices({files.write("u.mtx", text), ""}, {});
  EXPECT_EQ(m.rows, (std::vector<RowKey>{{4, 0}, {4, 2}}));
  EXPECT_EQ(m.stiffness, (Eigen::Matrix2d() << 1, 2, 2, 3).finished());
}

/// FORMAT=MATRIX INPUT: row node, component, column node, component, entry (Abaqus Keywords, *MATRIX INPUT).
TEST(AbaqusMatrix, ListOfNodesAndComponents) {
  const Files files;
  const std::string K =
      files.write("job_STIF1.mtx", "1,1, 1,1,  3.000000000000000e+05\n2,3, 1,1, -1.0e+05\n2,3 2,3 4e5\n");
  const std::string M =
      files.write("job_MASS1.mtx", "** mass\n*MATRIX INPUT, NAME=M\n1,1, 1,1, 2.0\n2,3, 2,3, 1.0\n-1,1,-1,1,1.0\n");
  const ReducedMatrices m = read_abaqus_matrices({K, M}, {});
  EXPECT_EQ(m.rows, (std::vector<RowKey>{{1, 0}, {2, 2}, {-1, 0}}));
  EXPECT_EQ(m.stiffness, (Eigen::Matrix3d() << 3e5, -1e5, 0, -1e5, 4e5, 0, 0, 0, 0).finished());
  EXPECT_TRUE(is_internal(m, m.rows[2]));
}

TEST(AbaqusMatrix, BothTrianglesMayBeGivenIfTheyAgree) {
  const Files files;
  const std::string M = files.write("m.mtx", "1,1,1,1,1.\n1,2,1,2,1.\n");
  const std::string good = files.write("k.mtx", "1,1,1,1,2.\n1,2,1,1,-1.\n1,1,1,2,-1.\n1,2,1,2,2.\n");
  EXPECT_EQ(read_abaqus_matrices({good, M}, {}).stiffness, (Eigen::Matrix2d() << 2, -1, -1, 2).finished());
  const std::string bad = files.write("b.mtx", "1,1,1,1,2.\n1,2,1,1,-1.\n1,1,1,2,-1.1\n1,2,1,2,2.\n");
  EXPECT_THAT(error_of([&] { static_cast<void>(read_abaqus_matrices({bad, M}, {})); }), HasSubstr("not symmetric"));
}

TEST(AbaqusMatrix, Errors) {
  const Files files;
  const auto error_in = [&](const std::string& text, const std::string& mass) {
    const std::string path = files.write("k.mtx", text);
    const std::string second = mass.empty() ? "" : files.write("m.mtx", mass);
    return error_of([&] { static_cast<void>(read_abaqus_matrices({path, second}, {})); });
  };
  const std::string head = "*USER ELEMENT, NODES=2, LINEAR\n** ELEMENT NODES\n** 1, 2\n";
  EXPECT_THAT(error_in(element_text + stiffness_block, ""), HasSubstr("no *MATRIX, TYPE=MASS"));
  EXPECT_THAT(error_in(element_text + mass_block, ""), HasSubstr("no *MATRIX, TYPE=STIFFNESS"));
  EXPECT_THAT(error_in(head + "1, 2\n" + stiffness_block + mass_block, ""), HasSubstr("6 numbers, expected 10"));
  EXPECT_THAT(error_in(head + "1\n" + stiffness_block + mass_block, ""), HasSubstr("more numbers than the 3"));
  EXPECT_THAT(error_in(head + "1, 8\n" + stiffness_block, ""), HasSubstr("component 8 of node 1"));
  EXPECT_THAT(error_in(head + "1\n5, 1\n" + stiffness_block, ""), HasSubstr("position 5"));
  EXPECT_THAT(error_in("*USER ELEMENT, NODES=3, LINEAR\n** ELEMENT NODES\n** 1, 2\n1\n", ""),
              HasSubstr("NODES=3, but 2 node numbers"));
  EXPECT_THAT(error_in("*USER ELEMENT, NODES=99999999, LINEAR\n1\n", ""), HasSubstr("expected 1 to 4000"));
  EXPECT_THAT(error_in(element_text + "*MATRIX,TYPE=STIFFNESS\n1., x\n", ""), HasSubstr("k.mtx:9"));
  EXPECT_THAT(error_in("1,1,1,1,1.\n", ""), HasSubstr("--mass"));
  EXPECT_THAT(error_in("1 1 1.0\n", "1,1,1,1,1.\n"), HasSubstr("FORMAT=COORDINATE"));
  EXPECT_THAT(error_in("1,1,1,1\n", "1,1,1,1,1.\n"), HasSubstr("has 4 fields"));
  EXPECT_THAT(error_in("1,1,1,1,inf\n", "1,1,1,1,1.\n"), HasSubstr("not a finite number"));
  EXPECT_THAT(error_in("1,11,1,11,1.\n", "1,1,1,1,1.\n"), HasSubstr("component 11"));
}

/// job.sti, job.mas: "row column value" of one triangle; job.dof: "node.direction" (ccx/src/matrixstorage.c of
/// CalculiX).
TEST(CalculixMatrix, StoredMatrices) {
  const Files files;
  const std::string sti =
      files.write("job.sti", "1 1  2.0000000000000e+00\n1 2 -1.0000000000000e+00\n2 2  3.0000000000000e+00\n");
  files.write("job.mas", "1 1  1.0e+00\n2 2  5.0e-01\n");
  files.write("job.dof", "12.1\n7.3\n");
  const ReducedMatrices m = read_calculix_matrices(sti, {});
  EXPECT_EQ(m.rows, (std::vector<RowKey>{{12, 0}, {7, 2}}));
  EXPECT_EQ(m.stiffness, (Eigen::Matrix2d() << 2, -1, -1, 3).finished());
  EXPECT_EQ(m.mass, (Eigen::Matrix2d() << 1, 0, 0, 0.5).finished());
}

TEST(CalculixMatrix, Errors) {
  const Files files;
  const auto error_in = [&](const std::string& sti, const std::string& mas, const std::string& dof) {
    files.write("a.mas", mas);
    files.write("a.dof", dof);
    const std::string path = files.write("a.sti", sti);
    return error_of([&] { static_cast<void>(read_calculix_matrices(path, {})); });
  };
  EXPECT_THAT(error_in("3 1 1.\n", "1 1 1.\n", "1.1\n1.2\n"),
              HasSubstr("an entry in row 3, but the .dof file names 2"));
  EXPECT_THAT(error_in("1 1\n", "1 1 1.\n", "1.1\n"), HasSubstr("has 2 fields"));
  EXPECT_THAT(error_in("1 1 1.\n", "1 1 1.\n", "1\n"), HasSubstr("expected node.direction"));
  EXPECT_THAT(error_in("1 1 1.\n", "1 1 1.\n", "1.0\n"), HasSubstr("direction 0"));
  EXPECT_THAT(error_in("1 1 1.\n", "1 1 1.\n", "1.1\n1.1\n"), HasSubstr("which is already an earlier row"));
  EXPECT_THAT(error_in("1 1 1.\n", "1 1 1.\n", ""), HasSubstr("an entry in row 1, but the .dof file names 0 rows"));
  EXPECT_THAT(error_of([&] { static_cast<void>(read_calculix_matrices(files.file("a.mas"), {})); }),
              HasSubstr("does not end in .sti"));
}

TEST(Places, DecksAndTables) {
  const Files files;
  const auto at = [&](const std::string& text) { return read_places(files.write("p", text)).at(5).position; };
  const Eigen::Vector3d expected(1, 2.5, -3);
  EXPECT_EQ(at("number,x,y,z\n# comment\n5, 1, 2.5, -3\n6, 0, 0, 0\n"), expected);
  EXPECT_EQ(at("5 1 2.5 -3 tip\n"), expected);
  EXPECT_EQ(at("*HEADING\nx\n*NODE, NSET=all\n5, 1., 2.5, -3.\n6, 0.\n"), expected);
  EXPECT_EQ(at("BEGIN BULK\nGRID,5,,1.,2.5,-3.\n"), expected);
  EXPECT_EQ(read_places(files.write("n", "5,1,2,3,tip\n")).at(5).name, "tip");
  const auto error_in = [&](const std::string& text) { return error_of([&] { static_cast<void>(at(text)); }); };
  EXPECT_THAT(error_in("5,1,2\n"), HasSubstr("p:1: has 3 fields"));
  EXPECT_THAT(error_in("5,1,2,3\n5,1,2,3\n"), HasSubstr("has a second position"));
  EXPECT_THAT(error_in("5,1,2,x\n"), HasSubstr("'x', not a finite number"));
  EXPECT_THAT(error_in(""), HasSubstr("holds no positions"));
  EXPECT_THAT(error_in("*NODE, SYSTEM=C\n5,1.,2.,3.\n"), HasSubstr("SYSTEM=C"));
  EXPECT_THAT(error_in("*NODE\n5,1.,2.,3.\n*INSTANCE, NAME=a, PART=b\n"), HasSubstr("*INSTANCE"));
}

}  // namespace
}  // namespace tisserand::reducer::exchange::abaqus_matrix_test
