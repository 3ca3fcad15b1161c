// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of the runs of a study for other programs.
#pragma once

#include <string>
#include <vector>

#include "mechanism/study/findings.hpp"

namespace tisserand::mechanism {

/// Table with a line per setting: series, its axes (empty if another series has none), outcome, CPU seconds (median,
/// confidence interval, repeats), coordinates, steps, iterations, error and order of each quantity, message.
std::string csv_text(const formats::Study& study, const std::vector<StudyRow>& rows);

/// Table as JSON, with the agreement of two references.
std::string json_text(const formats::Study& study, const std::vector<StudyRow>& rows,
                      const std::vector<double>& agreement);

/// Solution of a benchmark problem in the format of the IFToMM library: results over time in columns, after lines with
/// one number of accuracy and one time.
std::string benchmark_text(const formats::Study& study, const StudyRow& row, const std::vector<Series>& histories);

/// Summary at the end of the command: counts of settings, agreement of references, Pareto fronts.
std::string summary_text(const formats::Study& study, const std::vector<StudyRow>& rows,
                         const std::vector<double>& agreement);

}  // namespace tisserand::mechanism
