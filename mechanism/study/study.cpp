// SPDX-License-Identifier: GPL-3.0-or-later
// Sequence of calls of a study.
#include "mechanism/study/study.hpp"

#include <filesystem>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "common/text.hpp"
#include "mechanism/study/answer.hpp"
#include "mechanism/study/cluster.hpp"
#include "mechanism/study/page.hpp"
#include "mechanism/study/tables.hpp"

namespace tisserand::mechanism {
namespace {

std::string folder_of(const StudyRequest& request) {
  if (!request.folder.empty()) return request.folder;
  return (std::filesystem::path(request.file).parent_path() / (stem(request.file) + ".study")).string();
}

}  // namespace

std::string perform_study(const StudyRequest& request, const StudyControl& control) {
  const formats::Study study = formats::read_study(request.file);
  const std::string folder = folder_of(request);
  const StudyCells plan = plan_cells(study, folder);
  const std::vector<int> quantities = asked_quantities(study, request.quantity);
  Journal journal(folder, request.task ? fmt::format(".{}", *request.task) : "", measure_key(study, plan));
  require_own_runs(journal, plan, folder);
  Campaign campaign{study, folder, journal, control};

  const ReferenceHistories reference = make_reference(campaign, plan.references);
  if (control.interrupted && control.interrupted()) return "interrupted: run the same command to continue\n";
  if (request.task) {
    run_cells(campaign, task_of(plan, *request.task), reference);
    return "";
  }
  if (request.place == StudyPlace::slurm) {
    make_all_parts(campaign, plan.cells);
    submit(campaign, count_of(plan.cells));
    Journal collected(folder, "", measure_key(study, plan));
    const Campaign all{study, folder, collected, control};
    require_all_recorded(all, plan.cells);
    return conclude(all, plan, reference.agreement, request, quantities);
  }
  run_cells(campaign, plan.cells, reference);
  return conclude(campaign, plan, reference.agreement, request, quantities);
}

}  // namespace tisserand::mechanism
