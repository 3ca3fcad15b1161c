// SPDX-License-Identifier: GPL-3.0-or-later
// Files and messages at the end of a study.
#include "mechanism/study/answer.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "common/program/version.hpp"
#include "common/sha256.hpp"
#include "common/text.hpp"
#include "formats/scene/expand/tree.hpp"
#include "formats/scene/fields.hpp"
#include "mechanism/study/findings.hpp"
#include "mechanism/study/page.hpp"
#include "mechanism/study/tables.hpp"

namespace tisserand::mechanism {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void nothing_completed(const formats::Study& study, const std::vector<StudyRow>& rows) {
  for (const StudyRow& row : rows)
    if (row.has_run && row.outcome == CellOutcome::failed)
      throw Error(fmt::format("no run completed; '{}': {}", row.cell->label, row.message), study.file,
                  "correct the cause, then choose another folder with -o, or remove this one");
  throw Error("no run completed within its budget", study.file, "increase 'run_budget'");
}

/// Writes the scene of a setting into the folder of its original scene. Returns the path.
std::string write_scene(const formats::Study& study, const Cell& cell, double tolerance) {
  const std::string& base = study.series[cell.series].scene;
  const fs::path folder = fs::path(base).parent_path();
  std::vector<formats::Override> settings = cell.settings;
  for (const PartRequest& part : cell.parts)
    for (formats::Override& one : settings)
      if (one.value == part.superelement) one.value = fs::proximate(part.superelement, fs::absolute(folder)).string();
  const std::string path = (folder / fmt::format("{}_{:g}.scene.yaml", stem(study.file), tolerance)).string();
  write_text_file(path, fmt::format("# {}, {}, by {}\n{}", study.name, cell.label, producer("mechanism"),
                                    formats::scene_text(base, settings, formats::scene_key_sets())));
  return path;
}

std::string answer(const Campaign& campaign, const std::vector<StudyRow>& rows, const StudyRequest& request,
                   const std::vector<int>& quantities) {
  const formats::Study& study = campaign.study;
  const double tolerance = *request.tolerance;
  const int chosen = cheapest(rows, lines_of(study, rows), quantities, tolerance);
  if (chosen < 0) {
    double least = std::numeric_limits<double>::infinity();
    const StudyRow* best = nullptr;
    for (const StudyRow& row : rows) {
      if (!row.is_measured()) continue;
      if (const double worst = row.worst_error(quantities); worst < least) least = worst, best = &row;
    }
    throw Error(fmt::format("no setting keeps its error and those of all finer settings within {:g}; the smallest "
                            "error is {:.2e}, of '{}'",
                            tolerance, least, best == nullptr ? "" : best->cell->label),
                study.file, "refine the axes, or allow a larger error");
  }
  const StudyRow& row = rows[chosen];
  const std::string scene = write_scene(study, *row.cell, tolerance);
  const std::string benchmark = fmt::format("{}/benchmark_{:g}.txt", campaign.folder, tolerance);
  write_text_file(benchmark, benchmark_text(study, row, histories_of(campaign, *row.cell)));
  return fmt::format("{:g}: {}, error {:.1e} in {:.3g} s [{:.3g}, {:.3g}]; scene {}\n", tolerance, row.cell->label,
                     row.worst_error(quantities), row.time.median, row.time.least, row.time.greatest, scene);
}

}  // namespace

std::string measure_key(const formats::Study& study, const StudyCells& plan) {
  std::string text;
  for (const formats::StudyQuantity& quantity : study.quantities)
    text += fmt::format("{} {} {} {} {}\n", quantity.name, static_cast<int>(quantity.norm),
                        quantity.from.value_or(-1e300), quantity.to.value_or(1e300), quantity.scale.value_or(0.0));
  for (const Cell& cell : plan.references) text += cell.key + "\n";
  if (!study.reference.file.empty()) {
    std::ifstream file(study.reference.file, std::ios::binary);
    text += sha256_hex({std::istreambuf_iterator<char>(file), {}}) + study.reference.time;
    for (const auto& [quantity, column] : study.reference.columns) text += quantity + " " + column + "\n";
  }
  return sha256_hex(text);
}

std::vector<int> asked_quantities(const formats::Study& study, const std::string& name) {
  std::vector<int> indices;
  std::vector<std::string> names;
  for (int q = 0; q < std::ssize(study.quantities); ++q) {
    names.push_back(study.quantities[q].name);
    if (name.empty() || names.back() == name) indices.push_back(q);
  }
  if (indices.empty())
    throw Error(fmt::format("there is no quantity '{}'", name), "--of",
                fmt::format("the quantities are {}", listed(names)));
  return indices;
}

std::vector<Cell> task_of(const StudyCells& plan, int task) {
  if (task < 0 || task >= count_of(plan.cells))
    throw Error(fmt::format("there is no setting {}", task), "--task",
                fmt::format("give a number from 0 to {}", plan.cells.size() - 1));
  return {plan.cells[task]};
}

void require_own_runs(const Journal& journal, const StudyCells& plan, const std::string& folder) {
  const std::vector<std::string> recorded = journal.keys();
  const std::set<std::string> known(recorded.begin(), recorded.end());
  const auto is_recorded = [&](const Cell& cell) { return known.contains(cell.key); };
  if (known.empty() || std::ranges::any_of(plan.cells, is_recorded)) return;
  throw Error("the folder holds results of another scene, or of this one before it was changed", folder,
              "choose another folder with -o, or remove this one");
}

std::string conclude(const Campaign& campaign, const StudyCells& plan, const std::vector<double>& agreement,
                     const StudyRequest& request, const std::vector<int>& quantities) {
  const formats::Study& study = campaign.study;
  const std::vector<StudyRow> rows = rows_of(study, plan, campaign.journal);
  write_text_file(campaign.folder + "/table.csv", csv_text(study, rows));
  write_text_file(campaign.folder + "/table.json", json_text(study, rows, agreement));
  write_page(study, rows, agreement, campaign.folder);
  if (campaign.control.interrupted && campaign.control.interrupted())
    return summary_text(study, rows, agreement) + "interrupted: run the same command to continue\n";
  if (std::ranges::none_of(rows, &StudyRow::is_measured)) nothing_completed(study, rows);
  if (request.tolerance) return answer(campaign, rows, request, quantities);
  return summary_text(study, rows, agreement) + fmt::format("  {:<16} {}/index.html\n", "page", campaign.folder);
}

}  // namespace tisserand::mechanism
