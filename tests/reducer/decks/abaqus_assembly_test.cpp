// SPDX-License-Identifier: GPL-3.0-or-later
// Sets, parts and instances of Abaqus decks: who is meant by a number or a name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reducer/decks/abaqus_deck.hpp"

namespace tisserand::reducer::abaqus_assembly_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(AbaqusSets, RangesListsAndSetsInSets) {
  const Deck deck = abaqus_deck(
      abaqus_plate +
      "*NSET, NSET=odd, GENERATE\n1, 3, 2\n*NSET, NSET=both\nodd, 4\n*NSET, NSET=far, GENERATE\n1, 2000000000, 1\n"
      "*NSET, NSET=of, ELSET=plate\n*NSET, NSET=odd\n2\n*NSET, NSET=order, UNSORTED\n3, 1\n*ELSET, ELSET=e\nplate\n"
      "*SURFACE, NAME=top\nplate, SPOS\n");
  EXPECT_EQ(deck.node_sets.at("odd"), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(deck.node_sets.at("both"), (std::vector<int>{0, 2, 3}));
  EXPECT_EQ(deck.node_sets.at("far").size(), 4u);
  EXPECT_EQ(deck.node_sets.at("of").size(), 4u);
  EXPECT_EQ(deck.node_sets.at("order"), (std::vector<int>{2, 0}));
  EXPECT_EQ(deck.node_sets.at("top").size(), 4u);
  EXPECT_EQ(deck.element_sets.at("e").shells, (std::vector<int>{0}));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*NSET, NSET=a\n1, 99\n"), HasSubstr("node number '99' does not exist"));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*NSET, NSET=a\nb\n"), HasSubstr("node set 'b' does not exist"));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*NSET, NSET=a, GENERATE\n5, 9, 1\n"),
              HasSubstr("there is no node from 5 to 9"));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*NSET, NSET=a, GENERATE\n5, 1, 1\n"), HasSubstr("is not a range"));
  EXPECT_THAT(abaqus_error(abaqus_plate + "*NSET\n1\n"), HasSubstr("without NSET"));
}

/// Part with a beam along x from 0 to 2, nodes 1 and 2, set Tip = 2.
const std::string kPart =
    "*PART, NAME=Strut\n*NODE\n1, 0., 0., 0.\n2, 2., 0., 0.\n*ELEMENT, TYPE=B31, ELSET=All\n1, 1, 2\n*NSET, "
    "NSET=Tip\n2\n"
    "*BEAM SECTION, SECTION=RECT, ELSET=All, MATERIAL=steel\n1., 2.\n0., 1., 0.\n*END PART\n";

TEST(AbaqusAssembly, InstancesStandWhereTheirLinesSay) {
  const Deck deck =
      abaqus_deck(kPart +
                  "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=Strut-1, PART=Strut\n*END INSTANCE\n"
                  "*INSTANCE, NAME=Strut-2, PART=Strut\n2., 0., 0.\n2., 0., 0., 2., 0., 1., 90.\n*END INSTANCE\n"
                  "*NODE\n1, 2., 0., 0.\n"
                  "*NSET, NSET=Ends, INSTANCE=Strut-1\n1\n*NSET, NSET=Ends, INSTANCE=Strut-2\nTip\n"
                  "*NSET, NSET=joint\nStrut-1.Tip, strut-2.1\n"
                  "*MPC\nBEAM, joint, 1\n*END ASSEMBLY\n" +
                  abaqus_steel);
  ASSERT_EQ(deck.mesh.nodes(), 5);
  // The assembly's own node comes after those of the instances.
  EXPECT_EQ(deck.mesh.position.col(1), Eigen::Vector3d(2.0, 0.0, 0.0));
  // Moved by 2, then turned by 90° about the vertical line through (2, 0, 0).
  EXPECT_LT((deck.mesh.position.col(2) - Eigen::Vector3d(2.0, 0.0, 0.0)).norm(), 1e-14);
  EXPECT_LT((deck.mesh.position.col(3) - Eigen::Vector3d(2.0, 2.0, 0.0)).norm(), 1e-14);
  EXPECT_LT((deck.mesh.beams[1].R_PE.col(1) - Eigen::Vector3d(-1.0, 0.0, 0.0)).norm(), 1e-14);  // n1 turns too
  EXPECT_EQ(deck.mesh.node_label[3], "node strut-2.2");
  EXPECT_EQ(deck.node_sets.at("ends"), (std::vector<int>{0, 3}));
  EXPECT_EQ(deck.node_sets.at("strut-1.tip"), (std::vector<int>{1}));
  EXPECT_EQ(deck.node_sets.count("tip"), 0u);  // two instances have one
  EXPECT_EQ(deck.element_sets.at("strut-2.all").beams, (std::vector<int>{1}));
  EXPECT_EQ(deck.mesh.spiders.size(), 2u);
  EXPECT_EQ(deck.node_of_id.at(1), 4);  // that of the assembly
  EXPECT_EQ(deck.node_of_id.count(2), 0u);
}

TEST(AbaqusAssembly, SingleInstanceNeedsNoQualification) {
  const Deck deck =
      abaqus_deck(kPart + "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=s, PART=Strut\n*END INSTANCE\n*END ASSEMBLY\n" +
                  abaqus_steel + "*STEP\n*RETAINED NODAL DOFS\ns.Tip, 1, 6\ns.1, 1, 6\n*END STEP\n");
  EXPECT_EQ(deck.node_sets.at("tip"), (std::vector<int>{1}));
  EXPECT_EQ(deck.node_of_id.at(2), 1);
  ASSERT_EQ(deck.mesh.boundary.size(), 2u);
  EXPECT_EQ(deck.mesh.boundary[0].name, "node_s_1");
}

TEST(AbaqusAssembly, ElementsOfTheAssemblyJoinInstances) {
  const Deck deck =
      abaqus_deck(kPart +
                  "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=a, PART=Strut\n*END INSTANCE\n*INSTANCE, NAME=b, PART=Strut\n0., "
                  "1., 0.\n*END INSTANCE\n"
                  "*ELEMENT, TYPE=SPRINGA, ELSET=link\n1, a.2, b.2\n*SPRING, ELSET=link\n\n7.\n*END ASSEMBLY\n" +
                  abaqus_steel);
  ASSERT_EQ(deck.mesh.springs.size(), 1u);
  EXPECT_EQ(deck.mesh.springs[0].first, 1);
  EXPECT_EQ(deck.mesh.springs[0].second, 3);
}

TEST(AbaqusAssembly, Faults) {
  EXPECT_THAT(abaqus_error(kPart + "*INSTANCE, NAME=a, PART=Wing\n*END INSTANCE\n"), HasSubstr("no part 'wing'"));
  EXPECT_THAT(
      abaqus_error(kPart +
                   "*INSTANCE, NAME=a, PART=Strut\n*END INSTANCE\n*INSTANCE, NAME=A, PART=Strut\n*END INSTANCE\n"),
      HasSubstr("'a' exists twice"));
  EXPECT_THAT(abaqus_error("*PART, NAME=p\n*NODE\n1\n"), AllOf(HasSubstr("ends inside *PART"), HasSubstr("truncated")));
  EXPECT_THAT(
      abaqus_error(kPart + "*INSTANCE, NAME=a, PART=Strut\n0,0,0\n1,1,1,1,1,1,90\n*END INSTANCE\n" + abaqus_steel),
      HasSubstr("axis of rotation"));
  EXPECT_THAT(abaqus_error(kPart + "*INSTANCE, NAME=a, PART=Strut\n*END INSTANCE\n*NSET, NSET=n, INSTANCE=b\n1\n" +
                           abaqus_steel),
              HasSubstr("no instance 'b'"));
}

}  // namespace
}  // namespace tisserand::reducer::abaqus_assembly_test
