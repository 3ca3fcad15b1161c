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

/// Bulk data entry of a deck with its continuations. Its fields are in NastranCards::fields.
struct NastranCard {
  std::string_view name;    ///< name as in the deck, without the * of large fields
  std::size_t first = 0;    ///< index of its first field
  std::uint32_t count = 0;  ///< number of fields up to the last one that is not blank
  std::uint32_t line = 0;   ///< number of its first line, from 1
  std::uint32_t file = 0;   ///< index in NastranCards::files
};

/// Bulk data entries of a deck and its included files. Data fields of an entry are counted from 0, without the name
/// and without the fields of continuation marks. A line has eight of them in small or free field, four in large field.
/// So field 8 is the first one of the second small line.
struct NastranCards {
  std::vector<std::string> files;
  std::vector<std::unique_ptr<std::string>> texts;  ///< texts to which the views point
  std::vector<NastranCard> cards;
  std::vector<std::string_view> fields;
  bool complete = true;           ///< false: BEGIN BULK without ENDDATA
  bool has_case_control = false;  ///< CEND is present, or a set is selected
  /// Sets of SPC and MPC that case control selects; key: "SPC" or "MPC".
  std::map<std::string, std::set<std::string>> selected;

  std::string_view field(const NastranCard& card, int index) const {
    return static_cast<std::uint32_t>(index) < card.count ? fields[card.first + static_cast<std::uint32_t>(index)]
                                                          : std::string_view();
  }
  std::string where(const NastranCard& card) const;
};

/// Reads the cards of `path` and its included files. With BEGIN BULK only the cards after it in its file up to
/// ENDDATA, and PARAM before it, are read. Faults of single lines go to `faults`. Throws Error for a file that cannot
/// be read, and for more than 4 GiB of text. It also throws for a circular INCLUDE, one deeper than 20 levels, and
/// more than 2000 files.
NastranCards read_nastran_cards(const std::string& path, DeckFaults& faults);

/// Text `text` without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// Text `text` in upper case.
std::string capitals(std::string_view text);

/// Whether both texts are equal, apart from upper and lower case.
bool same_word(std::string_view a, std::string_view b);

}  // namespace tisserand::reducer
