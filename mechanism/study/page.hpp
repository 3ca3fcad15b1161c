// The picture book of a study: one page that needs nothing else, and its pictures as files.
#pragma once

#include <string>
#include <vector>

#include "mechanism/study/findings.hpp"

namespace tisserand::mechanism {

/// Writes <folder>/index.html with work-precision diagrams (error over CPU time, a line per setting, the Pareto front
/// wide and grey beneath, failures as crosses above), error and time along each axis with the others at their finest,
/// and a table with observed orders; the pictures also as <folder>/<name>.svg. Where gnuplot is missing the page says
/// so. Throws Error.
void write_page(const formats::Study& study, const std::vector<StudyRow>& rows, const std::vector<double>& agreement,
                const std::string& folder);

}  // namespace tisserand::mechanism
