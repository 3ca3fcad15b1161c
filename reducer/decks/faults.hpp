// SPDX-License-Identifier: GPL-3.0-or-later
// Collection of the faults of a deck for one Error.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "common/error.hpp"

namespace tisserand::reducer {

/// Collection of the faults of a deck for one Error. Faults after the first 50 are only counted.
class DeckFaults {
 public:
  /// Begins the collection. `more`: text, with {} for a number, for the faults that were only counted.
  explicit DeckFaults(std::string more = "and {} more errors of this deck") : more_text_(std::move(more)) {}
  void add(std::string what, std::string where, std::string remedy);
  bool empty() const { return errors_.empty(); }

  /// Throws all collected faults as one Error, if there are any.
  void raise() const;

 private:
  std::string more_text_;
  std::vector<Error> errors_;
  std::size_t more_ = 0;
};

}  // namespace tisserand::reducer
