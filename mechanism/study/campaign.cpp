// SPDX-License-Identifier: GPL-3.0-or-later
// Calls of `mechanism run` as child processes, and their results.
#include "mechanism/study/campaign.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>

#include "common/child.hpp"
#include "common/error.hpp"
#include "common/math/count.hpp"
#include "common/parallel.hpp"
#include "common/progress.hpp"
#include "common/text.hpp"
#include "formats/results/results.hpp"
#include "mechanism/study/measure.hpp"
#include "mechanism/study/parts.hpp"

namespace tisserand::mechanism {
namespace {

namespace fs = std::filesystem;

constexpr int fewest_repeats = 3;

std::string results_path(const std::string& folder, const Cell& cell) {
  return folder + "/runs/" + cell.key.substr(0, 16) + ".results.h5";
}

/// Message of a failed run, without the name of this program.
std::string reason_in(const std::string& complaint) {
  std::string text = complaint;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::string prefix = "mechanism: ";
  if (text.starts_with(prefix)) text.erase(0, prefix.size());
  return printable_line(text, 500);
}

void read_counts(const std::string& results, RunRecord& record) {
  const auto report = nlohmann::json::parse(formats::ResultsReader(results).report_json(), nullptr, false);
  if (!report.is_object()) return;
  record.steps = report.value("steps", 0L);
  record.iterations = report.value("iterations", 0L);
  if (const auto mobility = report.find("mobility"); mobility != report.end())
    record.coordinates = mobility->value("coordinates", 0);
}

/// Runs a cell in a child process. Its results are in results_path(); one thread at a time may read them. Returns false
/// if it was stopped from outside.
bool run_once(const Campaign& campaign, const Cell& cell, RunRecord& record) {
  const formats::StudySeries& series = campaign.study.series[cell.series];
  const std::string results = results_path(campaign.folder, cell);
  fs::create_directories(fs::path(results).parent_path());
  ChildRequest request;
  request.words = {own_program(), "run", series.scene, "-o", results};
  if (!series.analysis.empty()) request.words.insert(request.words.end(), {"--analysis", series.analysis});
  for (const std::string& word : setting_words(cell.settings)) request.words.push_back(word);
  request.seconds = campaign.study.run_budget;
  request.is_stopped = campaign.control.interrupted;
  const ChildReport report = run_child(request);
  if (report.ending == ChildEnding::stopped) return false;
  record.cpu_seconds = report.cpu_seconds;
  if (report.ending == ChildEnding::timed_out) {
    record.outcome = CellOutcome::over_budget;
    record.limit = campaign.study.run_budget;
    record.message = fmt::format("not finished within {:g} s", record.limit);
  } else if (report.ending == ChildEnding::killed) {
    if (campaign.control.interrupted && campaign.control.interrupted()) return false;
    record.outcome = CellOutcome::failed;
    record.message = fmt::format("ended by signal {}", report.code);
  } else if (report.code == 130) {
    return false;
  } else if (report.code != 0) {
    record.outcome = CellOutcome::failed;
    record.message = reason_in(report.complaint);
  }
  return true;
}

void remove_results(const Campaign& campaign, const Cell& cell) {
  std::error_code ignored;
  for (const char* ending : {"", ".part"}) fs::remove(results_path(campaign.folder, cell) + ending, ignored);
}

/// Measures the errors of a run. A run that cannot be measured counts as failed.
void measure(const Campaign& campaign, const Cell& cell, const ReferenceHistories& reference, RunRecord& record) {
  const std::string results = results_path(campaign.folder, cell);
  try {
    read_counts(results, record);
    const std::vector<Series> histories = read_quantities(results, cell.channels);
    for (std::size_t i = 0; i < histories.size(); ++i)
      record.errors.push_back(error_of(histories[i], reference.histories[i], campaign.study.quantities[i]));
  } catch (const Error& error) {
    record.outcome = CellOutcome::failed;
    record.message = printable_line(error.what(), 500);
  }
}

/// Runs a cell and records its errors. The lock also protects HDF5.
void run_cell(Campaign& campaign, const Cell& cell, const ReferenceHistories& reference, std::mutex& lock,
              double& used) {
  RunRecord record;
  if (!run_once(campaign, cell, record)) return remove_results(campaign, cell);
  const std::lock_guard guard(lock);
  if (record.outcome == CellOutcome::completed) measure(campaign, cell, reference, record);
  remove_results(campaign, cell);
  campaign.journal.add(cell.key, record);
  used += record.cpu_seconds;
}

bool is_interrupted(const Campaign& campaign) { return campaign.control.interrupted && campaign.control.interrupted(); }

/// Makes each part once, several at a time.
void make_parts(const Campaign& campaign, const std::vector<const Cell*>& cells) {
  std::set<std::string> known;
  std::vector<const PartRequest*> parts;
  for (const Cell* cell : cells)
    for (const PartRequest& part : cell->parts)
      if (!fs::exists(part.superelement) && known.insert(part.superelement).second) parts.push_back(&part);
  std::atomic<std::size_t> next{0};
  Progress progress("reducing parts", static_cast<double>(parts.size()));
  std::mutex reporting;
  on_threads(std::min(count_of(parts), core_count()) + (parts.empty() ? 1 : 0), [&](int) {
    for (std::size_t k = next++; k < parts.size() && !is_interrupted(campaign); k = next++) {
      reduce_part(*parts[k], campaign.control.interrupted);
      const std::lock_guard lock(reporting);
      progress.update(static_cast<double>(k + 1), parts[k]->name);
    }
  });
  if (!is_interrupted(campaign)) progress.finish();
}

/// Expected time of a cell, from the most similar cell that has run. A difference on the last axis counts double.
double expected_seconds(const Campaign& campaign, const std::vector<Cell>& cells, const Cell& cell) {
  double seconds = 0.0;
  int least = -1;
  for (const Cell& other : cells) {
    const std::vector<RunRecord>& runs = campaign.journal.runs(other.key);
    if (runs.empty() || other.series != cell.series) continue;
    int distance = 0;
    for (std::size_t i = 0; i < cell.values.size(); ++i)
      if (cell.values[i] != other.values[i]) distance += i + 1 == cell.values.size() ? 2 : 1;
    if (least >= 0 && distance >= least) continue;
    least = distance;
    seconds = runs.front().cpu_seconds;
  }
  return seconds;
}

/// Message on the remaining wall clock time. `slowness`: wall clock time over processor time.
std::string remaining_text(const Campaign& campaign, const std::vector<Cell>& cells, std::size_t done,
                           double slowness) {
  double seconds = 0.0, repeats = 0.0;
  int known = 0;
  for (const Cell& cell : cells) {
    const std::size_t runs = campaign.journal.runs(cell.key).size();
    repeats += static_cast<double>(runs);
    known += runs > 0 ? 1 : 0;
    if (runs == 0) seconds += expected_seconds(campaign, cells, cell);
  }
  seconds *= slowness * (known > 0 ? repeats / known : 1.0);
  return fmt::format("setting {} of {}, about {:.0f} s to go", done + 1, cells.size(), seconds);
}

}  // namespace

void make_all_parts(const Campaign& campaign, const std::vector<Cell>& cells) {
  std::vector<const Cell*> all;
  for (const Cell& cell : cells) all.push_back(&cell);
  make_parts(campaign, all);
}

std::vector<Series> histories_of(const Campaign& campaign, const Cell& cell) {
  RunRecord record;
  const bool has_ended = run_once(campaign, cell, record);
  if (!has_ended || record.outcome != CellOutcome::completed)
    throw Error(fmt::format("the run '{}' did not complete when it was repeated: {}", cell.label, record.message),
                campaign.study.file, "run the command again");
  std::vector<Series> histories = read_quantities(results_path(campaign.folder, cell), cell.channels);
  remove_results(campaign, cell);
  return histories;
}

MedianTime median_of(std::vector<double> seconds) {
  std::ranges::sort(seconds);
  const int n = count_of(seconds);
  if (n == 0) return {};
  // For any continuous distribution P(x_(k) <= median <= x_(n+1-k)) = 1 - 2 Σ_{i<k} C(n, i) / 2^n.
  double binomial = 1.0, tail = 0.0;
  int k = 0;
  while (k + 1 <= (n + 1) / 2) {
    tail += binomial * std::pow(0.5, n);
    if (k > 0 && 1.0 - 2.0 * tail < 0.75) break;
    binomial *= static_cast<double>(n - k) / (k + 1);
    ++k;
  }
  return {0.5 * (seconds[(n - 1) / 2] + seconds[n / 2]), seconds[k - 1], seconds[n - k]};
}

bool is_known(const formats::Study& study, const std::vector<RunRecord>& runs) {
  if (runs.empty()) return false;
  const RunRecord& last = runs.back();
  if (last.outcome == CellOutcome::over_budget) return study.run_budget > 0.0 && study.run_budget <= last.limit;
  if (last.outcome == CellOutcome::failed) return true;
  const int count = count_of(runs);
  if (study.timing == formats::StudyTiming::together || count >= study.repeats) return true;
  if (count < fewest_repeats) return false;
  std::vector<double> seconds;
  for (const RunRecord& run : runs) seconds.push_back(run.cpu_seconds);
  const MedianTime time = median_of(seconds);
  return std::max(time.greatest - time.median, time.median - time.least) <= study.within * time.median;
}

ReferenceHistories make_reference(Campaign& campaign, const std::vector<Cell>& references) {
  const formats::Study& study = campaign.study;
  if (references.empty()) return {read_reference_file(study), {}};
  make_parts(campaign,
             references.size() == 1 ? std::vector{&references[0]} : std::vector{&references[0], &references[1]});
  const Campaign apart{study, campaign.folder + "/references", campaign.journal, campaign.control};
  std::vector<const Cell*> left;
  for (const Cell& cell : references) {
    const std::string results = results_path(apart.folder, cell);
    if (!fs::exists(results) || !formats::ResultsReader(results).completed()) left.push_back(&cell);
  }
  on_threads(std::max(1, count_of(left)), [&](int k) {
    if (left.empty()) return;
    RunRecord record;
    if (run_once(apart, *left[k], record) && record.outcome != CellOutcome::completed)
      throw Error(fmt::format("the reference run '{}' failed: {}", left[k]->label, record.message), study.file,
                  "choose another reference");
  });
  if (is_interrupted(campaign)) return {};
  std::vector<std::vector<Series>> histories;
  for (const Cell& cell : references)
    histories.push_back(read_quantities(results_path(apart.folder, cell), cell.channels));
  ReferenceHistories reference{histories[0], {}};
  for (std::size_t i = 0; histories.size() > 1 && i < study.quantities.size(); ++i) {
    const formats::StudyQuantity& quantity = study.quantities[i];
    reference.agreement.push_back(error_of(histories[1][i], histories[0][i], quantity));
    if (reference.agreement[i] <= study.reference.agree) continue;
    throw Error(fmt::format("quantity '{}': the references disagree: {:.6g} ('{}') and {:.6g} ('{}') in its norm; they "
                            "differ by {:.2g} of the scale, more than {:g}",
                            quantity.name, size_of(histories[0][i], quantity), references[0].label,
                            size_of(histories[1][i], quantity), references[1].label, reference.agreement[i],
                            study.reference.agree),
                study.file, "refine the references, or find out which one is wrong");
  }
  return reference;
}

void run_cells(Campaign& campaign, const std::vector<Cell>& cells, const ReferenceHistories& reference) {
  const bool timed = campaign.study.timing == formats::StudyTiming::alone;
  std::vector<const Cell*> left;
  for (const Cell& cell : cells)
    if (!is_known(campaign.study, campaign.journal.runs(cell.key))) left.push_back(&cell);
  make_parts(campaign, left);
  const double begin = campaign.control.clock();
  Progress progress("study", 0.0);
  double used = 0.0;  // processor time [s]
  std::mutex writing;
  std::atomic<std::size_t> next{0};
  on_threads(timed ? 1 : core_count(), [&](int) {
    for (std::size_t k = next++; k < cells.size() && !is_interrupted(campaign); k = next++) {
      for (;;) {
        {
          const std::lock_guard lock(writing);
          if (is_known(campaign.study, campaign.journal.runs(cells[k].key))) break;
          const double slowness = used > 0.0 ? (campaign.control.clock() - begin) / used : 1.0;
          progress.update(0.0, remaining_text(campaign, cells, k, slowness));
        }
        if (is_interrupted(campaign)) return;
        run_cell(campaign, cells[k], reference, writing, used);
      }
    }
  });
  if (!is_interrupted(campaign)) progress.finish();
}

}  // namespace tisserand::mechanism
