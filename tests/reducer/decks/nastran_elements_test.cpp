// SPDX-License-Identifier: GPL-3.0-or-later
// Nastran decks: bars, rods, shells, solids, springs and masses in the mesh, against values by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/LU>

#include "reducer/elements/beam/beam.hpp"
#include "reducer/elements/element_matrices.hpp"
#include "tests/reducer/decks/nastran_deck.hpp"

namespace tisserand::testing::nastran_elements_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using namespace reducer;

const std::string steel = "MAT1,7,2.1+11,,.3,7800.\n";
const std::string rod_section = "PBAR,5,7,.02,3.-4,4.-4,5.-4\n";
/// System 9: x along basic y, y along basic z, z along basic x.
const std::string turned = "CORD2R,9,,0.,0.,0.,1.,0.,0.\n,0.,1.,0.\n";

Matrix3d columns(const Vector3d& x, const Vector3d& y, const Vector3d& z) {
  Matrix3d m;
  m << x, y, z;
  return m;
}

void expect_near(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  EXPECT_LT((a - b).norm(), 1e-12 * (1.0 + b.norm())) << a << "\ninstead of\n" << b;
}

BeamElement bar(const std::string& grids, const std::string& card) {
  return read_deck(grids + card + rod_section + steel).mesh.beams.at(0);
}

TEST(NastranBeams, OrientationByVectorAndByGridPoint) {
  const std::string grids = "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\n";
  const Matrix3d y_along_z = columns(Vector3d::UnitX(), Vector3d::UnitZ(), -Vector3d::UnitY());
  expect_near(bar(grids, "CBAR,11,5,1,2,3.,0.,1.\n").R_PE, y_along_z);
  expect_near(bar(grids + "GRID,3,,1.,0.,7.\n", "CBAR,11,5,1,2,3\n").R_PE, y_along_z);
  expect_near(bar(grids, "CBEAM,11,5,1,2,3.,0.,1.\n").R_PE, y_along_z);
  expect_near(bar(grids, "BAROR,,5,,,0.,0.,1.\nCBAR,11,,1,2\n").R_PE, y_along_z);
}

TEST(NastranBeams, OrientationStandsInTheFrameOfTheFirstEnd) {
  const std::string grids = turned + "GRID,1,,0.,0.,0.,9\nGRID,2,,2.,0.,0.\n";
  expect_near(bar(grids, "CBAR,11,5,1,2,0.,1.,0.\n").R_PE.col(1), Vector3d::UnitZ());  // y of system 9
  expect_near(bar(grids, "CBAR,11,5,1,2,0.,1.,0.,BGG\n").R_PE.col(1), Vector3d::UnitY());
}

TEST(NastranBeams, OffsetsPinsAndFrames) {
  const std::string grids = turned + "GRID,1,,0.,0.,0.,9\nGRID,2,,2.,0.,0.\n";
  const BeamElement beam = bar(grids, "CBAR,11,5,1,2,0.,1.,0.,BGG\n,45,6,.1,.2,.3,.4,.5,.6\n");
  expect_near(beam.first_offset, Vector3d(0.3, 0.1, 0.2));
  expect_near(beam.second_offset, Vector3d(0.4, 0.5, 0.6));
  const Vector3d axis = Vector3d(2.0, 0.0, 0.0) + Vector3d(0.4, 0.5, 0.6) - Vector3d(0.3, 0.1, 0.2);
  expect_near(beam.R_PE.col(0), axis.normalized());
  EXPECT_EQ(beam.released, (1u << 3) | (1u << 4) | (1u << 11));
  // O: axes of the bar without offsets: x along it, y along basic z.
  const BeamElement own = bar(grids, "CBAR,11,5,1,2,0.,0.,1.,BOO\n,,,0.,.2,.3,0.,.2,.3\n");
  expect_near(own.first_offset, Vector3d(0.0, -0.3, 0.2));
  expect_near(own.second_offset, Vector3d(0.0, -0.3, 0.2));
}

TEST(NastranBeams, FaultsNameTheBar) {
  const std::string rest = "GRID,1\nGRID,2,,2.\nGRID,3\n" + rod_section + steel;
  EXPECT_THAT(fault_of(rest + "CBAR,11,5,1,2,1.,0.,0.\n"),
              HasSubstr("main.bdf:6: CBAR 11: orientation (1, 0, 0) is zero or parallel"));
  EXPECT_THAT(fault_of(rest + "CBAR,11,5,1,2\n"), HasSubstr("orientation (0, 0, 0)"));
  EXPECT_THAT(fault_of(rest + "CBAR,11,5,1,3,0.,1.,0.\n"), HasSubstr("the ends of the axis coincide"));
  EXPECT_THAT(fault_of(rest + "CBAR,11,5,1,2,0.,1.,0.,GGX\n"), HasSubstr("OFFT 'GGX'"));
  EXPECT_THAT(fault_of(rest + "CBAR,11,5,1,2,0.,1.,0.\n,7\n"), HasSubstr("PA '7' does not name components"));
}

TEST(NastranBeams, RodsCarryTorsionOnlyBetweenNodesThatTurn) {
  const std::string grids = "GRID,1\nGRID,2,,2.\nGRID,3,,4.\n" + steel;
  const Deck free = read_deck(grids + "CROD,11,5,1,2\nPROD,5,7,.02,3.-4,,1.5\nCONROD,12,2,3,7,.01\n");
  ASSERT_EQ(free.mesh.beams.size(), 2u);
  const BeamElementData& rod = free.mesh.beam_properties[free.mesh.beams[0].property].data;
  EXPECT_TRUE(is_rod(rod));
  EXPECT_EQ(rod.section.torsion_constant, 0.0);
  EXPECT_EQ(rod.added_mass.first, 1.5);
  EXPECT_TRUE(warns(free, "torsion of rods is ignored"));
  const Deck held = read_deck(grids +
                              "CROD,11,5,1,2\nPROD,5,7,.02,3.-4\nCBAR,12,6,1,3,0.,1.,0.\nCBAR,13,6,2,3,0.,1.,0.\nPBAR,"
                              "6,7,.02,3.-4,4.-4,5.-4\n");
  EXPECT_EQ(held.mesh.beam_properties[held.mesh.beams[2].property].data.section.torsion_constant, 3e-4);
  const Deck tube = read_deck(grids + "CTUBE,11,5,1,2\nPTUBE,5,7,.1,.01\nCONROD,12,2,3,7,.01\n");
  EXPECT_NEAR(tube.mesh.beam_properties[0].data.section.area, std::numbers::pi * 0.1 * 0.01 * 0.9, 1e-15);
}

const std::string square = "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,2.,0.\nGRID,4,,0.,2.,0.\n";

TEST(NastranShells, MaterialAxisOffsetAndThickness) {
  const std::string rest = square + turned + steel + "PSHELL,5,7,.01,7,,7\n";
  const auto shell = [&](const std::string& card) { return read_deck(rest + card).mesh.shells.at(0); };
  EXPECT_TRUE(shell("CQUAD4,11,5,1,2,3,4\n").material_x.isZero());
  const ShellElement a = shell("CQUAD4,11,5,1,2,3,4,30.,.25\n");
  expect_near(a.material_x, Vector3d(std::sqrt(0.75), 0.5, 0.0));
  EXPECT_EQ(a.offset, 0.25);
  expect_near(shell("CTRIA3,11,5,1,2,3,90.,-.25\nCTRIA3,12,5,1,3,4\n").material_x, Vector3d::UnitY());
  EXPECT_EQ(shell("CTRIA3,11,5,1,2,3,90.,-.25\nCTRIA3,12,5,1,3,4\n").offset, -0.25);
  expect_near(shell("CQUAD4,11,5,1,2,3,4,9\n").material_x, Vector3d::UnitY());
  EXPECT_THAT(fault_of(rest + "CORD2R,8,9,0.,0.,0.,1.,0.,0.\n,0.,1.,0.\nCQUAD4,11,5,1,2,3,4,8\n"),
              HasSubstr("x axis of coordinate system 8 is perpendicular to the element"));
  const Deck own = read_deck(rest + "CQUAD4,11,5,1,2,3,4\n,,,.02,.02,.04\n");
  EXPECT_NEAR(own.mesh.shell_properties.at(0).section.thickness, 0.0225, 1e-16);  // (0.02 + 0.02 + 0.04 + 0.01)/4
  EXPECT_TRUE(warns(own, "different thickness at their corners"));
  const Deck factor = read_deck(rest + "CQUAD4,11,5,1,2,3,4\n,,1,2.,2.,2.,2.\n");
  EXPECT_NEAR(factor.mesh.shell_properties.at(0).section.thickness, 0.02, 1e-16);
  EXPECT_EQ(own.element_sets.at("pid5").shells.size(), 1u);
  EXPECT_THAT(own.node_sets.at("pid5"), ElementsAre(0, 1, 2, 3));
}

TEST(NastranShells, FaultsNameTheShell) {
  const std::string rest = square + steel + "PSHELL,5,7,.01,7,,7\n";
  EXPECT_THAT(fault_of(rest + "CQUAD4,11,5,1,2,3,3\n"), HasSubstr("CQUAD4 11: GRID 3 is at two corners"));
  EXPECT_THAT(fault_of(rest + "CQUAD4,11,5,1,2,3\n"), HasSubstr("CQUAD4 11: G is blank"));
  EXPECT_THAT(fault_of(rest + "CQUAD4,11,6,1,2,3,4\n"), HasSubstr("PID names property 6, which is missing"));
}

/// Edge nodes at the middle of the corners that the manuals name for G5 and so on, in the order of the manuals.
std::string quadratic(const std::vector<Vector3d>& corners, const std::vector<std::array<int, 2>>& edges,
                      const std::string& name) {
  std::string text, card = name + ",11,5";
  int id = 0;
  const auto add = [&](const Vector3d& x) {
    text += fmt::format("GRID,{},,{:.3f},{:.3f},{:.3f}\n", ++id, x.x(), x.y(), x.z());
    if ((id + 2) % 8 == 1) card += "\n";
    card += "," + std::to_string(id);
  };
  for (const Vector3d& x : corners) add(x);
  for (const auto& [a, b] : edges) add(0.5 * (corners[a - 1] + corners[b - 1]));
  return text + card + "\nPSOLID,5,7\n" + steel;
}

/// Total mass over density: the volume, which a wrong order of nodes changes or makes negative.
double volume(const Deck& deck) {
  ElementMatrices out;
  element_matrices(deck.mesh, deck.mesh.solids.at(0), out);
  Eigen::VectorXd ones = Eigen::VectorXd::Zero(out.M.rows());
  for (Eigen::Index i = 0; i < ones.size(); i += 3) ones(i) = 1.0;
  return ones.dot(out.M * ones) / 7800.0;
}

TEST(NastranSolids, NodesOfEveryShapeInTheirOrder) {
  const std::vector<Vector3d> cube{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0},
                                   {0, 0, 1}, {2, 0, 1}, {2, 3, 1}, {0, 3, 1}};
  const std::vector<Vector3d> wedge{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 1}, {2, 0, 1}, {0, 3, 1}};
  const std::vector<Vector3d> tetra{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 1}};
  // QRG figures of CHEXA, CPENTA and CTETRA: between which corners G9 to G20, G7 to G15, G5 to G10 lie.
  const std::vector<std::array<int, 2>> hexa_edges{{1, 2}, {2, 3}, {3, 4}, {4, 1}, {1, 5}, {2, 6},
                                                   {3, 7}, {4, 8}, {5, 6}, {6, 7}, {7, 8}, {8, 5}};
  const std::vector<std::array<int, 2>> penta_edges{{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 5},
                                                    {3, 6}, {4, 5}, {5, 6}, {6, 4}};
  const std::vector<std::array<int, 2>> tetra_edges{{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}};
  EXPECT_NEAR(volume(read_deck(quadratic(cube, {}, "CHEXA"))), 6.0, 1e-12);
  EXPECT_NEAR(volume(read_deck(quadratic(cube, hexa_edges, "CHEXA"))), 6.0, 1e-12);
  EXPECT_NEAR(volume(read_deck(quadratic(wedge, {}, "CPENTA"))), 3.0, 1e-12);
  EXPECT_NEAR(volume(read_deck(quadratic(wedge, penta_edges, "CPENTA"))), 3.0, 1e-12);
  EXPECT_NEAR(volume(read_deck(quadratic(tetra, {}, "CTETRA"))), 1.0, 1e-12);
  EXPECT_NEAR(volume(read_deck(quadratic(tetra, tetra_edges, "CTETRA"))), 1.0, 1e-12);
  // In gmsh's order node 8 of a tetrahedron lies between its nodes 2 and 3 (from 0).
  const Mesh mesh = read_deck(quadratic(tetra, tetra_edges, "CTETRA")).mesh;
  expect_near(mesh.position.col(mesh.solids[0].nodes[8]), 0.5 * (tetra[2] + tetra[3]));
  EXPECT_THAT(fault_of(quadratic(tetra, {{1, 2}, {2, 3}}, "CTETRA")), HasSubstr("2 of 6 edge nodes"));
}

TEST(NastranMasses, OffsetAndInertiaInTheirAxes) {
  const std::string grids = turned + "GRID,1,,1.,1.,1.\n";
  const NodalMass basic = read_deck(grids + "CONM2,1,1,,5.,.1,.2,.3\n,6.,.5,7.,.6,.7,8.\n").mesh.masses.at(0);
  Matrix3d J;
  J << 6.0, -0.5, -0.6, -0.5, 7.0, -0.7, -0.6, -0.7, 8.0;
  expect_near(basic.offset, Vector3d(0.1, 0.2, 0.3));
  expect_near(basic.inertia, J);
  const NodalMass other = read_deck(grids + "CONM2,1,1,9,5.,.1,.2,.3\n,6.,.5,7.,.6,.7,8.\n").mesh.masses.at(0);
  const Matrix3d R = columns(Vector3d::UnitY(), Vector3d::UnitZ(), Vector3d::UnitX());
  expect_near(other.offset, Vector3d(0.3, 0.1, 0.2));
  expect_near(other.inertia, R * J * R.transpose());
  expect_near(read_deck(grids + "CONM2,1,1,-1,5.,.1,.2,.3\n").mesh.masses.at(0).offset, Vector3d(-0.9, -0.8, -0.7));
  EXPECT_EQ(read_deck(grids + "PARAM,WTMASS,.5\nCONM2,1,1,,5.\n").mesh.masses.at(0).mass, 2.5);
  EXPECT_THAT(fault_of(grids + "CONM2,1,1,,5.\n,1.,2.,1.\n"), HasSubstr("no body can have these moments of inertia"));
}

const std::string two_bars = bar_deck() + "GRID,4,,4.,0.,1.\n";

TEST(NastranSprings, ScalarSpringsAndBushings) {
  // Along the line between the nodes: force k (w4 − w3).
  const Mesh mesh = read_deck(two_bars + "CELAS2,20,1000.,3,3,4,3\n").mesh;
  Eigen::Matrix<double, 12, 12> expected = Eigen::Matrix<double, 12, 12>::Zero();
  expected(2, 2) = expected(8, 8) = 1000.0;
  expected(2, 8) = expected(8, 2) = -1000.0;
  expect_near(mesh.springs.at(0).stiffness, expected);
  expect_near(read_deck(two_bars + "CELAS1,20,6,3,3,4,3\nPELAS,8,1.,,,6,1000.\n").mesh.springs.at(0).stiffness,
              expected);
  expect_near(read_deck(two_bars + "CBUSH,20,6,3,4\nPBUSH,6,K,1000.\n").mesh.springs.at(0).stiffness, expected);
  // Shear spring along x acting in the middle: arms of 0.5 along z turn u by ±0.5 θy.
  const Mesh bush = read_deck(two_bars + "CBUSH,20,6,3,4,,,,0\nPBUSH,6,K,1000.\n").mesh;
  Eigen::Matrix<double, 12, 1> e = Eigen::Matrix<double, 12, 1>::Zero();
  e(0) = -1.0;
  e(4) = -0.5;
  e(6) = 1.0;
  e(10) = -0.5;
  expect_near(bush.springs.at(0).stiffness, 1000.0 * e * e.transpose());
  // The same in z of system 9, at GRID 3 (S = 0), and given by OCID.
  e(4) = 0.0;
  e(10) = -1.0;
  const std::string in_9 = two_bars + turned + "PBUSH,6,K,,,1000.\n";
  expect_near(read_deck(in_9 + "CBUSH,20,6,3,4,,,,9\n,0.\n").mesh.springs.at(0).stiffness, 1000.0 * e * e.transpose());
  expect_near(read_deck(in_9 + "CBUSH,20,6,3,4,,,,9\n,,9,0.,0.,4.\n").mesh.springs.at(0).stiffness,
              1000.0 * e * e.transpose());
}

TEST(NastranSprings, SpringsThatHoldThePartAreFaults) {
  EXPECT_THAT(fault_of(two_bars + "CELAS2,20,1000.,3,1,4,1\n"), HasSubstr("resists rigid-body motion"));
  EXPECT_THAT(fault_of(two_bars + "CELAS2,20,1000.,3,1\n"), HasSubstr("CELAS2 20: fixes GRID 3 (1) to the ground"));
  EXPECT_THAT(fault_of(two_bars + "CBUSH,20,6,3,,,,,0\nPBUSH,6,K,1000.\n"),
              HasSubstr("CBUSH 20: fixes GRID 3 (123456) to the ground"));
  EXPECT_THAT(fault_of(two_bars + "CBUSH,20,6,3,4\nPBUSH,6,K,,1000.\n"), HasSubstr("orientation is missing"));
  EXPECT_THAT(fault_of(two_bars + "CELAS2,20,1000.,3,12,4,1\n"), HasSubstr("C '12' must be one component"));
}

}  // namespace
}  // namespace tisserand::testing::nastran_elements_test
