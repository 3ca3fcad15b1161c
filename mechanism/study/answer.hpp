// SPDX-License-Identifier: GPL-3.0-or-later
// End of a study: files, a summary, and the cheapest setting for a tolerance.
#pragma once

#include <string>
#include <vector>

#include "mechanism/study/campaign.hpp"
#include "mechanism/study/study.hpp"

namespace tisserand::mechanism {

/// Key of how errors are measured: quantities, reference and version. Results measured differently do not mix.
std::string measure_key(const formats::Study& study, const StudyCells& plan);

/// Indices of the quantities with this name; empty: all. Throws Error.
std::vector<int> asked_quantities(const formats::Study& study, const std::string& name);

/// Setting of one job. Throws Error if there is none of that number.
std::vector<Cell> task_of(const StudyCells& plan, int task);

/// Throws Error if the journal holds runs, but none of this study: its scene has changed, or it is another study.
void require_own_runs(const Journal& journal, const StudyCells& plan, const std::string& folder);

/// Writes tables and page. With a tolerance it also writes the scene of the cheapest setting, and its results in the
/// format of benchmarks. Throws Error: nothing completed, or no setting reaches the tolerance (with the best one).
std::string conclude(const Campaign& campaign, const StudyCells& plan, const std::vector<double>& agreement,
                     const StudyRequest& request, const std::vector<int>& quantities);

}  // namespace tisserand::mechanism
