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
  NastranFaults faults;
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
              HasSubstr("main.bdf:2: continuation '+B' follows a line that asks for '+A'"));
  EXPECT_THAT(fault_of("PBAR,1,2,,,,,,,+A,1.\n" + bar_deck()), HasSubstr("more than 10 fields"));
  EXPECT_THAT(fault_of("RBE2,30,3,123,1,2,3,4,5,6\n" + bar_deck()),
              HasSubstr("'6' stands where a continuation mark belongs"));
}

TEST(NastranCards, OnlyTheBulkSectionCounts) {
  const Deck deck = read_deck("SOL 103\nCEND\nSPC = 1\ntitle = bars, of steel\nBEGIN BULK\n" + bar_deck() +
                              "ENDDATA\nnothing of this is read\n");
  EXPECT_EQ(deck.mesh.nodes(), 3);
  EXPECT_EQ(deck.mesh.beams.size(), 2u);
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
  EXPECT_THAT(fault_of_files(broken), HasSubstr("goes in a circle"));
  broken["sub/deeper/all.inc"] = "INCLUDE 'none.inc'\n";
  EXPECT_THAT(fault_of_files(broken), HasSubstr("none.inc does not exist"));
  EXPECT_THAT(fault_of("INCLUDE '/dev/zero'\n"), HasSubstr("/dev/zero is not a file"));
  EXPECT_THAT(fault_of("INCLUDE 'open\n"), HasSubstr("no closing quote"));
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
  for (const char* text : {"7", "11", "1 2", "-1"}) EXPECT_FALSE(parse_components(text)) << text;
}

TEST(NastranCards, FaultsNameFieldAndValueAndComeTogether) {
  const std::string text = fault_of(bar_deck() + "GRID,4,,1.x,0.,0.\nGRID,a\nGRID,3\nCBAR,13,5,2,9,0.,1.,0.\n");
  EXPECT_THAT(text, HasSubstr("main.bdf:8: GRID 4: X1 '1.x' is not a finite number"));
  EXPECT_THAT(text, HasSubstr("main.bdf:9: GRID a: ID 'a' is not a whole number"));
  EXPECT_THAT(text, HasSubstr("main.bdf:10: GRID 3: this grid point is given twice"));
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
  EXPECT_TRUE(warns(deck, "PARAM without effect here: POST"));
}

TEST(NastranCards, DecksCutOffAndOtherFilesAreSuspected) {
  const std::string text = "cut off";
  EXPECT_TRUE(warns(read_deck("BEGIN BULK\n" + bar_deck()), text));
  EXPECT_FALSE(warns(read_deck("BEGIN BULK\n" + bar_deck() + "ENDDATA\n"), text));
  EXPECT_FALSE(warns(read_deck(bar_deck()), text)) << "bulk data alone";
  EXPECT_EQ(fault_of("ISO-10303-21;\nHEADER;\n"),
            "main.bdf: no GRID in the deck, which begins with 'ISO-1030'; name a file with Nastran bulk data");
}

TEST(NastranCards, ElementNumbersAreUnique) {
  EXPECT_THAT(fault_of(bar_deck() + "CONM2,12,1,,5.\n"),
              HasSubstr("main.bdf:8: CONM2 12: element 12 is given twice, first at main.bdf:5"));
  EXPECT_THAT(fault_of(bar_deck() + "MAT8,7,1.,1.\n"), HasSubstr("material 7 is given twice"));
  EXPECT_THAT(fault_of(bar_deck() + "PBARL,5,7,,ROD\n,1.\n"), HasSubstr("property 5 is given twice"));
  EXPECT_THAT(fault_of("PARAM,POST,1\n"), HasSubstr("no GRID in the deck"));
}

}  // namespace
}  // namespace tisserand::testing::nastran_cards_test
