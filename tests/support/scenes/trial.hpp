// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of tests/verification/references/trials, run as the program runs them: all analyses in order.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mechanism/run/report.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::test_support {

/// One scene and the settings of its command line ("parameters.n=40").
class Trial {
 public:
  /// Reads the scene <name>.scene.yaml and runs its analyses. Throws Error as the program would print it.
  explicit Trial(const std::string& name, const std::vector<std::string>& settings = {});

  /// Report of an analysis; the only or last one if `analysis` is empty.
  const mechanism::RunReport& report(const std::string& analysis = "") const;
  /// Values of a channel at all stored instants of that analysis ("nodes/position/cable/10/z").
  std::vector<double> channel(const std::string& name, const std::string& analysis = "") const;
  std::vector<double> time(const std::string& analysis = "") const;
  double last(const std::string& name, const std::string& analysis = "") const {
    return channel(name, analysis).back();
  }
  /// Frequencies of an analysis of modes, ascending as stored.
  std::vector<double> frequencies(const std::string& analysis = "") const;

 private:
  const std::string& chosen(const std::string& analysis) const { return analysis.empty() ? last_ : analysis; }

  TemporaryFolder folder_;
  std::map<std::string, mechanism::RunReport> reports_;
  std::string last_;
};

}  // namespace tisserand::test_support
