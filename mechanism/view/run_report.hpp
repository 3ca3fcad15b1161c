// SPDX-License-Identifier: GPL-3.0-or-later
// Report of a run as pages show it.
#pragma once

#include "formats/page/page_blocks.hpp"
#include "formats/results/results.hpp"

namespace tisserand::mechanism {

/// Report of a run as JSON {"notes", "doubts", "lines", "phases", "energy", "effects"}, for a page. The lists are empty
/// if the file holds no report or a damaged one.
formats::Json report_of_run(const formats::ResultsReader& reader);

}  // namespace tisserand::mechanism
