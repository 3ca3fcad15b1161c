// SPDX-License-Identifier: GPL-3.0-or-later
// The command `mechanism ledger`: runs the preceding analyses, reads the files and makes the ledger.
#pragma once

#include <string>

#include "mechanism/ledger/ledger.hpp"
#include "mechanism/run/analyses.hpp"

namespace tisserand::mechanism {

/// Makes the ledger of the named analysis of the scene, after running the analyses from which it starts. `analysis`:
/// its name; empty: the last dynamics analysis. Requires that control.clock counts processor time. Throws Error.
Ledger perform_ledger(const formats::Scene& scene, const std::string& analysis, const LedgerSettings& settings,
                      const RunControl& control, const LedgerProgress& progress);

}  // namespace tisserand::mechanism
