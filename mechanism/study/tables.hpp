// The runs of a study as tables for other programs.
#pragma once

#include <string>
#include <vector>

#include "mechanism/study/findings.hpp"

namespace tisserand::mechanism {

/// A line per setting: series, its axes (empty where another series has none), outcome, CPU seconds (median, the
/// interval in which it lies, repeats), coordinates, steps, iterations, error and order of each quantity, message.
std::string csv_text(const formats::Study& study, const std::vector<StudyRow>& rows);

/// The same as JSON, with agreement of two references.
std::string json_text(const formats::Study& study, const std::vector<StudyRow>& rows,
                      const std::vector<double>& agreement);

/// One solution of a benchmark problem as the IFToMM library compares them: results over time in columns, after lines
/// with one number of accuracy and one time.
std::string benchmark_text(const formats::Study& study, const StudyRow& row, const std::vector<Series>& histories);

/// "1 of 3 runs failed" and the like: what the command says at its end.
std::string summary_text(const formats::Study& study, const std::vector<StudyRow>& rows,
                         const std::vector<double>& agreement);

}  // namespace tisserand::mechanism
