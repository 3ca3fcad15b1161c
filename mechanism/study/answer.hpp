// What a study ends with: files, a summary, and the cheapest setting for a tolerance.
#pragma once

#include <string>
#include <vector>

#include "mechanism/study/campaign.hpp"
#include "mechanism/study/study.hpp"

namespace tisserand::mechanism {

/// What errors mean: quantities, reference and version; results that were measured otherwise do not mix.
std::string measure_key(const formats::Study& study, const StudyCells& plan);

/// Indices of the quantities that `name` means; empty: all. Throws Error.
std::vector<int> asked_quantities(const formats::Study& study, const std::string& name);

/// The setting of one job. Throws Error if there is none of that number.
std::vector<Cell> task_of(const StudyCells& plan, int task);

/// Throws Error if the journal holds runs, but none of this study: its scene has changed, or it is another one.
void require_own_runs(const Journal& journal, const StudyCells& plan, const std::string& folder);

/// Writes tables and page; with a tolerance also the scene of the cheapest setting and its results in the format of
/// benchmarks. Throws Error: nothing completed, no setting reaches the tolerance (what the best one does).
std::string conclude(const Campaign& campaign, const StudyCells& plan, const std::vector<double>& agreement,
                     const StudyRequest& request, const std::vector<int>& quantities);

}  // namespace tisserand::mechanism
