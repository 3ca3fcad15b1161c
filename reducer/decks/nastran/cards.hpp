// SPDX-License-Identifier: GPL-3.0-or-later
// First step of a Nastran deck: cards of fields with line numbers, from the text of the file and its INCLUDEs.
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

/// One bulk data entry with its continuations. Its fields are in NastranCards::fields.
struct NastranCard {
  std::string_view name;    ///< as in the deck, without the * of large fields
  std::size_t first = 0;    ///< index of its first field
  std::uint32_t count = 0;  ///< fields up to the last one that is not blank
  std::uint32_t line = 0;   ///< number of its first line, from 1
  std::uint32_t file = 0;   ///< index in NastranCards::files
};

/// Data fields are counted from 0 without the name and without the fields of continuation marks: eight per line of
/// small fields or free field, four per line of large fields. Field 8 is the first one of the second small line.
struct NastranCards {
  std::vector<std::string> files;
  std::vector<std::unique_ptr<std::string>> texts;  ///< texts to which the views point
  std::vector<NastranCard> cards;
  std::vector<std::string_view> fields;
  bool complete = true;  ///< false: BEGIN BULK without ENDDATA
  bool has_case_control = false;                          ///< CEND is present, or a set is selected
  std::map<std::string, std::set<std::string>> selected;  ///< sets of SPC and MPC that case control selects

  std::string_view field(const NastranCard& card, int index) const {
    return static_cast<std::uint32_t>(index) < card.count ? fields[card.first + static_cast<std::uint32_t>(index)]
                                                          : std::string_view();
  }
  std::string where(const NastranCard& card) const;
};

/// Reads `path` and its included files. With BEGIN BULK the cards are those after it in the same file, and PARAM before
/// it; ENDDATA ends it. Faults of single lines go to `faults`. Throws Error for a file that cannot be read, circular
/// INCLUDE (or deeper than 20 levels, more than 2000 files), and more than 4 GiB of text.
NastranCards read_nastran_cards(const std::string& path, DeckFaults& faults);

/// `text` without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// `text` in upper case.
std::string capitals(std::string_view text);

/// Whether both texts are equal, ignoring case.
bool same_word(std::string_view a, std::string_view b);

}  // namespace tisserand::reducer
