// SPDX-License-Identifier: GPL-3.0-or-later
// Collection of the faults of a deck for one Error.
#include "reducer/decks/faults.hpp"

#include <fmt/format.h>

namespace tisserand::reducer {
namespace {

constexpr std::size_t most_errors = 50;

}  // namespace

void DeckFaults::add(std::string what, std::string where, std::string remedy) {
  if (errors_.size() < most_errors)
    errors_.emplace_back(std::move(what), std::move(where), std::move(remedy));
  else
    ++more_;
}

void DeckFaults::raise() const {
  if (errors_.empty()) return;
  std::vector<Error> errors = errors_;
  if (more_ > 0) errors.emplace_back(fmt::format(fmt::runtime(more_text_), more_), "", "");
  throw merge_errors(errors);
}

}  // namespace tisserand::reducer
