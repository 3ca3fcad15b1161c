// SPDX-License-Identifier: GPL-3.0-or-later
// Page of a study, self-contained, with its pictures also as files.
#pragma once

#include <string>
#include <vector>

#include "mechanism/study/findings.hpp"

namespace tisserand::mechanism {

/// Writes the page <folder>/index.html of a study. It shows work-precision diagrams, error and time along each axis
/// with the others at their finest, and a table with observed orders. Diagrams show error over CPU time, with one line
/// per setting. The Pareto front lies beneath, wide and grey; failures are crosses at the top. Pictures are also
/// written to <folder>/<name>.svg. Without gnuplot there are none, and the page says so. `agreement`: error of the
/// second reference against the first, per quantity. Throws Error.
void write_page(const formats::Study& study, const std::vector<StudyRow>& rows, const std::vector<double>& agreement,
                const std::string& folder);

}  // namespace tisserand::mechanism
