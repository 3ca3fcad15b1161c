// SPDX-License-Identifier: GPL-3.0-or-later
// The command `mechanism ledger`: runs the preceding analyses, reads the files and makes the ledger.
#pragma once

#include <string>

#include "mechanism/ledger/ledger.hpp"
#include "mechanism/run/analyses.hpp"

namespace tisserand::mechanism {

/// Ledger of the named analysis (empty: the last dynamics analysis), after the analyses from which it starts.
/// control.clock counts processor time. Throws Error.
Ledger perform_ledger(const formats::Scene& scene, const std::string& analysis, const LedgerSettings& settings,
                      const RunControl& control, const LedgerProgress& progress);

}  // namespace tisserand::mechanism
