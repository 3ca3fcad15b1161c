// SPDX-License-Identifier: GPL-3.0-or-later
// Page of a study, self-contained, with its pictures also as files.
#pragma once

#include <string>
#include <vector>

#include "mechanism/study/findings.hpp"

namespace tisserand::mechanism {

/// Writes <folder>/index.html: work-precision diagrams, error and time along each axis with the others at their finest,
/// and a table with observed orders. Diagrams show error over CPU time, a line per setting, the Pareto front wide and
/// grey beneath, failures as crosses above. Pictures are also <folder>/<name>.svg. Without gnuplot the page says so.
/// Throws Error.
void write_page(const formats::Study& study, const std::vector<StudyRow>& rows, const std::vector<double>& agreement,
                const std::string& folder);

}  // namespace tisserand::mechanism
