// SPDX-License-Identifier: GPL-3.0-or-later
// Constraints, boundary and supports of Abaqus decks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reducer/decks/abaqus_deck.hpp"

namespace tisserand::reducer::abaqus_ties_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kReference = "*NODE\n10, 0.5, 0.5, 1.\n";
const std::string kSurface = "*SURFACE, NAME=Face, TYPE=ELEMENT\nPlate, SPOS\n";

TEST(AbaqusTies, KinematicCouplingIsARigidSpider) {
  const Deck deck = abaqus_deck(abaqus_plate + kReference + kSurface +
                                "*COUPLING, CONSTRAINT NAME=Hold, REF NODE=10, SURFACE=face\n*KINEMATIC\n1, 3\n5\n");
  ASSERT_EQ(deck.mesh.spiders.size(), 1u);
  const Spider& spider = deck.mesh.spiders[0];
  EXPECT_EQ(spider.kind, SpiderKind::rigid);
  EXPECT_EQ(spider.reference, 4);
  EXPECT_EQ(spider.nodes, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(spider.node_components, 0b010111);
  EXPECT_EQ(spider.name, "hold");
}

TEST(AbaqusTies, DistributingCouplingWeighsNodesByArea) {
  // A triangle of area 3 beside the unit square: nodes 2 and 3 belong to both.
  const Deck deck =
      abaqus_deck(abaqus_plate + kReference + "*NODE\n5, 7., 0., 0.\n*ELEMENT, TYPE=S3, ELSET=plate\n2, 2, 5, 3\n" +
                  kSurface + "*COUPLING, CONSTRAINT NAME=Mean, REF NODE=10, SURFACE=face\n*DISTRIBUTING\n1, 3\n6, 6\n");
  const Spider& spider = deck.mesh.spiders.at(0);
  EXPECT_EQ(spider.kind, SpiderKind::averaging);
  EXPECT_EQ(spider.node_components, translations_only);
  EXPECT_EQ(spider.reference_components, 0b100111);
  ASSERT_EQ(spider.nodes, (std::vector<int>{0, 1, 2, 3, 5}));
  const std::vector<double> expected = {0.25, 1.25, 1.25, 0.25, 1.0};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(spider.weight[i], expected[i], 1e-14);
}

TEST(AbaqusTies, SurfacesOfNodesAndOfSolidFaces) {
  const std::string brick =
      "*NODE\n1,0,0,0\n2,2,0,0\n3,2,3,0\n4,0,3,0\n5,0,0,5\n6,2,0,5\n7,2,3,5\n8,0,3,5\n10,0,0,9\n"
      "*ELEMENT, TYPE=C3D8, ELSET=b\n1, 1,2,3,4,5,6,7,8\n" +
      abaqus_steel + "*SOLID SECTION, ELSET=b, MATERIAL=steel\n";
  const auto spider = [&](const std::string& surface) {
    return abaqus_deck(brick + surface + "*COUPLING, REF NODE=10, SURFACE=s, CONSTRAINT NAME=c\n*DISTRIBUTING\n")
        .mesh.spiders.at(0);
  };
  const Spider top = spider("*SURFACE, NAME=s\nb, S2\n");
  EXPECT_EQ(top.nodes, (std::vector<int>{4, 5, 6, 7}));
  EXPECT_NEAR(top.weight[0], 1.5, 1e-14);               // a quarter of 2 x 3
  const Spider all = spider("*SURFACE, NAME=s\nb,\n");  // all free faces: each node has a quarter of three of them
  EXPECT_EQ(all.nodes.size(), 8u);
  EXPECT_NEAR(all.weight[3], (6.0 + 10.0 + 15.0) / 4.0, 1e-13);
  const Spider nodal = spider("*SURFACE, NAME=s, TYPE=NODE\n1\n7, 1.\n");
  EXPECT_EQ(nodal.nodes, (std::vector<int>{0, 6}));
  EXPECT_EQ(nodal.weight, (std::vector<double>{1.0, 1.0}));
  EXPECT_THAT(abaqus_error(brick + "*SURFACE, NAME=s\nb, SPOS\n*SURFACE, NAME=t\nb, E1\n"),
              HasSubstr("face 'E1' is not understood"));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*SURFACE, NAME=s\nplate, S3\n"), HasSubstr("has no such face"));
}

TEST(AbaqusTies, RigidBodyTiesAndPins) {
  const Deck deck = abaqus_deck(
      abaqus_plate + kReference +
      "*NSET, NSET=tied\n1, 2\n*NSET, NSET=pinned\n3\n*RIGID BODY, REF NODE=10, TIE NSET=tied, PIN NSET=pinned\n");
  ASSERT_EQ(deck.mesh.spiders.size(), 2u);
  EXPECT_EQ(deck.mesh.spiders[0].nodes, (std::vector<int>{0, 1}));
  EXPECT_EQ(deck.mesh.spiders[0].node_components, all_components);
  EXPECT_EQ(deck.mesh.spiders[1].node_components, translations_only);
  const Deck whole = abaqus_deck(abaqus_plate + kReference + "*RIGID BODY, REF NODE=10, ELSET=plate\n");
  EXPECT_EQ(whole.mesh.spiders.at(0).nodes.size(), 4u);
}

TEST(AbaqusTies, Mpcs) {
  const Deck deck = abaqus_deck(abaqus_plate + kReference +
                                "*NODE\n11, 0., 0., 0.\n*NSET, NSET=pair\n3, 4\n*MPC\nBEAM, pair, 10\nPIN, 11, 1\n");
  ASSERT_EQ(deck.mesh.spiders.size(), 3u);
  EXPECT_EQ(deck.mesh.spiders[1].reference, 4);
  EXPECT_EQ(deck.mesh.spiders[1].nodes, (std::vector<int>{3}));
  EXPECT_EQ(deck.mesh.spiders[2].node_components, translations_only);
  EXPECT_THAT(abaqus_error(abaqus_plate + "*MPC\nTIE, 1, 2\n"),
              AllOf(HasSubstr("node 1 and node 2 are 1 apart"), HasSubstr("BEAM")));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*MPC\nSLIDER, 1, 2, 3\n"), HasSubstr("BEAM, TIE or PIN"));
}

/// The trial transform_supports: axes of nodes that nothing but supports uses have no effect. Away from the axis of
/// TYPE=C the first direction leads away from it, the second around it (Abaqus keywords, *TRANSFORM).
TEST(AbaqusTies, CylindricalAxesOfNodes) {
  const std::string on_axis = "*NSET, NSET=t\n1\n*TRANSFORM, NSET=t, TYPE=C\n0., 0., 0., 0., 0., 1.\n";
  EXPECT_TRUE(abaqus_deck(abaqus_plate + on_axis).mesh.equations.empty());
  EXPECT_TRUE(abaqus_deck(abaqus_plate + "*NSET, NSET=t\n1\n*TRANSFORM, NSET=t, TYPE=S\n0., 0., 0., 0., 0., 1.\n")
                  .mesh.equations.empty());
  const std::string equation = "*EQUATION\n2\n1, 1, 1., 2, 2, -3.\n";
  EXPECT_THAT(abaqus_error(abaqus_plate + on_axis + equation),
              AllOf(HasSubstr("node 1: it lies on the axis"), HasSubstr("TYPE=R")));
  // Node 2 at (1, 0, 0), axis along y through (1, 0, 4): away from it −z, around it y x (−z) = −x.
  const Deck deck = abaqus_deck(abaqus_plate +
                                "*NSET, NSET=t\n2\n*TRANSFORM, NSET=t, TYPE=C\n1., 0., 4., 1., 2., 4.\n" + equation);
  const auto& terms = deck.mesh.equations.at(0).terms;
  ASSERT_EQ(terms.size(), 2u);
  EXPECT_EQ(terms[1].node, 1);
  EXPECT_EQ(terms[1].component, 0);
  EXPECT_NEAR(terms[1].coefficient, 3.0, 1e-14);
}

TEST(AbaqusTies, EquationsTurnWithTransformedNodes) {
  const Deck deck = abaqus_deck(
      abaqus_plate +
      "*NSET, NSET=t\n2\n*TRANSFORM, NSET=t\n0., 1., 0., -1., 0., 0.\n*EQUATION\n3\n1, 1, 2.\n2, 1, -1., 3, 6, 4.\n");
  ASSERT_EQ(deck.mesh.equations.size(), 1u);
  const auto& terms = deck.mesh.equations[0].terms;
  ASSERT_EQ(terms.size(), 3u);
  EXPECT_EQ(terms[0].node, 0);
  EXPECT_EQ(terms[0].coefficient, 2.0);
  EXPECT_EQ(terms[1].node, 1);
  EXPECT_EQ(terms[1].component, 1);  // the local x of node 2 is the global y
  EXPECT_EQ(terms[1].coefficient, -1.0);
  EXPECT_EQ(terms[2].component, 5);
  EXPECT_THAT(abaqus_error(abaqus_plate + "*EQUATION\n3\n1, 1, 2., 2, 1, 1.\n"),
              HasSubstr("3 terms are announced, but 2 are given"));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*EQUATION\n2\n1, 7, 2., 2, 1, 1.\n"), HasSubstr("degree of freedom '7'"));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*EQUATION\n1, 1, 2.\n"), HasSubstr("is not a number of terms"));
}

TEST(AbaqusTies, RetainedCoordinatesAreTheBoundary) {
  const Deck deck =
      abaqus_deck(abaqus_plate +
                  "*NSET, NSET=Corner\n1\n*NSET, NSET=Rest\n3, 4\n*STEP\n*SUBSTRUCTURE GENERATE, TYPE=Z1\n"
                  "*RETAINED NODAL DOFS\nCorner, 1, 6\nrest, 1, 3\n*SELECT EIGENMODES\n*NODE PRINT\nU\n*END STEP\n");
  ASSERT_EQ(deck.mesh.boundary.size(), 3u);
  EXPECT_EQ(deck.mesh.boundary[0].name, "corner");
  EXPECT_TRUE(deck.mesh.boundary[0].rotations);
  EXPECT_EQ(deck.mesh.boundary[1].name, "node_3");
  EXPECT_EQ(deck.mesh.boundary[1].node, 2);
  EXPECT_FALSE(deck.mesh.boundary[1].rotations);
  ASSERT_EQ(deck.mesh.warnings.size(), 1u);
  EXPECT_THAT(deck.mesh.warnings[0], AllOf(HasSubstr("*SELECT EIGENMODES (1)"), Not(HasSubstr("PRINT"))));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*RETAINED NODAL DOFS\n1, 1, 2\n"), HasSubstr("some of its translations"));
}

TEST(AbaqusTies, SupportsAreErrorsUnlessTheyHoldNothing) {
  const std::string remedy = "define the support in the scene";
  EXPECT_THAT(abaqus_error(abaqus_plate + "*BOUNDARY\n1, 1, 3\n"), AllOf(HasSubstr("node 1"), HasSubstr(remedy)));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*STEP\n*STATIC\n*BOUNDARY\nAll, ENCASTRE\n*END STEP\n"), HasSubstr(remedy));
  const Deck deck =
      abaqus_deck("*NODE, NSET=n\n1, 0,0,0\n2, 1,0,0\n3, 0,1,0\n4, 0,0,1\n*ELEMENT, TYPE=C3D4, ELSET=b\n1, 1,2,3,4\n" +
                  abaqus_steel + "*SOLID SECTION, ELSET=b, MATERIAL=steel\n*BOUNDARY\nn, 4, 6\n1, 11, 11, 20.\n");
  ASSERT_EQ(deck.mesh.warnings.size(), 1u);
  EXPECT_THAT(deck.mesh.warnings[0], AllOf(HasSubstr("2 lines"), HasSubstr("'n, 4, 6'")));
}

TEST(AbaqusTies, FaultsOfCouplings) {
  EXPECT_THAT(
      abaqus_error(abaqus_plate + kReference + kSurface + "*COUPLING, REF NODE=10, SURFACE=face, CONSTRAINT NAME=c\n"),
      HasSubstr("without *KINEMATIC"));
  EXPECT_THAT(
      abaqus_error(abaqus_plate + kReference + "*COUPLING, REF NODE=10, SURFACE=none, CONSTRAINT NAME=c\n*KINEMATIC\n"),
      HasSubstr("surface 'none'"));
  EXPECT_THAT(
      abaqus_error(abaqus_plate + kSurface + "*COUPLING, REF NODE=77, SURFACE=face, CONSTRAINT NAME=c\n*KINEMATIC\n"),
      HasSubstr("node number '77' does not exist"));
  EXPECT_THAT(
      abaqus_error(abaqus_plate + kReference + kSurface +
                   "*COUPLING, REF NODE=10, SURFACE=face, INFLUENCE RADIUS=0.1, CONSTRAINT NAME=c\n*KINEMATIC\n"),
      HasSubstr("connects no nodes"));
  EXPECT_THAT(abaqus_error(abaqus_plate + kReference + kSurface +
                           "*COUPLING, REF NODE=10, SURFACE=face, CONSTRAINT NAME=c\n*KINEMATIC\n2, 9\n"),
              HasSubstr("from 1 to 6"));
}

}  // namespace
}  // namespace tisserand::reducer::abaqus_ties_test
