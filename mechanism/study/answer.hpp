// SPDX-License-Identifier: GPL-3.0-or-later
// End of a study: files, a summary, and the cheapest setting for a tolerance.
#pragma once

#include <string>
#include <vector>

#include "mechanism/study/campaign.hpp"
#include "mechanism/study/study.hpp"

namespace tisserand::mechanism {

/// Key (SHA-256) of how errors are measured: quantities and reference. Errors with different keys are not compared.
std::string measure_key(const formats::Study& study, const StudyCells& plan);

/// Indices of the quantities of the study with this name; all if `name` is empty. Throws Error if there is none.
std::vector<int> asked_quantities(const formats::Study& study, const std::string& name);

/// Cell of the job number `task`, as a list of one. Throws Error if there is no such number.
std::vector<Cell> task_of(const StudyCells& plan, int task);

/// Throws Error if the journal holds runs, but none of this study. Then its scene has changed, or the journal belongs
/// to another study.
void require_own_runs(const Journal& journal, const StudyCells& plan, const std::string& folder);

/// Writes the tables and the page of a study. Returns a summary for the user. With a tolerance it also writes the scene
/// of the cheapest setting and its results in the format of benchmarks, and returns a text about this setting. Throws
/// Error if nothing completed, or if no setting reaches the tolerance (the message names the best one).
std::string conclude(const Campaign& campaign, const StudyCells& plan, const std::vector<double>& agreement,
                     const StudyRequest& request, const std::vector<int>& quantities);

}  // namespace tisserand::mechanism
