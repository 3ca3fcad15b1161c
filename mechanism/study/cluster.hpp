// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of a study as a job array of Slurm with one task per setting. Slurm does the scheduling.
#pragma once

#include <string>

#include "mechanism/study/campaign.hpp"

namespace tisserand::mechanism {

/// Text of the script <folder>/study.slurm for a job array over `tasks` settings. Each task is a call of this program
/// with --task.
std::string job_script(const formats::Study& study, const std::string& folder, int tasks);

/// Writes the script, submits it with sbatch and waits until all tasks have ended. Throws Error if Slurm is missing or
/// rejects the job.
void submit(Campaign& campaign, int tasks);

/// Throws Error if cells have no record in the journal. The message names the first tasks without a record, and the
/// folder of their logs.
void require_all_recorded(const Campaign& campaign, const std::vector<Cell>& cells);

}  // namespace tisserand::mechanism
