// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of a study: each is a child process. Its errors are measured and recorded before the next begins.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanism/histories/series.hpp"
#include "mechanism/study/cells.hpp"
#include "mechanism/study/journal.hpp"

namespace tisserand::mechanism {

struct StudyControl {
  std::function<bool()> interrupted;  ///< polled ten times a second and between runs
  std::function<double()> clock;      ///< [s]
};

/// Data that all runs of a campaign share.
struct Campaign {
  const formats::Study& study;
  const std::string& folder;
  Journal& journal;
  const StudyControl& control;
};

/// Reference histories of the errors.
struct ReferenceHistories {
  std::vector<Series> histories;  ///< one per quantity
  std::vector<double> agreement;  ///< error of the second reference run against the first; empty: there is none
};

/// Runs the references, or reads their file. Throws Error: a run failed, two disagree (with both values), a quantity is
/// not stored.
ReferenceHistories make_reference(Campaign& campaign, const std::vector<Cell>& references);

/// Median of the times of a cell and its confidence interval by order statistics, with a confidence of at least 3/4. Of
/// 3 to 5 runs it takes the least and the greatest, then the second of each end, and so on.
struct MedianTime {
  double median = 0.0, least = 0.0, greatest = 0.0;
};
MedianTime median_of(std::vector<double> seconds);

/// Whether a cell is complete: it failed, or its times are known as the study demands. That needs at least three runs
/// with the interval of the median within ± `within`, or `repeats` runs.
bool is_known(const formats::Study& study, const std::vector<RunRecord>& runs);

/// Makes the superelement files of the cells, each once. Throws Error.
void make_all_parts(const Campaign& campaign, const std::vector<Cell>& cells);

/// Histories of the quantities of a cell, which is run once more for them. Throws Error.
std::vector<Series> histories_of(const Campaign& campaign, const Cell& cell);

/// Runs what the journal lacks: one at a time if times count, else in parallel on the cores. Ends early when
/// interrupted. Throws Error if a part cannot be made.
void run_cells(Campaign& campaign, const std::vector<Cell>& cells, const ReferenceHistories& reference);

}  // namespace tisserand::mechanism
