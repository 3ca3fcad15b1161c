// The command `mechanism ledger`: analyses before the one that is meant, files, and its ledger.
#pragma once

#include <optional>
#include <string>

#include "mechanism/ledger/ledger.hpp"
#include "mechanism/run/analyses.hpp"

namespace tisserand::mechanism {

/// Whether a run of it makes a ledger: `output: {ledger: yes}` of dynamics.
bool wants_ledger(const PlannedAnalysis& one);

/// Makes the ledger of an analysis that has run from `begin` (absent: the poses of the scene), as by default, and
/// writes it to the JSON file `path`; returns what is told of it. A run that was `restarted` has none. Throws Error.
std::string ledger_beside(const PlannedAnalysis& one, std::optional<State> begin, bool restarted,
                          const std::string& path, const RunControl& control, const LedgerProgress& progress);

/// Of the named analysis of the scene (empty: the last of dynamics), after those that it starts from. control.clock
/// counts processor time. Throws Error.
Ledger perform_ledger(const formats::Scene& scene, const std::string& analysis, const LedgerSettings& settings,
                      const RunControl& control, const LedgerProgress& progress);

}  // namespace tisserand::mechanism
