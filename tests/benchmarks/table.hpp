// SPDX-License-Identifier: GPL-3.0-or-later
// Reporter of the benchmarks: one line of markdown per benchmark with its counters, medians where it is repeated.
#pragma once

#include <string>

#include <benchmark/benchmark.h>

namespace tisserand::benchmarks {

class TableReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;

 private:
  std::string columns_;  ///< counters of the table that is being printed
};

}  // namespace tisserand::benchmarks
