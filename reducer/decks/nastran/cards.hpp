// First step of a Nastran deck: from the text of the file and its INCLUDEs to cards of fields, each with its line.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "reducer/decks/faults.hpp"

namespace tisserand::reducer {

/// One bulk data entry with its continuations. Its fields stand in NastranCards::fields.
struct NastranCard {
  std::string_view name;    ///< as in the deck, without the * of large fields
  std::size_t first = 0;    ///< row of its first field
  std::uint32_t count = 0;  ///< fields up to the last one that is not blank
  std::uint32_t line = 0;   ///< of its first line, from 1
  std::uint32_t file = 0;   ///< row of NastranCards::files
};

/// Data fields are counted from 0 without the name and without the fields of continuation marks: eight per line of
/// small fields or free field, four per line of large fields. Field 8 is the first one of the second small line.
struct NastranCards {
  std::vector<std::string> files;
  std::vector<std::unique_ptr<std::string>> texts;  ///< what the views point into
  std::vector<NastranCard> cards;
  std::vector<std::string_view> fields;
  bool complete = true;  ///< false: BEGIN BULK without ENDDATA
  bool has_case_control = false;  ///< there is CEND, or a set is selected
  std::map<std::string, std::set<std::string>> selected;  ///< by case control: sets of SPC and MPC

  std::string_view field(const NastranCard& card, int index) const {
    return static_cast<std::uint32_t>(index) < card.count ? fields[card.first + static_cast<std::uint32_t>(index)]
                                                          : std::string_view();
  }
  std::string where(const NastranCard& card) const;
};

/// Reads `path` and what it includes. With BEGIN BULK the cards are what follows it in the same file, and PARAM before it;
/// ENDDATA ends it.
/// Faults of single lines go to `faults`; a file that cannot be read, INCLUDE in a circle (or deeper than 20 levels,
/// more than 2000 files) and more than 4 GiB of text throw Error.
NastranCards read_nastran_cards(const std::string& path, DeckFaults& faults);

/// `text` without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// `text` in capital letters.
std::string capitals(std::string_view text);

/// Whether both are the same text, upper and lower case taken as equal.
bool same_word(std::string_view a, std::string_view b);

}  // namespace tisserand::reducer
