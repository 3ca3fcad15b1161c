// SPDX-License-Identifier: GPL-3.0-or-later
// Job script, and sbatch as a child process.
#include "mechanism/study/cluster.hpp"

#include <cmath>
#include <filesystem>

#include "common/child.hpp"
#include "common/error.hpp"
#include "common/program/version.hpp"
#include "common/text.hpp"

namespace tisserand::mechanism {
namespace {

namespace fs = std::filesystem;

/// Text quoted as one word of a shell.
std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::string job_script(const formats::Study& study, const std::string& folder, int tasks) {
  const std::string path = fs::absolute(folder).string();
  std::string text =
      "#!/bin/sh\n# " + producer("mechanism") + "\n#SBATCH --job-name=study\n#SBATCH --cpus-per-task=1\n";
  text += fmt::format("#SBATCH --array=0-{}\n#SBATCH --output=\"{}/slurm/%a.log\"\n", tasks - 1, path);
  if (study.run_budget > 0.0)  // all repeats of a setting, and the start
    text +=
        fmt::format("#SBATCH --time={}\n", static_cast<int>(std::ceil(study.run_budget * study.repeats / 60.0)) + 1);
  return text + fmt::format("exec {} study {} -o {} --task \"$SLURM_ARRAY_TASK_ID\"\n", shell_quoted(own_program()),
                            shell_quoted(fs::absolute(study.file).string()), shell_quoted(path));
}

void submit(Campaign& campaign, int tasks) {
  if (!is_program("sbatch"))
    throw Error("Slurm is missing: there is no program sbatch", "--slurm",
                "run this command on a machine that can submit jobs, or omit --slurm");
  fs::create_directories(campaign.folder + "/slurm");
  const std::string script = campaign.folder + "/study.slurm";
  write_text_file(script, job_script(campaign.study, campaign.folder, tasks));
  ChildRequest request;
  request.words = {"sbatch", "--wait", script};
  request.is_stopped = campaign.control.interrupted;
  const ChildReport report = run_child(request);
  // With --wait the code is the greatest one of the tasks. Their results are in their journals.
  if (report.ending == ChildEnding::left && report.text.find("Submitted batch job") == std::string::npos)
    throw Error(fmt::format("sbatch failed: {}", printable_line(report.complaint, 500)), script,
                "check the limits of the cluster");
}

void require_all_recorded(const Campaign& campaign, const std::vector<Cell>& cells) {
  std::vector<std::string> lost;
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (campaign.journal.runs(cells[k].key).empty()) lost.push_back(fmt::format("{} ({})", k, cells[k].label));
  if (lost.empty()) return;
  throw Error(fmt::format("{} of {} jobs ended without a result: tasks {}", lost.size(), cells.size(), listed(lost)),
              campaign.folder + "/slurm",
              "read <task>.log there; run the same command to submit them again, or without --slurm to run them here");
}

}  // namespace tisserand::mechanism
