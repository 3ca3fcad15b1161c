// A ledger as lines and as JSON.
#pragma once

#include <string>

#include "mechanism/ledger/ledger.hpp"

namespace tisserand::mechanism {

/// "7.1 %"; "less than 1e-6 %" of what round-off makes; "1200 %"; "more than 10000 %" of what runs away.
std::string percent_text(double part);

/// One line of words per effect and body, the largest change first, then the verdicts on inertia.
std::string ledger_text(const Ledger& ledger, const Units& units);
std::string ledger_json(const Ledger& ledger);

}  // namespace tisserand::mechanism
