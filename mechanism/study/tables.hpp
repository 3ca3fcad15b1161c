// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of the runs of a study for other programs.
#pragma once

#include <string>
#include <vector>

#include "mechanism/study/findings.hpp"

namespace tisserand::mechanism {

/// Table of a study as CSV, with a line per setting. Columns are series, its axes (empty if another series has none),
/// outcome, CPU seconds (median, confidence interval, repeats), coordinates, steps and iterations. Error and order of
/// each quantity and the message follow.
std::string csv_text(const formats::Study& study, const std::vector<StudyRow>& rows);

/// Table of a study as JSON. `agreement`: error of the second reference against the first, per quantity.
std::string json_text(const formats::Study& study, const std::vector<StudyRow>& rows,
                      const std::vector<double>& agreement);

/// Solution of a benchmark problem in the format of the IFToMM library. The results over time are in columns, after
/// lines with one number for the accuracy and one for the time.
std::string benchmark_text(const formats::Study& study, const StudyRow& row, const std::vector<Series>& histories);

/// Summary of a study at the end of the command: counts of settings, agreement of references, Pareto fronts.
std::string summary_text(const formats::Study& study, const std::vector<StudyRow>& rows,
                         const std::vector<double>& agreement);

}  // namespace tisserand::mechanism
