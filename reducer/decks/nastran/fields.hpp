// SPDX-License-Identifier: GPL-3.0-or-later
// Second step of a Nastran deck: numbers from the fields of a card, with faults that name card, field and value.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reducer/decks/nastran/cards.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Integer that the text holds, of up to 18 digits. Returns nothing for any other text.
std::optional<long> parse_integer(std::string_view text);

/// Finite number that the text holds: 7.0, .7, 7., 0.7E1, 70.-1, 7.+2, 7D3. 7 without a point, and blanks before and
/// in the exponent are also allowed. Returns nothing for any other text.
std::optional<double> parse_real(std::string_view text);

/// Whether the text is written as a real number, with a point or an exponent.
bool is_real(std::string_view text);

/// Set of components from the digits 1 to 6, which become the bits 0 to 5. Each digit may occur once, with blanks
/// between them. 0 alone means no component. Returns nothing for any other text.
std::optional<Components> parse_components(std::string_view text);

/// Reader of the fields of one card as numbers. A fault is added to the faults of the deck and clears ok(). After
/// that, no further fault of a field is added. Fields are counted as in NastranCards.
class CardFields {
 public:
  CardFields(const NastranCards& cards, const NastranCard& card, DeckFaults& faults)
      : cards_(&cards), card_(&card), faults_(&faults) {}

  bool blank(int index) const { return text(index).empty(); }
  std::string_view text(int index) const { return cards_->field(*card_, index); }
  int size() const { return static_cast<int>(card_->count); }

  /// Number greater than 0 that identifies something, in a field that must not be blank. Returns 0 after a fault.
  /// `name`: name of the field for the message.
  long id(int index, std::string_view name);

  /// Number that identifies something, or 0 if the field is blank or 0.
  long id_or_none(int index, std::string_view name);
  long integer(int index, std::string_view name, long if_blank);

  /// Real number in a field that must not be blank. Returns NaN after a fault.
  double real(int index, std::string_view name);
  double real(int index, std::string_view name, double if_blank);
  Components components(int index, std::string_view name, Components if_blank);
  Eigen::Vector3d vector(int index, std::string_view name);  ///< vector in three fields; blanks are 0

  /// Identifying numbers in the fields from `index` on, without blanks. "a THRU b" stands for the numbers of this
  /// range that exist: known(a, b, ids) must append these to `ids`.
  template <class Known>
  std::vector<long> id_list(int index, std::string_view name, const Known& known);

  /// Name of the card with its first field for messages, such as "CQUAD4 17".
  std::string label() const;
  std::string where() const { return cards_->where(*card_); }
  const NastranCard& card() const { return *card_; }
  bool ok() const { return ok_; }
  void mark_faulty() { ok_ = false; }  ///< clears ok() after a fault that the caller adds itself
  void fault(const std::string& what, const std::string& remedy);
  /// Adds the fault and returns nothing, as the return value of functions that end with this fault.
  std::nullopt_t refuse(const std::string& what, const std::string& remedy) {
    fault(what, remedy);
    return std::nullopt;
  }

 private:
  void field_fault(int index, std::string_view name, std::string_view what, std::string_view remedy);
  bool thru(int index, std::string_view name, long& first, long& last);

  const NastranCards* cards_;
  const NastranCard* card_;
  DeckFaults* faults_;
  bool ok_ = true;
};

template <class Known>
std::vector<long> CardFields::id_list(int index, std::string_view name, const Known& known) {
  std::vector<long> ids;
  for (int i = index; i < size() && ok_; ++i) {
    if (blank(i)) continue;
    if (same_word(text(i + 1), "THRU")) {
      long first = 0, last = 0;
      if (!thru(i, name, first, last)) break;
      known(first, last, ids);
      i += 2;
    } else {
      ids.push_back(id(i, name));
    }
  }
  return ids;
}

}  // namespace tisserand::reducer
