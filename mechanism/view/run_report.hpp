// The report of a run as pages show it.
#pragma once

#include "formats/results/results.hpp"
#include "mechanism/view/page_blocks.hpp"

namespace tisserand::mechanism {

/// {"notes", "doubts", "lines", "phases", "energy", "effects"}; empty lists where the file holds no report or a damaged
/// one.
Json report_of_run(const formats::ResultsReader& reader);

}  // namespace tisserand::mechanism
