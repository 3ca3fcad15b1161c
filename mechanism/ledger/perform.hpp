// The command `mechanism ledger`: analyses before the one that is meant, files, and its ledger.
#pragma once

#include <string>

#include "mechanism/ledger/ledger.hpp"
#include "mechanism/run/analyses.hpp"

namespace tisserand::mechanism {

/// Of the named analysis of the scene (empty: the last of dynamics), after those that it starts from. control.clock
/// counts processor time. Throws Error.
Ledger perform_ledger(const formats::Scene& scene, const std::string& analysis, const LedgerSettings& settings,
                      const RunControl& control, const LedgerProgress& progress);

}  // namespace tisserand::mechanism
