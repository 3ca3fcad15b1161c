// SPDX-License-Identifier: GPL-3.0-or-later
// Nastran decks: rigid and averaging elements, equations, boundary and supports.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/reducer/decks/nastran_deck.hpp"

namespace tisserand::testing::nastran_ties_test {
namespace {

using Eigen::Matrix3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using namespace reducer;

/// Bars 1-2-3 and free points 4, 5 (displacements of 5 in system 9: x along basic y, y along basic z).
const std::string base = bar_deck() +
                         "GRID,4,,4.,1.,0.\nGRID,5,,4.,0.,1.,9\n"
                         "CORD2R,9,,0.,0.,0.,1.,0.,0.\n,0.,1.,0.\n";

Matrix3d system_9() {
  Matrix3d m;
  m << 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  return m;
}

std::vector<Spider> spiders(const std::string& cards) { return read_deck(base + cards).mesh.spiders; }

TEST(NastranTies, Rbe2) {
  const std::vector<Spider> full = spiders("RBE2,30,3,123456,4,5,1.-5\n");
  ASSERT_EQ(full.size(), 1u);
  EXPECT_EQ(full[0].kind, SpiderKind::rigid);
  EXPECT_EQ(full[0].reference, 2);
  EXPECT_THAT(full[0].nodes, ElementsAre(3, 4));
  EXPECT_EQ(full[0].node_components, all_components);
  EXPECT_THAT(spiders("RBE2,30,3,123,4,THRU,5\n").at(0).nodes, ElementsAre(3, 4));
  // Components of one direction stand in the axes of each dependent point.
  const std::vector<Spider> part = spiders("RBE2,30,3,1,4,5\n");
  ASSERT_EQ(part.size(), 2u);
  EXPECT_EQ(part[0].axes, Matrix3d::Identity());
  EXPECT_LT((part[1].axes - system_9()).norm(), 1e-15);
  EXPECT_THAT(fault_of(base + "RBE2,30,3,123,3,4\n"), HasSubstr("RBE2 30: GRID 3 depends on itself"));
  EXPECT_THAT(fault_of(base + "RBE2,30,3,,4\n"), HasSubstr("CM is blank"));
  EXPECT_THAT(fault_of(base + "RBE2,30,3,123\n"), HasSubstr("no dependent grid points"));
}

TEST(NastranTies, RbarAndRbe1) {
  const Spider bar = spiders("RBAR,30,3,4,123456\n").at(0);
  EXPECT_EQ(bar.reference, 2);
  EXPECT_THAT(bar.nodes, ElementsAre(3));
  EXPECT_EQ(bar.node_components, all_components);
  const Spider back = spiders("RBAR,30,4,3,,123456,123\n").at(0);
  EXPECT_EQ(back.reference, 2);
  EXPECT_EQ(back.node_components, translations_only);
  EXPECT_THAT(fault_of(base + "RBAR,30,3,4,123,456\n"), HasSubstr("RBAR 30: independent components on both ends"));
  const Spider one = spiders("RBE1,30,3,123456\n,UM,4,123,5,123\n").at(0);
  EXPECT_EQ(one.reference, 2);
  EXPECT_THAT(one.nodes, ElementsAre(3, 4));
  EXPECT_THAT(fault_of(base + "RBE1,30,3,123,2,3,1,12\n,UM,4,123\n"), HasSubstr("use RBE2"));
}

TEST(NastranTies, Rbe3) {
  const Spider spider = spiders("RBE3,30,,4,123456,1.,123,1,2\n,2.5,123,3\n,UM,1,123,2,123\n,ALPHA,1.-5\n").at(0);
  EXPECT_EQ(spider.kind, SpiderKind::averaging);
  EXPECT_EQ(spider.reference, 3);
  EXPECT_THAT(spider.nodes, ElementsAre(0, 1, 2));
  EXPECT_THAT(spider.weight, ElementsAre(1.0, 1.0, 2.5));
  EXPECT_EQ(spider.node_components, translations_only);
  EXPECT_EQ(spider.reference_components, all_components);
  EXPECT_THAT(spiders("RBE3,30,,4,123,1.,123,1,2\n,1.,123,2,3\n").at(0).weight, ElementsAre(1.0, 2.0, 1.0));
  EXPECT_THAT(fault_of(base + "RBE3,30,,4,123,1.,123,1,2\n,1.,12,3\n"),
              HasSubstr("give all groups the same components"));
  EXPECT_THAT(fault_of(base + "RBE3,30,,4,123,1.,12,1,2\n,5\n"), HasSubstr("CD differs between the grid points"));
  EXPECT_THAT(fault_of(base + "RBE3,30,,4,123,1.,123,4,2\n"),
              HasSubstr("the reference point is also one of the averaged points"));
  EXPECT_THAT(fault_of(base + "RBE3,30,,4,123,-1.,123,1,2\n"), HasSubstr("weight -1 is negative"));
  EXPECT_THAT(fault_of(base + "RBE3,30,,4,123,1,x,1\n"), HasSubstr("C 'x' does not name components"));
}

TEST(NastranTies, MpcInAxesOfThePoints) {
  const Deck deck = read_deck(base + "RBE2,30,3,123456,4\nMPC,1,5,1,2.,1,3,-1.\n,,2,6,.5\n");
  ASSERT_EQ(deck.mesh.equations.size(), 1u);
  const std::vector<TieTerm>& terms = deck.mesh.equations[0].terms;
  ASSERT_EQ(terms.size(), 3u);
  EXPECT_EQ(terms[0].node, 4);
  EXPECT_EQ(terms[0].component, 1);  // x of system 9 is basic y
  EXPECT_EQ(terms[0].coefficient, 2.0);
  EXPECT_EQ(terms[1].component, 2);
  EXPECT_EQ(terms[2].component, 5);
  EXPECT_EQ(terms[2].coefficient, 0.5);
  EXPECT_THAT(fault_of(base + "MPC,1,4,1,1.,1,1,-1.\nMPC,2,4,2,1.,1,1,-1.\n"), HasSubstr("sets 1 and 2 of MPC"));
  EXPECT_THAT(fault_of(base + "MPC,1,4,12,1.,1,1,-1.\n"), HasSubstr("C '12' must be one component"));
}

TEST(NastranBoundary, AsetInEveryForm) {
  const Deck pairs = read_deck(base + "RBE2,30,3,123456,5\nASET,3,123,1,123456,3,456,5,123\n");
  ASSERT_EQ(pairs.mesh.boundary.size(), 3u);
  EXPECT_EQ(pairs.mesh.boundary[0].name, "node_3");
  EXPECT_TRUE(pairs.mesh.boundary[0].translations && pairs.mesh.boundary[0].rotations);
  EXPECT_EQ(pairs.mesh.boundary[1].node, 0);
  EXPECT_FALSE(pairs.mesh.boundary[2].rotations);
  EXPECT_TRUE(warns(pairs, "boundary coordinates have the axes of the part, not those of CD, at GRID: 5"));
  EXPECT_EQ(read_deck(base + "BSET1,123456,1,THRU,3\n").mesh.boundary.size(), 3u);
  EXPECT_EQ(read_deck(base + "ASET1,456,1,3\n").mesh.boundary[1].node, 2);
  EXPECT_THAT(fault_of(base + "ASET1,12,1\n"), HasSubstr("ASET1 12: GRID 1: components 12 alone cannot be boundary"));
  EXPECT_THAT(fault_of(base + "ASET1,123,9\n"), HasSubstr("ID names GRID 9, which is missing"));
}

TEST(NastranBoundary, SupportsAreFaultsWhereSomethingIsHeld) {
  EXPECT_THAT(fault_of(base + "SPC1,1,123,1,THRU,3\n"),
              HasSubstr("SPC1 1: fixes GRID 1 (123), 2 (123), 3 (123) to the ground"));
  EXPECT_THAT(
      fault_of(base + "SPC,1,2,3,0.\n"),
      HasSubstr(
          "SPC 1: fixes GRID 2 (3) to the ground; a superelement has no supports: define the support in the scene"));
  EXPECT_THAT(fault_of("GRDSET,,,,,,,5\n" + base), HasSubstr("fixes GRID 1 (5) to the ground"));
  // Rotations of solid nodes, drilling of a flat shell.
  const std::string tetra =
      "GRID,1\nGRID,2,,1.\nGRID,3,,0.,1.\nGRID,4,,0.,0.,1.\nCTETRA,11,5,1,2,3,4\nPSOLID,5,7\nMAT1,7,1.,,.3,1.\n";
  const Deck solid = read_deck(tetra + "SPC1,1,456,1,2,3,4\nASET1,123456,1\n");
  EXPECT_TRUE(warns(solid, "supports of components without stiffness and mass are ignored at GRID: 1 (456), 2 (456)"));
  EXPECT_FALSE(solid.mesh.boundary[0].rotations);
  EXPECT_THAT(fault_of(tetra + "SPC1,1,3456,1\n"), HasSubstr("fixes GRID 1 (3) to the ground"));
  const std::string plate =
      "GRID,1\nGRID,2,,1.\nGRID,3,,1.,1.\nGRID,4,,0.,1.\nCQUAD4,11,5,1,2,3,4\nPSHELL,5,7,.01,7,,7\nMAT1,7,1.,,.3,1.\n";
  EXPECT_TRUE(warns(read_deck(plate + "SPC1,1,6,1,2,3,4\n"), "1 (6), 2 (6), 3 (6), 4 (6)"));
  EXPECT_THAT(fault_of(plate + "SPC1,1,56,1\n"), HasSubstr("fixes GRID 1 (5) to the ground"));
  EXPECT_THAT(fault_of(plate + "SPC1,1,6,1\nCONM2,12,1,,1.\n,1.,,1.,,,1.\n"),
              HasSubstr("fixes GRID 1 (6) to the ground"));
}

}  // namespace
}  // namespace tisserand::testing::nastran_ties_test
