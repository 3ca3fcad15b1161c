// SPDX-License-Identifier: GPL-3.0-or-later
// A ledger as lines of text and as JSON.
#pragma once

#include <string>

#include "mechanism/ledger/ledger.hpp"

namespace tisserand::mechanism {

/// Text of the fraction `part` as a percentage: "7.1 %", "1200 %". It is "less than 1e-6 %" at round-off, and "more
/// than 10000 %" if a motion diverges.
std::string percent_text(double part);

/// Ledger as text: one line per effect and body in the order of the ledger, then the sentences on inertia.
std::string ledger_text(const Ledger& ledger, const Units& units);
/// Ledger as JSON.
std::string ledger_json(const Ledger& ledger);

}  // namespace tisserand::mechanism
