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

/// Integer of up to 18 digits. Empty for any other text.
std::optional<long> parse_integer(std::string_view text);

/// A finite number: 7.0, .7, 7., 0.7E1, 70.-1, 7.+2, 7D3; also 7 without a point, and blanks before and in the
/// exponent. Empty for any other text.
std::optional<double> parse_real(std::string_view text);

/// Whether the text is written as a real number, with a point or an exponent.
bool is_real(std::string_view text);

/// Digits 1 to 6, each at most once, blanks between them, as bits 0 to 5; 0 alone is none. Empty for any other text.
std::optional<Components> parse_components(std::string_view text);

/// Access to the fields of a card. A fault is added once and clears ok(). Positions as in NastranCards.
class CardFields {
 public:
  CardFields(const NastranCards& cards, const NastranCard& card, DeckFaults& faults)
      : cards_(&cards), card_(&card), faults_(&faults) {}

  bool blank(int index) const { return text(index).empty(); }
  std::string_view text(int index) const { return cards_->field(*card_, index); }
  int size() const { return static_cast<int>(card_->count); }

  /// Required number greater than 0, for ids of every kind. 0 after a fault.
  long id(int index, std::string_view name);

  /// Id that may be blank or 0 (both give 0).
  long id_or_none(int index, std::string_view name);
  long integer(int index, std::string_view name, long if_blank);

  /// Real number; NaN after a fault.
  double real(int index, std::string_view name);
  double real(int index, std::string_view name, double if_blank);
  Components components(int index, std::string_view name, Components if_blank);
  Eigen::Vector3d vector(int index, std::string_view name);  ///< blanks are 0

  /// Ids from `index` on. Blanks are skipped; "a THRU b" stands for the numbers in this range that `known` accepts.
  template <class Known>
  std::vector<long> id_list(int index, std::string_view name, const Known& known);

  /// Card with its first field, "CQUAD4 17".
  std::string label() const;
  std::string where() const { return cards_->where(*card_); }
  const NastranCard& card() const { return *card_; }
  bool ok() const { return ok_; }
  void mark_faulty() { ok_ = false; }  ///< after a fault that the caller adds itself
  void fault(const std::string& what, const std::string& remedy);
  /// Adds the fault and returns nothing, for functions that end with it.
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
