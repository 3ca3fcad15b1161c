// SPDX-License-Identifier: GPL-3.0-or-later
// The text of Abaqus decks: comments, continuation, case, included files, numbers, and files that are no decks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reducer/decks/abaqus/lines.hpp"
#include "tests/reducer/decks/abaqus_deck.hpp"

namespace tisserand::reducer::abaqus_lines_test {
namespace {

using abaqus::to_integer;
using abaqus::to_number;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(AbaqusLines, NumbersWithFortranExponentsAreRead) {
  EXPECT_EQ(to_number("1.5D+3"), 1500.0);
  EXPECT_EQ(to_number("-2.d0"), -2.0);
  EXPECT_EQ(to_number("+.5"), 0.5);
  EXPECT_EQ(to_number("7"), 7.0);
  EXPECT_EQ(to_number(""), std::nullopt);
  EXPECT_EQ(to_number("nan"), std::nullopt);
  EXPECT_EQ(to_number("inf"), std::nullopt);
  EXPECT_EQ(to_number("1e999"), std::nullopt);
  EXPECT_EQ(to_number("1.5 mm"), std::nullopt);
  EXPECT_EQ(to_integer("12"), 12);
  EXPECT_EQ(to_integer("12."), std::nullopt);
  EXPECT_EQ(to_integer("99999999999999999999"), std::nullopt);
}

TEST(AbaqusLines, CommentsCaseBlanksAndContinuationDoNotMatter) {
  const Deck deck = abaqus_deck(
      "** a comment\n"
      "*heading\r\n"
      "any text, even 1, 2\r\n"
      "\n"
      "  *Node ,\n"
      "  nset = \"All\"\n"
      "\t1 ,0. , 0 ,0\n"
      "** between\n"
      "2, 1.\n"
      "*ELEMENT, type = t3d2,\n"
      "ELSET=Bar\n"
      "1, 1, 2,\n" +
      abaqus_steel + "*SolidSection, elset=BAR, material=STEEL\n3.,\n");
  EXPECT_EQ(deck.mesh.nodes(), 2);
  EXPECT_EQ(deck.mesh.position.col(1), Eigen::Vector3d(1.0, 0.0, 0.0));
  ASSERT_EQ(deck.mesh.beams.size(), 1u);
  EXPECT_EQ(deck.mesh.beam_properties[0].data.section.area, 3.0);
  EXPECT_EQ(deck.node_sets.at("all"), (std::vector<int>{0, 1}));
  EXPECT_EQ(deck.element_sets.at("bar").beams, (std::vector<int>{0}));
}

TEST(AbaqusLines, IncludedFilesAndInputParametersAreReadBesideTheDeck) {
  AbaqusDeckFile file("*INCLUDE, INPUT=mesh/nodes.inp\n*ELEMENT, TYPE=S4, ELSET=plate, INPUT=elements.txt\n" +
                      abaqus_steel + "*SHELL SECTION, ELSET=plate, MATERIAL=steel\n0.5\n");
  std::filesystem::create_directory(std::filesystem::path(file.path()).parent_path() / "mesh");
  file.add("mesh/nodes.inp", "*NODE\n1,0,0,0\n*INCLUDE, INPUT=more.inp\n");
  file.add("mesh/more.inp", "*NODE\n2,1,0,0\n3,1,1,0\n4,0,1,0\n");
  file.add("elements.txt", "** data lines only\n1,1,2,3,4\n");
  const Deck deck = read_abaqus(file.path(), {UnknownCards::refuse});
  EXPECT_EQ(deck.mesh.nodes(), 4);
  EXPECT_EQ(deck.mesh.shells.size(), 1u);
}

TEST(AbaqusLines, FileThatIncludesItselfIsAnError) {
  AbaqusDeckFile file("*INCLUDE, INPUT=a.inp\n");
  file.add("a.inp", "*HEADING\n*INCLUDE, INPUT=./deck.inp\n");
  try {
    read_abaqus(file.path(), {UnknownCards::refuse});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("a.inp:2"), HasSubstr("includes itself")));
  }
}

TEST(AbaqusLines, ManyInclusionsOfOneFileEnd) {
  AbaqusDeckFile file("*INCLUDE, INPUT=a.inp\n");
  std::string twice_each = "*HEADING\n";
  for (int k = 0; k < 40; ++k) twice_each += "*INCLUDE, INPUT=b.inp\n";
  file.add("a.inp", twice_each);
  std::string many = "*HEADING\n";
  for (int k = 0; k < 40; ++k) many += "*INCLUDE, INPUT=c.inp\n";
  file.add("b.inp", many);
  file.add("c.inp", "*HEADING\n");
  EXPECT_THROW(read_abaqus(file.path(), {UnknownCards::refuse}), Error);
}

TEST(AbaqusLines, MissingFilesAndOtherFormatsAreErrors) {
  EXPECT_THAT(abaqus_error("*INCLUDE, INPUT=none.inp\n"), AllOf(HasSubstr("deck.inp:1"), HasSubstr("none.inp")));
  EXPECT_THAT(abaqus_error("*INCLUDE\n"), HasSubstr("INPUT"));
  EXPECT_THAT(abaqus_error(""), HasSubstr("no keyword"));
  EXPECT_THAT(abaqus_error("$MeshFormat\n2.2 0 8\n"), AllOf(HasSubstr("deck.inp:1"), HasSubstr("another format")));
  EXPECT_THAT(abaqus_error("*HEADING\nempty\n"), HasSubstr("no nodes"));
  EXPECT_THROW(read_abaqus("/dev/null", {UnknownCards::refuse}), Error);
}

TEST(AbaqusLines, UnknownKeywordsAreListedWithCountsAndCanBeIgnored) {
  const std::string text =
      abaqus_plate +
      "*TIE, NAME=a\nx, y\n*TIE, NAME=b\nx, y\n*Gap Flow\n*ELEMENT, TYPE=M3D4\n7, 1, 2, 3, 4\n8, 1, 2, 3, 4\n";
  EXPECT_THAT(abaqus_error(text), AllOf(HasSubstr("*TIE (2)"), HasSubstr("*GAP FLOW (1)"),
                                        HasSubstr("*ELEMENT, TYPE=M3D4 (2)"), HasSubstr("unknown: ignore")));
  const AbaqusDeckFile file(text + "*ELSET, ELSET=mixed\n1, 7, 8\n");
  const Deck deck = read_abaqus(file.path(), {UnknownCards::ignore});
  EXPECT_EQ(deck.element_sets.at("mixed").shells, (std::vector<int>{0}));
  ASSERT_EQ(deck.mesh.warnings.size(), 1u);
  EXPECT_THAT(deck.mesh.warnings[0], HasSubstr("*TIE (2)"));
}

TEST(AbaqusLines, ErrorsAreCollectedAndTheirNumberIsBounded) {
  std::string text = "*NODE\n";
  for (int k = 0; k < 500; ++k) text += "x, 0, 0, 0\n";
  const std::string error = abaqus_error(text);
  EXPECT_THAT(error, AllOf(HasSubstr("deck.inp:2"), HasSubstr("deck.inp:51"), HasSubstr("and 450 more errors")));
  EXPECT_LT(std::count(error.begin(), error.end(), '\n'), 60);
}

}  // namespace
}  // namespace tisserand::reducer::abaqus_lines_test
