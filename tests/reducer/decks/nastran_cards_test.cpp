// SPDX-License-Identifier: GPL-3.0-or-later
// Nastran decks: fields in every format, continuations, comments, INCLUDE, numbers, unknown cards.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reducer/decks/nastran/cards.hpp"
#include "reducer/decks/nastran/fields.hpp"
#include "tests/reducer/decks/nastran_deck.hpp"

namespace tisserand::testing::nastran_cards_test {
namespace {

using ::testing::HasSubstr;
using namespace reducer;

std::vector<std::string> fields_of(const std::string& text) {
  const DeckFolder folder({{"main.bdf", text}});
  DeckFaults faults;
  const NastranCards cards = read_nastran_cards(folder.main(), faults);
  faults.raise();
  std::vector<std::string> fields{std::string(cards.cards.at(0).name)};
  for (std::uint32_t i = 0; i < cards.cards[0].count; ++i)
    fields.emplace_back(cards.field(cards.cards[0], static_cast<int>(i)));
  return fields;
}

// The example of the manuals: one GRID in each format.
TEST(NastranCards, SmallLargeAndFreeFieldAreTheSame) {
  const std::vector<std::string> expected{"GRID", "2", "", "1.0", "-2.0", "3.0", "", "136"};
  EXPECT_EQ(fields_of("GRID    2               1.0     -2.0    3.0             136\n"), expected);
  EXPECT_EQ(fields_of("GRID,2,,1.0,-2.0,3.0,,136\n"), expected);
  EXPECT_EQ(fields_of("GRID, 2,, 1.0 , -2.0,3.0,,136  $ comment, with commas\r\n"), expected);
  EXPECT_EQ(fields_of("GRID*                  2                             1.0            -2.0*GRID10\n"
                      "*GRID10              3.0                             136\n"),
            expected);
  EXPECT_EQ(fields_of("GRID*                  2                             1.0            -2.0\n"
                      "$ a comment between\n"
                      "*                    3.0                             136\n"),
            expected);
  EXPECT_EQ(fields_of("GRID*,2,,1.0,-2.0,*G1\n*G1,3.0,,136\n"), expected);
  EXPECT_EQ(fields_of("GRID\t2\t\t1.0\t-2.0\t3.0\t\t136\n"), expected);
}

TEST(NastranCards, ContinuationsFillTheSameFields) {
  const std::vector<std::string> expected{"PBAR", "39", "6", "2.9", "", "5.97", "", "", "", "", "", "2.0", "-4.0"};
  EXPECT_EQ(fields_of("PBAR    39      6       2.9             5.97                            +PB1\n"
                      "+PB1                    2.0     -4.0\n"),
            expected);
  EXPECT_EQ(fields_of("PBAR    39      6       2.9             5.97\n                        2.0     -4.0\n"),
            expected);
  EXPECT_EQ(fields_of("PBAR,39,6,2.9,,5.97,,,,+A\n+A,,,2.0,-4.0\n"), expected);
  EXPECT_EQ(fields_of("PBAR,39,6,2.9,,5.97,+\n+,,,2.0,-4.0\n"), expected);
  EXPECT_EQ(fields_of("PBAR,39,6,2.9,,5.97\n,,,2.0,-4.0\n"), expected);
  EXPECT_EQ(fields_of("PBAR*                 39               6             2.9                *\n"
                      "*                   5.97\n"
                      "+                       2.0     -4.0\n"),
            expected);
  EXPECT_EQ(fields_of("PBAR*                 39               6             2.9                *\n"
                      "*                   5.97\n"
                      "*                                                    2.0            -4.0\n"),
            expected);
}

TEST(NastranCards, ContinuationsOutOfPlaceAreFaults) {
  EXPECT_THAT(fault_of("+,1.\n" + bar_deck()), HasSubstr("main.bdf:1: continuation '+' without a card before it"));
  EXPECT_THAT(fault_of("PBAR,1,2,,,,,,,+A\n+B,1.\n" + bar_deck()),
              HasSubstr("main.bdf:2: continuation '+B' follows a line with the mark '+A'"));
  EXPECT_THAT(fault_of("PBAR,1,2,,,,,,,+A,1.\n" + bar_deck()), HasSubstr("more than 10 fields"));
  EXPECT_THAT(fault_of("RBE2,30,3,123,1,2,3,4,5,6\n" + bar_deck()),
              HasSubstr("'6' is in the field of the continuation mark"));
}

TEST(NastranCards, OnlyTheBulkSectionCounts) {
  const Deck deck = read_deck("SOL 103\nCEND\nSPC = 1\ntitle = bars, of steel\nBEGIN BULK\n" + bar_deck() +
                              "ENDDATA\nnothing of this is read\n");
  EXPECT_EQ(deck.mesh.nodes(), 3);
  EXPECT_EQ(deck.mesh.beams.size(), 2u);
}

// PARAM counts wherever it stands, and that of case control before that of the bulk data.
TEST(NastranCards, CaseControlHoldsParametersAndSets) {
  const std::string bulk = "BEGIN BULK\n" + bar_deck() + "CONM2,1,3,,5.\n";
  const auto mass = [&](const std::string& before, const std::string& behind) {
    return read_deck(before + bulk + behind + "ENDDATA\n").mesh.masses.at(0).mass;
  };
  EXPECT_EQ(mass("SOL 103\nCEND\nPARAM,WTMASS,.5\n", ""), 2.5);
  EXPECT_EQ(mass("SOL 103\nCEND\nPARAM,WTMASS,.5\n", "PARAM,WTMASS,.25\n"), 2.5);
  EXPECT_EQ(mass("SOL 103\nCEND\n", "PARAM,WTMASS,.25\n"), 1.25);
  const std::string equations = "MPC,7,1,1,1.,3,1,-1.\nMPC,8,1,2,1.,3,2,-1.\nMPCADD,9,8\nSPC1,4,1,2\n";
  const auto deck = [&](const std::string& before) { return read_deck(before + bulk + equations + "ENDDATA\n"); };
  EXPECT_THAT(fault_of("SOL 103\n" + bulk + equations + "ENDDATA\n"), HasSubstr("the deck has sets 7 and 8 of MPC"));
  const Deck none = deck("SOL 103\nCEND\n");
  EXPECT_EQ(none.mesh.equations.size(), 0u);
  EXPECT_TRUE(warns(none, "sets of MPC that case control does not select are ignored: 7, 8"));
  EXPECT_TRUE(warns(none, "sets of SPC that case control does not select are ignored: 4"));
  EXPECT_EQ(deck("CEND\nMPC = 7\n").mesh.equations.at(0).terms.at(0).component, 0);
  EXPECT_EQ(deck("CEND\nsubcase 1\n  mpc=9 $ of 8\n").mesh.equations.at(0).terms.at(0).component, 1);
  EXPECT_THAT(fault_of("CEND\nSPC=4\n" + bulk + equations + "ENDDATA\n"), HasSubstr("fixes GRID 2 (1) to the ground"));
}

TEST(NastranCards, ReplicationRepeatsTheCardBefore) {
  const Deck deck = read_deck(
      "GRID,1,,0.,0.,0.\n=,*1,=,*10.,==\n=1\n=,*(7),=,30.,*(-2.5),=\n"
      "CBAR,11,5,1,2,0.,1.,0.\n=,*1,=,*1,*1,==\nPBAR,5,7,.02,3.-4,4.-4,5.-4\n"
      "MAT1,7,2.1+11,,.3,7800.\n");
  ASSERT_EQ(deck.mesh.nodes(), 4);
  EXPECT_EQ(deck.mesh.position(0, 2), 20.0);
  EXPECT_EQ(deck.node_of_id.at(10), 3);
  EXPECT_EQ(deck.mesh.position.col(3), Eigen::Vector3d(30, -2.5, 0));
  EXPECT_EQ(deck.mesh.beams.at(1).first, 1);
  EXPECT_EQ(deck.mesh.beams.at(1).second, 2);
  EXPECT_THAT(fault_of("=,1\n" + bar_deck()),
              HasSubstr("main.bdf:1: replication '=' does not follow a card of one line"));
  EXPECT_THAT(fault_of(bar_deck() + "=999999\n"), HasSubstr("replication '=999999' is not understood"));
  EXPECT_THAT(fault_of("GRID,1,,0.,0.,0.\n=,*x,==\n" + bar_deck()), HasSubstr("'x' cannot be added to '1'"));
}

TEST(NastranCards, BlanksWhereFortranAllowsThem) {
  EXPECT_EQ(parse_real("1.0 E+7"), 1e7);
  EXPECT_EQ(parse_real("1.0 +7"), 1e7);
  EXPECT_EQ(parse_real("-2. D -3"), -2e-3);
  EXPECT_EQ(parse_real("1.0 7"), std::nullopt);
  EXPECT_EQ(parse_components("12 3456"), all_components);
  EXPECT_EQ(parse_components("1 1"), std::nullopt);
  EXPECT_EQ(read_deck("  BEGIN BULK\n" + bar_deck() + "   ENDDATA\nnothing of this is read\n").mesh.nodes(), 3);
}

// Numbers of rigid elements and of masses are their own; old decks have 1 or 2 in the place of OFFT.
TEST(NastranCards, OldDecks) {
  const Deck deck = read_deck(
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,4.,0.,0.\nCBAR,1,5,1,2,0.,1.,0.,1\n"
      "PBAR,5,7,.02,3.-4,4.-4,5.-4\nMAT1,7,2.1+11,,.3,7800.\nRBE2,1,2,123456,3\nCONM2,1,3,,2.5\n");
  EXPECT_EQ(deck.mesh.spiders.size(), 1u);
  const Deck rods = read_deck(
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,4.,0.,0.\nCROD,1,5,1,2,2,5,2,3\n"
      "PROD,5,7,.02\nMAT1,7,2.1+11,,.3,7800.\n");
  ASSERT_EQ(rods.mesh.beams.size(), 2u);
  EXPECT_EQ(rods.mesh.beams[1].first, 1);
  EXPECT_EQ(rods.mesh.beams[1].second, 2);
  EXPECT_EQ(deck.mesh.masses.size(), 1u);
  EXPECT_THAT(fault_of(bar_deck() + "CONM2,1,3,,2.5\nCONM2,1,2,,2.5\n"), HasSubstr("element 1 is defined twice"));
  const Deck extra = read_deck(bar_deck() + "CONM2,7,2,0,5.,0.,0.,0.\n,1.,0.,1.,0.,0.,1.,99.\n");
  EXPECT_TRUE(
      warns(extra, "values in fields that the card does not have are ignored: CONM2 7 (line 2, field 8: '99.')"));
}

TEST(NastranCards, IncludeIsRelativeToItsFile) {
  const std::map<std::string, std::string> files{{"main.bdf", "BEGIN BULK\nINCLUDE 'sub/grids.inc'\nENDDATA\n"},
                                                 {"sub/grids.inc", "$ bars\nINCLUDE \"deeper/\n   all.inc\" \n"},
                                                 {"sub/deeper/all.inc", bar_deck()}};
  const DeckFolder folder(files);
  EXPECT_EQ(read_nastran(folder.main(), {}).mesh.beams.size(), 2u);
  auto broken = files;
  broken["sub/deeper/all.inc"] += "CBAR,13,6,2,3,0.,1.,0.\n";
  EXPECT_THAT(fault_of_files(broken),
              HasSubstr("sub/deeper/all.inc:8: CBAR 13: PID names property 6, which is missing"));
  broken["sub/deeper/all.inc"] = "INCLUDE ../../main.bdf $ again\n";
  EXPECT_THAT(fault_of_files(broken), HasSubstr("this file includes itself"));
  broken["sub/deeper/all.inc"] = "INCLUDE 'none.inc'\n";
  EXPECT_THAT(fault_of_files(broken), HasSubstr("none.inc does not exist"));
  EXPECT_THAT(fault_of("INCLUDE '/dev/zero'\n"), HasSubstr("/dev/zero is not a file"));
  EXPECT_THAT(fault_of("INCLUDE 'open\n"), HasSubstr("the closing quote is missing"));
}

TEST(NastranCards, NumbersOfEveryForm) {
  for (const char* text : {"7.0", ".7E1", "0.7+1", ".70+1", "7.E+0", "70.-1", "+7.", "7", "7.D0", "7d0", "0.7E+1"})
    EXPECT_EQ(parse_real(text), 7.0) << text;
  EXPECT_EQ(parse_real("-1.5-3"), -1.5e-3);
  EXPECT_EQ(parse_real("2.1+11"), 2.1e11);
  for (const char* text : {"", "+", "-", ".", "e5", "1.5e", "1.5-", "1..2", "nan", "inf", "-inf", "1e999", "0x10",
                           "1,5", "1.5+3+4", "--1", "+-1", "1.5 3"})
    EXPECT_FALSE(parse_real(text)) << text;
  EXPECT_EQ(parse_integer("-12"), -12);
  for (const char* text : {"", "1.", "1e3", "12345678901234567890", "a"}) EXPECT_FALSE(parse_integer(text)) << text;
  EXPECT_EQ(parse_components("1346"), 0b101101);
  EXPECT_EQ(parse_components("0"), 0);
  for (const char* text : {"7", "11", "1 1", "-1"}) EXPECT_FALSE(parse_components(text)) << text;
}

TEST(NastranCards, FaultsNameFieldAndValueAndComeTogether) {
  const std::string text = fault_of(bar_deck() + "GRID,4,,1.x,0.,0.\nGRID,a\nGRID,3\nCBAR,13,5,2,9,0.,1.,0.\n");
  EXPECT_THAT(text, HasSubstr("main.bdf:8: GRID 4: X1 '1.x' is not a finite number"));
  EXPECT_THAT(text, HasSubstr("main.bdf:9: GRID a: ID 'a' is not a whole number"));
  EXPECT_THAT(text, HasSubstr("main.bdf:10: GRID 3: this grid point is defined twice"));
  EXPECT_THAT(text, HasSubstr("main.bdf:11: CBAR 13: GB names GRID 9, which is missing"));
  std::string many = bar_deck();
  for (int i = 0; i < 80; ++i) many += "GRID,x\n";
  EXPECT_THAT(fault_of(many), HasSubstr("and 30 more errors of this deck"));
}

TEST(NastranCards, UnknownCardsAreCounted) {
  const std::string text = bar_deck() + "CQUAD8,1,1\nCQUAD8,2,1\nRSPLINE,7\nEIGRL,1,,,10\nPARAM,POST,-1\n";
  EXPECT_THAT(fault_of(text), HasSubstr("main.bdf:8: cards that are not understood: CQUAD8 (2), RSPLINE (1)"));
  const DeckFolder folder({{"main.bdf", text}});
  const Deck deck = read_nastran(folder.main(), {UnknownCards::ignore});
  EXPECT_TRUE(warns(deck, "CQUAD8 (2), RSPLINE (1)"));
  EXPECT_TRUE(warns(deck, "EIGRL (1)"));
  EXPECT_TRUE(warns(deck, "PARAM cards without effect on the mesh are ignored: POST"));
}

TEST(NastranCards, DecksCutOffAndOtherFilesAreSuspected) {
  const std::string text = "is the file truncated?";
  EXPECT_TRUE(warns(read_deck("BEGIN BULK\n" + bar_deck()), text));
  EXPECT_FALSE(warns(read_deck("BEGIN BULK\n" + bar_deck() + "ENDDATA\n"), text));
  EXPECT_FALSE(warns(read_deck(bar_deck()), text)) << "bulk data alone";
  EXPECT_EQ(fault_of("ISO-10303-21;\nHEADER;\n"), "main.bdf: the deck has no GRID; name a file with Nastran bulk data");
}

TEST(NastranCards, ElementNumbersAreUnique) {
  EXPECT_THAT(fault_of(bar_deck() + "CBAR,12,5,1,3,0.,1.,0.\n"),
              HasSubstr("main.bdf:8: CBAR 12: element 12 is defined twice, first at main.bdf:5"));
  EXPECT_THAT(fault_of(bar_deck() + "MAT8,7,1.,1.\n"), HasSubstr("material 7 is defined twice"));
  EXPECT_THAT(fault_of(bar_deck() + "PBARL,5,7,,ROD\n,1.\n"), HasSubstr("property 5 is defined twice"));
  EXPECT_THAT(fault_of("PARAM,POST,1\n"), HasSubstr("the deck has no GRID"));
}

}  // namespace
}  // namespace tisserand::testing::nastran_cards_test
