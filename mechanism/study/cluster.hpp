// The runs of a study as a job array of Slurm: one task per setting; nothing here schedules.
#pragma once

#include <string>

#include "mechanism/study/campaign.hpp"

namespace tisserand::mechanism {

/// The text of <folder>/study.slurm: an array over `tasks` settings, each a call of this program with --task.
std::string job_script(const formats::Study& study, const std::string& folder, int tasks);

/// Writes the script, submits it with sbatch and waits until all tasks have ended. Throws Error: Slurm is missing or
/// refuses.
void submit(Campaign& campaign, int tasks);

/// Throws Error with the first tasks of which nothing was recorded, and where they would have said why.
void require_all_recorded(const Campaign& campaign, const std::vector<Cell>& cells);

}  // namespace tisserand::mechanism
