// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of a study as a job array of Slurm with one task per setting. Slurm does the scheduling.
#pragma once

#include <string>

#include "mechanism/study/campaign.hpp"

namespace tisserand::mechanism {

/// Text of <folder>/study.slurm: an array over `tasks` settings, each a call of this program with --task.
std::string job_script(const formats::Study& study, const std::string& folder, int tasks);

/// Writes the script, submits it with sbatch and waits until all tasks have ended. Throws Error: Slurm is missing, or
/// rejects the job.
void submit(Campaign& campaign, int tasks);

/// Throws Error with the first tasks without a record, and the place of their logs.
void require_all_recorded(const Campaign& campaign, const std::vector<Cell>& cells);

}  // namespace tisserand::mechanism
