// SPDX-License-Identifier: GPL-3.0-or-later
// Prints medians; a new heading whenever the counters differ from those of the line before.
#include "tests/benchmarks/table.hpp"

#include <ostream>

#include <fmt/format.h>

namespace tisserand::benchmarks {

bool TableReporter::ReportContext(const Context&) {
  GetOutputStream() << "CPU time of one core; medians of the repetitions.\n";
  return true;
}

void TableReporter::ReportRuns(const std::vector<Run>& runs) {
  std::ostream& out = GetOutputStream();
  for (const Run& run : runs) {
    if (run.error_occurred) {
      out << fmt::format("| {} | not measured: {} |\n", run.run_name.function_name, run.error_message);
      continue;
    }
    const bool median = run.run_type == Run::RT_Aggregate && run.aggregate_name == "median";
    if (run.repetitions > 1 && !median) continue;
    std::string columns, rule, values;
    for (const auto& [name, counter] : run.counters) {
      columns += " " + name + " |";
      rule += " --: |";
      values += fmt::format(" {:.4g} |", counter.value);
    }
    if (columns != columns_) out << fmt::format("\n| benchmark |{}\n| --- |{}\n", columns, rule);
    columns_ = columns;
    const std::string arguments = run.run_name.args;
    out << fmt::format("| {}{}{} |{}\n", run.run_name.function_name, arguments.empty() ? "" : "/", arguments, values);
  }
  out.flush();
}

}  // namespace tisserand::benchmarks
