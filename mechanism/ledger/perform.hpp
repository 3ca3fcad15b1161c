// The command `mechanism ledger`: analyses before the one that is meant, files, and the text of its ledger.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanism/ledger/ledger.hpp"

namespace tisserand::mechanism {

/// As the command line has it.
struct LedgerCommand {
  std::string results;  ///< whose instants begin windows; empty: a run of its own
  WindowChoice windows;
  int repeats = 3;
  double least_activity = 0.0;
  std::vector<std::string> channels;
  ToggleChoice choice;
  bool json = false;
};

/// Of the named analysis of the scene (empty: the last of dynamics), after those that it starts from. control.clock
/// counts processor time. Throws Error.
std::string perform_ledger(const formats::Scene& scene, const std::string& analysis, const LedgerCommand& command,
                           const RunControl& control,
                           const std::function<void(double done, const std::string& next)>& progress);

}  // namespace tisserand::mechanism
